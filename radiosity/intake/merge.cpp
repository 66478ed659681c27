// SPDX-License-Identifier: MIT
#include <radiosity/intake/merge.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/planar.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/intake/clean.hpp>

namespace radiosity::intake {
namespace detail {

inline constexpr std::size_t longest_outline = 512;  // the search for self-intersections is quadratic
inline constexpr double tol_straight = 1e-4;         // sine of the angle of a corner that counts as straight

class Merger {
 public:
  Merger(Working& mesh, const Topology& topology)
      : mesh_(mesh), topology_(topology), region_(mesh.faces.size(), none), gone_(mesh.faces.size(), false) {
    face_of_.resize(topology.mate.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) { face_of_[s] = f; }
      planes_.push_back(raycast::plane_of(mesh.outline(mesh.faces[f])));
    }
  }

  void run() {
    std::vector<double> area;
    for (const Face& face : mesh_.faces) { area.push_back(brep::area(mesh_.outline(face))); }
    std::vector<std::uint32_t> order(mesh_.faces.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return std::pair(-area[a], a) < std::pair(-area[b], b); });
    for (const std::uint32_t seed : order) {
      if (region_[seed] != none) { continue; }
      grow(seed);
      if (faces_.size() > 1) { merge_region(seed); }
    }
    flatten_merged();
    take_away_straight_corners(mesh_);
  }

 private:
  struct Merged {
    Face face;
    std::vector<std::uint32_t> parts;
  };

