// SPDX-License-Identifier: MIT
#pragma once

// The three scenes of the comparison and their rays. A scene is known to the peer as triangles and spheres, to halflight as objects.
// A bundle is 16 segments between two patches that face each other; in the hierarchical set 16 bundles in succession are the child pairs
// of one pair of patches, each split in four, as link refinement makes them. An incoherent set has the same kind of segment, each
// between two patches of its own.

#include <raycast/scene.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bench {

struct Patch {
  std::vector<glm::dvec3> contour;
  glm::dvec3 normal{0.0};
  std::uint32_t owner = raycast::no_object;
  double bulge = 0.0;  // how far points of the patch leave the contour's plane polygon
};

struct Ray {
  raycast::Segment segment;
  std::uint32_t source, target;
};

struct Set {
  std::string name;
  std::vector<Ray> rays;                         // 16 per bundle
  std::vector<std::pair<Patch, Patch>> pairs;    // one per bundle; empty for incoherent rays
  std::vector<std::pair<Patch, Patch>> parents;  // one per 16 bundles; empty where there is no hierarchy
  bool closest = false;
};

struct World {
  std::string name;
  std::vector<std::array<glm::dvec3, 3>> triangles;
  struct Ball {
    glm::dvec3 centre;
    double radius;
  };
  std::vector<Ball> balls;
  std::vector<raycast::PlacedObject> objects;
  std::vector<Set> sets;
};

[[nodiscard]] World cornell();
[[nodiscard]] World spheres();
[[nodiscard]] World bumpy();

}  // namespace bench
