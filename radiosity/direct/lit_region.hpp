// SPDX-License-Identifier: MIT
#pragma once

// Direct light at points: the irradiance from each lamp, with occlusion.
//
// A LitRegion holds what the points of one place (a leaf, some neighbouring pixels) have in common: which lamps they may see, and which
// objects may block these. It is made once and evaluated at each of its points. The blockers between a flat lamp and a region are treated
// by one of these methods, in the order of their cost:
//   nothing             proven by the occluder lists of the scene (raycast/shaft.hpp) or by the shaft of both (polygon_shaft.hpp)
//   faces, convex bodies  their shadow is cut out of the lamp (shadow.hpp): exact for flat faces, without noise, smooth in the point
//                       (closed meshes that are convex within 0.04 % of their diameter count as convex bodies, because corners in files
//                       are rounded). If they are many, those hidden by others from the whole region are left out first. For a picture
//                       the share that is left of a lamp is measured along lines where the shadows divide it into many parts
//                       (target_lines.hpp).
//   anything else       segments to 256 points of the lamp, the same from each point, so that neighbours agree; they are weighted so
//                       that only the hidden share is estimated, and stop after a quarter if these agree. Fewer are cast to a lamp that
//                       can add little to the light of the others. Special cases:
//                       Close to a lamp, where few samples face the point or most are far away, they go to parts of equal light.
//                       If faces and bodies hide most of a flat lamp, their shadow is cut out first, and segments go to the rest;
//                       for other large lamps of which little is visible, up to 512 finer samples find the border of the visible part.
//                       Curved objects that are slow to intersect or not convex are replaced by meshes within 0.04 % of their diameter.
// Curved lamps are always sampled by segments if something may stand between. Nothing here is random: the result depends on the region and
// the point alone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/compiled.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/direct/light_vector.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/shadow.hpp>
#include <radiosity/visibility/target_lines.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::size_t fewest_segments = 16;  // least number that is cast to a lamp

// A convex part of a facet above the horizon of a point that it faces, and the form factor from the point to it.
struct LampPart {
  Polygon contour;
  std::uint32_t facet = 0;
  double factor = 0.0;
};

struct Umbra;

}  // namespace detail

// How the visible share of a flat lamp is found behind faces and convex bodies: up to rounding, or, where they are many, to about a
// thousandth of the lamp.
enum class Shadows : unsigned char { exact, for_pictures };

