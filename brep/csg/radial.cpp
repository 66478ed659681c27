// SPDX-License-Identifier: MIT
#include <brep/csg/radial.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE void Radial::run() {
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

HALFLIGHT_INLINE void Radial::sort(Spine* begin, Spine* end) {
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

HALFLIGHT_INLINE void Radial::label(Spine* begin, Spine* end) {
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

HALFLIGHT_INLINE std::optional<std::pair<std::uint32_t, std::uint32_t>> pair_wedges(Work& work, std::uint32_t first,
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
