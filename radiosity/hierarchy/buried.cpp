// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/buried.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>

namespace radiosity {

namespace detail {

// The convex solids of a scene, without rooms.
class ConvexSolids {
 public:
  explicit ConvexSolids(const std::vector<Surface>& surfaces) : surfaces_{&surfaces} {
    std::vector<raycast::Box> boxes;
    for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
      const raycast::PlacedObject& object = *surfaces[o].object;
      if (!object.convex() || !object.solid() || object.inside()) { continue; }
      solids_.push_back(o);
      boxes.push_back(object.bounds());
    }
    if (!solids_.empty()) { tree_ = raycast::Bvh{boxes}; }
  }

  // Does one of the solids contain the convex hull of these points and everything within `bulge` of it, deeper than the tolerance of
  // occlusion (raycast/scene.hpp)? Tests at most `most_asked` solids.
  [[nodiscard]] bool hold(const Polygon& points, double bulge, std::uint32_t owner) const {
    if (solids_.empty()) { return false; }
    raycast::Box box;
    for (const glm::dvec3& p : points) { box.extend(p); }
    const double margin = bulge + 4e-9 * (*surfaces_)[owner].object->bounds().diameter() + 1e-13;  // coordinates in the frame are about 1
    box = box.grown(margin);
    std::uint32_t asked = 0;
    const auto hold_them = [&](std::uint32_t item) {
      const raycast::PlacedObject& solid = *(*surfaces_)[solids_[item]].object;
      if (solids_[item] == owner || !solid.bounds().contains(box)) { return false; }
      ++asked;
      return holds(solid, points, margin);
    };
    return raycast::any_within(
        tree_, [&](const raycast::Box& around) { return asked < most_asked && around.contains(box); }, hold_them);
  }

 private:
  static constexpr std::uint32_t most_asked = 256;

  // Tests octahedra around the points. A sphere of radius r lies within the octahedron of size sqrt(3) r, and because the solid is
  // convex, it contains everything between octahedra that it contains.
  [[nodiscard]] static bool holds(const raycast::PlacedObject& solid, const Polygon& points, double margin) {
    const glm::dvec3 centre = solid.bounds().centre();
    const auto inside = [&](const glm::dvec3& p) {
      const raycast::Segment inwards{p, centre - p};
      if (!raycast::has_line(inwards)) { return true; }
      raycast::Spans spans;
      solid.spans(inwards, spans);
      return spans.size() == 1 && spans[0].in.t <= 0.0 && spans[0].out.t >= 0.0;
    };
    return std::all_of(points.begin(), points.end(), [&](glm::dvec3 p) {
      for (int k = 0; k < 3; ++k) {
        const double at = p[k];
        for (const double sign : {-1.0, 1.0}) {
          p[k] = at + sign * 1.7320508075688774 * margin;
          if (!inside(p)) { return false; }
        }
        p[k] = at;
      }
      return true;
    });
  }

  const std::vector<Surface>* surfaces_;
  std::vector<std::uint32_t> solids_;
  raycast::Bvh tree_;
};

}  // namespace detail

HALFLIGHT_INLINE std::vector<bool> buried_nodes(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy) {
  std::vector<bool> covered(surfaces.size(), false);
  for (const auto& pair : twins(surfaces)) { covered[pair[0]] = true; }
  const detail::ConvexSolids solids{surfaces};
  std::vector<bool> buried(hierarchy.size(), false);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children come after their parents
    const Node& node = hierarchy[i];
    if (is_input_face(hierarchy, i)) {
      buried[i] = covered[node.object] || solids.hold(contour(surfaces, hierarchy, static_cast<std::uint32_t>(i)),
                                                      node.radius * node.deviation + node.rim, node.object);
    } else if (node.is_cluster()) {
      buried[i] = true;
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { buried[i] = buried[i] && buried[c]; }
    }
  }
  return buried;
}

}  // namespace radiosity
