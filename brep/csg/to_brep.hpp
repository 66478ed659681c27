// SPDX-License-Identifier: MIT
#pragma once

// From an exact solid back to a BRep with positions in double, and the measures of a solid.
//
// Every umbrella of faces at a point becomes a vertex of its own, so where a solid touches itself the BRep is still a 2-manifold. Every
// cycle of a face becomes a face at first; then the cycles of one face are joined by bridge edges with the Euler operator, hole by hole.
// Face i of the solid is FaceId{i}.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/csg/bridges.hpp>
#include <brep/csg/directions.hpp>
#include <brep/csg/solid.hpp>

namespace brep::csg {

namespace detail {

// Twice the area of a face as a vector, in spacings.
[[nodiscard]] inline glm::dvec3 double_area(const Boundary& b, const Face& f) {
  const glm::dvec3 o = b.points[b.halves[f.first].point].position;
  glm::dvec3 sum{0.0};
  for (std::uint32_t h = f.first; h < f.first + f.count; ++h) {
    sum += glm::cross(b.points[b.halves[h].point].position - o, b.points[b.halves[b.halves[h].next].point].position - o);
  }
  return sum;
}

}  // namespace detail

// In the units of the leaves. Exact except for the rounding of coordinates (2^-27 spacings) and sums.
template <class F>
[[nodiscard]] double area(const Solid<F>& solid) {
  double sum = 0.0;
  for (const Face& f : solid.faces().faces) { sum += 0.5 * glm::length(detail::double_area(solid.faces(), f)); }
  return sum * solid.grid().spacing() * solid.grid().spacing();
}
template <class F>
[[nodiscard]] double volume(const Solid<F>& solid) {
  const Boundary& b = solid.faces();
  if (b.faces.empty()) { return 0.0; }
  const glm::dvec3 origin = b.points[0].position;
  double sum = 0.0;
  for (const Face& f : b.faces) { sum += glm::dot(detail::double_area(b, f), b.points[b.halves[f.first].point].position - origin) / 6.0; }
  return sum * solid.grid().spacing() * solid.grid().spacing() * solid.grid().spacing();
}

namespace detail {

template <class B>
class Export {
 public:
  Export(const Grid& grid, const Boundary& boundary) : grid_(grid), boundary_(boundary) {}

  template <class SetFace>
  B run(SetFace&& set_face) {
    using brep::detail::Raw;
    const auto count = static_cast<std::uint32_t>(boundary_.halves.size());
    name_halves();
    Raw::halfedges(brep_).append(count / 2);
    const std::vector<std::uint32_t> vertex = umbrellas();
    std::vector<std::uint32_t> cycle(count, invalid_index);
    std::vector<std::uint32_t> first;  // a half-edge of each cycle: first the one of each face, then further ones
    const auto walk = [&](std::uint32_t h) {
      for (std::uint32_t x = h; cycle[x] == invalid_index; x = boundary_.halves[x].next) {
        cycle[x] = static_cast<std::uint32_t>(first.size());
      }
      first.push_back(h);
    };
    for (const Face& f : boundary_.faces) { walk(outer(f)); }
    for (std::uint32_t h = 0; h < count; ++h) {
      if (cycle[h] == invalid_index) { walk(h); }
    }
    Raw::faces(brep_).append(static_cast<std::uint32_t>(first.size()));
    for (std::uint32_t f = 0; f < first.size(); ++f) {
      Raw::at(brep_, FaceId{f}).halfedge = HalfedgeId{name_[first[f]]};
      if (f < boundary_.faces.size()) { set_face(brep_.data(FaceId{f}), boundary_.faces[f].attribute); }
    }
    for (std::uint32_t h = 0; h < count; ++h) {
      const Half& half = boundary_.halves[h];
      const HalfedgeId id{name_[h]}, next{name_[half.next]};
      auto& r = Raw::at(brep_, id);
      r.next = next;
      r.vertex = VertexId{vertex[h]};
      r.face = FaceId{cycle[h]};
      Raw::at(brep_, next).prev = id;
    }
    std::vector<std::vector<HalfedgeId>> holes(boundary_.faces.size());
    for (std::size_t c = boundary_.faces.size(); c < first.size(); ++c) {
      holes[boundary_.halves[first[c]].face].push_back(HalfedgeId{name_[first[c]]});
    }
    for (std::uint32_t f = 0; f < holes.size(); ++f) {
      if (holes[f].empty()) { continue; }
      holes[f].push_back(HalfedgeId{name_[first[f]]});
      const OrientedPlane plane = boundary_.faces[f].plane;
      const Projection on(grid_.planes()[plane.number()], plane.sign());
      const auto place = [&, on](HalfedgeId h) {
        const glm::dvec3 p = grid_.to_grid(brep_.data(brep_.vertex(h)).position);
        return glm::dvec2{p[on.u], p[on.v]};
      };
      Bridges(brep_, place, holes[f]).run();
    }
    return std::move(brep_);
  }

