// SPDX-License-Identifier: MIT
#pragma once

// Direct light at points: the irradiance that each lamp causes, with what stands in between.
//
//   DirectLight   the lamps of a scene: each one sheet of one object that emits.
//   LitRegion     what points of one place (a leaf, some neighbouring pixels) have in common: which lamps they can see, and what may stand in
//                 between. It is made once and asked for each of its points.
//
// Without anything in between, the form factor from a point to a lamp is the contour integral over the lamp's outline (facets.hpp): exact
// for flat lamps; a curved one is a polyhedron of the same area, its outline off by at most 0.2 % of its diameter.
// What stands between a flat lamp and a region, in the order of what it costs:
//   nothing             proven by the occluder lists of the scene (raycast/shaft.hpp) or by the shaft of both (polygon_shaft.hpp)
//   faces, convex bodies  their shadow is cut out of the lamp (shadow.hpp): exact for flat faces, without noise, smooth in the point
//   anything else       segments to 256 points of the lamp, the same from each point, so that neighbours agree; they are weighed so
//                       that only what is hidden is sampled, and they stop at 64 when these agree. In place of curved objects that are slow or not convex
//                       segments meet meshes within 0.04 % of their diameter
// Curved lamps are always asked by segments where something may stand between. Nothing here is random: the result depends on the region and
// the point alone.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

struct LampLimits {
  // The strongest sheets are taken, up to this number; curved ones up to this share of the scene's area: what shines all around a point
  // is not met better one by one.
  std::uint32_t most = 64;
  double most_curved = 0.1;
};

class DirectLight {
 public:
  DirectLight() = default;
  // `surfaces`: the unrefined boundaries of the objects of the scene, one each, needed no more after this; `emission`: exitance of each input surface.
  DirectLight(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
              const LampLimits& limits = {});

  struct Sample {
    glm::dvec3 position{0.0}, normal{0.0};
  };
  struct Lamp {
    std::uint32_t surface = 0, object = 0;  // of the input
    Color exitance{0.0};
    Facets facets;
    bool flat = false;        // all facets lie in one plane
    double correction = 1.0;  // area of the true surface over that of the facets
    glm::dvec3 centre{0.0};   // of a sphere around it
    double radius = 0.0;
    std::array<glm::dvec3, 4> corners;  // of a rectangle around it, in its plane; of a curved one, around a point of it
    double bulge = 0.0;                 // how far it leaves the rectangle
    std::vector<Sample> samples;        // even over its area, the first ones too
    std::vector<bool> behind;           // by object: some of it lies behind the plane of the flat lamp
    [[nodiscard]] raycast::PatchShape shape() const { return {corners, object, bulge}; }
  };
  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }
  // Is this input surface among the lamps? What else emits is left to whoever asks.
  [[nodiscard]] bool is_lamp(std::uint32_t surface) const { return surface < is_lamp_.size() && is_lamp_[surface]; }

  // What segments meet: the scene, in which open meshes stand in for curved objects that are slow to meet; two for each, the second ones
  // behind all objects. The object that such a mesh belongs to, and how far points on it are lifted to be above its meshes; 0: none stand in.
  [[nodiscard]] const raycast::Scene& objects() const { return *objects_; }
  [[nodiscard]] std::uint32_t whole(std::uint32_t o) const { return o < bodies_.size() ? o : whole_[o - bodies_.size()]; }
  [[nodiscard]] double lift(std::uint32_t o) const { return bodies_[o].lift; }

 private:
  friend class LitRegion;
  // How an object is taken out of a lamp.
  struct Body {
    Facets facets;
    bool convex = false;  // by its outline
    bool closed = false;  // by those faces alone that show their front
    bool exact = false;   // its facets are it
    raycast::Box bounds;
    double lift = 0.0;  // above 0: meshes stand in for it where segments are asked, and points on it are lifted above them by so much
  };
  void take_bodies(const std::vector<Surface>& surfaces);
  [[nodiscard]] static Lamp make_lamp(const Surface& surface, std::uint32_t sheet, const Color& exitance);

  const raycast::Scene* objects_ = nullptr;
  // Where meshes stand in, objects_ points to this.
  std::shared_ptr<const raycast::Scene> with_stand_ins_;
  std::vector<std::uint32_t> whole_;  // of those the objects that they are halves of
  std::vector<Lamp> lamps_;
  std::vector<bool> is_lamp_;  // by input surface
  std::vector<Body> bodies_;   // by object; without facets: asked by segments
  std::vector<std::uint32_t> rooms_;
};

class LitRegion {
 public:
  // Points of this shape, which the object `shape.owner` owns; its bulge is that of the points off the plane of the contour. `normal`: of all
  // points, when it is the same, else 0. `light` must outlive this. Not for several threads at once.
  LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal);

  // Lamps that some point may see.
  [[nodiscard]] std::size_t size() const { return reaches_.size(); }
  [[nodiscard]] const DirectLight::Lamp& lamp(std::size_t k) const { return light_->lamps_[reaches_[k].lamp]; }
  // Of one of them, with what stands between, from the point x of the region with unit normal n.
  [[nodiscard]] double form_factor(std::size_t k, const glm::dvec3& x, const glm::dvec3& n) {
    return reaches_[k].between == Between::nothing ? unhidden(k, x, n) : unhidden(k, x, n) * visible(k, x, n);
  }
  // The same in two factors: the form factor if nothing stood between, and the share of it that is not hidden. The second is what takes time.
  [[nodiscard]] double unhidden(std::size_t k, const glm::dvec3& x, const glm::dvec3& n);
  [[nodiscard]] double visible(std::size_t k, const glm::dvec3& x, const glm::dvec3& n);
  [[nodiscard]] bool may_be_hidden(std::size_t k) const { return reaches_[k].between != Between::nothing; }
  // From all lamps, W/m2.
  [[nodiscard]] Color irradiance(const glm::dvec3& x, const glm::dvec3& n) {
    Color sum{0.0};
    for (std::size_t k = 0; k < size(); ++k) { sum += lamp(k).exitance * form_factor(k, x, n); }
    return sum;
  }
  [[nodiscard]] std::uint64_t rays() const { return rays_; }

 private:
  enum class Between : unsigned char { nothing, bodies, anything };
  struct Reach {
    std::uint32_t lamp = 0;
    Between between = Between::nothing;
    raycast::OccluderList list;
    std::vector<Blocker> faces;
    struct Outline {
      const Facets* facets = nullptr;
      std::uint32_t nearest = 0;        // the facet that the region's centre is highest above
      std::vector<glm::dvec3> corners;  // that may belong to the outline seen from the region
    };
    std::vector<Outline> outlines;
    std::uint32_t hint = 0xffffffff;
  };

  [[nodiscard]] bool take_bodies(Reach& reach, const raycast::PatchShape& shape) const;
  // The cone from x over a convex body; empty when x lies on the body's surface.
  void make_cone(const Reach::Outline& outline, const glm::dvec3& x);
  [[nodiscard]] double cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n);
  [[nodiscard]] double seen_share(Reach& reach, const glm::dvec3& x, const glm::dvec3& n);

  const DirectLight* light_;
  std::uint32_t owner_;
  glm::dvec3 centre_{0.0};
  double radius_ = 0.0;
  double lift_ = 0.0;
  std::vector<Reach> reaches_;
  std::vector<char> facing_;
  std::vector<HalfSpace> cone_;
  struct Projected {
    double s = 0.0, t = 0.0;
    const glm::dvec3* corner = nullptr;
  };
  std::vector<Projected> projected_, hull_;
  std::uint64_t rays_ = 0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/direct_light.cpp>
#endif
