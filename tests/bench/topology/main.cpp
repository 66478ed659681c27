// SPDX-License-Identifier: MIT
// Speed of the kernel against its peers, side by side in one run.
//
//   cmake --build build/release --target bench_topology && build/release/tests/bench/bench_topology [n [repetitions]]
//
// prints nanoseconds per operation, median [minimum] over the repetitions, for a closed quad torus of n x n faces (316). Repetitions
// of the kernels are interleaved. Memory: malloc keeps what is freed, so every kernel works in warm memory. README.md has a table.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "bench.hpp"

namespace {
volatile std::uint64_t sink = 0;
}  // namespace

namespace bench {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
std::size_t live_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}
void fail(const std::string& kernel, const std::string& what) {
  std::fprintf(stderr, "%s: wrong %s\n", kernel.c_str(), what.c_str());
  std::exit(1);
}
void keep(std::uint64_t value) { sink = value; }

Torus::Torus(std::uint32_t n) {
  const auto angle = [&](std::uint32_t i) { return 6.2831853f * static_cast<float>(i) / static_cast<float>(n); };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const float r = 2.0f + std::cos(angle(k));
      positions.push_back({r * std::cos(angle(i)), r * std::sin(angle(i)), std::sin(angle(k))});
      const std::uint32_t i1 = (i + 1) % n, k1 = (k + 1) % n;
      quads.push_back({i * n + k, i1 * n + k, i1 * n + k1, i * n + k1});
    }
  }
}

}  // namespace bench

namespace {

using bench::Row;

struct Line {
  Row row;
  const char* text;
  double goal;   // halflight against the best peer: so many times faster (smaller)
  double limit;  // or an absolute limit
};
constexpr Line lines[] = {
    {Row::face_sequential, "split + join face", 2, 0},
    {Row::face_shuffled, "  shuffled", 1, 0},
    {Row::edge_sequential, "split edge + undo", 2, 0},
    {Row::edge_shuffled, "  shuffled", 1, 0},
    {Row::vertex_sequential, "split + join vertex", 2, 0},
    {Row::vertex_shuffled, "  shuffled", 1, 0},
    {Row::build, "build from face list, per face", 4, 0},
    {Row::refine, "1-to-4 refinement, per new quad", 2, 0},
    {Row::refine_by_level, "  refine.hpp, by level, placed", 0, 0},
    {Row::walk_faces, "walk around faces, per half-edge", 1, 0},
    {Row::walk_vertices, "walk around vertices", 1, 0},
    {Row::walk_faces_refined, "  faces, refined mesh", 1, 0},
    {Row::walk_vertices_refined, "  vertices, refined mesh", 1, 0},
    {Row::bytes, "bytes per quad face", 0, 85},
    {Row::bytes_refined, "  refined mesh", 0, 85},
    {Row::validity, "validity pass, per half-edge", 0, 3},
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const std::uint32_t n = count > 1 ? static_cast<std::uint32_t>(std::atoi(arguments[1])) : 316;
  const int repetitions = count > 2 ? std::atoi(arguments[2]) : 9;
  if (n < 3 || n > 4000 || repetitions < 1) {
    std::fprintf(stderr, "usage: bench_topology [n = 3..4000 [repetitions]]\n");
    return 2;
  }
  const bench::Torus torus(n);
  auto courses = bench::halflight_courses(torus);
  const std::size_t own = courses.size();
#ifdef HALFLIGHT_BENCH_CGAL
  for (auto& course : bench::cgal_courses(torus)) { courses.push_back(std::move(course)); }
#else
  std::printf("CGAL was not found: its columns are left out\n");
#endif
#ifdef HALFLIGHT_BENCH_OPENMESH
  for (auto& course : bench::openmesh_courses(torus)) { courses.push_back(std::move(course)); }
#else
  std::printf("OpenMesh was not found: its column is left out\n");
#endif

  std::vector<std::map<Row, std::vector<double>>> results(courses.size());
  for (int repetition = -1; repetition < repetitions; ++repetition) {  // the first one warms up
    for (std::size_t k = 0; k < courses.size(); ++k) {
      for (const auto& [row, value] : courses[k]->repeat()) {
        if (repetition >= 0) { results[k][row].push_back(value); }
      }
    }
  }

  std::printf("closed quad torus, %zu faces; ns per operation, median [minimum] of %d\n\n", torus.quads.size(), repetitions);
  std::printf("%-34s", "");
  for (const auto& course : courses) { std::printf("%18s", course->name().c_str()); }
  std::printf("   best peer / halflight (unchecked), goal\n");
  for (const Line& line : lines) {
    std::printf("%-34s", line.text);
    double best = 0;
    std::vector<double> mine;
    for (std::size_t k = 0; k < courses.size(); ++k) {
      const auto found = results[k].find(line.row);
      if (found == results[k].end()) {
        std::printf("%18s", "-");
        continue;
      }
      const double value = median(found->second);
      std::printf("%10.1f [%5.1f]", value, *std::min_element(found->second.begin(), found->second.end()));
      if (k < own) {
        mine.push_back(value);
      } else if (best == 0 || value < best) {
        best = value;
      }
    }
    std::printf("   ");
    if (best > 0) {
      std::printf("%5.2f", best / mine[0]);
      if (mine.size() > 1) { std::printf(" (%.2f)", best / mine[1]); }
    }
    if (line.goal > 0) { std::printf("  goal %gx", line.goal); }
    if (line.limit > 0) { std::printf("  goal <= %g", line.limit); }
    std::printf("\n");
  }
}