 private:
  // Twins lie side by side in a BRep.
  void name_halves() {
    name_.assign(boundary_.halves.size(), invalid_index);
    std::uint32_t next = 0;
    for (std::uint32_t h = 0; h < name_.size(); ++h) {
      if (name_[h] != invalid_index) { continue; }
      name_[h] = next;
      name_[boundary_.halves[h].twin] = next + 1;
      next += 2;
    }
  }

  // A half-edge of the cycle around the face: the one of largest area, seen from outside.
  [[nodiscard]] std::uint32_t outer(const Face& f) const {
    const Plane& plane = grid_.planes()[f.plane.number()];
    const glm::dvec3 normal = glm::dvec3{plane.normal[0], plane.normal[1], plane.normal[2]} * static_cast<double>(f.plane.sign());
    std::uint32_t best = f.first;
    double largest = 0.0;
    std::vector<bool> seen(f.count, false);
    for (std::uint32_t h = f.first; h < f.first + f.count; ++h) {
      if (seen[h - f.first]) { continue; }
      const glm::dvec3 o = boundary_.points[boundary_.halves[h].point].position;
      glm::dvec3 sum{0.0};
      for (std::uint32_t x = h; !seen[x - f.first]; x = boundary_.halves[x].next) {
        seen[x - f.first] = true;
        sum += glm::cross(boundary_.points[boundary_.halves[x].point].position - o,
                          boundary_.points[boundary_.halves[boundary_.halves[x].next].point].position - o);
      }
      if (glm::dot(sum, normal) > largest) { best = h, largest = glm::dot(sum, normal); }
    }
    return best;
  }

  // Makes a vertex for each umbrella; returns that of each half-edge.
  [[nodiscard]] std::vector<std::uint32_t> umbrellas() {
    using brep::detail::Raw;
    std::vector<std::uint32_t> previous(boundary_.halves.size()), vertex(boundary_.halves.size(), invalid_index), start;
    for (std::uint32_t h = 0; h < previous.size(); ++h) { previous[boundary_.halves[h].next] = h; }
    for (std::uint32_t h = 0; h < vertex.size(); ++h) {
      if (vertex[h] != invalid_index) { continue; }
      for (std::uint32_t x = h; vertex[x] == invalid_index; x = boundary_.halves[previous[x]].twin) {
        vertex[x] = static_cast<std::uint32_t>(start.size());
      }
      start.push_back(h);
    }
    Raw::vertices(brep_).append(static_cast<std::uint32_t>(start.size()));
    for (std::uint32_t v = 0; v < start.size(); ++v) {
      Raw::at(brep_, VertexId{v}).halfedge = HalfedgeId{name_[start[v]]};
      brep_.data(VertexId{v}).position = grid_.from_grid(boundary_.points[boundary_.halves[start[v]].point].position);
    }
    return vertex;
  }

  const Grid& grid_;
  const Boundary& boundary_;
  B brep_;
  std::vector<std::uint32_t> name_;
};

}  // namespace detail

// The BRep of a solid. Vertex data get their `position`; set_face(face data, attribute) is called for every face.
// Valid and closed for every solid; positions are rounded, so what is thinner than a double can show collapses: check_export tells.
template <class B, class F, class SetFace>
[[nodiscard]] B to_brep(const Solid<F>& solid, SetFace&& set_face) {
  return detail::Export<B>(solid.grid(), solid.faces()).run([&](typename B::face_type& data, std::uint32_t attribute) {
    set_face(data, solid.attributes()[attribute]);
  });
}
// The same for face data with a `sheet`, which gets the attribute.
template <class B, class F>
[[nodiscard]] B to_brep(const Solid<F>& solid) {
  return to_brep<B>(solid, [](typename B::face_type& data, const F& attribute) { data.sheet = attribute; });
}

}  // namespace brep::csg
