// SPDX-License-Identifier: MIT
#pragma once

// The surfaces between which form factors are asked for, and what of their flat faces is exposed.
//
// A surface is a sheet of an object that has a name of its own ("room.x0", "post.side"). The numbered faces of a mesh are taken together:
// a mesh of one material is one surface, a mesh of several has one for each ("wedge.white").
//
// Faces lose exactly what other flat objects bury: what they stand on, what they lie on, what is inside them. Where that cannot be done
// exactly (a curved or concave object cuts a face or lies on it), the surface is marked: rays decide point by point.

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
  bool exact = false;         // `facets` are all that is exposed of it
  std::vector<Facet> facets;  // of a flat object with straight borders
  std::uint32_t material = 0;
};

struct FactorRows {
  std::vector<FactorRow> rows;                     // those of an object side by side
  std::vector<std::vector<std::uint32_t>> row_of;  // [object][sheet]
};

// The convex faces of the exact objects: what stops light, and what covers.
struct FlatFace {
  Polygon contour;
  glm::dvec3 normal{0.0};
  std::uint32_t object = 0, sheet = 0;
};

// The rows of a scene by their names, without facets.
[[nodiscard]] FactorRows name_rows(const Scene& scene);

[[nodiscard]] std::vector<FlatFace> flat_faces(const std::vector<Surface>& surfaces);

// Gives the rows of exact objects their facets. Cost: faces times objects.
void expose(FactorRows& rows, const raycast::Scene& scene, const std::vector<FlatFace>& faces, double slack);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_rows.cpp>
#endif
