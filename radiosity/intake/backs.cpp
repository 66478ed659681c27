// SPDX-License-Identifier: MIT
#include <radiosity/intake/backs.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <radiosity/intake/clean.hpp>

namespace radiosity::intake {
namespace detail {

struct FacePair {
  std::uint32_t front, back;
};

// Pairs of faces of one shell with the same corners in opposite order. No two faces have the same corners in the same order.
inline std::vector<FacePair> opposite_faces(const Working& mesh) {
  struct Entry {
    std::uint32_t shell, face;
    std::vector<std::uint32_t> corners;  // canonical order of the corners or of the reversed corners, whichever is less
  };
  std::vector<Entry> entries;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    std::vector<std::uint32_t> ahead = canonical(mesh.faces[f].corners), reversed = mesh.faces[f].corners;
    std::reverse(reversed.begin(), reversed.end());
    reversed = canonical(std::move(reversed));
    entries.push_back({mesh.faces[f].shell, f, std::min(ahead, reversed)});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.shell, a.corners, a.face) < std::tie(b.shell, b.corners, b.face); });
  std::vector<FacePair> pairs;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const Entry &a = entries[i - 1], &b = entries[i];
    if (a.shell == b.shell && a.corners == b.corners) { pairs.push_back({a.face, b.face}); }
  }
  return pairs;
}

template <class Visit>
void each_edge_of(const Face& face, const Visit& visit) {
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const auto [low, high] = std::minmax(face.corners[i], face.corners[i + 1 < face.corners.size() ? i + 1 : 0]);
    visit(std::tuple(face.shell, low, high));
  }
}

// The triangles of a mesh by their corners and by their sides, and the number of faces at each edge.
struct Triangles {
  // Shell, and the three corners or the two ends of a side.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  std::map<Key, std::uint32_t> by_corners, by_side;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> faces_of;  // shell, edge

  explicit Triangles(const Working& mesh) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      each_edge_of(mesh.faces[f], [&](const auto& edge) { ++faces_of[edge]; });
      const std::vector<std::uint32_t> c = canonical(mesh.faces[f].corners);
      if (c.size() != 3) { continue; }
      by_corners.emplace(Key{mesh.faces[f].shell, c[0], c[1], c[2]}, f);
      for (std::size_t i = 0; i < 3; ++i) { by_side.emplace(Key{mesh.faces[f].shell, c[i], c[(i + 1) % 3], 0}, f); }
    }
  }
  [[nodiscard]] std::uint32_t with_corners(std::uint32_t shell, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const std::vector<std::uint32_t> k = canonical({a, b, c});
    const auto found = by_corners.find(Key{shell, k[0], k[1], k[2]});
    return found == by_corners.end() ? none : found->second;
  }
  [[nodiscard]] std::uint32_t with_side(std::uint32_t shell, std::uint32_t a, std::uint32_t b) const {
    const auto found = by_side.find(Key{shell, a, b, 0});
    return found == by_side.end() ? none : found->second;
  }
  // Do the four triangles form a closed surface, that is, does no edge have another face?
  [[nodiscard]] bool closed(const Working& mesh, const std::array<std::uint32_t, 4>& four) const {
    bool only_these = true;
    for (const std::uint32_t f : four) {
      each_edge_of(mesh.faces[f], [&](const auto& edge) { only_these = only_these && faces_of.at(edge) == 2; });
    }
    return only_these;
  }
};

}  // namespace detail

