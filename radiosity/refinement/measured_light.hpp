// SPDX-License-Identifier: MIT
#pragma once

// The opinion of F-refinement about pairs with a lamp where the light on the other node is measured (discontinuity/light_meshing.hpp), in
// place of the light oracle's bounds. A node is split while its share of the relative L2 error is too large:
//
//     RMS variation of the reflected direct light over the node * sqrt(area of the node / area of the scene)
//         >  a quarter of light_epsilon * RMS of the reflected direct light over the scene
//
// A quarter, because the light oracle's bounds of a variation are several times too large as a rule. So n leaves that are split as far as
// this asks err by sqrt n times that together.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

class MeasuredLight {
 public:
  // Nothing is measured, and there is no opinion, unless the scene has a LightMeshing. The scene must outlive this; its hierarchy holds
  // clusters and input faces when it is made. `buried`: input faces that do not count; `scene_area` is that of the others.
  MeasuredLight(DiscreteScene& scene, const std::vector<bool>& buried, double scene_area, double light_epsilon, double min_area);

  // Of a pair with a lamp: the node on which the light is measured; else no_node.
  [[nodiscard]] std::uint32_t receiver(const NodePair& pair) const;
  // Is the lamp's radiosity the same all over, so that a link takes it as a whole, however large the form factor is?
  [[nodiscard]] bool takes_whole_lamp(const NodePair& pair) const;
  // Measures what has not been yet.
  void measure(const NodePairs& pairs);
  // Of a pair with a receiver that was measured: split it, or link.
  [[nodiscard]] Decision operator()(const NodePair& pair) const;

 private:
  void measure_nodes(std::vector<std::uint32_t> nodes);

  DiscreteScene* scene_;
  double min_area_;
  double least_ = 0.0;  // variance times area that is too much
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/measured_light.cpp>
#endif
