// SPDX-License-Identifier: MIT
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <radiosity/direct/lit_region.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/shadow.hpp>
#include <radiosity/visibility/target_lines.hpp>

// LitRegion: blockers between a region and a flat lamp whose shadows are cut out of the lamp.

namespace radiosity {

HALFLIGHT_INLINE std::optional<std::vector<std::uint32_t>> LitRegion::bodies_between(const Reach& reach) const {
  const raycast::Scene& objects = *light_->objects_;
  std::vector<std::uint32_t> bodies;
  constexpr std::size_t most_objects = 64;
  if (!reach.list.known() && light_->bodies_.size() > most_objects) { return std::nullopt; }
  if (reach.list.known()) {
    for (const std::uint32_t s : reach.list.shapes()) { bodies.push_back(light_->whole(objects.object_of(s))); }
  } else {  // no occluder list, but few objects: take them all
    for (std::uint32_t o = 0; o < light_->bodies_.size(); ++o) {
      if (!objects.left_out(o)) { bodies.push_back(o); }
    }
  }
  if (!reach.list.rooms_clear()) { bodies.insert(bodies.end(), light_->rooms_.begin(), light_->rooms_.end()); }
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

HALFLIGHT_INLINE LitRegion::Reach::Outline LitRegion::outline_of(const DirectLight::Body& convex) const {
  Reach::Outline outline;
  outline.facets = &convex.facets;
  const auto& facets = convex.facets.facets;
  for (std::uint32_t f = 1; f < facets.size(); ++f) {
    if (facets[f].height(region_.centre) > facets[outline.nearest].height(region_.centre)) { outline.nearest = f; }
  }
  const auto side = [&](std::uint32_t f) {  // 1: the whole region is in front of the facet, -1: behind it
    const double height = facets[f].height(region_.centre), slack = light_->slack_;
    return height > region_.radius + slack ? 1 : height < -region_.radius - slack ? -1 : 0;
  };
  for (const Facets::Edge& edge : convex.facets.edges) {
    const int left = side(edge.left);
    if (left != 0 && edge.right != brep::invalid_index && side(edge.right) == left) { continue; }
    outline.corners.push_back(edge.a);
    outline.corners.push_back(edge.b);
  }
  const auto before = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::sort(outline.corners.begin(), outline.corners.end(), before);
  outline.corners.erase(std::unique(outline.corners.begin(), outline.corners.end()), outline.corners.end());
  for (const glm::dvec3& p : outline.corners) { outline.centre += p / static_cast<double>(outline.corners.size()); }
  for (const glm::dvec3& p : outline.corners) { outline.radius = std::max(outline.radius, glm::length(p - outline.centre)); }
  return outline;
}

HALFLIGHT_INLINE bool LitRegion::take_bodies(Reach& reach, const raycast::PatchShape& shape) const {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  const std::optional<std::vector<std::uint32_t>> bodies = bodies_between(reach);
  if (!bodies) { return false; }
  const double slack = light_->slack_;
  // The shaft needs all points of the region, which the contour of a region with a bulge does not bound; then all bodies are kept.
  std::vector<Shaft> shaft;
  if (shape.bulge == 0.0) { shaft.emplace_back(shape.contour, lamp.corners, slack + lift_); }
  constexpr std::size_t most_faces = 128, most_of_stand_ins = 64;  // with more faces segments cost less
  bool all = true;
  for (const std::uint32_t o : *bodies) {
    const DirectLight::Body& body = light_->bodies_[o];
    if (body.convex && o == owner_) { continue; }
    if (body.facets.empty()) {
      all = false;
      continue;
    }
    const auto missed = [&](const auto& part) { return !shaft.empty() && shaft[0].misses(part); };
    if (missed(body.bounds)) { continue; }
    if (body.convex && body.closed && !lamp.behind[o]) {
      reach.outlines.push_back(outline_of(body));
      continue;
    }
    if (!body.exact && (body.convex ? body.closed : !(body.lift > 0.0))) {
      all = false;
      continue;
    }
    // The lamp does not hide itself. Its corners leave its plane by more than the slack if it is a distant sun, whose rounding is larger.
    const bool own = std::find(lamp.object_of.begin(), lamp.object_of.end(), o) != lamp.object_of.end();
    const double thickness = slack + 2.0 * light_->true_objects_->object(o).slack();
    const auto in_lamp = [&](const glm::dvec3& p) { return std::abs(lamp.facets.facets[0].height(p)) <= thickness; };
    const std::size_t before = reach.faces.size(), most = body.exact ? most_faces : most_of_stand_ins;
    const std::span<const Facets::Facet> facets = body.facets.facets;
    for (std::size_t run = 0; run < body.runs.size() && reach.faces.size() <= most; ++run) {
      if (missed(body.runs[run])) { continue; }
      const std::size_t first = run * DirectLight::Body::of_run;
      for (const Facets::Facet& facet : facets.subspan(first, std::min(DirectLight::Body::of_run, facets.size() - first))) {
        if (own && std::all_of(facet.contour.begin(), facet.contour.end(), in_lamp)) { continue; }
        // A back face of a closed body: its front faces hide as much.
        if (body.closed && facet.height(region_.centre) <= slack - region_.radius) { continue; }
        if (missed(facet.contour)) { continue; }
        reach.faces.push_back({facet.contour, facet.normal});
      }
    }
    if (reach.faces.size() > most) {
      reach.faces.resize(before);
      all = false;
    }
  }
  return all;
}

namespace detail {

// The umbra of a convex body or face: the places hidden from all points of a region. These lie within all `cones` (one from each corner
// of the region over the body) and behind all `fronts` (the planes of those faces that a point of the region may be in front of). A
// segment from each corner to such a place meets the body; because the body is convex, so does a segment from any point between the
// corners.
struct Umbra {
  std::vector<HalfSpace> cones, fronts;

  [[nodiscard]] bool holds(std::span<const glm::dvec3> corners) const {
    const auto within = [&](const HalfSpace& plane) {
      return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& p) { return plane.height(p) >= 0.0; });
    };
    return !cones.empty() && std::all_of(fronts.begin(), fronts.end(), within) && std::all_of(cones.begin(), cones.end(), within);
  }
};

}  // namespace detail

