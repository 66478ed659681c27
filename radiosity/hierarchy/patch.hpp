// SPDX-License-Identifier: MIT
#pragma once

// The geometry of one patch, prepared for form factors and visibility tests: contour, plane, size, and quadrature points. A patch is made
// for every node of the hierarchy and kept until the end of the run (Patches, occlusion.hpp), because the node takes part in many links.
// It takes about 1.4 kB for a quadrilateral (304 bytes here, the rest for corners and points); the node itself, with the centre, normal
// and area of paper 4.2, takes 112 bytes. So patches are most of a run's memory while there are few links per node.

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/support/big_array.hpp>

namespace radiosity {

struct QuadraturePoint {
  glm::dvec3 position{0.0};
  double weight = 0.0;  // area; the weights of a rule sum to the area of the patch
};

struct Patch {
  Polygon contour;         // counter-clockwise seen from the front, (nearly) planar; convex if there are no parts
  glm::dvec3 centre{0.0};  // mean of the corners
  glm::dvec3 normal{0.0};
  double area = 0.0;
  double radius = 0.0;                            // largest distance of a corner from the centre
  glm::dvec3 centroid{0.0};                       // centroid of the area
  glm::dmat3 inverse_inertia{0.0};                // inverse, in the plane, of the mean of (x - centroid)(x - centroid)'
  BigArray<QuadraturePoint> rule2, rule3, rule4;  // 2x2, 3x3 and 4x4 Gauss points on each quadrilateral piece
  bool bent = false;                              // is its surface curved, so that normals vary over it?
  glm::dmat3 bend{0.0};                           // if so, S of bend.hpp, in 1 / length
  std::vector<Polygon> parts;  // convex parts of a non-convex contour, which reaches holes by bridge edges that it follows twice
};

namespace detail {

// A unit vector perpendicular to the unit vector n.
[[nodiscard]] glm::dvec3 tangent(const glm::dvec3& n);

inline constexpr std::array<double, 3> gauss3_x{0.11270166537925831148, 0.5, 0.88729833462074168852};
inline constexpr std::array<double, 3> gauss3_w{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
inline constexpr std::array<double, 4> gauss4_x{0.06943184420297371239, 0.33000947820757186760, 0.66999052179242813240,
                                                0.93056815579702628761};
inline constexpr std::array<double, 4> gauss4_w{0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                                                0.17392742256872692869};

}  // namespace detail

// The vector area of a polygon (Newell): unit normal times area; independent of the starting corner up to rounding.
[[nodiscard]] glm::dvec3 vector_area(std::span<const glm::dvec3> polygon);

// The patch with this contour; one that is not convex comes with its convex parts. A contour of no area gives a patch of area 0 without
// Makes the patch with this contour; if it is not convex, its convex parts must be given. A contour without area gives a patch
// of area 0 without quadrature points. `arrays`: memory for the quadrature points; null: the default heap.
[[nodiscard]] Patch make_patch(Polygon contour, std::vector<Polygon> parts = {}, std::pmr::memory_resource* arrays = nullptr);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/hierarchy/patch.cpp>
#endif
