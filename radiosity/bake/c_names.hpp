// SPDX-License-Identifier: MIT
#pragma once

// The options and figures of halflight.h, by name.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include <radiosity/bake/bake.hpp>

namespace radiosity::c_interface {

// C has no optional values: 0 turns these options off.
template <class Number>
[[nodiscard]] std::optional<Number> unless_zero(Number value) {
  return value != Number{} ? std::optional(value) : std::nullopt;
}

// An option: its name, its permitted range, and where its value is stored.
struct NumberOption {
  std::string_view name;
  double least, most;
  bool whole;
  void (*set)(BakeOptions& options, double value);
};

inline constexpr double any = std::numeric_limits<double>::max();
inline constexpr double exact = 9007199254740992.0;  // whole numbers up to here

inline constexpr std::array<NumberOption, 11> number_options{{
    {"epsilon", 0.0, 1.0, false, [](BakeOptions& o, double v) { o.solve.epsilon = v; }},
    {"min_area", 0.0, 1.0, false, [](BakeOptions& o, double v) { o.solve.min_area = v; }},
    {"error", 0.0, 1.0, false, [](BakeOptions& o, double v) { o.solve.error = unless_zero(v); }},
    {"seconds", 0.0, any, false,
     [](BakeOptions& o, double v) {
       o.solve.time = unless_zero(v);
       o.solve.refinement = o.solve.time ? radiosity::Refinement::a_posteriori : radiosity::Refinement::a_priori;
     }},
    {"audit_points", 0.0, 1e8, true, [](BakeOptions& o, double v) { o.solve.audit_points = static_cast<std::uint32_t>(v); }},
    {"threads", 0.0, 4096.0, true, [](BakeOptions& o, double v) { o.solve.threads = static_cast<unsigned>(v); }},
    {"seed", 0.0, exact, true, [](BakeOptions& o, double v) { o.solve.seed = static_cast<std::uint64_t>(v); }},
    {"memory", 0.0, exact, true, [](BakeOptions& o, double v) { o.solve.memory = unless_zero(static_cast<std::uint64_t>(v)); }},
    {"weld", 0.0, radiosity::largest_weld, false, [](BakeOptions& o, double v) { o.intake.weld = v; }},
    {"two_sided", 0.0, 1.0, true, [](BakeOptions& o, double v) { o.intake.two_sided = v != 0.0; }},
    {"merge", 0.0, 1.0, true, [](BakeOptions& o, double v) { o.intake.merge = v != 0.0; }},
}};

struct Figure {
  std::string_view name;
  std::optional<double> (*value)(const radiosity::Baked& baked);
};

template <class Number>
[[nodiscard]] std::optional<double> number(Number value) {
  return static_cast<double>(value);
}

[[nodiscard]] inline std::optional<double> of_error(const radiosity::Baked& baked, double radiosity::ErrorEstimate::*value) {
  return baked.audit.surface_error ? std::optional((*baked.audit.surface_error).*value) : std::nullopt;
}

inline constexpr std::array<Figure, 16> figures{{
    {"error",
     [](const radiosity::Baked& b) {  // its upper bound if noise hides it: 0 would be read as exact
       const auto error = of_error(b, &radiosity::ErrorEstimate::relative_l2), low = of_error(b, &radiosity::ErrorEstimate::low);
       return low && *low > 0.0 ? error : of_error(b, &radiosity::ErrorEstimate::high);
     }},
    {"error_low", [](const radiosity::Baked& b) { return of_error(b, &radiosity::ErrorEstimate::low); }},
    {"error_high", [](const radiosity::Baked& b) { return of_error(b, &radiosity::ErrorEstimate::high); }},
    {"seconds", [](const radiosity::Baked& b) { return number(b.audit.wall_seconds); }},
    {"cpu_seconds", [](const radiosity::Baked& b) { return number(b.audit.cpu_seconds); }},
    {"faces", [](const radiosity::Baked& b) { return number(b.faces); }},
    {"leaves", [](const radiosity::Baked& b) { return number(b.audit.leaves); }},
    {"links", [](const radiosity::Baked& b) { return number(b.audit.links); }},
    {"rays", [](const radiosity::Baked& b) { return number(b.audit.rays); }},
    {"residual", [](const radiosity::Baked& b) { return number(b.audit.residual); }},
    {"iterations", [](const radiosity::Baked& b) { return number(b.audit.iterations); }},
    {"converged", [](const radiosity::Baked& b) { return number(b.audit.status() == radiosity::RunStatus::converged); }},
    {"interrupted", [](const radiosity::Baked& b) { return number(b.audit.interrupted); }},
    {"coarsened", [](const radiosity::Baked& b) { return number(b.audit.coarsened); }},
    {"epsilon", [](const radiosity::Baked& b) { return number(b.audit.epsilon); }},
    {"without", [](const radiosity::Baked& b) { return number(b.colors.without); }},
}};

}  // namespace radiosity::c_interface