HALFLIGHT_INLINE detail::Umbra LitRegion::umbra_of(const Reach::Outline& outline, std::span<const glm::dvec3> region) {
  detail::Umbra umbra;
  const auto& facets = outline.facets->facets;
  constexpr std::size_t most_facets = 32;  // enough for walls and furniture; with more, the test costs more than it saves
  if (facets.size() > most_facets || !(facets[outline.nearest].height(region_.centre) > region_.radius + light_->slack_)) { return {}; }
  for (const Facets::Facet& facet : facets) {
    if (facet.height(region_.centre) > -region_.radius) { umbra.fronts.push_back({facet.contour[0], -facet.normal}); }
  }
  for (const glm::dvec3& x : region) {
    make_cone(outline, x);
    if (cone_.size() < 3) { return {}; }
    umbra.cones.insert(umbra.cones.end(), cone_.begin(), cone_.end());
  }
  return umbra;
}

HALFLIGHT_INLINE detail::Umbra LitRegion::umbra_of(const Blocker& face, std::span<const glm::dvec3> region) const {
  detail::Umbra umbra;
  const double height = glm::dot(face.normal, region_.centre - face.contour[0]);
  if (!(std::abs(height) > region_.radius + light_->slack_)) { return {}; }
  umbra.fronts.push_back({face.contour[0], height > 0.0 ? -face.normal : face.normal});
  for (const glm::dvec3& x : region) {
    for (std::size_t i = 0; i < face.contour.size(); ++i) {
      const glm::dvec3 a = face.contour[i] - x, b = face.contour[i + 1 < face.contour.size() ? i + 1 : 0] - x;
      umbra.cones.push_back({x, height > 0.0 ? glm::cross(b, a) : glm::cross(a, b)});
    }
  }
  return umbra;
}

