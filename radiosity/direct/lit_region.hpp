// SPDX-License-Identifier: MIT
#pragma once

// Direct light at points: the irradiance that each lamp causes, with what stands in between.
//
// A LitRegion is what points of one place (a leaf, some neighbouring pixels) have in common: which lamps they can see, and what may stand
// in between. It is made once and asked for each of its points. What stands between a flat lamp and a region, in the order of its cost:
//   nothing             proven by the occluder lists of the scene (raycast/shaft.hpp) or by the shaft of both (polygon_shaft.hpp)
//   faces, convex bodies  their shadow is cut out of the lamp (shadow.hpp): exact for flat faces, without noise, smooth in the point
//                       (closed meshes that are convex within 0.04 % of their diameter are bodies, too: corners of files are rounded).
//                       Where they are many, those that others hide from all of the region are left out first.
//   anything else       segments to 256 points of the lamp, the same from each point, so that neighbours agree; they are weighed so
//                       that only what is hidden is sampled, and they stop at a quarter when these agree. Fewer go to a lamp that can
//                       add little to the light of the others.
//                       Right beside a lamp, where few of them face the point or most are far, they go to parts of it of equal light.
//                       Where faces and bodies hide most of a flat lamp, their shadow is cut out first, and segments go to what is left;
//                       of other large lamps of which little is seen up to 512 finer ones find the rim of that.
//                       Curved objects that are slow to meet, or not convex, are met as meshes within 0.04 % of their diameter.
// Curved lamps are always asked by segments where something may stand between. Nothing here is random: the result depends on the region and
// the point alone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/direct/light_vector.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::size_t fewest_segments = 16;  // that are asked for a lamp

// A convex part of a facet, above the horizon of a point that it faces, and the form factor from there to it.
struct LampPart {
  Polygon contour;
  std::uint32_t facet = 0;
  double factor = 0.0;
};

struct Umbra;

}  // namespace detail

