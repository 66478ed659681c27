// SPDX-License-Identifier: MIT
#pragma once

// The importance of a node's error for the picture of one camera, beyond its share of the area (importance; Smits, Arvo and Salesin
// 1992), estimated before anything is solved. Example: the camera stands under a roof of six metres on a plain of four kilometres. The
// shadow of the roof is a millionth of all surfaces, but fills the picture.
//
// Paths from the camera (audit/view_paths.hpp) leave points on the surfaces. A node with the share p of their weight and the share a of
// the area has the weight p / a / 10, times the squared ratio of the light reflected in the scene to that in the picture, limited to 1
// ... 10 000. If the points of a node are concentrated in a small part of it, the area of that part is used, and the node is called
// uneven: it must be split before its light can be judged.

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
  // All nodes have weight 1: errors count by area.
  Importance() = default;
  // `contrast`: squared ratio of the reflected light of the scene (RMS over its area) to that of the picture. `area`: of the scene.
  Importance(std::vector<ImportantPoint> points, double contrast, double area, std::size_t surfaces);

  // That ratio; 0 if errors count by area.
  [[nodiscard]] double contrast() const { return contrast_; }

  // Adds the nodes that have become leaves since the last call (at first all leaves, later the children of split leaves). Their patches
  // must exist.
  void extend(const Hierarchy& hierarchy, const Patches& patches);

  // Factor by which a squared error counts more than by area; at least 1.
  [[nodiscard]] double weight(std::uint32_t node) const { return node < nodes_.size() ? nodes_[node].weight : 1.0; }
  [[nodiscard]] bool uneven(std::uint32_t node) const { return node < nodes_.size() && nodes_[node].uneven; }

 private:
  struct Of {
    double weight = 1.0, mean = 0.0;  // mean over the whole node, before limiting
    bool uneven = false;
  };
  std::vector<ImportantPoint> points_;
  double contrast_ = 0.0;
  double scale_ = 0.0;  // factor from the weight of points per area to the weight of a node
  std::size_t surfaces_ = 0;
  std::vector<Of> nodes_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/importance.cpp>
#endif
