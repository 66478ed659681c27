// SPDX-License-Identifier: MIT
#pragma once

// A stiff or extreme case: scenes that are solved, and figures of what came out, each against its bound. What was done (solved, warned,
// refused) is recorded as it happens; why that is right is what the case says of itself. Every figure depends on the scenes alone.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <radiosity/radiosity.hpp>

namespace apps::stress {

// A measured number and the bound that it must keep. NaN keeps none.
struct Figure {
  enum class Bound { at_most, at_least, exactly };
  std::string what;
  double measured = 0.0;
  Bound kind = Bound::at_most;
  double bound = 0.0;

  [[nodiscard]] bool holds() const {
    return kind == Bound::at_most ? measured <= bound : kind == Bound::at_least ? measured >= bound : measured == bound;
  }
};

// What running a case brought to light.
class Findings {
 public:
  void at_most(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::at_most, bound});
  }
  void at_least(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::at_least, bound});
  }
  void exactly(std::string what, double measured, double bound) {
    figures_.push_back({std::move(what), measured, Figure::Bound::exactly, bound});
  }

  // The solution of a scene that has one. When there is none, or a radiosity is not finite, the case has failed, and what comes back is
  // empty.
  radiosity::Solution solve(const radiosity::Scene& scene, const radiosity::Options& options, const radiosity::Control& control = {});
  // A scene, or an object, that must be refused with a sentence that contains `word`.
  void refuse(const std::string& what, const radiosity::Scene& scene, const radiosity::Options& options, std::string_view word);
  void refuse(const std::string& what, const std::string& sentence, std::string_view word);
  // The solution must warn with a sentence that contains `word`.
  void warned(const std::string& what, const radiosity::Solution& solution, std::string_view word);

  [[nodiscard]] const std::vector<Figure>& figures() const { return figures_; }
  [[nodiscard]] const std::vector<std::string>& refusals() const { return refusals_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  [[nodiscard]] std::uint32_t solved() const { return solved_; }
  [[nodiscard]] bool hold() const;

 private:
  std::vector<Figure> figures_;
  std::vector<std::string> refusals_, warnings_;  // the sentences that were asked for
  std::uint32_t solved_ = 0;
};

// A row: what is stressed, why what is done is right, and the scenes with their figures.
struct Case {
  std::string_view name;
  std::string_view what;
  std::string_view why;
  void (*run)(Findings&);
};

[[nodiscard]] std::span<const Case> light_cases();     // reflectance, emission, the linear system
[[nodiscard]] std::span<const Case> contact_cases();   // what touches, coincides, overlaps
[[nodiscard]] std::span<const Case> boundary_cases();  // shells, normals, what hides what
[[nodiscard]] std::span<const Case> size_cases();      // scale, place, thinness, number and depth

// All of them, in the order in which they are run.
[[nodiscard]] const std::vector<Case>& cases();

}  // namespace apps::stress
