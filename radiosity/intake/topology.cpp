// SPDX-License-Identifier: MIT
#include <radiosity/intake/topology.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>
#include <brep/union_find.hpp>

namespace radiosity::intake {
namespace detail {

// A side of a face, as a use of the edge between two vertices.
struct Use {
  std::uint32_t shell, low, high;
  std::uint32_t side, face;
  bool up;  // does it run from low to high?

  [[nodiscard]] auto key() const { return std::tie(shell, low, high); }
};

// All uses sorted by edge; `first`: the first side of each face.
inline std::vector<Use> uses_of(const Working& mesh, std::vector<std::uint32_t>& first) {
  std::vector<Use> uses;
  first.clear();
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<std::uint32_t>& corners = mesh.faces[f].corners;
    first.push_back(static_cast<std::uint32_t>(uses.size()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i], b = corners[i + 1 < corners.size() ? i + 1 : 0];
      uses.push_back({mesh.faces[f].shell, std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(uses.size()), f, a < b});
    }
  }
  first.push_back(static_cast<std::uint32_t>(uses.size()));
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return std::tuple(a.key(), a.side) < std::tuple(b.key(), b.side); });
  return uses;
}

// Calls visit with the uses of each edge.
template <class Visit>
void each_edge(std::span<const Use> uses, Visit&& visit) {
  for (std::size_t first = 0, end = 0; first < uses.size(); first = end) {
    while (end < uses.size() && uses[end].key() == uses[first].key()) { ++end; }
    visit(uses.subspan(first, end - first));
  }
}

// Are the faces the two sides of one sheet: the same corners in opposite order?
inline bool back_to_back(const Face& a, const Face& b) {
  const std::size_t n = a.corners.size();
  if (n != b.corners.size()) { return false; }
  const auto at = std::find(b.corners.begin(), b.corners.end(), a.corners[0]);
  if (at == b.corners.end()) { return false; }
  const auto shift = static_cast<std::size_t>(at - b.corners.begin());
  for (std::size_t i = 0; i < n; ++i) {
    if (a.corners[i] != b.corners[(shift + n - i) % n]) { return false; }
  }
  return true;
}

class Joiner {
 public:
  explicit Joiner(Working& mesh) : mesh_(mesh), uses_(uses_of(mesh, topology_.first)), loose_(mesh.faces.size(), false) {
    topology_.mate.assign(uses_.size(), none);
    face_of_.resize(uses_.size());
    for (const Use& use : uses_) { face_of_[use.side] = use.face; }
  }

  Topology run(bool report) {
    each_edge(uses_, [&](std::span<const Use> edge) { join(edge, report); });
    for (bool again = true; again;) {
      part_fans();
      const std::size_t before = loosened_;
      loosen(report);
      again = loosened_ != before;
    }
    brep::detail::UnionFind components(mesh_.faces.size());
    for (std::uint32_t s = 0; s < topology_.mate.size(); ++s) {
      if (topology_.mate[s] != none) { components.unite(face_of_[s], face_of_[topology_.mate[s]]); }
    }
    topology_.components = components.enumerate(topology_.component);
    return std::move(topology_);
  }

 private:
  void join(std::span<const Use> edge, bool report) {
    if (edge.size() == 2) {
      if (edge[0].up != edge[1].up && !back_to_back(mesh_.faces[edge[0].face], mesh_.faces[edge[1].face])) { mate(edge[0], edge[1]); }
      return;
    }
    if (edge.size() == 1) { return; }
    if (std::vector<Use> rest = mate_pieces(edge); rest.size() < edge.size()) {
      if (!rest.empty()) { join(rest, report); }
      return;
    }
    const auto up = static_cast<std::size_t>(std::count_if(edge.begin(), edge.end(), [](const Use& use) { return use.up; }));
    if (2 * up == edge.size() && edge.size() <= 16 && join_around(edge)) { return; }
    if (report) { mesh_.changed(ChangeKind::nonmanifold, mesh_.faces[edge[0].face].polygon); }
  }

