// SPDX-License-Identifier: MIT
#pragma once

// Condition objects: is this face finished? (paper 2.2: "condition objects determine, if splitting should go on")
//
// A condition is any function object bool(const BRep&, FaceId). Those of this file and their combinations compose by && || and !,
// with each other and with lambdas; all_of, any_of and negate do the same for lambdas alone. Operands are copied, and asked from
// left to right as far as needed:
//
//   split_recursively(brep, f, NiceSplit{}, quadrangles && Convex{} && [](const Mesh& m, FaceId g) { return m.data(g).sheet == 1; });
//
// NoTVertices stands in t_vertices.hpp, BesidePlane in split_plane.hpp. A type joins in by the member type `condition_object`.

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/outline.hpp>

namespace brep {

template <class T>
concept ConditionObject = requires {
  typename std::remove_cvref_t<T>::condition_object;
};

// At most `edges` edges.
struct AtMost {
  using condition_object = AtMost;
  std::size_t edges = 4;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    std::size_t n = 0;
    for ([[maybe_unused]] HalfedgeId h : halfedges_of(brep, f)) {
      if (++n > edges) { return false; }
    }
    return true;
  }
};
inline constexpr AtMost triangles{3};
inline constexpr AtMost quadrangles{4};  // or triangles

// Convex (polygon.hpp says with which tolerance); straight corners are allowed.
struct Convex {
  using condition_object = Convex;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return is_convex(brep, f);
  }
};

// Every corner turns left, by an angle of 1e-9 at least: no straight corner, none that turns right.
struct StrictlyConvex {
  using condition_object = StrictlyConvex;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    const Outline outline{Polygon(positions(brep, f))};
    for (std::size_t i = 0; i < outline.size(); ++i) {
      if (outline.turn(i) < 1e-9) { return false; }
    }
    return true;
  }
};

// Convex, and the inscribed over the circumscribed circle is above `ratio` (proportion.hpp; an equilateral triangle has 1/2). Cuts can make
// the proportion worse, so this condition may stay out of reach.
struct ProportionAbove {
  using condition_object = ProportionAbove;
  double ratio = 0.0;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return is_convex(brep, f) && proportion(brep, f) > ratio;
  }
};

// Area below `area`. Diagonals alone cannot go below the area of the triangles that they leave.
struct AreaBelow {
  using condition_object = AreaBelow;
  double area = 0.0;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return brep::area(brep, f) < area;
  }
};

namespace detail {

template <class... Conditions>
struct AllOf {
  using condition_object = AllOf;
  std::tuple<Conditions...> conditions;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return std::apply([&](const auto&... each) { return (static_cast<bool>(each(brep, f)) && ...); }, conditions);
  }
};
template <class... Conditions>
struct AnyOf {
  using condition_object = AnyOf;
  std::tuple<Conditions...> conditions;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return std::apply([&](const auto&... each) { return (static_cast<bool>(each(brep, f)) || ...); }, conditions);
  }
};
template <class Condition>
struct Not {
  using condition_object = Not;
  Condition condition;
  template <class B>
  bool operator()(const B& brep, FaceId f) const {
    return !static_cast<bool>(condition(brep, f));
  }
};

template <class T>
concept FunctionObject = std::is_class_v<std::remove_cvref_t<T>> || std::is_function_v<std::remove_pointer_t<std::decay_t<T>>>;

}  // namespace detail

template <class... Conditions>
[[nodiscard]] auto all_of(Conditions&&... conditions) {
  return detail::AllOf<std::decay_t<Conditions>...>{{std::forward<Conditions>(conditions)...}};
}
template <class... Conditions>
[[nodiscard]] auto any_of(Conditions&&... conditions) {
  return detail::AnyOf<std::decay_t<Conditions>...>{{std::forward<Conditions>(conditions)...}};
}
template <class Condition>
[[nodiscard]] auto negate(Condition&& condition) {
  return detail::Not<std::decay_t<Condition>>{std::forward<Condition>(condition)};
}

template <detail::FunctionObject L, detail::FunctionObject R>
requires(ConditionObject<L> || ConditionObject<R>) [[nodiscard]] auto operator&&(L&& left, R&& right) {
  return all_of(std::forward<L>(left), std::forward<R>(right));
}
template <detail::FunctionObject L, detail::FunctionObject R>
requires(ConditionObject<L> || ConditionObject<R>) [[nodiscard]] auto operator||(L&& left, R&& right) {
  return any_of(std::forward<L>(left), std::forward<R>(right));
}
template <ConditionObject C>
[[nodiscard]] auto operator!(C&& condition) {
  return negate(std::forward<C>(condition));
}

}  // namespace brep
