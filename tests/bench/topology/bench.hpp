// SPDX-License-Identifier: MIT
#pragma once

// The course that every kernel runs: one text of the timed loops, and an adapter for each kernel that says how its operators are
// called (halflight.cpp, cgal.cpp, openmesh.cpp).
//
// An adapter K has Mesh, Face, Vertex and Halfedge (cheap values), name, and functions of a Mesh& m:
//   build(m, torus)                            from the face list, with the peer's reserve where it has one
//   vertices(m) edges(m) faces(m)              counts;   valid(m): the full validity pass;   collect(m): garbage collection
//   face_list vertex_list halfedge_list(m)     all faces, all vertices, the first half of every edge
//   first_half(m, h), next(m, h), loop(m, f)   loop: some half-edge of f
//   split_join_face(m, f) split_join_edge(m, h) split_join_vertex(m, v)     an operator and its inverse, at opposite corners
//   split_edge(m, h)                           keeps h's corner on the same side of it (see below)
//   refine_face(m, h0, h1, h2, h3)             the four half-edges of the mid-edge points of a face: spokes to a new centre
//   walk_faces(m) walk_vertices(m)             sums something over the half-edges, with the iterators of the kernel
// A half-edge stands for the corner where it starts (halflight) or ends (CGAL, OpenMesh). After split_edge the first half still stands
// for the same corner and the new point comes behind it; the other half stands for the new point.
//
// Time is that of the thread, so other load disturbs only through the caches. Counts are compared after each pass and the
// validator of the kernel is asked; a kernel that fails is not measured but reported, and the program fails.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace bench {

// A closed quad torus of n x n faces: v = f, e = 2f.
struct Torus {
  explicit Torus(std::uint32_t n);
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

enum class Row {
  face_sequential,
  face_shuffled,
  edge_sequential,
  edge_shuffled,
  vertex_sequential,
  vertex_shuffled,
  build,
  refine,
  refine_by_level,
  walk_faces,
  walk_vertices,
  walk_faces_refined,
  walk_vertices_refined,
  bytes,
  bytes_refined,
  validity
};

double thread_seconds();
std::size_t live_bytes();  // allocated and not yet freed, as malloc counts them
[[noreturn]] void fail(const std::string& kernel, const std::string& what);
void keep(std::uint64_t value);  // so that the sum of a walk is not optimised away

class Course {
 public:
  virtual ~Course() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  // One repetition of all rows: nanoseconds (or bytes) per operation. The first one warms caches and allocator and is thrown away.
  virtual std::map<Row, double> repeat() = 0;
};

template <class K>
class CourseOf : public Course {
 public:
  explicit CourseOf(const Torus& torus) : torus_(torus) {}
  [[nodiscard]] std::string name() const override { return K::name; }

  std::map<Row, double> repeat() override {
    rows_.clear();
    const double f = static_cast<double>(torus_.quads.size());
    const std::size_t before = live_bytes();
    auto mesh = std::make_unique<typename K::Mesh>();
    if constexpr (requires { K::build(*mesh, torus_); }) {
      time(Row::build, f, [&] { K::build(*mesh, torus_); });
    }
    rows_[Row::bytes] = static_cast<double>(live_bytes() - before) / f;
    expect(*mesh, 1, "build");

    operators(*mesh, Row::face_sequential, K::face_list(*mesh), [&](auto x) { K::split_join_face(*mesh, x); });
    operators(*mesh, Row::edge_sequential, K::halfedge_list(*mesh), [&](auto x) { K::split_join_edge(*mesh, x); });
    if constexpr (requires { K::split_join_vertex(*mesh, K::vertex_list(*mesh)[0]); }) {
      operators(*mesh, Row::vertex_sequential, K::vertex_list(*mesh), [&](auto x) { K::split_join_vertex(*mesh, x); });
    }
    mesh.reset();

    mesh = std::make_unique<typename K::Mesh>();  // fresh: operators move anchors, and walks shall go in the order of the file
    K::build(*mesh, torus_);
    walks(*mesh, Row::walk_faces, Row::walk_vertices);
    time(Row::validity, 4 * f, [&] {
      if (!K::valid(*mesh)) { fail(K::name, "validity"); }
    });
    const auto halves = K::halfedge_list(*mesh);
    std::vector<std::pair<typename K::Halfedge, bool>> loops;
    for (auto x : K::face_list(*mesh)) { loops.emplace_back(K::loop(*mesh, x), K::first_half(*mesh, K::loop(*mesh, x))); }
    time(Row::refine, 4 * f, [&] {
      for (auto h : halves) { K::split_edge(*mesh, h); }
      for (auto [h, first] : loops) {
        const auto m0 = first ? K::next(*mesh, h) : h;
        const auto m1 = K::next(*mesh, K::next(*mesh, m0)), m2 = K::next(*mesh, K::next(*mesh, m1)),
                   m3 = K::next(*mesh, K::next(*mesh, m2));
        K::refine_face(*mesh, m0, m1, m2, m3);
      }
    });
    expect(*mesh, 4, "refinement");
    rows_[Row::bytes_refined] =
        static_cast<double>(live_bytes() - before - halves.capacity() * sizeof(halves[0]) - loops.capacity() * sizeof(loops[0])) / (4 * f);
    walks(*mesh, Row::walk_faces_refined, Row::walk_vertices_refined);
    mesh.reset();
    if constexpr (requires { K::refine_by_level(torus_); }) { rows_[Row::refine_by_level] = K::refine_by_level(torus_); }
    return std::move(rows_);
  }

 private:
  template <class Body>
  void time(Row row, double operations, Body&& body) {
    const double start = thread_seconds();
    body();
    rows_[row] = 1e9 * (thread_seconds() - start) / operations;
  }

  // In memory order, then in random order: each row is the next of the enumeration.
  template <class List, class Operator>
  void operators(typename K::Mesh& mesh, Row row, List list, Operator&& cycle) {
    for (int shuffled = 0; shuffled < 2; ++shuffled) {
      if (shuffled == 1) {
        std::mt19937 random(7);
        std::shuffle(list.begin(), list.end(), random);
      }
      time(static_cast<Row>(static_cast<int>(row) + shuffled), static_cast<double>(list.size()), [&] {
        for (auto x : list) { cycle(x); }
      });
      K::collect(mesh);
      expect(mesh, 1, "operators");
    }
  }

  void walks(typename K::Mesh& mesh, Row faces, Row vertices) {
    const double halves = 2 * static_cast<double>(K::edges(mesh));
    time(faces, halves, [&] { keep(K::walk_faces(mesh)); });
    time(vertices, halves, [&] { keep(K::walk_vertices(mesh)); });
  }

  void expect(typename K::Mesh& mesh, std::size_t times, const char* after) {
    const std::size_t f = times * torus_.quads.size();
    if (K::vertices(mesh) != f || K::edges(mesh) != 2 * f || K::faces(mesh) != f) { fail(K::name, std::string("counts after ") + after); }
    if (!K::valid(mesh)) { fail(K::name, std::string("validity after ") + after); }
  }

  const Torus& torus_;
  std::map<Row, double> rows_;
};

std::vector<std::unique_ptr<Course>> halflight_courses(const Torus& torus);
std::vector<std::unique_ptr<Course>> cgal_courses(const Torus& torus);
std::vector<std::unique_ptr<Course>> openmesh_courses(const Torus& torus);

}  // namespace bench
