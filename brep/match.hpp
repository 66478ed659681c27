// SPDX-License-Identifier: MIT
#pragma once

// For the diagnosis of what close() could not stitch, independent of the attributes: which half-edge does each corner become?
//
// A corner stands for the half-edge from it to the next corner of its face. Two corners that run along the same two vertices
// in opposite directions are the halves of an edge. The edges found so far hang in chains, one for each vertex; an edge hangs at the
// end of lower degree, so that a vertex of high degree (the tip of a cone) does not make the search slow. What does not fit is
// kept for the reports in diagnosis.hpp; what is wrong with a vertex or a face by itself is reported here.

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/builder_input.hpp>

namespace brep::detail {

struct Matching {
  static constexpr std::uint32_t none = invalid_index;
  struct Edge {
    std::uint32_t origin, target;         // of the first half
    std::uint32_t next;                   // in the chain
    std::array<std::uint32_t, 2> corner;  // of the first half and of its twin
  };
  struct Extra {  // a further corner that runs along a half-edge which has one already
    std::uint32_t halfedge, corner;
  };

  std::vector<std::uint32_t> halfedge;     // of each corner, in the order of the builder
  std::vector<std::uint32_t> next_corner;  // on the same face
  std::vector<Edge> edges;
  std::vector<Extra> extras;
  std::size_t matched = 0;            // corners that have a twin, or were reported
  std::vector<std::uint32_t> degree;  // corners at a vertex
  std::vector<bool> bad;              // faces that cannot be used
  std::vector<bool> excused;          // vertices at such a face: what is missing there has been reported
  std::vector<Defect> defects;

  explicit Matching(const Builder& builder) {
    check_vertices(builder);
    check_corners(builder);
    match(builder);
  }

  static std::string name(std::uint32_t v) { return to_string(VertexId{v}); }
  void add(DefectKind kind, std::vector<Element> elements, std::string sentence) {
    defects.push_back({kind, std::move(elements), std::move(sentence)});
  }

 private:
  void check_vertices(const Builder& builder) {
    for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
      const glm::dvec3& p = builder.position(v);
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
      add(DefectKind::bad_position, {VertexId{v}}, name(v) + " has a coordinate that is not a finite number");
    }
  }

  void check_corners(const Builder& builder) {
    const std::uint32_t n = builder.vertex_count();
    bad.assign(builder.face_count(), false);
    degree.assign(n, 0);
    excused.assign(n, false);
    std::vector<std::uint32_t> seen(n, none);
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      const auto corners = builder.corners(f);
      bool wrong = corners.size() < 3;
      if (wrong) {
        add(DefectKind::few_corners, {FaceId{f}},
            to_string(FaceId{f}) + " has " + std::to_string(corners.size()) + " corners, a face needs three");
      }
      for (std::uint32_t v : corners) {
        if (v >= n) {
          add(DefectKind::bad_index, {FaceId{f}, VertexId{v}},
              to_string(FaceId{f}) + " has the corner " + name(v) + ", but there are only " + std::to_string(n) + " vertices");
          wrong = true;
          continue;
        }
        ++degree[v];
        if (seen[v] == f) {
          add(DefectKind::repeated_corner, {FaceId{f}, VertexId{v}}, to_string(FaceId{f}) + " visits " + name(v) + " twice");
          wrong = true;
        }
        seen[v] = f;
      }
      if (!wrong) continue;
      bad[f] = true;
      for (std::uint32_t v : corners) {
        if (v < n) excused[v] = true;
      }
    }
  }

  void match(const Builder& builder) {
    std::vector<std::uint32_t> chain(builder.vertex_count(), none);
    halfedge.assign(builder.corner_count(), none);
    next_corner.resize(builder.corner_count());
    edges.reserve(builder.corner_count() / 2 + 1);
    std::uint32_t corner = 0;
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      const auto corners = builder.corners(f);
      const std::uint32_t first = corner, count = static_cast<std::uint32_t>(corners.size());
      corner += count;
      if (bad[f]) {
        matched += count;
        continue;
      }
      for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t here = first + k, following = k + 1 < count ? k + 1 : 0;
        next_corner[here] = first + following;
        halfedge[here] = match(corners[k], corners[following], here, chain);
      }
    }
  }

  // The half-edge from u to w for this corner: a new edge's first half, or the twin of one that was met before.
  std::uint32_t match(std::uint32_t u, std::uint32_t w, std::uint32_t corner, std::vector<std::uint32_t>& chain) {
    const bool at_u = degree[u] < degree[w] || (degree[u] == degree[w] && u < w);
    std::uint32_t& head = chain[at_u ? u : w];
    for (std::uint32_t e = head; e != none; e = edges[e].next) {
      Edge& edge = edges[e];
      const bool same = edge.origin == u && edge.target == w;
      if (!same && !(edge.origin == w && edge.target == u)) continue;
      const std::uint32_t half = same ? 0 : 1;
      if (edge.corner[half] == none) {
        edge.corner[half] = corner;
        matched += 2;
      } else {
        extras.push_back({2 * e + half, corner});
      }
      return 2 * e + half;
    }
    edges.push_back({u, w, head, {corner, none}});
    head = static_cast<std::uint32_t>(edges.size() - 1);
    return 2 * head;
  }
};

}  // namespace brep::detail
