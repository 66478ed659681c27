// SPDX-License-Identifier: MIT
#pragma once

// What the tests of brep/ share: attribute types, small solids, and a picture of all records to compare before and after.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <brep/builder.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/tag.hpp>
#include <brep/validate.hpp>

#include "box.hpp"
#include "catch.hpp"

namespace shapes {

struct Vertex : brep::Tag {
  glm::dvec3 position{0.0};
};
struct Face : brep::Tag {
  std::uint32_t sheet = 77;
  int label = 0;  // anything of the user's
};
using Mesh = brep::BRep<Vertex, brep::NoData, Face>;

// The corners of each face of a builder, and a builder with other faces on the same vertices.
using Faces = std::vector<std::vector<std::uint32_t>>;

inline Faces faces_of(const brep::Builder& b) {
  Faces all;
  for (std::uint32_t f = 0; f < b.face_count(); ++f) { all.emplace_back(b.corners(f).begin(), b.corners(f).end()); }
  return all;
}
inline brep::Builder with_faces(const brep::Builder& positions, const Faces& faces, std::uint32_t extra_vertices = 0) {
  brep::Builder b;
  for (std::uint32_t v = 0; v < positions.vertex_count(); ++v) { b.vertex(positions.position(v)); }
  for (std::uint32_t v = 0; v < extra_vertices; ++v) { b.vertex({9.0, 9.0, static_cast<double>(v)}); }
  for (const auto& corners : faces) { b.face(corners, 0); }
  return b;
}
inline bool names(const brep::Defect& d, brep::Element e) { return std::find(d.elements.begin(), d.elements.end(), e) != d.elements.end(); }

constexpr double pi = 3.14159265358979323846;

inline brep::Builder cube_builder() { return box(glm::dvec3(0.0), glm::dvec3(1.0)); }
inline brep::Builder tetrahedron_builder() {
  brep::Builder b;
  b.vertex({0, 0, 0});
  b.vertex({1, 0, 0});
  b.vertex({0, 1, 0});
  b.vertex({0, 0, 1});
  b.face({0, 2, 1}, 0);
  b.face({0, 1, 3}, 1);
  b.face({1, 2, 3}, 2);
  b.face({2, 0, 3}, 3);
  return b;
}
// A regular n-gon of circumscribed radius 1 and height 1: two n-gons and n quadrilaterals.
inline brep::Builder prism_builder(std::uint32_t n) {
  brep::Builder b;
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    const double angle = 2.0 * pi * (i % n) / n;
    b.vertex({std::cos(angle), std::sin(angle), i < n ? 0.0 : 1.0});
    if (i < n) {
      bottom.insert(bottom.begin(), i);
    } else {
      top.push_back(i);
    }
  }
  b.face(bottom, 0);
  b.face(top, 1);
  for (std::uint32_t i = 0; i < n; ++i) { b.face({i, (i + 1) % n, n + (i + 1) % n, n + i}, 2); }
  return b;
}
// A polygon in the plane z = 0 and its back.
inline brep::Builder pillow_builder(const std::vector<glm::dvec2>& outline) {
  brep::Builder b;
  std::vector<std::uint32_t> front, back;
  for (const glm::dvec2& p : outline) {
    front.push_back(b.vertex({p.x, p.y, 0.0}));
    back.insert(back.begin(), front.back());
  }
  b.face(front, 0);
  b.face(back, brep::no_sheet);
  return b;
}
// m x n quadrilaterals on a torus.
inline brep::Builder torus_builder(std::uint32_t m, std::uint32_t n) {
  brep::Builder b;
  for (std::uint32_t i = 0; i < m * n; ++i) {
    const double u = 2.0 * pi * (i % m) / m, w = 2.0 * pi * (i / m) / n;
    b.vertex({(2.0 + std::cos(w)) * std::cos(u), (2.0 + std::cos(w)) * std::sin(u), std::sin(w)});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < m; ++x) {
      b.face({y * m + x, y * m + (x + 1) % m, (y + 1) % n * m + (x + 1) % m, (y + 1) % n * m + x}, 0);
    }
  }
  return b;
}

template <class B = Mesh>
B build(const brep::Builder& builder) {
  brep::BuildResult<B> result = brep::close<B>(builder);
  for (const brep::Defect& defect : result.defects) { UNSCOPED_INFO(defect.sentence); }
  REQUIRE(result.brep.has_value());
  return std::move(*result.brep);
}

