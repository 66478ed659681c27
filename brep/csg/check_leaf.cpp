// SPDX-License-Identifier: MIT
#include <brep/csg/check_leaf.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/box_pairs.hpp>
#include <brep/csg/contacts.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/point_in_solid.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/wide.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/result.hpp>

namespace brep::csg::detail {

// Are two faces of one boundary apart, except for common vertices and edges?
class SelfContacts : public Contacts {
 public:
  using Contacts::Contacts;

  [[nodiscard]] bool legal(std::uint32_t f, std::uint32_t g) {
    if (at_most_a_vertex(f, g) || at_most_a_vertex(g, f) || !meet(f, g)) { return true; }
    int state[2] = {0, 0};
    for (std::uint32_t k = 0; k + 1 < groups_.size(); ++k) {
      if (state[0] != 0 && state[1] != 0 && !(edge_before(k, false) && edge_before(k, true))) { return false; }
      bool at[2] = {state[0] != 0, state[1] != 0};
      std::uint32_t vertex[2] = {invalid_index, invalid_index};
      for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
        const Event& e = events_[i];
        at[e.of_g] = true;
        state[e.of_g] ^= e.turn;
        if (e.vertex) { vertex[e.of_g] = work_.halves[e.half].point; }
      }
      if (at[0] && at[1] && (vertex[0] == invalid_index || vertex[0] != vertex[1])) { return false; }
    }
    return true;
  }

 private:
  // Does g lie on one side of the plane of f except for a vertex that both have? Common in smooth surfaces, and quickly answered.
  [[nodiscard]] bool at_most_a_vertex(std::uint32_t f, std::uint32_t g) const {
    const WorkFace &ff = work_.faces[f], &gg = work_.faces[g];
    std::uint32_t on = invalid_index;
    int side = 0;
    for (std::uint32_t h = gg.first; h < gg.first + gg.count; ++h) {
      const int s = work_.predicates.side(work_.from(h), ff.plane.number());
      if (s * side < 0) { return false; }
      if (s == 0 && on != invalid_index) { return false; }
      if (s == 0) { on = work_.halves[h].point; }
      if (s != 0) { side = s; }
    }
    bool common = on == invalid_index;
    for (std::uint32_t h = ff.first; h < ff.first + ff.count; ++h) { common = common || work_.halves[h].point == on; }
    return common;
  }
  // Is all between the groups k - 1 and k one edge of the face?
  [[nodiscard]] bool edge_before(std::uint32_t k, bool of_g) const {
    for (const Along& a : along_) {
      if (a.of_g == of_g && a.first + 1 == k && a.last == k) { return true; }
    }
    return false;
  }
};

HALFLIGHT_INLINE Refusal CheckLeaf::run() {
  Refusal refusal = contacts();
  if (refusal.code == Code::none) { refusal = wedges(); }
  if (refusal.code == Code::none) { refusal = shells(); }
  return refusal;
}

HALFLIGHT_INLINE Refusal CheckLeaf::contacts() {
  for (std::uint32_t h = 0; h < work_.halves.size(); ++h) {
    const std::uint32_t f = work_.halves[h].face, g = work_.halves[work_.halves[h].twin].face;
    if (work_.faces[f].plane == work_.faces[g].plane.flipped()) { return {Code::self_intersecting, {name(f), name(g)}}; }
  }
  SelfContacts contacts(work_);
  BoxPairs pairs;
  for (std::uint32_t f = 0; f < work_.faces.size(); ++f) { pairs.a.push_back({work_.faces[f].box, f}); }
  pairs.b = pairs.a;
  Refusal refusal;
  pairs.run([&](std::uint32_t f, std::uint32_t g) {
    if (f < g && refusal.code == Code::none && !contacts.legal(f, g)) { refusal = {Code::self_intersecting, {name(f), name(g)}}; }
  });
  return refusal;
}

HALFLIGHT_INLINE Refusal CheckLeaf::wedges() {
  const auto wrong = pair_wedges(work_, 0, several);
  if (!wrong) { return {}; }
  return {Code::self_intersecting, {name(work_.halves[wrong->first].face), name(work_.halves[wrong->second].face)}};
}

HALFLIGHT_INLINE int CheckLeaf::orientation(const std::vector<std::uint32_t>& shell) const {
  Int128 exact = 0;
  double rough = 0.0;
  bool on_grid = true;
  for (std::uint32_t f : shell) {
    const WorkFace& face = work_.faces[f];
    const glm::dvec3 o = work_.from(work_.half(face, 0)).position;
    glm::dvec3 area{0.0};
    std::array<Int128, 3> exact_area{};
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t h = work_.half(face, i);
      const glm::dvec3 a = work_.from(h).position - o, b = work_.to(h).position - o;
      area += glm::cross(a, b);
      on_grid = on_grid && work_.from(h).on_grid();
      for (int k = 0; on_grid && k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        exact_area[static_cast<std::size_t>(k)] += static_cast<Int128>(static_cast<std::int64_t>(a[u])) * static_cast<std::int64_t>(b[v]) -
                                                   static_cast<Int128>(static_cast<std::int64_t>(a[v])) * static_cast<std::int64_t>(b[u]);
      }
    }
    rough += glm::dot(o, area);
    for (int k = 0; on_grid && k < 3; ++k) { exact += exact_area[static_cast<std::size_t>(k)] * static_cast<std::int64_t>(o[k]); }
  }
  return on_grid ? detail::sign(exact) : detail::sign(rough);
}

HALFLIGHT_INLINE Refusal CheckLeaf::shells() {
  std::vector<std::uint32_t> shell_of(work_.faces.size(), invalid_index);
  std::vector<std::vector<std::uint32_t>> shells;
  for (std::uint32_t f = 0; f < work_.faces.size(); ++f) {
    if (shell_of[f] != invalid_index) { continue; }
    std::vector<std::uint32_t> shell{f};
    shell_of[f] = static_cast<std::uint32_t>(shells.size());
    for (std::size_t k = 0; k < shell.size(); ++k) {
      const WorkFace& face = work_.faces[shell[k]];
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t g = work_.halves[work_.halves[work_.half(face, i)].twin].face;
        if (shell_of[g] == invalid_index) { shell_of[g] = shell_of[f], shell.push_back(g); }
      }
    }
    shells.push_back(std::move(shell));
  }
  const PointInSolid others(work_, true);
  for (const std::vector<std::uint32_t>& shell : shells) {
    int depth = -1;
    if (shells.size() > 1) {
      for (WorkFace& f : work_.faces) { f.of_b = true; }
      for (std::uint32_t f : shell) { work_.faces[f].of_b = false; }
      const std::uint32_t h = work_.half(work_.faces[shell[0]], 0);
      depth = others(others.vertex(work_.halves[h].point));
      if (depth == 0) { depth = others(others.middle(work_.halves[h].point, work_.target(h))); }
    }
    if (orientation(shell) != -depth) { return {Code::inside_out, {name(shell[0])}}; }
  }
  for (WorkFace& f : work_.faces) { f.of_b = false; }
  return {};
}

}  // namespace brep::csg::detail
