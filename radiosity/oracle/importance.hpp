// SPDX-License-Identifier: MIT
#pragma once

// How much the error of a node counts for the picture of one camera, beside its share of the area (importance; Smits, Arvo and Salesin
// 1992), before anything is solved. The camera may stand under a roof of six metres on a plain of four kilometres: of all surfaces that
// shadow is a millionth, of the picture it is all.
//
// Paths from the camera (audit/view_paths.hpp) leave points on the surfaces. A node with a part p of their weight and a part a of the
// area has the weight p / a / 10, times the squared ratio of what the scene and the picture reflect; at least 1 and at most 10 000. Where
// the points of a node lie together in a small part of it, that part counts, and the node is uneven: it has to be split before anything
// can be said of its light.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <raycast/object.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

struct ImportantPoint {
  std::uint32_t surface = 0;
  raycast::SurfacePoint at;
  double weight = 0.0;
};

class Importance {
 public:
  // All nodes count by their area.
  Importance() = default;
  // `contrast`: squared ratio of the light that the scene reflects, RMS over its area, to that of the picture. `area` of the scene.
  Importance(std::vector<ImportantPoint> points, double contrast, double area, std::size_t surfaces);

  // That ratio; 0 where all nodes count by their area.
  [[nodiscard]] double contrast() const { return contrast_; }

  // Takes in the nodes that have become leaves since, whose patches must be there: those of the first call, then the children of leaves
  // that were split.
  void extend(const Hierarchy& hierarchy, const Patches& patches);

  // How many times more the square of an error counts than by the area: at least 1.
  [[nodiscard]] double weight(std::uint32_t node) const { return node < nodes_.size() ? nodes_[node].weight : 1.0; }
  [[nodiscard]] bool uneven(std::uint32_t node) const { return node < nodes_.size() && nodes_[node].uneven; }

 private:
  struct Of {
    double weight = 1.0, mean = 0.0;  // mean: over the whole node, before it is held within limits
    bool uneven = false;
  };
  std::vector<ImportantPoint> points_;
  double contrast_ = 0.0;
  double scale_ = 0.0;  // weight of a unit of the points' weight on a unit of area
  std::size_t surfaces_ = 0;
  std::vector<Of> nodes_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/importance.cpp>
#endif
