// SPDX-License-Identifier: MIT
#include <radiosity/intake/backs.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>

namespace radiosity::intake {
namespace detail {

struct FacePair {
  std::uint32_t front, back;
};

// The faces of one shell that have the same corners in opposite order. No two have the same corners in the same order.
inline std::vector<FacePair> opposite_faces(const Working& mesh) {
  struct Entry {
    std::uint32_t shell, face;
    std::vector<std::uint32_t> corners;  // in the lesser of both orders
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

}  // namespace detail

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