class LitRegion {
 public:
  // Points of this shape, which the object `shape.owner` owns; its bulge is that of the points off the plane of the contour. `normal`: of
  // all points, when it is the same, else 0. `light` must outlive this. Not for several threads at once.
  LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal);

  // Lamps that some point may see, those that may give most first.
  [[nodiscard]] std::size_t size() const { return reaches_.size(); }
  [[nodiscard]] const DirectLight::Lamp& lamp(std::size_t k) const { return light_->lamps_[reaches_[k].lamp]; }
  // Of one of them, with what stands between, from the point x of the region with unit normal n. `others` is irradiance that the point is
  // known to have from elsewhere: the less the lamp can add to that, the fewer segments are asked.
  [[nodiscard]] double form_factor(std::size_t k, const glm::dvec3& x, const glm::dvec3& n, const Color& others = Color{0.0}) {
    const double seen = visible(k, x, n, others);
    return seen > 0.0 ? seen * unhidden(k, x, n) : 0.0;
  }
  // The same in two factors: the form factor if nothing stood between, and the share of it that is not hidden. The second is what takes
  // time.
  [[nodiscard]] double unhidden(std::size_t k, const glm::dvec3& x, const glm::dvec3& n);
  [[nodiscard]] double visible(std::size_t k, const glm::dvec3& x, const glm::dvec3& n, const Color& others = Color{0.0});
  [[nodiscard]] bool may_be_hidden(std::size_t k) const { return reaches_[k].between != Between::nothing; }
  // From all lamps, W/m2.
  [[nodiscard]] Color irradiance(const glm::dvec3& x, const glm::dvec3& n) {
    Color sum{0.0};
    for (std::size_t k = 0; k < size(); ++k) { sum += lamp(k).exitance * form_factor(k, x, n, sum); }
    return sum;
  }
  [[nodiscard]] std::uint64_t rays() const { return rays_; }

 private:
  enum class Between : unsigned char { nothing, bodies, anything };
  // What is seen of a lamp from the middle of a flat region by more segments than each point sends: small openings.
  struct Survey {
    bool dark;                         // nothing
    std::vector<std::uint32_t> mixed;  // cells of samples that are partly seen, ascending
  };
  // A part of a lamp that has many facets, as it is seen from the region.
  struct PartLight {
    PossibleOutline outline;
    std::optional<LinearLightVector> vector;
  };
  struct Reach {
    std::uint32_t lamp = 0;
    double may_give = 0.0;  // to the middle of the region, about
    Between between = Between::nothing;
    raycast::OccluderList list;
    std::vector<Blocker> faces;  // these and outlines are all that may stand between, if it is bodies
    struct Outline {
      const Facets* facets = nullptr;
      std::uint32_t nearest = 0;        // the facet that the region's centre is highest above
      std::vector<glm::dvec3> corners;  // that may belong to the outline seen from the region
      glm::dvec3 centre{0.0};           // of a sphere around them
      double radius = 0.0;
    };
    std::vector<Outline> outlines;
    std::vector<std::optional<PartLight>> parts;  // of the lamp, when they were asked for
    std::uint32_t hint = 0xffffffff;
    std::optional<Survey> survey;  // known when it was asked for
  };

  [[nodiscard]] const PartLight& known(std::optional<PartLight>& light, const Facets& facets, const Facets::Part& part);
  // The form factor of part p of the lamp, all of which lies above the horizon of x.
  [[nodiscard]] double part_above(Reach& reach, std::size_t p, const glm::dvec3& x, const glm::dvec3& n);
  // Takes what may stand between as faces and outlines; false when some of it is neither.
  [[nodiscard]] bool take_bodies(Reach& reach, const raycast::PatchShape& shape) const;
  // Where faces and outlines are many: leaves out those that others hide from all of the region. Of a house that is seen from outside these
  // are most of what stands in it, and each would be cut out of every piece that the others leave of the lamp.
  void leave_out_hidden(Reach& reach, std::span<const glm::dvec3> contour);
  // Has no cones where the umbra could not be found.
  [[nodiscard]] detail::Umbra umbra_of(const Reach::Outline& outline, std::span<const glm::dvec3> region);
  [[nodiscard]] detail::Umbra umbra_of(const Blocker& face, std::span<const glm::dvec3> region) const;
  // The cone from x over a convex body; empty when x lies on the body's surface.
  void make_cone(const Reach::Outline& outline, const glm::dvec3& x);
  // The form factor of what faces and outlines leave of the lamp, and its convex parts.
  [[nodiscard]] double cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>* left);
  // Segments from x to up to sixteen samples of a lamp: what each carries if it is free, and which are.
  struct Asked16 {
    std::array<double, 16> weight{};
    std::uint32_t seen = 0;
  };
  [[nodiscard]] Asked16 ask16(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::span<const LampSample> samples);
  [[nodiscard]] double seen_share(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::size_t most);
  // How many segments are to tell what is seen of the lamp.
  [[nodiscard]] static std::size_t segments_for(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n,
                                                const Color& others);
  // Do sixteen of the segments say that most of the lamp is seen?
  [[nodiscard]] bool mostly_open(Reach& reach, const glm::dvec3& x, const glm::dvec3& n);
  // Is x so near to the lamp, beside the distance of its samples, that these do not tell what it sees of it? Then what they carry in the
  // mean is not what the outline of the lamp says.
  [[nodiscard]] bool too_near(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n, double mean_weight);
  // The same by segments to parts of the facets that face x.
  [[nodiscard]] double seen_share_of_parts(Reach& reach, const glm::dvec3& x, const glm::dvec3& n);
  // The share of these parts that is seen, by segments to parts of them, each with about the same form factor or less.
  [[nodiscard]] double seen_share_of(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>& parts);
  // Asks finer samples where neighbours differ, as many as it takes for the share to be known within some 3 % of itself: puts their sums in
  // place of those of all samples and of the seen ones.
  void refine(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, double& all, double& seen);
  const Survey& survey(Reach& reach);

  // Above the meshes that stand in for its owner; x itself where none do.
  const glm::dvec3& lifted(const glm::dvec3& x, const glm::dvec3& n);

  const DirectLight* light_;
  std::uint32_t owner_;
  glm::dvec3 normal_{0.0};  // 0 where it is not the same everywhere
  glm::dvec3 centre_{0.0};
  double radius_ = 0.0;
  double lift_ = 0.0;
  glm::dvec3 last_{0.0}, last_normal_{0.0}, last_lifted_{0.0};  // what lifted() was asked last
  std::vector<Reach> reaches_;
  std::vector<char> facing_;
  std::vector<HalfSpace> cone_;
  struct Projected {
    double s = 0.0, t = 0.0;
    const glm::dvec3* corner = nullptr;
  };
  std::vector<Projected> projected_, hull_;
  // Of the samples of the lamp that was asked for last: what each carries, whether it is seen, and which differ from a neighbour.
  std::vector<double> weight_;
  std::vector<char> seen_;
  std::vector<std::uint32_t> mixed_;
  std::uint64_t rays_ = 0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/lit_region.cpp>
#include <radiosity/direct/lit_region_segments.cpp>
#include <radiosity/direct/lit_region_shadows.cpp>
#endif