  // Collects the faces connected with the seed that lie in its plane.
  void grow(std::uint32_t seed) {
    const Face& first = mesh_.faces[seed];
    const raycast::Plane& plane = planes_[seed];
    const double height = std::min(mesh_.tolerance, 1e-4 * brep::extent(mesh_.outline(first)));
    const auto fits = [&](std::uint32_t f) {
      const Face& face = mesh_.faces[f];
      if (face.material != first.material || face.back != first.back || face.group != first.group || face.mixed != first.mixed) {
        return false;
      }
      const glm::dvec3& normal = planes_[f].normal;
      if (!(glm::dot(normal, plane.normal) > 0.0 && glm::length(glm::cross(normal, plane.normal)) < raycast::tol_plane_angle)) {
        return false;
      }
      return std::all_of(face.corners.begin(), face.corners.end(),
                         [&](std::uint32_t v) { return std::abs(glm::dot(mesh_.positions[v] - plane.point, plane.normal)) <= height; });
    };
    faces_.assign(1, seed);
    region_[seed] = seed;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      for (std::uint32_t s = topology_.first[faces_[i]]; s < topology_.first[faces_[i] + 1]; ++s) {
        if (topology_.mate[s] == none) { continue; }
        const std::uint32_t f = face_of_[topology_.mate[s]];
        if (region_[f] != none || !fits(f)) { continue; }
        region_[f] = seed;
        faces_.push_back(f);
      }
    }
  }

  [[nodiscard]] std::uint32_t corner(std::uint32_t side) const {
    return mesh_.faces[face_of_[side]].corners[side - topology_.first[face_of_[side]]];
  }
  [[nodiscard]] bool within(std::uint32_t side, std::uint32_t region) const {
    return topology_.mate[side] != none && region_[face_of_[topology_.mate[side]]] == region;
  }

  void merge_region(std::uint32_t seed) {
    if (auto outline = single_outline(seed)) { return keep(std::move(*outline), faces_); }
    merge_convex(seed);
  }

  void keep(std::vector<std::uint32_t> outline, const std::vector<std::uint32_t>& parts) {
    // The first polygon, because faces are in the order of their polygons.
    const std::uint32_t first = *std::min_element(parts.begin(), parts.end());
    Merged merged{mesh_.faces[first], parts};
    merged.face.corners = std::move(outline);
    for (const std::uint32_t f : parts) {
      if (f != first) { merged.face.stand_for(mesh_.faces[f]); }
      gone_[f] = true;
    }
    merged_.push_back(std::move(merged));
  }

  // The outline of the region, if it is a single simple polygon.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> single_outline(std::uint32_t seed) {
    std::unordered_map<std::uint32_t, std::uint32_t> begins;  // from a vertex to the border side that begins there
    std::uint32_t start = none;
    for (const std::uint32_t f : faces_) {
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        if (within(s, seed)) { continue; }
        if (!begins.emplace(corner(s), s).second || begins.size() > longest_outline) { return std::nullopt; }
        start = std::min(start, s);
      }
    }
    std::vector<std::uint32_t> outline;
    if (start == none) { return std::nullopt; }
    std::uint32_t side = start;
    do {
      outline.push_back(corner(side));
      const auto next = begins.find(corner(topology_.next(side, face_of_[side])));
      if (next == begins.end() || outline.size() > begins.size()) { return std::nullopt; }
      side = next->second;
    } while (side != start);
    if (outline.size() != begins.size() || !nearly_sound(mesh_.outline(outline), mesh_.tolerance)) { return std::nullopt; }
    return outline;
  }

  // Joins faces across their common sides, the longest first, as long as the result is convex.
  void merge_convex(std::uint32_t seed) {
    struct Part {
      std::vector<std::uint32_t> corners, faces;
    };
    std::unordered_map<std::uint32_t, Part> parts;  // by the face that represents the part
    std::unordered_map<std::uint32_t, std::uint32_t> stands_for;
    std::vector<std::pair<double, std::uint32_t>> sides;
    for (const std::uint32_t f : faces_) {
      parts[f] = {mesh_.faces[f].corners, {f}};
      stands_for[f] = f;
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        if (!within(s, seed) || topology_.mate[s] < s) { continue; }
        const glm::dvec3 along = mesh_.positions[corner(s)] - mesh_.positions[corner(topology_.next(s, f))];
        sides.emplace_back(-glm::dot(along, along), s);
      }
    }
    std::sort(sides.begin(), sides.end());
    for (const auto& [length, s] : sides) {
      const std::uint32_t a = stands_for[face_of_[s]], b = stands_for[face_of_[topology_.mate[s]]];
      if (a == b) { continue; }
      auto joined = join(parts[a].corners, parts[b].corners, corner(s), corner(topology_.next(s, face_of_[s])));
      if (!joined) { continue; }
      Part& larger = parts[a].faces.size() >= parts[b].faces.size() ? parts[a] : parts[b];
      Part& smaller = &larger == &parts[a] ? parts[b] : parts[a];
      const std::uint32_t name = &larger == &parts[a] ? a : b;
      for (const std::uint32_t f : smaller.faces) { stands_for[f] = name; }
      larger.faces.insert(larger.faces.end(), smaller.faces.begin(), smaller.faces.end());
      larger.corners = std::move(*joined);
      smaller = {};
    }
    for (const std::uint32_t f : faces_) {
      Part& part = parts[f];
      if (part.faces.size() > 1) { keep(std::move(part.corners), part.faces); }
    }
  }

  // Joins two polygons across the side from u to v of the first one; nothing if the result is not convex.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> join(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b, std::uint32_t u,
                                                               std::uint32_t v) {
    if (a.size() + b.size() > longest_outline) { return std::nullopt; }
    std::rotate(a.begin(), std::find(a.begin(), a.end(), v), a.end());  // v ... u
    std::rotate(b.begin(), std::find(b.begin(), b.end(), u), b.end());  // u ... v
    if (a.back() != u || b.back() != v) { return std::nullopt; }
    a.insert(a.end(), b.begin() + 1, b.end() - 1);
    // If they have more sides in common, the joined outline runs there and back (a b a); such spikes are removed.
    for (bool spike = true; spike && a.size() > 3;) {
      spike = false;
      for (std::size_t i = 0; i < a.size() && a.size() > 3; ++i) {
        const std::size_t n = a.size();
        if (a[i] != a[(i + 2) % n]) { continue; }
        const std::uint32_t tip = a[(i + 1) % n], twice = a[i];
        a.erase(std::find(a.begin(), a.end(), tip));
        a.erase(std::find(a.begin(), a.end(), twice));
        spike = true;
        break;
      }
    }
    std::vector<std::uint32_t> sorted = a;
    std::sort(sorted.begin(), sorted.end());
    if (a.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) { return std::nullopt; }
    const std::span<const glm::dvec3> outline = mesh_.outline(a);
    if (!brep::is_convex(outline) || raycast::plane_of(outline).slack > mesh_.tolerance) { return std::nullopt; }
    return a;
  }

  void flatten_merged() {
    std::vector<Face> before = std::move(mesh_.faces);
    mesh_.faces.clear();
    for (std::size_t f = 0; f < before.size(); ++f) {
      if (!gone_[f]) { mesh_.faces.push_back(before[f]); }
    }
    const std::size_t others = mesh_.faces.size();
    for (const Merged& merged : merged_) { mesh_.faces.push_back(merged.face); }
    flatten(mesh_);
    std::vector<Face> faces(mesh_.faces.begin(), mesh_.faces.begin() + static_cast<std::ptrdiff_t>(others));
    for (const Merged& merged : merged_) {
      if (raycast::polygon_fault(mesh_.outline(merged.face))) {
        for (const std::uint32_t f : merged.parts) { faces.push_back(before[f]); }
      } else {
        mesh_.changed(ChangeKind::merged, merged.face.polygon, 0.0, merged.parts.size() - 1);
        faces.push_back(merged.face);
      }
    }
    std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.polygon < b.polygon; });
    mesh_.faces = std::move(faces);
  }

 public:
  // A corner is removed if it is straight in all faces that have it, and these are at most two.
  static void take_away_straight_corners(Working& mesh) {
    struct Seen {
      std::uint32_t faces = 0, low = none, high = none;  // low, high: the adjacent corners
      bool straight = true;
    };
    std::vector<Seen> seen(mesh.positions.size());
    const auto beside = [](const std::vector<std::uint32_t>& corners, std::size_t i) {
      const std::size_t n = corners.size();
      return std::pair(corners[(i + n - 1) % n], corners[(i + 1) % n]);
    };
    for (const Face& face : mesh.faces) {
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        Seen& vertex = seen[face.corners[i]];
        const auto [before, after] = beside(face.corners, i);
        const auto [low, high] = std::minmax(before, after);
        const glm::dvec3 u = mesh.positions[face.corners[i]] - mesh.positions[before],
                         w = mesh.positions[after] - mesh.positions[face.corners[i]];
        const double sine = glm::length(glm::cross(u, w)) / (glm::length(u) * glm::length(w));
        const bool straight =
            glm::dot(u, w) > 0.0 && sine <= tol_straight && sine * std::min(glm::length(u), glm::length(w)) <= mesh.tolerance;
        vertex.straight = vertex.straight && straight && (vertex.faces == 0 || (vertex.low == low && vertex.high == high));
        vertex.low = low, vertex.high = high;
        ++vertex.faces;
      }
    }
    for (Face& face : mesh.faces) {
      const auto bent =
          std::count_if(face.corners.begin(), face.corners.end(), [&](auto v) { return !seen[v].straight || seen[v].faces > 2; });
      if (bent < 3) {  // keep the corners of a face that would otherwise vanish
        for (const std::uint32_t v : face.corners) { seen[v].straight = false; }
      }
    }
    for (Face& face : mesh.faces) {
      std::erase_if(face.corners, [&](std::uint32_t v) { return seen[v].straight && seen[v].faces <= 2; });
    }
  }

 private:
  Working& mesh_;
  const Topology& topology_;
  std::vector<raycast::Plane> planes_;
  std::vector<std::uint32_t> face_of_, region_;
  std::vector<bool> gone_;
  std::vector<std::uint32_t> faces_;  // faces of the current region
  std::vector<Merged> merged_;
};

}  // namespace detail

HALFLIGHT_INLINE void merge_coplanar(Working& mesh, const Topology& topology) { detail::Merger(mesh, topology).run(); }

}  // namespace radiosity::intake
