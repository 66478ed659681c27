// SPDX-License-Identifier: MIT
#include <radiosity/direct/flat_parts.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>
#include <brep/outline.hpp>
#include <brep/polygon.hpp>

namespace radiosity {

HALFLIGHT_INLINE void append_flat_parts(const brep::Builder& boundary, const FaceCorners& face, std::vector<FaceCorners>& parts) {
  constexpr double planar = 1e-12;  // largest brep::planarity that counts as planar; rounding leaves about 1e-16
  std::vector<glm::dvec3> positions;
  for (const std::uint32_t v : face) { positions.push_back(boundary.position(v)); }
  if (face.size() <= 3 || (face.size() > 4 && brep::planarity(positions) < planar)) {
    parts.push_back(face);
    return;
  }
  const auto ends = brep::Outline{positions}.best_diagonal().value_or(std::pair<std::size_t, std::size_t>{0, 2});
  const auto part = [&](std::size_t from, std::size_t to) {
    FaceCorners corners{face[from]};
    for (std::size_t i = from; i != to; corners.push_back(face[i])) { i = (i + 1) % face.size(); }
    return corners;
  };
  append_flat_parts(boundary, part(ends.first, ends.second), parts);
  append_flat_parts(boundary, part(ends.second, ends.first), parts);
}

}  // namespace radiosity
