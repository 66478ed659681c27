// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/buried.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// The bounds of an object to a millionth of the scene.
struct Place {
  std::array<double, 6> bounds;
  std::uint32_t object;
};

// Of all objects, equal bounds beside each other.
HALFLIGHT_INLINE std::vector<Place> sorted_places(const std::vector<Surface>& surfaces) {
  std::vector<Place> places;
  raycast::Box all;
  for (const Surface& surface : surfaces) { all.extend(surface.object->bounds()); }
  const double grid = 0x1p-20 * all.diameter();
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    const raycast::Box& box = surfaces[o].object->bounds();
    Place place{{}, o};
    for (int k = 0; k < 3; ++k) {
      place.bounds[static_cast<std::size_t>(k)] = std::round(box.lo[k] / grid);
      place.bounds[static_cast<std::size_t>(k + 3)] = std::round(box.hi[k] / grid);
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.bounds != b.bounds ? a.bounds < b.bounds : a.object < b.object; });
  return places;
}

// The corners of the faces with the normals of their sheets.
HALFLIGHT_INLINE std::vector<raycast::SurfacePoint> corners(const Surface& surface) {
  std::vector<raycast::SurfacePoint> points;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const std::uint32_t sheet = surface.brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
      const glm::dvec3& p = surface.brep.data(surface.brep.vertex(h)).position;
      points.push_back({p, surface.object->project(sheet, p).normal});
    }
  }
  return points;
}

// Is every corner of a one of b, or, when b is curved, on b? What is the same comes in the same order, as a rule.
HALFLIGHT_INLINE bool lies_in(const Surface& a, const Surface& b) {
  const raycast::PlacedObject& other = *b.object;
  const double touch = 1e-9 * other.bounds().diameter() + other.slack() + a.object->slack();
  const std::vector<raycast::SurfacePoint> of_a = corners(a);
  const std::vector<raycast::SurfacePoint> of_b = other.exact() ? corners(b) : std::vector<raycast::SurfacePoint>{};
  const std::size_t count = other.exact() ? of_b.size() : other.sheet_count();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    bool found = false;
    for (std::size_t k = 0; k < count && !found; ++k) {
      const std::size_t j = (i + k) % count;
      const auto q = other.exact() ? of_b[j] : other.project(static_cast<std::uint32_t>(j), of_a[i].position);
      found = glm::length(q.position - of_a[i].position) <= touch && glm::dot(q.normal, of_a[i].normal) > 0.999;
    }
    if (!found) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE std::vector<std::array<std::uint32_t, 2>> twins(const std::vector<Surface>& surfaces, std::size_t most) {
  const std::vector<Place> places = sorted_places(surfaces);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first + 1;
    while (last < places.size() && places[last].bounds == places[first].bounds) { ++last; }
    // Each with the next one that is its twin, among the 64 that follow: of many at one place each covers the one before.
    for (std::size_t i = first; i < last && pairs.size() < most; ++i) {
      for (std::size_t k = i + 1; k < std::min(last, i + 65); ++k) {
        const std::uint32_t a = places[i].object;
        const std::uint32_t b = places[k].object;
        if (!lies_in(surfaces[a], surfaces[b]) || !lies_in(surfaces[b], surfaces[a])) { continue; }
        pairs.push_back({a, b});
        break;
      }
    }
    first = last;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The convex solids of a scene, rooms left out.
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

  // Does one of them hold the hull of these points and all that is nearer to it than `bulge`, deeper than the tolerance of occlusion
  // (raycast/scene.hpp)? At most `most_asked` solids around it are asked.
  [[nodiscard]] bool hold(const Polygon& points, double bulge, std::uint32_t owner) const {
    if (solids_.empty()) { return false; }
    raycast::Box box;
    for (const glm::dvec3& p : points) { box.extend(p); }
    const double margin = bulge + 4e-9 * (*surfaces_)[owner].object->bounds().diameter() + 1e-13;  // the frame makes coordinates of size 1
    box = box.grown(margin);
    std::uint32_t asked = 0;
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty() && asked < most_asked) {
      const raycast::Bvh::Node& node = tree_.nodes()[stack.back()];
      stack.pop_back();
      if (!around(node.box, box)) { continue; }
      if (node.count == 0) {
        stack.insert(stack.end(), {node.first, node.first + 1});
        continue;
      }
      for (const std::uint32_t item : tree_.items(node)) {
        const raycast::PlacedObject& solid = *(*surfaces_)[solids_[item]].object;
        if (solids_[item] == owner || !around(solid.bounds(), box)) { continue; }
        ++asked;
        if (holds(solid, points, margin)) { return true; }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t most_asked = 256;

  [[nodiscard]] static bool around(const raycast::Box& outer, const raycast::Box& box) {
    return glm::all(glm::lessThanEqual(outer.lo, box.lo)) && glm::all(glm::lessThanEqual(box.hi, outer.hi));
  }
  // A sphere of this radius lies within the octahedron of sqrt 3 times the size; all that lies between such octahedra lies in the solid.
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
  for (const auto& pair : detail::twins(surfaces)) { covered[pair[0]] = true; }
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
