// SPDX-License-Identifier: MIT
#include <radiosity/intake/join.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <radiosity/intake/t_joints.hpp>

namespace radiosity::intake {
namespace detail {

// An edge as seen from one of its faces.
struct FaceEdge {
  std::uint32_t low, high, group, face;

  [[nodiscard]] auto ends() const { return std::pair(low, high); }
};

// The edges of all faces, sorted by their vertices, then by group.
inline std::vector<FaceEdge> face_edges(std::span<const Face> faces) {
  std::vector<FaceEdge> edges;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const std::vector<std::uint32_t>& corners = faces[f].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]);
      edges.push_back({low, high, faces[f].group, f});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
    return std::tie(a.low, a.high, a.group, a.face) < std::tie(b.low, b.high, b.group, b.face);
  });
  return edges;
}

// The connected parts of groups, and where their borders meet.
class Borders {
 public:
  explicit Borders(std::span<const Face> faces) : edges_(face_edges(faces)), part_(faces.size()), open_(faces.size(), false) {
    each_edge([&](std::span<const FaceEdge> edge) {
      for (std::size_t i = 1; i < edge.size(); ++i) {
        if (edge[i].group == edge[i - 1].group) { part_.unite(edge[i].face, edge[i - 1].face); }
      }
    });
    each_edge([&](std::span<const FaceEdge> edge) {
      for (const FaceEdge& side : border_of(edge)) { open_[part_.find(side.face)] = true; }
    });
  }

  [[nodiscard]] bool open(std::uint32_t face) { return open_[part_.find(face)]; }

  // By face: the number of the shell that its part closes together with others, or none.
  [[nodiscard]] std::vector<std::uint32_t> shells() {
    while (leave_out_what_ends()) {}
    brep::detail::UnionFind joined(open_.size());
    std::vector<bool> closed(open_.size(), true);
    each_edge([&](std::span<const FaceEdge> edge) {
      const std::vector<FaceEdge> sides = border_of(edge);
      for (std::size_t i = 1; i < sides.size(); ++i) { joined.unite(part_.find(sides[i].face), part_.find(sides[0].face)); }
      if (sides.size() > 2) { closed[part_.find(sides[0].face)] = false; }
    });
    for (std::uint32_t f = 0; f < closed.size(); ++f) {
      if (!closed[f]) { closed[joined.find(f)] = false; }
    }
    std::vector<std::uint32_t> shell(open_.size(), none);
    for (std::uint32_t f = 0; f < shell.size(); ++f) {
      const std::uint32_t whole = joined.find(part_.find(f));
      if (open(f) && closed[whole]) { shell[f] = whole; }
    }
    return shell;
  }

 private:
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (std::size_t first = 0, end = 0; first < edges_.size(); first = end) {
      while (end < edges_.size() && edges_[end].ends() == edges_[first].ends()) { ++end; }
      visit(std::span(edges_).subspan(first, end - first));
    }
  }
  // The sides that belong to the border of their group; ignores parts that have been left out.
  [[nodiscard]] std::vector<FaceEdge> border_of(std::span<const FaceEdge> edge) {
    std::vector<FaceEdge> border;
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const bool several = (i > 0 && edge[i - 1].group == edge[i].group) || (i + 1 < edge.size() && edge[i + 1].group == edge[i].group);
      if (!several && !gone(edge[i].face)) { border.push_back(edge[i]); }
    }
    return border;
  }
  [[nodiscard]] bool gone(std::uint32_t face) { return !gone_.empty() && gone_[part_.find(face)]; }

  // Leaves out parts with a border edge that matches no other, because they cannot close a shell. This may leave other parts with such an
  // edge, so it is repeated while it returns true.
  bool leave_out_what_ends() {
    gone_.resize(open_.size(), false);
    std::vector<std::uint32_t> ends;
    each_edge([&](std::span<const FaceEdge> edge) {
      const std::vector<FaceEdge> sides = border_of(edge);
      if (sides.size() == 1) { ends.push_back(part_.find(sides[0].face)); }
    });
    for (const std::uint32_t part : ends) {
      gone_[part] = true;
      open_[part] = false;
    }
    return !ends.empty();
  }

  std::vector<FaceEdge> edges_;
  brep::detail::UnionFind part_;   // union-find over faces
  std::vector<bool> open_, gone_;  // by the face that represents a part
};

}  // namespace detail

HALFLIGHT_INLINE void join_groups(Working& mesh) {
  Working trial;  // only the open parts, as one shell
  trial.positions = mesh.positions;
  trial.tolerance = mesh.tolerance;
  std::vector<std::uint32_t> origin;
  std::uint32_t shells = 0;
  bool several = false;
  detail::Borders now(mesh.faces);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    shells = std::max(shells, mesh.faces[f].shell + 1);
    if (!now.open(f)) { continue; }
    several = several || (!origin.empty() && mesh.faces[origin[0]].group != mesh.faces[f].group);
    origin.push_back(f);
    trial.faces.push_back(mesh.faces[f]);
    trial.faces.back().shell = 0;
  }
  if (!several) { return; }
  close_t_joints(trial);
  const std::vector<std::uint32_t> shell = detail::Borders(trial.faces).shells();
  const std::uint32_t first = shells;
  for (std::size_t i = 0; i < shell.size(); ++i) {
    if (shell[i] != none) { mesh.faces[origin[i]].shell = first + shell[i]; }
  }
  close_t_joints(mesh, first);
}

}  // namespace radiosity::intake
