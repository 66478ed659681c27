// SPDX-License-Identifier: MIT
#include "apps/stress/case.hpp"

#include <algorithm>

#include <brep/finite.hpp>

namespace apps::stress {

radiosity::Solution Findings::solve(const radiosity::Scene& scene, const radiosity::Options& options, const radiosity::Control& control) {
  radiosity::Outcome outcome = radiosity::solve(scene, options, control);
  if (!outcome.solution) {
    exactly("solved, but: " + (outcome.failure.sentences.empty() ? "no solution" : outcome.failure.sentences.front()), 0.0, 1.0);
    return {};
  }
  ++solved_;
  const auto& b = outcome.solution->radiosity;
  const auto broken = std::count_if(
      b.begin(), b.end(), [](const radiosity::Color& c) { return !(brep::is_finite(c) && c.x >= 0.0 && c.y >= 0.0 && c.z >= 0.0); });
  if (broken > 0) { exactly("radiosities that are negative or no numbers", static_cast<double>(broken), 0.0); }
  return std::move(*outcome.solution);
}

void Findings::refuse(const std::string& what, const radiosity::Scene& scene, const radiosity::Options& options, std::string_view word) {
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  refuse(what, outcome.solution || outcome.failure.sentences.empty() ? std::string{} : outcome.failure.sentences.front(), word);
}

void Findings::refuse(const std::string& what, const std::string& sentence, std::string_view word) {
  const bool said = !sentence.empty() && sentence.find(word) != std::string::npos;
  exactly(what + (said ? ": refused" : ": refused for its reason"), said ? 1.0 : 0.0, 1.0);
  if (!sentence.empty()) { refusals_.push_back(sentence); }
}

void Findings::warned(const std::string& what, const radiosity::Solution& solution, std::string_view word) {
  const auto& all = solution.audit.warnings;
  const auto said = std::find_if(all.begin(), all.end(), [&](const std::string& w) { return w.find(word) != std::string::npos; });
  exactly(what + ": warned", said != all.end() ? 1.0 : 0.0, 1.0);
  if (said != all.end()) { warnings_.push_back(*said); }
}

bool Findings::hold() const {
  return std::all_of(figures_.begin(), figures_.end(), [](const Figure& f) { return f.holds(); });
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> result;
    for (const auto& group : {light_cases(), contact_cases(), boundary_cases(), size_cases()}) {
      result.insert(result.end(), group.begin(), group.end());
    }
    return result;
  }();
  return all;
}

}  // namespace apps::stress
