// SPDX-License-Identifier: MIT
#pragma once

// The faces of both operands around each common edge, in order, and what they say about inside and outside.
//
// Around an edge with direction d a face is a half-plane. With m = its outward normal for a half-edge that runs along d, and minus that
// for one that runs against, the half-plane is m turned by 90 degrees: the order of the m is the order of the faces. Going round
// counter-clockwise, a half-edge against d is a face where its solid begins, one along d a face where it ends; so the first face of
// each operand tells whether the walk starts inside of it, and no ray is needed. Equal m are faces in one plane on one side of the edge.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/predicates.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/wide.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>

namespace brep::csg::detail {

struct Spine {
  std::uint32_t lo, hi;  // points; d runs from lo to hi
  std::uint32_t half;
  bool begins, of_b;          // the solid begins here
  bool stacked;               // in the plane of the one before, and on its side of the edge
  Side side = Side::outside;  // of the face, with respect to the other operand
};

class Radial {
 public:
  explicit Radial(Work& work) : work_(work) {}

  std::vector<Spine> spines;            // edge after edge, each in counter-clockwise order
  std::vector<std::uint32_t> first;     // the first spine of each edge, and the end
  std::uint32_t fault = invalid_index;  // a face that begins where its solid has begun already, if there is one

  void add(std::uint32_t h) {
    const std::uint32_t p = work_.halves[h].point, q = work_.target(h);
    spines.push_back({std::min(p, q), std::max(p, q), h, p > q, work_.faces[work_.halves[h].face].of_b, false});
  }

  // Sorts what was added, and leaves out the edges that one operand alone has.
  void run();

  // Sorts the spines of one edge.
  void sort(Spine* begin, Spine* end);

 private:
  using Normal = std::array<std::int64_t, 3>;
  struct Ranked {
    Spine spine;
    Normal m;
    int half;
  };

  static int cross(const Normal& a, const Normal& b, std::size_t i) {
    const std::size_t j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
    return detail::sign(static_cast<Int128>(a[j]) * b[k] - static_cast<Int128>(a[k]) * b[j]);
  }
  static int dot(const Normal& a, const Normal& b) {
    return detail::sign(static_cast<Int128>(a[0]) * b[0] + static_cast<Int128>(a[1]) * b[1] + static_cast<Int128>(a[2]) * b[2]);
  }

  void label(Spine* begin, Spine* end);

  Work& work_;
  std::vector<Ranked> ranked_;
};

// Where edges of one operand coincide, chooses their twins by solid wedges; for the half-edges from `first` on. Notes them in `several`.
// Returns two half-edges that do not begin and end a solid in turn, if there are such.
[[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> pair_wedges(Work& work, std::uint32_t first,
                                                                                 std::vector<std::uint32_t>& several);

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/radial.cpp>
#endif