  // Where solids touch in an edge, each is usually a separate piece. If a piece has exactly two sides at the edge, these become
  // neighbours, whatever the orientation of the other pieces. Returns the remaining uses.
  std::vector<Use> mate_pieces(std::span<const Use> edge) {
    std::vector<Use> rest(edge.begin(), edge.end());
    const auto piece = [&](const Use& use) { return mesh_.faces[use.face].piece; };
    std::stable_sort(rest.begin(), rest.end(), [&](const Use& a, const Use& b) { return piece(a) < piece(b); });
    std::vector<Use> left;
    for (std::size_t first = 0, end = 0; first < rest.size(); first = end) {
      while (end < rest.size() && piece(rest[end]) == piece(rest[first])) { ++end; }
      const bool pair = piece(rest[first]) != none && end == first + 2 && rest[first].up != rest[first + 1].up &&
                        !back_to_back(mesh_.faces[rest[first].face], mesh_.faces[rest[first + 1].face]);
      if (pair) {
        mate(rest[first], rest[first + 1]);
      } else {
        left.insert(left.end(), rest.begin() + static_cast<std::ptrdiff_t>(first), rest.begin() + static_cast<std::ptrdiff_t>(end));
      }
    }
    return left;
  }

  void mate(const Use& a, const Use& b) {
    topology_.mate[a.side] = b.side;
    topology_.mate[b.side] = a.side;
  }

  // For several solids that touch in an edge: connects each face around the edge with the next one on the other side of the
  // solid behind it.
  bool join_around(std::span<const Use> edge) {
    const glm::dvec3 axis = glm::normalize(mesh_.positions[edge[0].high] - mesh_.positions[edge[0].low]);
    std::vector<double> angle;
    glm::dvec3 zero{0.0};
    for (const Use& use : edge) {
      const glm::dvec3 normal = brep::normal(mesh_.outline(mesh_.faces[use.face]));
      const glm::dvec3 into = use.up ? glm::cross(normal, axis) : glm::cross(axis, normal);  // direction from the edge into the face
      if (angle.empty()) { zero = into; }
      const double a = std::atan2(glm::dot(glm::cross(zero, into), axis), glm::dot(zero, into));
      angle.push_back(a < -1e-9 ? a + 2.0 * std::numbers::pi : std::max(a, 0.0));
    }
    std::vector<std::pair<const Use*, const Use*>> pairs;
    std::vector<bool> taken(edge.size(), false);
    for (std::size_t i = 0; i < edge.size(); ++i) {
      if (!edge[i].up) { continue; }
      std::optional<std::size_t> best;
      double least = HUGE_VAL;
      for (std::size_t j = 0; j < edge.size(); ++j) {
        if (edge[j].up || taken[j] || back_to_back(mesh_.faces[edge[i].face], mesh_.faces[edge[j].face])) { continue; }
        double turn = angle[i] - angle[j];  // the solid lies behind the face, so the angle is measured against the axis
        if (turn < 1e-9) { turn += 2.0 * std::numbers::pi; }
        if (turn < least) {
          least = turn;
          best = j;
        }
      }
      if (!best) { return false; }
      taken[*best] = true;
      pairs.emplace_back(&edge[i], &edge[*best]);
    }
    for (const auto& [a, b] : pairs) { mate(*a, *b); }
    return true;
  }

  void part_fans() {
    brep::detail::UnionFind fans(uses_.size());
    for (std::uint32_t s = 0; s < topology_.mate.size(); ++s) {
      const std::uint32_t t = topology_.mate[s];
      if (t != none) { fans.unite(s, topology_.next(t, face_of_[t])); }
    }
    topology_.vertices = fans.enumerate(topology_.vertex);
  }