HALFLIGHT_INLINE void LitRegion::leave_out_hidden(Reach& reach, std::span<const glm::dvec3> contour) {
  constexpr std::size_t few = 8;           // so few are cut out faster than they are tested for being hidden
  constexpr std::size_t most_umbrae = 16;  // only the blockers of largest apparent size are tried as hiding others
  constexpr double least_square = 1e-12;   // lower bound of a squared distance
  if (reach.faces.size() + reach.outlines.size() <= few) { return; }
  std::vector<glm::dvec3> region;
  for (const glm::dvec3& p : contour) {
    if (std::find(region.begin(), region.end(), p) == region.end()) { region.push_back(p); }
  }
  struct Shadow {
    double size = 0.0;  // approximate solid angle
    const Blocker* face = nullptr;
    const Reach::Outline* outline = nullptr;
    bool hidden = false;
  };
  std::vector<Shadow> shadows;
  for (const Blocker& face : reach.faces) {
    double size = 0.0;
    for (std::size_t i = 1; i + 1 < face.contour.size(); ++i) {
      const glm::dvec3 a = face.contour[0] - region_.centre, b = face.contour[i] - region_.centre, c = face.contour[i + 1] - region_.centre;
      const double r2 = std::max(glm::dot(a + b + c, a + b + c) / 9.0, least_square);
      size += 0.5 * std::abs(glm::dot(a, glm::cross(b, c))) / (r2 * std::sqrt(r2));
    }
    shadows.push_back({size, &face, nullptr});
  }
  for (const Reach::Outline& outline : reach.outlines) {
    const glm::dvec3 d = outline.centre - region_.centre;
    shadows.push_back({outline.radius * outline.radius / std::max(glm::dot(d, d), least_square), nullptr, &outline});
  }
  std::vector<Shadow*> by_size;
  for (Shadow& shadow : shadows) { by_size.push_back(&shadow); }
  std::stable_sort(by_size.begin(), by_size.end(), [](const Shadow* a, const Shadow* b) { return a->size > b->size; });
  for (std::size_t i = 0; i < std::min(by_size.size(), most_umbrae); ++i) {
    const Shadow& large = *by_size[i];
    if (large.hidden) { continue; }
    const detail::Umbra umbra = large.face ? umbra_of(*large.face, region) : umbra_of(*large.outline, region);
    for (std::size_t k = i + 1; k < by_size.size(); ++k) {
      Shadow& other = *by_size[k];
      other.hidden = other.hidden || umbra.holds(other.face ? other.face->contour : std::span{other.outline->corners});
    }
  }
  std::vector<Blocker> faces;
  std::vector<Reach::Outline> outlines;
  for (std::size_t k = 0; k < shadows.size(); ++k) {
    if (shadows[k].hidden) { continue; }
    if (shadows[k].face) {
      faces.push_back(*shadows[k].face);
    } else {
      outlines.push_back(std::move(reach.outlines[k - reach.faces.size()]));
    }
  }
  reach.faces = std::move(faces);
  reach.outlines = std::move(outlines);
}

