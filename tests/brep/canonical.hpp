// SPDX-License-Identifier: MIT
#pragma once

// A word for each shell of a BRep, the same exactly when an orientation-preserving renaming maps one shell to the other.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <brep/shells.hpp>

namespace shapes {

// Numbers the half-edges in the order in which next and twin reach them from a root and writes the links down; the least word of all
// roots. O(e^2): for small shells.
template <class B>
std::vector<std::vector<std::uint32_t>> canonical(const B& mesh) {
  std::vector<std::vector<std::uint32_t>> words;
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> number(mesh.halfedge_end(), none);
  for (const brep::Shell& shell : brep::shells(mesh)) {
    std::vector<std::uint32_t> best;
    const auto halves = brep::halfedges_of_shell(mesh, shell.halfedge);
    for (brep::HalfedgeId root : halves) {
      for (brep::HalfedgeId h : halves) number[h.index] = none;
      std::vector<brep::HalfedgeId> order{root};
      std::vector<std::uint32_t> word;
      number[root.index] = 0;
      for (std::size_t i = 0; i < order.size(); ++i) {
        for (brep::HalfedgeId h : {mesh.next(order[i]), brep::twin(order[i])}) {
          if (number[h.index] == none) {
            number[h.index] = static_cast<std::uint32_t>(order.size());
            order.push_back(h);
          }
          word.push_back(number[h.index]);
        }
      }
      if (best.empty() || word < best) best = word;
    }
    words.push_back(best);
  }
  std::sort(words.begin(), words.end());
  return words;
}

// Random operators from nothing: a BRep with every degenerate state, handles and several shells.
template <class B, class Random>
B random_map(Random& random, int operators) {
  B m;
  for (int i = 0; i < operators; ++i) {
    std::vector<brep::HalfedgeId> all;
    for (brep::EdgeId e : brep::edges(m)) all.insert(all.end(), {brep::halfedge(e), brep::twin(brep::halfedge(e))});
    if (all.empty() || random.below(12) == 0) {
      (void)brep::make_segment(m);
      continue;
    }
    const brep::HalfedgeId a = all[random.below(all.size())], c = all[random.below(all.size())];
    brep::HalfedgeId b = a, d = a;
    for (std::uint32_t k = random.below(5); k > 0; --k) {
      b = m.next(b);
      d = m.next(brep::twin(d));
    }
    switch (random.below(10)) {
      case 0:
        (void)brep::bridge(m, a, c);
        break;
      case 1:
        (void)brep::weld(m, a, c);
        break;
      case 2:
        (void)brep::cut(m, a);
        break;
      case 3:
        (void)brep::unweld(m, a);
        break;
      case 4:
        (void)brep::join_faces(m, a);
        break;
      case 5:
      case 6:
        (void)brep::split_vertex(m, a, d);
        break;
      default:
        (void)brep::split_face(m, a, b);
        break;
    }
  }
  return m;
}

}  // namespace shapes
