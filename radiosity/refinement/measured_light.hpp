// SPDX-License-Identifier: MIT
#pragma once

// Decides in F-refinement about pairs with a lamp if the direct light on the other node has been measured
// (discontinuity/light_meshing.hpp), instead of the light oracle's bounds. A node is split while its share of the relative L2 error is
// too large:
//
//     RMS variation of the reflected direct light over the node * sqrt(area of the node / area of the scene)
//         >  a quarter of light_epsilon * RMS of the reflected direct light over the scene
//
// The factor of a quarter is used because the light oracle's bounds of a variation are usually several times too large. n leaves that
// just meet this limit have sqrt(n) times that error together.

#include <cstdint>
#include <vector>

#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

class MeasuredLight {
 public:
  // If the scene has no LightMeshing, nothing is measured and nothing decided. `scene` must outlive this; its hierarchy then holds only
  // clusters and input faces. `buried`: input faces that do not count; `scene_area`: area of the others.
  MeasuredLight(DiscreteScene& scene, const std::vector<bool>& buried, double scene_area, double light_epsilon, double min_area);

  // For a pair with a lamp: the node on which the light is measured; otherwise no_node.
  [[nodiscard]] std::uint32_t receiver(const NodePair& pair) const;
  // Is the lamp's radiosity constant, so that a link can take the lamp as a whole, however large the form factor is?
  [[nodiscard]] bool takes_whole_lamp(const NodePair& pair) const;
  // Measures the light for those of these pairs for which it is not known yet.
  void measure(const NodePairs& pairs);
  // For a pair whose receiver has been measured: split it, or link.
  [[nodiscard]] Decision operator()(const NodePair& pair) const;

 private:
  void measure_nodes(std::vector<std::uint32_t> nodes);

  DiscreteScene* scene_;
  double min_area_;
  double least_ = 0.0;  // limit of variance times area
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/measured_light.cpp>
#endif
