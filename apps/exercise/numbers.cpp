// SPDX-License-Identifier: MIT
#include "apps/exercise/exercises.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>

#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps::exercise {
namespace {

using Fault = std::optional<std::string>;

struct Answer {
  std::string_view name;
  double value;
  const char* hint;  // what to reconsider; never the number
};

std::string stripped(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == text.npos ? "" : text.substr(begin, end - begin + 1);
}

// Reports the first answer that is missing, not a number, or wrong by more than half a per cent (by more than 0.001 if it is 0).
Fault compare(const std::string& text, const std::vector<Answer>& answers) {
  std::vector<std::string_view> names;
  for (const Answer& answer : answers) { names.push_back(answer.name); }
  std::map<std::string, double, std::less<>> given;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string at = "line " + std::to_string(number) + ": ";
    line = stripped(line.substr(0, line.find('#')));
    if (line.empty()) { continue; }
    const std::size_t equals = line.find('=');
    if (equals == line.npos) { return at + "expected `name = number`"; }
    const std::string name = stripped(line.substr(0, equals)), value = stripped(line.substr(equals + 1));
    if (!contains(names, name)) { return at + "nobody asked for '" + name + "'" + suggestion(name, names); }
    if (value.empty()) { continue; }
    const auto x = number_in<double>(value);
    if (!x) { return at + "'" + value + "' is no number"; }
    given[name] = *x;
  }
  for (const Answer& answer : answers) {
    const auto found = given.find(answer.name);
    const std::string name(answer.name);
    if (found == given.end()) { return name + " is not answered yet"; }
    const double off = found->second - answer.value;
    if (!(std::abs(off) <= std::max(0.005 * std::abs(answer.value), 1e-3 * (answer.value == 0.0)))) {
      return name + " is too " + (off > 0.0 ? "large" : "small") + ": " + answer.hint;
    }
  }
  return std::nullopt;
}

}  // namespace

Fault form_factors(const std::string& text) {
  const auto square = [](double z, bool up) {
    radiosity::Polygon corners = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
    return radiosity::make_patch(up ? corners : radiosity::Polygon{corners.rbegin(), corners.rend()});
  };
  const radiosity::Patch lower = square(0.0, true), upper = square(2.0, false);
  const double f = radiosity::exchange(lower, upper);  // divided by an area of 1 m2
  return compare(text, {{"F", f, "does the formula have the sides over the distance, and its factor in front?"},
                        {"disk", radiosity::disk_estimate(lower.centre, lower.normal, upper.centre, upper.normal, upper.area),
                         "both cosines, the area, and what stands below the fraction"},
                        {"away", 1.0 - f, "what leaves a square goes to the other or misses it, nothing else"}});
}

Fault push_pull(const std::string& text) {
  constexpr double rho = 0.5, lamp = 2.0, to_p = 0.1, to_a = 0.3, area_a = 1.0, area_b = 2.0;
  constexpr double gather_p = to_p * lamp, gather_a = to_a * lamp, b_a = rho * (gather_p + gather_a), b_b = rho * gather_p;
  return compare(
      text, {{"gather_P", gather_p, "gather takes F times the radiosity of the other end, for this link alone"},
             {"gather_A", gather_a, "gather takes F times the radiosity of the other end, for this link alone"},
             {"arrived_A", gather_p + gather_a, "push adds what the parent gathered; irradiance is per m2, so is it divided by anything?"},
             {"arrived_B", gather_p, "a child without a link of its own still lies in the light of its parent"},
             {"B_A", b_a, "the leaf reflects a share of what arrives"},
             {"B_B", b_b, "the leaf reflects a share of what arrives"},
             {"B_P", (area_a * b_a + area_b * b_b) / (area_a + area_b), "pull is a mean; of two children of different size"}});
}

Fault t_vertex(const std::string& text) {
  constexpr double a = 0.2, b = 0.6, m = 0.7, coarse = (a + b) / 2.0;
  return compare(text,
                 {{"coarse", coarse, "the coarse face knows a and b alone, and Gouraud shading is linear along an edge"},
                  {"jump", m - coarse, "the fine faces show the colour of m itself"},
                  {"quarter", (m - coarse) / 2.0, "both sides are linear between a and m"},
                  {"after", 0.0, "which corners do the faces have in common then?"},
                  {"gap", 1.0 - std::sqrt(0.5), "the coarse face still has the straight edge; how far is its middle from the circle?"}});
}

}  // namespace apps::exercise
