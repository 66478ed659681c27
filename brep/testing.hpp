// SPDX-License-Identifier: MIT
#pragma once

// Matchers for unit tests of topology code, to be used with Catch2:
//
//   CHECK_THAT(brep, IsValid());                                the structure, R1 to R8 (validate.hpp)
//   CHECK_THAT(brep, IsValid(Constraint::polygons));            and rules from R9 on (validate_constraints.hpp)
//   CHECK_THAT(brep, HasCounts({.v = 8, .e = 12, .f = 6}));     any of v, e, f, s (shells) and h (handles)
//   CHECK_THAT(brep, IsIsomorphicTo(cube));                     equal up to the names of the elements
//   CHECK_THAT(brep, !IsIsomorphicTo(cube));
//
// A test that fails prints what is wrong in sentences. Catch2 asks a matcher for two members only, `match` and `toString`, in version 2 as
// in version 3; so this header needs no Catch2 itself, and other test libraries may call the two as well.

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/isomorphism.hpp>
#include <brep/validate.hpp>
#include <brep/validate_constraints.hpp>

namespace brep {

// How Catch2 prints a BRep in the line of a failed check.
template <class VertexT, class HalfedgeT, class FaceT, class LogT, class AllocatorT>
std::ostream& operator<<(std::ostream& out, const BRep<VertexT, HalfedgeT, FaceT, LogT, AllocatorT>& brep) {
  return out << "the BRep with v = " << brep.vertex_count() << ", e = " << brep.edge_count() << ", f = " << brep.face_count();
}

namespace detail {

inline std::string sentences(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) { text += '\n' + fault.sentence; }
  return text;
}

}  // namespace detail

// The opposite of a matcher: CHECK_THAT(a, !IsIsomorphicTo(b)).
template <class Matcher>
class Not {
 public:
  explicit Not(Matcher matcher) : matcher_(std::move(matcher)) {}
  template <class B>
  [[nodiscard]] bool match(const B& brep) const {
    return !matcher_.match(brep);
  }
  [[nodiscard]] std::string toString() const { return "not: " + matcher_.toString(); }

 private:
  Matcher matcher_;
};
template <class Matcher>
[[nodiscard]] Not<Matcher> operator!(const Matcher& matcher) requires(requires { matcher.brep_matcher; }) {
  return Not<Matcher>(matcher);
}

// Are all rules of structure kept, and the constraints that are asked for?
class IsValid {
 public:
  static constexpr bool brep_matcher = true;

  IsValid() = default;
  explicit IsValid(Constraint constraints) : constraints_(constraints) {}
  template <class B>
  [[nodiscard]] bool match(const B& brep) const {
    const std::vector<Fault> faults = constraints_ ? validate(brep, *constraints_) : validate(brep);
    found_ = detail::sentences(faults);
    return faults.empty();
  }
  [[nodiscard]] std::string toString() const { return "is valid" + found_; }

 private:
  std::optional<Constraint> constraints_;
  mutable std::string found_;  // by the last match
};

// Has it these counts? Those that are not given may be anything. s and h are counted by flood fill, in a valid BRep only.
struct HasCounts {
  static constexpr bool brep_matcher = true;

  std::optional<long> v{}, e{}, f{}, s{}, h{};
  mutable std::string found{};  // by the last match; not to be set

  template <class B>
  [[nodiscard]] bool match(const B& brep) const {
    found.clear();
    if ((s || h) && !is_valid(brep)) {
      found = "\nshells and handles cannot be counted:" + detail::sentences(validate(brep));
      return false;
    }
    bool equal = true;
    const auto compare = [&](const char* name, const std::optional<long>& expected, auto&& count) {
      if (!expected) { return; }
      const long value = static_cast<long>(count());
      found += std::string("\n") + name + " = " + std::to_string(value);
      if (value == *expected) { return; }
      found += ", expected " + std::to_string(*expected);
      equal = false;
    };
    compare("v", v, [&] { return brep.vertex_count(); });
    compare("e", e, [&] { return brep.edge_count(); });
    compare("f", f, [&] { return brep.face_count(); });
    compare("s", s, [&] { return shell_count(brep); });
    compare("h", h, [&] { return genus(brep); });
    return equal;
  }
  [[nodiscard]] std::string toString() const { return "has the counts" + found; }
};

// Is it the same up to the names of its elements, with the same orientation? `expected` must outlive the matcher; both must be valid.
template <class Expected>
class IsIsomorphicTo {
 public:
  static constexpr bool brep_matcher = true;

  explicit IsIsomorphicTo(const Expected& expected) : expected_(&expected) {}
  template <class B>
  [[nodiscard]] bool match(const B& brep) const {
    found_ = detail::sentences(validate(brep));
    if (found_.empty() && !is_valid(*expected_)) {
      found_ = "\nbut that one is not valid:" + detail::sentences(validate(*expected_));
    } else if (found_.empty()) {
      found_ = difference(brep, *expected_);
      if (!found_.empty()) { found_.insert(0, 1, '\n'); }
    }
    return found_.empty();
  }
  [[nodiscard]] std::string toString() const { return "is isomorphic to the expected one" + found_; }

 private:
  const Expected* expected_;
  mutable std::string found_;
};

}  // namespace brep
