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
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>

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
  void run() {
    std::sort(spines.begin(), spines.end(), [](const Spine& a, const Spine& b) {
      return a.lo != b.lo ? a.lo < b.lo : a.hi != b.hi ? a.hi < b.hi : a.half < b.half;
    });
    spines.erase(std::unique(spines.begin(), spines.end(), [](const Spine& a, const Spine& b) { return a.half == b.half; }), spines.end());
    std::size_t kept = 0;
    for (std::size_t i = 0, end = 0; i < spines.size(); i = end) {
      bool a = false, b = false;
      for (; end < spines.size() && spines[end].lo == spines[i].lo && spines[end].hi == spines[i].hi; ++end) {
        (spines[end].of_b ? b : a) = true;
      }
      if (!a || !b) { continue; }
      first.push_back(static_cast<std::uint32_t>(kept));
      sort(spines.data() + i, spines.data() + end);
      label(spines.data() + i, spines.data() + end);
      for (std::size_t k = i; k < end; ++k) { spines[kept++] = spines[k]; }
    }
    spines.resize(kept);
    first.push_back(static_cast<std::uint32_t>(kept));
  }

  // Sorts the spines of one edge.
  void sort(Spine* begin, Spine* end) {
    const Point &from = work_.points[begin->lo], &to = work_.points[begin->hi];
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      const auto length = [&](std::size_t k) { return std::abs(to.position[static_cast<int>(k)] - from.position[static_cast<int>(k)]); };
      if (length(i) > length(axis)) { axis = i; }
    }
    const int along = work_.predicates.compare(from, to, static_cast<int>(axis)) < 0 ? 1 : -1;
    std::vector<Ranked>& ranked = ranked_;
    ranked.clear();
    for (const Spine* s = begin; s != end; ++s) {
      const WorkFace& f = work_.faces[work_.halves[s->half].face];
      const std::int64_t sign = f.plane.sign() * (s->begins ? -1 : 1);
      Ranked r{*s, {}, 0};
      for (std::size_t i = 0; i < 3; ++i) { r.m[i] = sign * work_.plane(f).n[i]; }
      if (!ranked.empty()) {
        const int turn = along * cross(ranked[0].m, r.m, axis);
        r.half = turn != 0 ? (turn > 0 ? 0 : 1) : dot(ranked[0].m, r.m) > 0 ? 0 : 1;
      }
      ranked.push_back(r);
    }
    const auto turn = [&](const Ranked& a, const Ranked& b) { return along * cross(a.m, b.m, axis); };
    std::sort(ranked.begin(), ranked.end(), [&](const Ranked& a, const Ranked& b) {
      if (a.half != b.half) { return a.half < b.half; }
      const int t = turn(a, b);
      return t != 0 ? t > 0 : a.spine.half < b.spine.half;
    });
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      begin[i] = ranked[i].spine;
      begin[i].stacked = i > 0 && ranked[i - 1].half == ranked[i].half && turn(ranked[i - 1], ranked[i]) == 0;
    }
  }

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

  void label(Spine* begin, Spine* end) {
    bool inside[2] = {false, false}, known[2] = {false, false};
    for (const Spine* s = begin; s != end; ++s) {
      if (!known[s->of_b]) { inside[s->of_b] = !s->begins, known[s->of_b] = true; }
    }
    for (Spine* s = begin; s != end;) {
      Spine* stack_end = s + 1;
      while (stack_end != end && stack_end->stacked) { ++stack_end; }
      const Spine* in_plane[2] = {nullptr, nullptr};
      for (const Spine* x = s; x != stack_end; ++x) {
        if (in_plane[x->of_b] != nullptr || inside[x->of_b] == x->begins) { fault = work_.halves[x->half].face; }
        in_plane[x->of_b] = x;
      }
      for (Spine* x = s; x != stack_end; ++x) {
        const Spine* other = in_plane[!x->of_b];
        if (other != nullptr) {
          x->side = other->begins == x->begins ? Side::on_same : Side::on_opposite;
        } else {
          x->side = inside[!x->of_b] ? Side::inside : Side::outside;
        }
      }
      for (const Spine* x = s; x != stack_end; ++x) { inside[x->of_b] = x->begins; }
      s = stack_end;
    }
  }

  Work& work_;
  std::vector<Ranked> ranked_;
};

// Where edges of one operand coincide, chooses their twins by solid wedges; for the half-edges from `first` on. Notes them in `several`.
// Returns two half-edges that do not begin and end a solid in turn, if there are such.
[[nodiscard]] inline std::optional<std::pair<std::uint32_t, std::uint32_t>> pair_wedges(Work& work, std::uint32_t first,
                                                                                        std::vector<std::uint32_t>& several) {
  Radial radial(work);
  for (std::uint32_t h = first; h < work.halves.size(); ++h) { radial.add(h); }
  std::vector<Spine>& spines = radial.spines;
  std::sort(spines.begin(), spines.end(), [](const Spine& a, const Spine& b) {
    return a.lo != b.lo ? a.lo < b.lo : a.hi != b.hi ? a.hi < b.hi : a.half < b.half;
  });
  for (std::size_t i = 0, end = 0; i < spines.size(); i = end) {
    while (end < spines.size() && spines[end].lo == spines[i].lo && spines[end].hi == spines[i].hi) { ++end; }
    if (end - i == 2) { continue; }
    radial.sort(spines.data() + i, spines.data() + end);
    for (std::size_t k = i; k < end; ++k) {
      const Spine &s = spines[k], &next = spines[k + 1 == end ? i : k + 1];
      if (s.begins == next.begins || s.stacked) { return std::pair(s.half, next.half); }
      several.push_back(s.half);
      if (s.begins) { work.halves[s.half].twin = next.half, work.halves[next.half].twin = s.half; }
    }
  }
  return std::nullopt;
}

}  // namespace brep::csg::detail