HALFLIGHT_INLINE void match_diagonals(Working& mesh) {
  const detail::Triangles triangles(mesh);
  std::vector<bool> done(mesh.faces.size(), false);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3 && mesh.faces[f].corners.size() == 3 && !done[f]; ++i) {
      Face& first = mesh.faces[f];
      const std::uint32_t x = first.corners[i], y = first.corners[(i + 1) % 3], p = first.corners[(i + 2) % 3];
      const std::uint32_t g = triangles.with_side(first.shell, y, x);
      if (g == none || g == f || done[g] || mesh.faces[g].material != first.material) { continue; }
      Face& second = mesh.faces[g];  // x and y are the ends of this diagonal, p and q those of the other one
      const auto opposite = std::find_if(second.corners.begin(), second.corners.end(), [&](auto v) { return v != x && v != y; });
      if (opposite == second.corners.end() || *opposite == p) { continue; }
      const std::uint32_t q = *opposite, a = triangles.with_corners(first.shell, x, p, q), b = triangles.with_corners(first.shell, p, y, q);
      if (a == none || b == none || done[a] || done[b]) { continue; }
      const glm::dvec3 up = brep::vector_area(mesh.outline(first));
      const auto looks = [&](std::uint32_t face) { return glm::dot(brep::vector_area(mesh.outline(mesh.faces[face])), up); };
      if (!(looks(g) > 0.0 && looks(a) < 0.0 && looks(b) < 0.0)) { continue; }
      // If the four triangles are closed and not nearly planar, they are the surface of a tetrahedron.
      const glm::dvec3* const at = mesh.positions.data();
      if (triangles.closed(mesh, {f, g, a, b}) && !nearly_sound(std::array{at[x], at[q], at[y], at[p]}, mesh.tolerance)) { continue; }
      done[f] = done[g] = done[a] = done[b] = true;
      const Face before = first;
      first.corners = {x, q, p};
      second.corners = {q, y, p};
      first.stand_for(second);  // each of the two new triangles covers parts of both polygons
      second.stand_for(before);
    }
  }
}

HALFLIGHT_INLINE void join_backs(Working& mesh) {
  const std::vector<detail::FacePair> pairs = detail::opposite_faces(mesh);
  if (pairs.empty()) { return; }
  std::vector<bool> gone(mesh.faces.size(), false);
  for (const detail::FacePair& pair : pairs) { gone[pair.back] = true; }
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> left;  // shell, edge: faces that remain
  for (const detail::FacePair& pair : pairs) {
    detail::each_edge_of(mesh.faces[pair.front], [&](const auto& edge) { left[edge] = 0; });
  }
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (gone[f]) { continue; }
    detail::each_edge_of(mesh.faces[f], [&](const auto& edge) {
      if (const auto found = left.find(edge); found != left.end()) { ++found->second; }
    });
  }
  for (const auto& [front, back] : pairs) {
    bool fits = true;
    detail::each_edge_of(mesh.faces[front], [&](const auto& edge) { fits = fits && left[edge] <= 2; });
    gone[back] = fits;
    if (!fits) { continue; }
    Face other = mesh.faces[back];
    mesh.faces[front].back = other.material;
    other.turn();
    mesh.faces[front].more.push_back({other.polygon, other.turned, true});
    for (Source source : other.more) {
      source.back = !source.back;
      mesh.faces[front].more.push_back(source);
    }
  }
  std::erase_if(mesh.faces, [&](const Face& face) { return gone[static_cast<std::size_t>(&face - mesh.faces.data())]; });
}

HALFLIGHT_INLINE void settle_backs(Working& mesh, const Topology& topology) {
  std::vector<bool> closed(topology.components, true), without(topology.components, false);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::uint32_t component = topology.component[f];
    without[component] = without[component] || mesh.faces[f].back == none;
    for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) {
      closed[component] = closed[component] && topology.mate[s] != none;
    }
  }
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].back == none || !closed[topology.component[f]] || !without[topology.component[f]]) { continue; }
    leave_out_backs(mesh, mesh.faces[f]);
    mesh.faces[f].back = none;
  }
}

HALFLIGHT_INLINE void leave_out_backs(Working& mesh, const Face& face) {
  for (const Source& source : face.more) {
    if (source.back) { mesh.changed(ChangeKind::duplicate, source.polygon); }
  }
}

}  // namespace radiosity::intake
