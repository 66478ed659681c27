// SPDX-License-Identifier: MIT
#pragma once

// The surfaces between which form factors are computed (the rows of the matrix), and the exposed parts of their flat faces.
//
// A surface is a named sheet of an object ("room.x0", "post.side"). The numbered faces of a mesh are joined: a mesh of one material is
// one surface, a mesh of several materials has one surface for each ("wedge.white").
//
// Parts of faces that other flat objects bury are removed exactly: where an object stands on the face, lies on it, or contains it. Where
// that cannot be done exactly (a curved or concave object cuts a face or lies on it), FactorRow::exact is false and rays decide point by
// point.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

struct FactorRow {
  std::string name;
  std::uint32_t object = 0;
  bool exact = false;         // do `facets` describe the exposed part exactly?
  std::vector<Facet> facets;  // of a flat object with straight borders
  std::uint32_t material = 0;
};

struct FactorRows {
  std::vector<FactorRow> rows;                     // the rows of an object are consecutive
  std::vector<std::vector<std::uint32_t>> row_of;  // [object][sheet]
};

// A convex face of an exact object, which blocks light and may cover other faces.
struct FlatFace {
  Polygon contour;
  glm::dvec3 normal{0.0};
  std::uint32_t object = 0, sheet = 0;
};

// The rows of a scene by name, without facets yet.
[[nodiscard]] FactorRows name_rows(const Scene& scene);

[[nodiscard]] std::vector<FlatFace> flat_faces(const std::vector<Surface>& surfaces);

// Sets the facets of exact rows. Cost: faces times objects.
void expose(FactorRows& rows, const raycast::Scene& scene, const std::vector<FlatFace>& faces, double slack);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_rows.cpp>
#endif
