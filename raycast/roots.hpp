// SPDX-License-Identifier: MIT
#pragma once

// Zeros of a function on an interval, for surfaces without a closed formula.
//
//   bracketed_root   one zero between two points of different sign: Newton's method while it stays inside and converges, else bisection
//   sign_changes     all of them, for a function that is the sum of a convex and a concave one
//
// The second needs no bounds from the caller: the slope of a convex function increases and that of a concave one decreases, so over [a,
// b]
//      convex'(a) + concave'(b)  <=  f'  <=  convex'(b) + concave'(a).
// An interval on which f' keeps its sign has at most one sign change; one on which f cannot reach 0 with these slopes has none; any other
// interval is divided. Near a touching point the division ends when the remaining values are within `negligible` of 0.

#include <algorithm>
#include <cmath>

#include <raycast/box.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

struct Sample {
  double value, slope;
};

// f(s) -> Sample, with different signs at a < b (`rising`: from negative to positive). Returns the zero with an error of at most 2 u of the
// larger |end|, or where the value is 0. `s`: first guess. Two cases would make bisection take fifty evaluations, one per bit:
// - If f behaves like a root of the distance from a or b, its zero may be many powers of two away, and Newton's steps leave the bracket or
//   grow endlessly. So the distance from that end is bisected in its logarithm (geometric mean).
// - At the zero Newton's steps are mere rounding and leave the bracket as often as not. Then a point slightly beyond the zero closes it;
//   where the rounding of f hides its sign there, too, one four times as far.
template <class F>
[[nodiscard]] double bracketed_root(F&& f, double a, double b, bool rising, double s) {
  const double start = a, end = b, shortest = eps_root * std::max(std::abs(a), std::abs(b)), rounding = 8.0 * shortest;
  const auto far = [](double least, double most) { return least < most / 16.0; };
  const auto between = [&](double least, double most) {
    return far(least, most) ? std::sqrt(std::max(least, shortest) * most) : 0.5 * (least + most);
  };
  double last = b - a;
  double beyond = 0.0;  // how far s was placed beyond the zero that Newton's steps had found
  for (int i = 0; i < 200; ++i) {
    const Sample at = f(s);
    if (at.value == 0.0) { return s; }
    const bool before = (at.value < 0.0) == rising;
    (before ? a : b) = s;
    if (b - a <= 2.0 * shortest) { return a + 0.5 * (b - a); }
    const double step = at.value / at.slope, past = std::max({rounding, 2.0 * std::abs(step), 4.0 * beyond});
    double next = s - step;
    if (next > a && next < b && std::abs(next - s) <= 0.5 * last) {
      if (std::abs(next - s) <= shortest) { return next; }
      beyond = 0.0;
    } else if (std::abs(step) <= 16.0 * rounding && b - a > 4.0 * past) {
      beyond = past;
      next = before ? s + past : s - past;
    } else {
      const bool to_start = next <= a || (next < b && a > start && far(a - start, b - start));
      const bool to_end = next >= b || (next > a && b < end && far(end - b, end - a));
      next = to_start == to_end ? a + 0.5 * (b - a) : to_start ? start + between(a - start, b - start) : end - between(end - b, end - a);
      if (!(next > a && next < b)) { next = a + 0.5 * (b - a); }
      if (!(next > a && next < b)) { return next; }
      beyond = 0.0;
    }
    last = std::abs(next - s);
    s = next;
  }
  return s;
}

// A value, with the slopes of its convex and its concave part; slopes may be infinite where a part has a vertical tangent.
struct SplitSample {
  double value, convex, concave;
};

// Calls found(lo, hi, rising, guess) for every sign change of f on [a, b], from left to right. f is monotone on [lo, hi] (or the interval
// is as short as 4 u of the larger |end|), and `guess` is about where its chord is 0. f(s) -> SplitSample; a value of 0 counts as
// positive. Two sign changes between which |f| stays below `negligible` may be omitted. Typically takes 5 to 15 values.
template <class F, class Found>
void sign_changes(F&& f, double a, double b, double negligible, Found&& found) {
  struct Part {
    double a, b;
    SplitSample at_a, at_b;
  };
  const double shortest = eps_interval * std::max(std::abs(a), std::abs(b));
  InlineVector<Part, 64> stack;
  stack.push({a, b, f(a), f(b)});
  while (!stack.empty()) {
    const Part p = stack.back();
    stack.pop();
    const double width = p.b - p.a, fa = p.at_a.value, fb = p.at_b.value;
    const bool rises = fa < 0.0 && !(fb < 0.0), falls = !(fa < 0.0) && fb < 0.0;
    const double least = p.at_a.convex + p.at_b.concave, most = p.at_b.convex + p.at_a.concave;
    if (rises || falls) {
      if (least >= 0.0 || most <= 0.0 || width <= shortest) {
        found(p.a, p.b, rises, p.a + width * std::clamp(fa / (fa - fb), 0.02, 0.98));
        continue;
      }
    } else if (least >= 0.0 || most <= 0.0 || width <= shortest) {
      continue;
    }
    double middle = p.a + 0.5 * width;
    if (!rises && !falls) {
      // How close to 0 the slopes allow f to come between the ends: g = |f| begins at ga with a slope of at least -down and ends at gb
      // with at most up.
      const double ga = std::abs(fa), gb = std::abs(fb), down = fa < 0.0 ? most : -least, up = fa < 0.0 ? -least : most;
      const double finite_down = down < infinity ? ga - down * width : -infinity, finite_up = up < infinity ? gb - up * width : -infinity;
      double lowest = std::max(finite_down, finite_up);
      if (down < infinity && up < infinity) {
        const double meet = (ga - gb + up * width) / (down + up);  // where the two lines intersect
        if (meet > 0.0 && meet < width) {
          lowest = ga - down * meet;
          middle = p.a + std::clamp(meet, 0.1 * width, 0.9 * width);
        }
      }
      if (lowest > -negligible) { continue; }
    }
    const SplitSample at = f(middle);
    stack.push({middle, p.b, at, p.at_b});
    stack.push({p.a, middle, p.at_a, at});
  }
}

}  // namespace raycast
