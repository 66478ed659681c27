// SPDX-License-Identifier: MIT
#pragma once

// The solved light on the polygons that a caller gave, in the caller's own numbering. The intake has repaired, merged and turned them, and
// the solver has cut them into patches; PolygonParts (intake.hpp) lead from a polygon to the sheets that it became, whose triangles hold
// the light.
//
// A polygon has a front, from which its corners run counter-clockwise, and a back. Most have light on one side alone: where the side that
// is asked for has none, the other one answers.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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
  // The objects that `parts` speaks of are those of the solved scene from `first_object` on. Nothing of scene and solution is kept.
  BakedLight(const Scene& scene, const Solution& solution, PolygonParts parts, std::uint32_t first_object = 0);

  // The radiosity B in W/m2, emission included, at a point of a polygon, in the scene's coordinates; of a point beside the polygon that at
  // the nearest place, and where another object covers it that beside. The radiance that leaves it is B / pi. Nothing when the polygon was
  // left out or lies hidden under another object. Cost: a walk down a small tree. May be called from many threads at once.
  [[nodiscard]] std::optional<Color> radiosity(std::size_t polygon, const glm::dvec3& point, FaceSide side = FaceSide::front) const;

  // The one sheet that shows the polygon's front; polygons with the same sheet are parts of one planar face. Nothing when it was split.
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
    double squared = 0.0;  // distance
    Color radiosity{0.0};
  };
  [[nodiscard]] std::optional<Found> nearest(const Sheet& sheet, const glm::dvec3& point) const;

  PolygonParts parts_;
  std::vector<std::uint32_t> first_sheet_;  // of each object of the parts
  std::vector<Sheet> sheets_;
  std::vector<Corner> corners_;
};

// The light at the corners of polygons, and at their vertices.
struct BakedColors {
  std::vector<Color> corner;  // one a corner of the input: W/m2
  std::vector<Color> vertex;  // one a position: the mean of its corners, each weighted with its angle
  std::size_t without = 0;  // corners of polygons that were left out or are hidden: they have the colour of others at their place, or none
};

// `input` is what the parts were made of, in the scene's coordinates.
[[nodiscard]] BakedColors baked_colors(const BakedLight& light, const PolygonView& input);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/baked_light.cpp>
#endif
