// SPDX-License-Identifier: MIT
#pragma once

// Is a BRep sound? Asked slowly and word for word from the comment of brep.hpp, with sets, and with nothing of the validator's code: a
// judge of the validator.

#include <cstdint>
#include <set>

#include <brep/brep.hpp>

namespace slow_check {

template <class PoolType>
bool free_list_holds_the_dead(const PoolType& pool, std::uint32_t step) {
  std::set<std::uint32_t> dead, listed;
  for (std::uint32_t i = 0; i < pool.size(); i += step) {
    if (!pool.alive(i)) { dead.insert(i); }
  }
  for (std::uint32_t i = pool.first_free(); i != PoolType::end_of_list; i = link(pool[i]) & ~PoolType::dead_bit) {
    if (dead.count(i) == 0 || !listed.insert(i).second) { return false; }
  }
  return listed == dead && pool.count() == pool.size() / step - dead.size();
}

template <class B>
bool is_sound(const B& m) {
  using brep::HalfedgeId;
  using brep::detail::Raw;
  if (!free_list_holds_the_dead(Raw::halfedges(m), 2) || !free_list_holds_the_dead(Raw::vertices(m), 1) ||
      !free_list_holds_the_dead(Raw::faces(m), 1)) {
    return false;
  }
  std::set<HalfedgeId> all;
  for (std::uint32_t i = 0; i < m.halfedge_end(); ++i) {
    if (m.alive(HalfedgeId{i})) { all.insert(HalfedgeId{i}); }
  }
  for (HalfedgeId h : all) {
    if (!m.alive(m.next(h)) || !m.alive(m.prev(h)) || !m.alive(m.vertex(h)) || !m.alive(m.face(h))) { return false; }
    if (m.prev(m.next(h)) != h || m.next(m.prev(h)) != h) { return false; }
  }
  // One closed succession for each: the walk from the anchor is the set of all that name the element.
  const auto succession = [&](auto id, auto owner, auto step) {
    if (!m.alive(id)) { return true; }
    std::set<HalfedgeId> naming, walked;
    for (HalfedgeId h : all) {
      if (owner(h) == id) { naming.insert(h); }
    }
    HalfedgeId h = m.halfedge(id);
    while (all.count(h) != 0 && walked.insert(h).second) { h = step(h); }
    return h == m.halfedge(id) && !walked.empty() && walked == naming;
  };
  for (std::uint32_t i = 0; i < m.face_end(); ++i) {
    if (!succession(
            brep::FaceId{i}, [&](HalfedgeId h) { return m.face(h); }, [&](HalfedgeId h) { return m.next(h); }))
      return false;
  }
  for (std::uint32_t i = 0; i < m.vertex_end(); ++i) {
    if (!succession(
            brep::VertexId{i}, [&](HalfedgeId h) { return m.vertex(h); }, [&](HalfedgeId h) { return m.next(twin(h)); }))
      return false;
  }
  return true;
}

}  // namespace slow_check