  // Makes faces loose that share an edge and direction with another one, or meet another one in an edge without being its neighbour: at
  // each such edge, the later face.
  void loosen(bool report) {
    struct Run {
      std::uint32_t from, to, side;
    };
    std::vector<Run> runs;
    for (std::uint32_t s = 0; s < topology_.vertex.size(); ++s) {
      runs.push_back({topology_.vertex[s], topology_.vertex[topology_.next(s, face_of_[s])], s});
    }
    const auto before = [](const Run& a, const Run& b) { return std::tie(a.from, a.to, a.side) < std::tie(b.from, b.to, b.side); };
    std::sort(runs.begin(), runs.end(), before);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Run& run = runs[i];
      const bool doubled = i > 0 && runs[i - 1].from == run.from && runs[i - 1].to == run.to;
      bool strange = doubled;
      const auto other = std::lower_bound(runs.begin(), runs.end(), Run{run.to, run.from, 0}, before);
      if (other != runs.end() && other->from == run.to && other->to == run.from && topology_.mate[run.side] != other->side) {
        strange = strange || other->side < run.side;
      }
      if (strange) { set_loose(face_of_[run.side], report); }
    }
    std::vector<std::uint32_t> corners;  // a face with a repeated vertex
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      corners.assign(topology_.vertex.begin() + topology_.first[f], topology_.vertex.begin() + topology_.first[f + 1]);
      std::sort(corners.begin(), corners.end());
      if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) { set_loose(f, report); }
    }
  }

  void set_loose(std::uint32_t face, bool report) {
    if (loose_[face]) { return; }
    loose_[face] = true;
    ++loosened_;
    if (report) { mesh_.changed(ChangeKind::loose, mesh_.faces[face].polygon); }
    for (std::uint32_t s = topology_.first[face]; s < topology_.first[face + 1]; ++s) {
      if (topology_.mate[s] == none) { continue; }
      topology_.mate[topology_.mate[s]] = none;
      topology_.mate[s] = none;
    }
  }

  Working& mesh_;
  Topology topology_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> face_of_;
  std::vector<bool> loose_;
  std::size_t loosened_ = 0;
};

}  // namespace detail

HALFLIGHT_INLINE void orient(Working& mesh) {
  std::vector<std::uint32_t> first;
  const std::vector<detail::Use> uses = detail::uses_of(mesh, first);
  struct Neighbour {
    std::uint32_t face;
    bool alike;
  };
  std::vector<std::vector<Neighbour>> neighbours(mesh.faces.size());
  detail::each_edge(uses, [&](std::span<const detail::Use> edge) {
    if (edge.size() != 2 || edge[0].face == edge[1].face) { return; }
    if (detail::back_to_back(mesh.faces[edge[0].face], mesh.faces[edge[1].face])) { return; }
    const bool alike = edge[0].up != edge[1].up;
    neighbours[edge[0].face].push_back({edge[1].face, alike});
    neighbours[edge[1].face].push_back({edge[0].face, alike});
  });
  std::vector<signed char> side(mesh.faces.size(), 0);  // 1: orientation of the first face of the component, -1: opposite
  std::vector<std::uint32_t> component;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (side[f] != 0) { continue; }
    component.assign(1, f);
    side[f] = 1;
    double along = 0.0, against = 0.0;
    bool one_sided = false;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t at = component[i];
      if (mesh.faces[at].back == none) { (side[at] > 0 ? along : against) += brep::area(mesh.outline(mesh.faces[at])); }
      for (const auto& [next, alike] : neighbours[at]) {
        const auto wanted = static_cast<signed char>(alike ? side[at] : -side[at]);
        if (side[next] == 0) {
          side[next] = wanted;
          component.push_back(next);
        } else if (side[next] != wanted) {
          one_sided = true;
          if (at < next) { mesh.changed(ChangeKind::moebius, mesh.faces[at].polygon); }
        }
      }
    }
    const bool mixed = one_sided || 10.0 * std::min(along, against) > along + against;
    for (const std::uint32_t at : component) {
      mesh.faces[at].piece = f;
      mesh.faces[at].mixed = mixed;
      if ((side[at] > 0) == (along >= against)) { continue; }
      mesh.faces[at].turn();
      if (mesh.faces[at].back == none) { mesh.changed(ChangeKind::turned, mesh.faces[at].polygon); }
    }
  }
}

HALFLIGHT_INLINE Topology topology_of(Working& mesh, bool report) { return detail::Joiner(mesh).run(report); }

}  // namespace radiosity::intake