class LitRegion {
 public:
  // A region of points within `shape`, on the object `shape.owner`; shape.bulge is their largest distance from the plane of the contour.
  // `normal`: the common normal of all points, or 0 if they differ. `light` must outlive this. Not thread-safe, not even the queries.
  LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal, Shadows shadows = Shadows::exact);

  // Number of lamps that some point may see. They are sorted by the light that they may give, largest first.
  [[nodiscard]] std::size_t size() const { return reaches_.size(); }
  [[nodiscard]] const DirectLight::Lamp& lamp(std::size_t k) const { return light_->lamps_[reaches_[k].lamp]; }
  // The form factor, with occlusion, from the point x of the region with unit normal n to lamp k. `others`: irradiance that the point is
  // known to receive from elsewhere; the less the lamp can add to it, the fewer segments are cast.
  [[nodiscard]] double form_factor(std::size_t k, const glm::dvec3& x, const glm::dvec3& n, const Color& others = Color{0.0}) {
    const double seen = visible(k, x, n, others);
    return seen > 0.0 ? seen * unhidden(k, x, n) : 0.0;
  }
  // The two factors of form_factor(): the unoccluded form factor, and the visible share of it. The second one takes most of the time.
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
  // What segments from the middle of a flat region see of a lamp, more segments than a point casts, to find small openings.
  struct Survey {
    bool dark;                         // nothing was seen
    std::vector<std::uint32_t> mixed;  // cells of samples that are partly visible, ascending
  };
  // The light of one part of a lamp of many facets, prepared for the region.
  struct PartLight {
    PossibleOutline outline;
    std::optional<LinearLightVector> vector;
  };
  struct Reach {
    std::uint32_t lamp = 0;
    double may_give = 0.0;  // upper estimate of the light that the middle of the region receives
    Between between = Between::nothing;
    raycast::OccluderList list;
    std::vector<Blocker> faces;  // if `between` is bodies, these faces and the outlines are all possible blockers
    struct Outline {
      const Facets* facets = nullptr;
      std::uint32_t nearest = 0;        // the facet above whose plane the region's centre lies highest
      std::vector<glm::dvec3> corners;  // corners that may lie on the outline seen from the region
      glm::dvec3 centre{0.0};           // of a sphere around them
      double radius = 0.0;
    };
    std::vector<Outline> outlines;
    std::vector<std::optional<PartLight>> parts;  // by part of the lamp; set on first use
    std::uint32_t hint = raycast::no_shape;
    std::optional<Survey> survey;  // set on first use
  };

  [[nodiscard]] const PartLight& known(std::optional<PartLight>& light, const Facets& facets, const Facets::Part& part);
  // The form factor of part p of the lamp, which must lie entirely above the horizon of x.
  [[nodiscard]] double part_above(Reach& reach, std::size_t p, const glm::dvec3& x, const glm::dvec3& n);
  // The bodies that may lie between the region and the lamp, ascending. Nothing if that is not known and there are many objects.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> bodies_between(const Reach& reach) const;
  [[nodiscard]] Reach::Outline outline_of(const DirectLight::Body& convex) const;
  // Stores the possible blockers as faces and outlines; returns false if one of them is neither.
  [[nodiscard]] bool take_bodies(Reach& reach, const raycast::PatchShape& shape) const;
  // If faces and outlines are many, removes those that others hide from the whole region. For a house seen from outside these are most of
  // its furniture, and each of them would be cut out of every piece of the lamp that the others leave.
  void leave_out_hidden(Reach& reach, std::span<const glm::dvec3> contour);
  // The umbra of a body or a face; without cones if it could not be found.
  [[nodiscard]] detail::Umbra umbra_of(const Reach::Outline& outline, std::span<const glm::dvec3> region);
  [[nodiscard]] detail::Umbra umbra_of(const Blocker& face, std::span<const glm::dvec3> region) const;
  // Makes the cone from x over a convex body; empty if x lies on the body's surface.
  void make_cone(const Reach::Outline& outline, const glm::dvec3& x);
  // Calls hide(cone) with the shadow of each face and outline on the target, until it returns false.
  template <class Hide>
  void each_shadow(const Reach& reach, ShadowedTarget& target, const glm::dvec3& x, const Hide& hide);
  // The form factor of the part of the lamp that faces and outlines leave visible; `left`, if given, receives its convex parts.
  [[nodiscard]] double cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>* left);
  // Result of segments from x to up to sixteen samples of a lamp: the light that each carries if it is not blocked, and which
  // are not blocked.
  struct Asked16 {
    std::array<double, 16> weight{};
    std::uint32_t seen = 0;
  };
  [[nodiscard]] Asked16 ask16(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::span<const LampSample> samples);
  // To samples at their places, also of a ball.
  [[nodiscard]] Asked16 ask_placed16(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::span<const LampSample> samples);
  [[nodiscard]] double seen_share(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::size_t most);
  // The number of segments that determine the visible share of the lamp.
  [[nodiscard]] static std::size_t segments_for(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n,
                                                const Color& others);
  // Do sixteen of the segments see most of the lamp?
  [[nodiscard]] bool mostly_open(Reach& reach, const glm::dvec3& x, const glm::dvec3& n);
  // Is x so close to the lamp, compared with the spacing of its samples, that the samples do not determine the visible share? This is so
  // if their mean weight differs from the form factor of the lamp's outline.
  [[nodiscard]] bool too_near(const DirectLight::Lamp& lamp, const glm::dvec3& x, const glm::dvec3& n, double mean_weight);
  // As seen_share(), by segments to parts of the facets that face x.
  [[nodiscard]] double seen_share_of_parts(Reach& reach, const glm::dvec3& x, const glm::dvec3& n);
  // The visible share of these parts, by segments to subdivided parts of about equal or smaller form factor.
  [[nodiscard]] double seen_share_of(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>& parts);
  // Casts segments to finer samples where neighbouring cells differ, as many as give the share to within some 3 % of itself. Replaces the
  // sums `all` and `seen` by those of the finer samples.
  void refine(Reach& reach, const glm::dvec3& x, const glm::dvec3& n, double& all, double& seen);
  const Survey& survey(Reach& reach);

  // The point lifted above the meshes that stand in for its owner; x itself if there are none.
  const glm::dvec3& lifted(const glm::dvec3& x, const glm::dvec3& n);

  const DirectLight* light_;
  std::uint32_t owner_;
  Shadows shadows_;
  PointRegion region_;  // normal: 0 if the points differ in it
  double lift_ = 0.0;
  glm::dvec3 last_{0.0}, last_normal_{0.0}, last_lifted_{0.0};  // arguments and result of the last call of lifted()
  std::vector<Reach> reaches_;
  std::vector<char> facing_;
  std::vector<HalfSpace> cone_;
  const Facets::Facet* facet_of_lines_ = nullptr;
  std::optional<TargetLines> lines_;  // across that facet
  struct Projected {
    double s = 0.0, t = 0.0;
    const glm::dvec3* corner = nullptr;
  };
  std::vector<Projected> projected_, hull_;
  // Samples of the lamp queried last: their light, whether they were visible, and those that differ from a neighbour.
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
