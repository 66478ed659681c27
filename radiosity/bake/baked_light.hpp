// SPDX-License-Identifier: MIT
#pragma once

// Looks up the solved light on the caller's polygons, in the caller's numbering. The intake has repaired, merged and turned the polygons,
// and the solver has cut them into patches. PolygonParts (intake.hpp) lists, for each polygon, the sheets that it became part of; the
// triangles of these sheets hold the light.
//
// A polygon has a front, seen from which its corners run counter-clockwise, and a back. Most polygons have light on one side only: if the
// requested side has none, the other side is used.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/bvh.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

enum class FaceSide : unsigned char { front, back };

class BakedLight {
 public:
  BakedLight() = default;
  // `parts` numbers its objects from `first_object` of the solved scene on. Keeps no reference to scene and solution.
  BakedLight(const Scene& scene, const Solution& solution, PolygonParts parts, std::uint32_t first_object = 0);

  // The radiosity B in W/m2, emission included, at a point of a polygon, in scene coordinates. The value is taken at the nearest place of
  // the polygon that has light of its own, if the point lies beside the polygon or another object covers it there. The emitted radiance
  // is B / pi. Nothing if the polygon was left out or is hidden under another object. Cost: one descent of a small tree. Thread-safe.
  [[nodiscard]] std::optional<Color> radiosity(std::size_t polygon, const glm::dvec3& point, FaceSide side = FaceSide::front) const;

  // The sheet that shows the polygon's front; polygons with the same sheet are parts of one planar face. Nothing if the polygon belongs
  // to several sheets.
  [[nodiscard]] std::optional<PolygonPart> front(std::size_t polygon) const;

  [[nodiscard]] std::size_t polygons() const { return parts_.first.size() - 1; }

 private:
  struct Corner {
    glm::dvec3 position{0.0};
    Color radiosity{0.0};
  };
  struct Sheet {
    std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into corners_
    raycast::Bvh tree;
  };
  struct Found {
    double squared = 0.0;  // squared distance
    Color radiosity{0.0};
  };
  [[nodiscard]] std::optional<Found> nearest(const Sheet& sheet, const glm::dvec3& point) const;

  PolygonParts parts_;
  std::vector<std::uint32_t> first_sheet_;  // of each object of the parts
  std::vector<Sheet> sheets_;
  std::vector<Corner> corners_;
};

// The radiosity at the corners of polygons and at their vertices.
struct BakedColors {
  std::vector<Color> corner;  // one per corner of the input, W/m2
  std::vector<Color> vertex;  // one per position: the mean over its corners, weighted by their angles
  std::size_t without = 0;  // corners without light of their own (hidden or left-out polygons): the mean of others at their place, or black
};

// `input`: the polygons from which the parts were made, in scene coordinates.
[[nodiscard]] BakedColors baked_colors(const BakedLight& light, const PolygonView& input);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/baked_light.cpp>
#endif
