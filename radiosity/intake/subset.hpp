// SPDX-License-Identifier: MIT
#pragma once

// Takes some faces out of a mesh, as a mesh of their own.
//
// At each vertex of the mesh a single fan of faces meets. Without some of its faces, such as the rug on a floor or those of another group,
// a fan is several, which have nothing but a point in common: no manifold. Each gets a vertex of its own.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

struct Subset {
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> corners;  // by face, in the order in which they were given: indices of positions
};

class Subsets {
 public:
  Subsets(const Working& mesh, const Topology& topology);

  // Time: in proportion to the corners of these faces, each of which must be given once.
  [[nodiscard]] Subset of(std::span<const std::uint32_t> faces);

  [[nodiscard]] std::uint32_t face_of(std::uint32_t side) const { return face_of_[side]; }

 private:
  void number_fan(std::uint32_t side, std::uint32_t number);

  const Working& mesh_;
  const Topology& topology_;
  std::vector<std::uint32_t> face_of_;  // by side
  std::vector<bool> chosen_;            // by face
  std::vector<std::uint32_t> number_;   // by side: of the position at its beginning; none: not numbered yet
  std::vector<std::uint32_t> fan_;      // sides that begin at one position
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/subset.cpp>
#endif
