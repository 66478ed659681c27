// SPDX-License-Identifier: MIT
#pragma once

// Form factors of curved objects that see each other freely: the exchanges of two meshes of each, extrapolated to the smooth surface.
//
// The error of a mesh is h^2, h its chord length, so what a finer mesh changes tells what the finest would change (Richardson 1911):
// F = F_2 + (F_2 - F_1) / (r - 1), r the ratio of the chord errors. Each end of a pair has its own ratio and its own correction. The error
// that is stated is that of the next order, the square of the relative correction, and never below 1/200 of the correction, because where
// surfaces touch the next order is h^3 or h^4 log h.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/scene.hpp>

#include <radiosity/exchange.hpp>
#include <radiosity/factor_faces.hpp>
#include <radiosity/factor_rows.hpp>
#include <radiosity/patch.hpp>

namespace radiosity {

// Two meshes of a row, the finer one last; of a flat row with straight borders one, which is exact.
struct RowMeshes {
  std::vector<Patch> level[2];
  double ratio = 1.0;  // of the chord errors; 1: there is only level 1
  Estimate area;
};

namespace detail {

// The value at h = 0, from those of two meshes.
[[nodiscard]] inline double correction(double coarse, double fine, double ratio) {
  return ratio > 1.0 ? (fine - coarse) / (ratio - 1.0) : 0.0;
}
[[nodiscard]] inline double next_order(double value, double correction) {
  const double relative = value > 0.0 ? std::abs(correction) / value : 0.0;
  return value * std::max(relative * relative, 0.005 * relative) + 1e-8 * value;
}

struct ObjectMesh {
  std::vector<std::vector<Patch>> patches;  // by sheet
  double chord_error = 0.0;                 // mean over the vertices' faces of the distance of their middles from the surface
  std::size_t faces = 0, most_corners = 0;
};

[[nodiscard]] inline ObjectMesh mesh_of(const raycast::PlacedObject& object, double tolerance) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  ObjectMesh mesh;
  mesh.patches.resize(object.sheet_count());
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const std::uint32_t sheet = builder.sheet(f);
    if (sheet == brep::no_sheet) { continue; }
    Polygon contour;
    glm::dvec3 middle{0.0};
    for (const std::uint32_t v : builder.corners(f)) { contour.push_back(builder.position(v)); }
    for (const glm::dvec3& p : contour) { middle += p / static_cast<double>(contour.size()); }
    ++mesh.faces;
    mesh.most_corners = std::max(mesh.most_corners, contour.size());
    mesh.chord_error += glm::length(object.project(sheet, middle).position - middle);
    const glm::dvec3 normal = vector_area(contour);
    const bool planar = std::all_of(contour.begin(), contour.end(), [&](const glm::dvec3& p) {
      return std::abs(glm::dot(normal, p - middle)) <= 1e-12 * glm::length(normal);
    });
    if (planar || contour.size() != 4) {
      mesh.patches[sheet].push_back(make_patch(contour));
    } else {
      mesh.patches[sheet].push_back(make_patch({contour[0], contour[1], contour[2]}));
      mesh.patches[sheet].push_back(make_patch({contour[0], contour[2], contour[3]}));
    }
  }
  mesh.chord_error /= static_cast<double>(std::max<std::size_t>(1, mesh.faces));
  return mesh;
}

[[nodiscard]] inline double exchange_of(const std::vector<Patch>& p, const std::vector<Patch>& q) {
  double sum = 0.0;
  for (const Patch& a : p) {
    for (const Patch& b : q) {
      if (&a != &b && glm::dot(a.normal, b.centre - a.centre) > -b.radius && glm::dot(b.normal, a.centre - b.centre) > -a.radius) {
        sum += exchange(a, b);
      }
    }
  }
  return sum;
}

}  // namespace detail

// The meshes of the rows of one curved object: the coarser one of some hundred faces, the other of about four times as many.
inline void make_meshes(const raycast::PlacedObject& object, std::span<const std::uint32_t> row_of_sheet, std::vector<RowMeshes>& rows) {
  double tolerance = 0.02 * object.bounds().diameter();
  detail::ObjectMesh coarse = detail::mesh_of(object, tolerance);
  for (int round = 0; round < 16 && coarse.faces < 200 && coarse.most_corners < 64; ++round) {
    tolerance *= 0.7;
    coarse = detail::mesh_of(object, tolerance);
  }
  const detail::ObjectMesh fine = detail::mesh_of(object, 0.25 * tolerance);
  const double by_corners =
      static_cast<double>(fine.most_corners * fine.most_corners) / static_cast<double>(coarse.most_corners * coarse.most_corners);
  const double ratio = object.flat() ? by_corners : coarse.chord_error / fine.chord_error;
  for (std::uint32_t s = 0; s < row_of_sheet.size(); ++s) {
    RowMeshes& row = rows[row_of_sheet[s]];
    row.level[0] = coarse.patches[s];
    row.level[1] = fine.patches[s];
    row.ratio = ratio;
    double area[2] = {0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
      for (const Patch& patch : row.level[k]) { area[k] += patch.area; }
    }
    const double correction = detail::correction(area[0], area[1], ratio);
    row.area = {area[1] + correction, detail::next_order(area[1], correction)};
  }
}

// The exchange of two rows between which nothing stands. Of rows of one object both meshes are refined together.
[[nodiscard]] inline Estimate free_exchange(const RowMeshes& p, const RowMeshes& q, bool same_object) {
  const double finest = detail::exchange_of(p.level[1], q.level[1]);
  double corrected = finest;
  double error = 1e-5 * finest;  // of the quadrature: exchange.hpp, mostly far below
  const auto take = [&](double coarse, double ratio) {
    const double correction = detail::correction(coarse, finest, ratio);
    corrected += correction;
    error += detail::next_order(finest, correction);
  };
  if (same_object) {
    if (p.ratio > 1.0) { take(detail::exchange_of(p.level[0], q.level[0]), p.ratio); }
  } else {
    if (p.ratio > 1.0) { take(detail::exchange_of(p.level[0], q.level[1]), p.ratio); }
    if (q.ratio > 1.0) { take(detail::exchange_of(p.level[1], q.level[0]), q.ratio); }
  }
  return {corrected, error};
}

}  // namespace radiosity