// The sentences of all faults, empty for a valid BRep: CHECK(faults(mesh) == "").
template <class B>
std::string faults(const B& mesh) {
  std::string all;
  for (const brep::Fault& fault : brep::validate(mesh)) { all += fault.sentence + '\n'; }
  return all;
}

// Every record of every living element, and the counts.
template <class B>
std::vector<std::uint32_t> records(const B& mesh) {
  using brep::detail::Raw;
  std::vector<std::uint32_t> all;
  for (brep::EdgeId e : brep::edges(mesh)) {
    for (brep::HalfedgeId h : {brep::halfedge(e), brep::twin(brep::halfedge(e))}) {
      const auto& r = Raw::at(mesh, h);
      all.insert(all.end(), {h.index, r.next.index, r.prev.index, r.vertex.index, r.face.index});
    }
  }
  for (brep::VertexId v : brep::vertices(mesh)) { all.insert(all.end(), {v.index, mesh.halfedge(v).index}); }
  for (brep::FaceId f : brep::faces(mesh)) { all.insert(all.end(), {f.index, mesh.halfedge(f).index}); }
  for (std::size_t count : {mesh.vertex_count(), mesh.edge_count(), mesh.face_count()}) {
    all.push_back(static_cast<std::uint32_t>(count));
  }
  return all;
}

// What decides all that a BRep will ever do: every record of every living element, the counts, and which slots each pool hands out next,
// the free ones in their order and then fresh ones. A free slot that a fresh one would equal is left out: an operator
// may have used it for the first time.
enum class Anchors { shown, hidden };
template <class B>
std::vector<std::uint32_t> picture(const B& mesh, Anchors anchors = Anchors::shown) {
  using brep::detail::Raw;
  std::vector<std::uint32_t> all;
  all.reserve(5 * mesh.halfedge_end() + 3 * (mesh.vertex_end() + mesh.face_end()) + 12);
  const auto add_pool = [&](const auto& pool, std::uint32_t step, auto&& add_record) {
    using Pool = std::decay_t<decltype(pool)>;
    all.push_back(pool.count());
    for (std::uint32_t i = 0; i < pool.size(); i += step) {
      if (pool.alive(i)) { add_record(i); }
    }
    const std::size_t first = all.size();
    for (std::uint32_t i = pool.first_free(); i != Pool::end_of_list; i = link(pool[i]) & ~Pool::dead_bit) { all.push_back(i); }
    std::uint32_t fresh = pool.size();
    for (; all.size() > first && all.back() + step == fresh; fresh -= step) { all.pop_back(); }
    all.push_back(fresh);
  };
  add_pool(Raw::halfedges(mesh), 2, [&](std::uint32_t i) {
    for (std::uint32_t k : {i, i + 1}) {
      const auto& r = Raw::halfedges(mesh)[k];
      all.insert(all.end(), {k, r.next.index, r.prev.index, r.vertex.index, r.face.index});
    }
  });
  const bool shown = anchors == Anchors::shown;
  add_pool(Raw::vertices(mesh), 1, [&](std::uint32_t i) { all.insert(all.end(), {i, shown ? Raw::vertices(mesh)[i].halfedge.index : 0}); });
  add_pool(Raw::faces(mesh), 1, [&](std::uint32_t i) { all.insert(all.end(), {i, shown ? Raw::faces(mesh)[i].halfedge.index : 0}); });
  return all;
}

template <class B>
std::vector<brep::HalfedgeId> all_halfedges(const B& mesh) {
  std::vector<brep::HalfedgeId> all;
  for (brep::EdgeId e : brep::edges(mesh)) {
    all.push_back(brep::halfedge(e));
    all.push_back(brep::twin(brep::halfedge(e)));
  }
  return all;
}

template <class B>
double total_area(const B& mesh) {
  double sum = 0.0;
  for (brep::FaceId f : brep::faces(mesh)) { sum += brep::area(mesh, f); }
  return sum;
}

// A generator whose seed is printed when a check of the test fails.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  double unit() { return static_cast<double>(engine_()) / 4294967296.0; }

 private:
  std::mt19937 engine_;
};

}  // namespace shapes