// The cone is bounded by the convex hull of the corners as projected from x (Andrew 1979), so it does not depend on how a curved body was
// divided into facets.
HALFLIGHT_INLINE void LitRegion::make_cone(const Reach::Outline& outline, const glm::dvec3& x) {
  cone_.clear();
  const auto& facets = outline.facets->facets;
  const Facets::Facet* plane = &facets[outline.nearest];
  if (!(plane->height(x) > light_->slack_)) {
    plane = &*std::max_element(facets.begin(), facets.end(), [&](const auto& a, const auto& b) { return a.height(x) < b.height(x); });
    if (!(plane->height(x) > light_->slack_)) { return; }
  }
  const glm::dvec3 axis = -plane->normal;  // all corners lie in this direction
  const auto [s, t] = orthonormal(axis);
  projected_.clear();
  for (const glm::dvec3& corner : outline.corners) {
    const glm::dvec3 d = corner - x;
    const double ahead = std::max(glm::dot(d, axis), light_->slack_);
    projected_.push_back({glm::dot(d, s) / ahead, glm::dot(d, t) / ahead, &corner});
  }
  std::sort(projected_.begin(), projected_.end(),
            [](const Projected& a, const Projected& b) { return a.s != b.s ? a.s < b.s : a.t < b.t; });
  const auto turns_right = [](const Projected& a, const Projected& b, const Projected& c) {
    return !((b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s) > 0.0);
  };
  hull_.clear();
  const auto half = [&](auto first, auto last) {
    const std::size_t base = hull_.size();
    for (; first != last; ++first) {
      while (hull_.size() >= base + 2 && turns_right(hull_[hull_.size() - 2], hull_.back(), *first)) { hull_.pop_back(); }
      hull_.push_back(*first);
    }
    hull_.pop_back();  // it is the first point of the other half
  };
  half(projected_.begin(), projected_.end());
  half(projected_.rbegin(), projected_.rend());
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const glm::dvec3 a = *hull_[i].corner - x, b = *hull_[i + 1 < hull_.size() ? i + 1 : 0].corner - x, across = glm::cross(a, b);
    // Two corners in the same direction, such as those of an edge seen from its end, span no plane.
    constexpr double least = raycast::tol_edge * raycast::tol_edge;
    if (glm::dot(across, across) > least * glm::dot(a, a) * glm::dot(b, b)) { cone_.push_back({x, across}); }
  }
}

template <class Hide>
void LitRegion::each_shadow(const Reach& reach, ShadowedTarget& target, const glm::dvec3& x, const Hide& hide) {
  for (const Blocker& face : reach.faces) {
    if (!hide(target.shadow_of(face))) { return; }
  }
  for (const Reach::Outline& outline : reach.outlines) {
    if (target.misses(outline.centre, outline.radius)) { continue; }
    make_cone(outline, x);
    if (!hide(std::span<const HalfSpace>{cone_})) { return; }
  }
}

HALFLIGHT_INLINE double LitRegion::cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>* left) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  const bool lines = shadows_ == Shadows::for_pictures;
  const auto add_part = [&](std::uint32_t facet, std::span<const glm::dvec3> contour) {
    detail::LampPart& part = left->emplace_back(detail::LampPart{{}, facet, point_to_polygon(x, n, contour)});
    for (const glm::dvec3& p : contour) { part.contour.push_back(p); }
  };
  constexpr std::size_t many_pieces = 16;  // lines are about as fast from 8 to 32 pieces on, within a tenth of the time of a picture
  double sum = 0.0;
  for (std::uint32_t f = 0; f < lamp.facets.facets.size(); ++f) {
    const Facets::Facet& facet = lamp.facets.facets[f];
    if (!(facet.height(x) > light_->slack_)) { continue; }
    ShadowedTarget target{facet.contour, facet.normal, {}, light_->slack_};
    target.look(x, n);
    bool divided = false;
    each_shadow(reach, target, x, [&](std::span<const HalfSpace> cone) {
      target.hide(cone);
      divided = lines && target.pieces().size() > many_pieces;
      return !divided && !target.hidden();
    });
    if (divided) {
      if (facet_of_lines_ != &facet) { lines_.emplace(facet.contour, facet.normal); }
      facet_of_lines_ = &facet;
      lines_->look(x, n);
      each_shadow(reach, target, x, [&](std::span<const HalfSpace> cone) {
        if (!cone.empty()) { lines_->hide(cone); }
        return !lines_->hidden();
      });
      target.look(x, n);  // without the shadows
      sum += lines_->visible_share() * target.form_factor();
      if (left != nullptr) {
        lines_->each_strip([&](const std::array<glm::dvec3, 4>& strip) { add_part(f, strip); });
      }
      continue;
    }
    sum += target.form_factor();
    if (left == nullptr) { continue; }
    for (const Piece& piece : target.pieces()) { add_part(f, piece); }
  }
  return sum;
}

}  // namespace radiosity
