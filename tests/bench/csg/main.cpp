// SPDX-License-Identifier: MIT
// Speed of brep/csg beside CGAL's corefinement, in one run.
//
//   cmake --build build/release --target bench_csg && build/release/tests/bench/bench_csg [repetitions [small]]
//
// prints CPU milliseconds, median over the repetitions, which are interleaved. The column manifold is not measured here: it holds the
// figures that manifold 3.5.1 had beside CGAL on another day, times the ratio of CGAL's exact times, today's to that day's. Every volume is
// checked; a wrong one, or a refusal, ends the program with code 1.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "bench.hpp"

namespace bench {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace bench

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Cell {
  std::vector<double> milliseconds, rest;
  bench::Outcome last;
};

}  // namespace

int main(int count, char** arguments) {
  const int repetitions = count > 1 ? std::atoi(arguments[1]) : 7;
  const bool all = count < 3 || std::strcmp(arguments[2], "small") != 0;
  if (repetitions < 1) {
    std::fprintf(stderr, "usage: bench_csg [repetitions [small]]\n");
    return 2;
  }
  std::vector<std::unique_ptr<bench::Engine>> engines;
  engines.push_back(bench::halflight_engine());
#ifdef HALFLIGHT_BENCH_CGAL
  engines.push_back(bench::cgal_exact_engine());
  engines.push_back(bench::cgal_inexact_engine());
#else
  std::printf("CGAL was not found: its columns and manifold's are left out\n");
#endif
  const std::vector<bench::Case> cases = bench::cases(all);
  std::vector<std::vector<Cell>> table(cases.size(), std::vector<Cell>(engines.size()));
  bool wrong = false;
  for (std::size_t row = 0; row < cases.size(); ++row) {
    for (int repetition = -1; repetition < repetitions; ++repetition) {  // the first one warms up
      for (std::size_t k = 0; k < engines.size(); ++k) {
        const auto outcome = engines[k]->run(cases[row]);
        if (!outcome) { continue; }
        Cell& cell = table[row][k];
        cell.last = *outcome;
        // Operands of 26 bits: the volume is known to about 1e-7 of itself.
        if (outcome->failed || !(std::abs(outcome->volume - cases[row].volume) <= 1e-6 * cases[row].volume)) {
          std::fprintf(stderr, "%s: %s: %s, volume %.12g instead of %.12g\n", engines[k]->name().c_str(), cases[row].name.c_str(),
                       outcome->failed ? "refused" : "wrong", outcome->volume, cases[row].volume);
          wrong = wrong || k == 0;
        }
        if (repetition < 0 && repetitions > 1 && outcome->seconds < 5.0) { continue; }
        cell.milliseconds.push_back(1e3 * outcome->seconds);
        cell.rest.push_back(1e3 * outcome->in_and_out);
        if (outcome->seconds > 5.0) repetition = repetitions;  // once is enough
      }
    }
  }

  // Today against the day of manifold's figures: where CGAL was not run in a row, the geometric mean of the others.
  double logs = 0.0;
  int rows = 0;
  const auto day = [&](std::size_t row) -> std::optional<double> {
    if (engines.size() < 2 || table[row][1].milliseconds.empty() || !cases[row].cgal_exact) { return std::nullopt; }
    return median(table[row][1].milliseconds) / *cases[row].cgal_exact;
  };
  for (std::size_t row = 0; row < cases.size(); ++row) {
    if (const auto ratio = day(row)) { logs += std::log(*ratio), ++rows; }
  }

  std::printf("CPU ms, median of %d; in brackets: operands in and result out\n\n%-32s", repetitions, "");
  for (const auto& engine : engines) { std::printf("%20s", engine->name().c_str()); }
  std::printf("%12s %22s   faces: halflight, CGAL\n", "manifold*", "manifold / halflight");
  for (std::size_t row = 0; row < cases.size(); ++row) {
    std::printf("%-32s", cases[row].name.c_str());
    for (const Cell& cell : table[row]) {
      if (cell.milliseconds.empty()) {
        std::printf("%20s", "-");
      } else {
        std::printf("%11.2f [%6.2f]", median(cell.milliseconds), median(cell.rest));
      }
    }
    if (cases[row].manifold && rows > 0) {
      const double scaled = *cases[row].manifold * day(row).value_or(std::exp(logs / rows));
      std::printf("%12.2f %22.2f", scaled, scaled / median(table[row][0].milliseconds));
    } else {
      std::printf("%12s %22s", "-", "-");
    }
    std::printf("   %zu", table[row][0].last.faces);
    if (engines.size() > 1 && !table[row][1].milliseconds.empty()) { std::printf(", %zu", table[row][1].last.faces); }
    std::printf("\n");
  }
  return wrong ? 1 : 0;
}
