// SPDX-License-Identifier: MIT
#pragma once

// Input faces of which nothing can be seen, found before any pair of faces is looked at: of a thousand boxes at one place 999 are covered by
// the last, of nested boxes all but the outermost are in the dark. Refinement would split them all against each other, as near as they
// are, and only then find that nothing of them is exposed (exposure.hpp).
//
// Proven, in the sense of raycast::Scene::covered: a face is buried when a later object is the same surface at the same place, or when a
// convex solid holds its corners, and all that finer patches can bulge, deeper than any skin. Faces for which neither is found are treated
// as visible: of curved solids those with gaps to the next that are narrower than the bulge of its chord patches.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <brep/circulators.hpp>
#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

namespace detail {

// Pairs (earlier, later) of objects whose surfaces are the same: each corner of one is a corner of the other, or lies on it when it is
// curved, and the other way round, to 1e-9 of the size, and both face the same way. Compared are objects whose bounds agree to a millionth
// of the scene. Each object is the earlier one of one pair at most; no more than `most` pairs are looked for.
inline std::vector<std::array<std::uint32_t, 2>> twins(const std::vector<Surface>& surfaces,
                                                       std::size_t most = std::numeric_limits<std::size_t>::max()) {
  const auto object = [&](std::uint32_t o) -> const raycast::PlacedObject& { return *surfaces[o].object; };
  struct Place {
    std::array<double, 6> bounds;
    std::uint32_t object;
  };
  std::vector<Place> places;
  raycast::Box all;
  for (const Surface& surface : surfaces) { all.extend(surface.object->bounds()); }
  const double grid = 0x1p-20 * all.diameter();
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    const raycast::Box& box = object(o).bounds();
    Place place{{}, o};
    for (int k = 0; k < 3; ++k) {
      place.bounds[static_cast<std::size_t>(k)] = std::round(box.lo[k] / grid);
      place.bounds[static_cast<std::size_t>(k + 3)] = std::round(box.hi[k] / grid);
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.bounds != b.bounds ? a.bounds < b.bounds : a.object < b.object; });
  const auto corners = [&](std::uint32_t o) {
    std::vector<raycast::SurfacePoint> points;
    const SurfaceBRep& brep = surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t sheet = brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        const glm::dvec3& p = brep.data(brep.vertex(h)).position;
        points.push_back({p, object(o).project(sheet, p).normal});
      }
    }
    return points;
  };
  // Is every corner of a one of b, or, when b is curved, on b? What is the same comes in the same order, as a rule.
  const auto on = [&](std::uint32_t a, std::uint32_t b) {
    const raycast::PlacedObject& other = object(b);
    const double touch = 1e-9 * other.bounds().diameter() + other.slack() + object(a).slack();
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
  };
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first + 1;
    while (last < places.size() && places[last].bounds == places[first].bounds) { ++last; }
    // Each with the next one that is its twin, among the 64 that follow: of many at one place each covers the one before.
    for (std::size_t i = first; i < last && pairs.size() < most; ++i) {
      for (std::size_t k = i + 1; k < std::min(last, i + 65); ++k) {
        const std::uint32_t a = places[i].object;
        const std::uint32_t b = places[k].object;
        if (!on(a, b) || !on(b, a)) { continue; }
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

  // Does one of them hold the hull of these points and all that is nearer to it than `bulge`, deeper than any skin (raycast/scene.hpp)? At
  // most `most_asked` solids around it are asked.
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
  // A ball of this radius lies within the octahedron of sqrt 3 times the size; all that lies between such octahedra lies in the solid.
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

// Which input faces are proven to be buried, and which clusters have no other; by node. Time: n log n, and, among solids that hold each
// other, up to 256 solids a face.
[[nodiscard]] inline std::vector<bool> buried_nodes(const std::vector<Surface>& surfaces, const Hierarchy& hierarchy) {
  std::vector<bool> covered(surfaces.size(), false);
  for (const auto& pair : detail::twins(surfaces)) { covered[pair[0]] = true; }
  const detail::ConvexSolids solids{surfaces};
  std::vector<bool> buried(hierarchy.size(), false);
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children come after their parents
    const Node& node = hierarchy[i];
    if (is_input_face(hierarchy, i)) {
      buried[i] = covered[node.object] ||
                  solids.hold(contour(surfaces, hierarchy, static_cast<std::uint32_t>(i)), node.radius * node.deviation, node.object);
    } else if (node.is_cluster()) {
      buried[i] = true;
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { buried[i] = buried[i] && buried[c]; }
    }
  }
  return buried;
}

}  // namespace radiosity
