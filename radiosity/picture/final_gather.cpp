// SPDX-License-Identifier: MIT
#include <radiosity/picture/final_gather.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>
#include <radiosity/picture/lamps_of_picture.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/picture/pass_through.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/off_surfaces.hpp>

namespace radiosity {

HALFLIGHT_INLINE FinalGather::FinalGather(const Scene& scene, const Mesh& mesh, const Frame& frame)
    : lookup_{scene, mesh, frame}, near_{lookup_, direct_, materials_, lamp_photons_} {
  std::vector<Color> emission;
  for (const InputSurface& input : surfaces(scene)) {
    materials_.push_back(scene.materials[input.material]);
    emission.push_back(materials_.back().emission);
  }
  std::vector<Surface> boundaries;
  for (std::uint32_t o = 0; o < objects().size(); ++o) {
    SurfaceResult made = make_surface(objects().object(o), lookup_.surface(o, 0));
    if (!made.surface) { return; }  // such a scene has no solution
    boundaries.push_back(std::move(*made.surface));
  }
  lookup_.leave_out(copies(boundaries));
  direct_ = DirectLight{objects(), boundaries, emission_of_lamps(lookup_, emission), {.bodies = true}};
  lamp_photons_ = send_lamp_photons(boundaries, emission);
  for (std::uint32_t s = 0; s < emission.size(); ++s) {
    if (!direct_.is_lamp(s) && !is_black(materials_[s].reflectance)) { emission[s] = Color{0.0}; }
  }
  spots_ = BrightSpots{lookup_, direct_, emission};
  direct_alone_ = std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const MeshFace& face) {
    const Color lamp = direct_.is_lamp(face.surface) ? materials_[face.surface].emission : Color{0.0};
    const auto corners = std::span(mesh.corners).subspan(face.first_corner, face.corner_count);
    return std::all_of(corners.begin(), corners.end(), [&](const MeshCorner& corner) { return corner.radiosity == lamp; });
  });
}

HALFLIGHT_INLINE PhotonGrid FinalGather::send_lamp_photons(const std::vector<Surface>& boundaries, std::vector<Color> emission) const {
  if (direct_.lamps().size() < 2) { return {}; }
  for (std::uint32_t s = 0; s < emission.size(); ++s) {
    if (!direct_.is_lamp(s)) { emission[s] = Color{0.0}; }
  }
  const auto meet = [&](const raycast::ScenePoint& from, const glm::dvec3& direction) -> std::optional<raycast::ScenePoint> {
    const double lift = direct_.lift(from.object);
    const raycast::Segment ray{direct_.lifted(from.object, from.position, from.normal), direction * objects().diameter()};
    const auto hit = direct_.objects().closest(ray, lift > 0.0 ? raycast::no_object : from.object, from.sheet);
    return hit && hit->front ? std::optional{met(*hit, ray)} : std::nullopt;
  };
  std::vector<PhotonGrid::Photon> photons = photons_by_lamp(boundaries, emission, meet, direct_.objects().ray_work());
  for (PhotonGrid::Photon& photon : photons) {
    photon.source = static_cast<std::uint32_t>(direct_.lamp_of(photon.source) - direct_.lamps().data());
  }
  return {photons, objects().diameter()};
}

HALFLIGHT_INLINE FinalGather::Eye FinalGather::eye(const glm::dvec3& in_scene) const {
  Eye eye{off_surfaces(objects(), (in_scene - frame().centre) * frame().scale), true};
  for (std::uint32_t o = 0; o < objects().size() && eye.in_air; ++o) {
    const raycast::PlacedObject& object = objects().object(o);
    if (!object.solid() || (!object.inside() && !object.bounds().contains(eye.position))) { continue; }
    raycast::Spans spans;
    object.spans({eye.position, {1.0, 0.0, 0.0}}, spans);
    for (const raycast::Span& span : spans) { eye.in_air = eye.in_air && !(span.in.t <= 0.0 && span.out.t >= 0.0); }
  }
  return eye;
}

HALFLIGHT_INLINE std::array<std::optional<FinalGather::Place>, 16> FinalGather::seen16(const Eye& eye,
                                                                                       std::span<const glm::dvec3> directions,
                                                                                       bool outlines) const {
  const raycast::Scene& scene = outlines ? objects() : direct_.objects();
  std::array<std::optional<Place>, 16> result;
  raycast::Segments16 rays;
  for (unsigned i = 0; i < directions.size(); ++i) { rays.set(i, {eye.position, directions[i]}, raycast::no_object, raycast::no_object); }
  pass_through(scene, rays, [&](unsigned i, const raycast::Hit& hit, const raycast::Segment& ray, int passed) -> std::optional<glm::dvec3> {
    const raycast::ScenePoint found = outlines ? objects().point(hit, ray) : met(hit, ray);
    const bool from_air = eye.in_air && passed == 0;
    const bool shown = hit.front && (from_air || !objects().covered(found));
    if (!shown) { return ray.at(hit.t); }
    result[i] = Place{found, found.object, lookup_.surface(found.object, found.sheet)};
    return std::nullopt;
  });
  return result;
}

HALFLIGHT_INLINE std::optional<FinalGather::Place> FinalGather::beside(const Place& place, const glm::dvec3& eye,
                                                                       const glm::dvec3& direction) const {
  const double towards = glm::dot(direction, place.point.normal);
  const double height = glm::dot(eye - place.point.position, place.point.normal);
  if (!(towards < 0.0) || !(height > 0.0)) { return std::nullopt; }
  Place result = place;
  result.point.position = eye - height / towards * direction;
  const raycast::PlacedObject& object = objects().object(place.object);
  if (!object.flat()) {
    result.point = object.project(place.surface - lookup_.surface(place.object, 0), result.point.position);
    if (!(glm::dot(result.point.normal, direction) < 0.0)) { return std::nullopt; }
  }
  return result;
}

HALFLIGHT_INLINE LitRegion FinalGather::lit_region(std::span<const Place> places) const {
  const Place& first = places.front();
  glm::dvec3 n{0.0};
  for (const Place& place : places) { n += place.point.normal; }
  n = glm::length(n) > 0.0 ? glm::normalize(n) : first.point.normal;
  const bool flat = std::all_of(places.begin(), places.end(), [&](const Place& place) {
    constexpr double rounding = 1e-12;
    return glm::dot(place.point.normal, first.point.normal) > 1.0 - rounding &&
           std::abs(glm::dot(place.point.position - first.point.position, first.point.normal)) < rounding;
  });
  if (flat) { n = first.point.normal; }
  // A flat rectangle around the points; on a curved surface also their largest distance from it.
  const auto [s, t] = orthonormal(n);
  glm::dvec3 lo{0.0}, hi{0.0};
  for (const Place& place : places) {
    const glm::dvec3 d = place.point.position - first.point.position;
    const glm::dvec3 at{glm::dot(d, s), glm::dot(d, t), glm::dot(d, n)};
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  const auto corner = [&, s = s, t = t](double u, double v) { return first.point.position + u * s + v * t; };
  const std::array<glm::dvec3, 4> contour{corner(lo.x, lo.y), corner(hi.x, lo.y), corner(hi.x, hi.y), corner(lo.x, hi.y)};
  const double bulge = flat ? 0.0 : std::max(hi.z, -lo.z);
  return {direct_, {contour, first.object, bulge}, flat ? n : glm::dvec3{0.0}, Shadows::for_pictures};
}

namespace detail {

// Sixteen aimed rays are cast up to four times after every 64 uniform ones; more often if the spots stand out more.
inline constexpr double most_aimed = 4.0;
inline constexpr std::uint32_t enough_spots = 32;  // spot hits of aimed rays from which their spread is a reliable estimate of the error

// Light from nearby is recomputed by paths if it is at least this share of all light. If there are at most `plain_paths` paths, the
// standard deviation of a path is assumed to equal its mean; for more paths, it is assumed to grow in proportion.
inline constexpr double least_near = 0.05, plain_paths = 256.0;

// Share of the rays that may meet a small object near the point, such as an eave or a table leg, which hides much of its light.
inline constexpr double few_rays = 0.01;

inline constexpr double least_distance = 0.1;  // lower limit of the distances of hits, relative to DirectLight::off_surface

}  // namespace detail

HALFLIGHT_INLINE FinalGather::Arriving FinalGather::arriving(const Sender& sender, const raycast::ScenePoint& found,
                                                             const BrightSpots::Target* target) const {
  const std::uint32_t surface = lookup_.surface(found.object, found.sheet);
  const Color lamp = direct_.is_lamp(surface) ? materials_[surface].emission : Color{0.0};
  if (is_black(materials_[surface].reflectance)) { return {materials_[surface].emission - lamp}; }
  const std::optional<Lookup::Found> light = target != nullptr ? spots_.found(*target) : lookup_.find(found);
  if (!light) { return {}; }
  double aimed = 0.0;
  if (sender.aimed > 0) {
    aimed = sender.aimed / 4.0 * sender.spots.aimed(surface, *light, {sender.from, sender.place.point.normal}, found);
  }
  return {light->radiosity - lamp, aimed, light->coarse_within};
}

HALFLIGHT_INLINE void FinalGather::cast_evenly(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const {
  const double reach = objects().diameter(), least = detail::least_distance * direct_.off_surface();
  const glm::dvec3 normal = sender.place.point.normal;
  raycast::Segments16 segments;
  for (unsigned k = 0; k < 16; ++k) {
    const auto [u, v] = sequence.first_two(first + k);
    segments.set(k, {sender.from, reach * cosine_direction(normal, u, v)}, sender.owner, raycast::no_object, sender.sheet);
  }
  const raycast::Hits16 hits = direct_.objects().closest16(segments);
  for (std::uint32_t rest = hits.met; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(rest));
    const raycast::Hit& hit = hits.hit[k];
    const double distance = std::max(hit.t * reach, least);
    sum.nearness += 1.0 / distance;
    sum.distances.push_back(distance);
    if (!hit.front) { continue; }
    const raycast::ScenePoint at = met(hit, segments.at(k));
    const Arriving found = arriving(sender, at);
    const bool near = hit.t * reach < found.coarse_within;
    if (near) { sum.near.push_back({at, found.light}); }
    sum.add(first / 16 % 4, near ? found.light : found.light / (1.0 + found.aimed), distance);
  }
}

HALFLIGHT_INLINE void FinalGather::cast_at_spots(const Sender& sender, const Sobol4& sequence, std::uint32_t first, Sum& sum) const {
  const double reach = objects().diameter(), least = detail::least_distance * direct_.off_surface();
  raycast::Segments16 segments;
  std::array<BrightSpots::Target, 16> targets;
  for (unsigned k = 0; k < 16; ++k) {
    targets[k] = sender.spots.choose(sequence(first + k));
    const glm::dvec3 d = targets[k].at.position - sender.from;
    if (!(glm::dot(d, sender.place.point.normal) > 0.0) || !(glm::dot(d, targets[k].at.normal) < 0.0)) { continue; }
    segments.set(k, {sender.from, reach * glm::normalize(d)}, sender.owner, raycast::no_object, sender.sheet);
  }
  if (segments.lanes == 0) { return; }
  const raycast::Hits16 hits = direct_.objects().closest16(segments);
  for (std::uint32_t rest = hits.met & segments.lanes; rest != 0; rest &= rest - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(rest));
    const raycast::Hit& hit = hits.hit[k];
    if (!hit.front || direct_.whole(hit.object) != targets[k].at.object) { continue; }
    const raycast::ScenePoint found = met(hit, segments.at(k));
    if (!BrightSpots::reached(direct_, targets[k].at, sender.from, found)) { continue; }
    const Arriving light = arriving(sender, targets[k].at, &targets[k]);
    if (!(light.aimed > 0.0) || hits.hit[k].t * reach < light.coarse_within) { continue; }
    sum.add(k / 4, light.light / (1.0 + light.aimed), std::max(hit.t * reach, least));
    ++sum.spots_met;
  }
}

HALFLIGHT_INLINE double FinalGather::mend_near(Sum& sum, const Place& place, double all, std::uint32_t rays, const GatherRays& effort,
                                               std::uint64_t key) const {
  Color near{0.0};
  for (const NearLight::Seen& seen : sum.near) { near += seen.light; }
  const double share = sum_of_channels(near) / all;
  if (!(share > detail::least_near)) { return 0.0; }
  const double most = effort.most_paths;
  const double wanted = std::min(most, most / detail::plain_paths * std::pow(share / effort.error, 2.0));
  constexpr std::uint32_t step = NearLight::paths_at_once;
  const BrightSpots::From spots{spots_, place.point.position};
  const bool aimed = !spots_.empty() && spots.spread_more_than(all / rays);
  const std::uint32_t paths = step * std::max(1u, static_cast<std::uint32_t>(wanted / step));
  const NearLight::Sum better = near_.light(sum.near, paths, key, aimed ? &spots : nullptr);
  sum.light += better.light - near;
  return better.variance;
}

HALFLIGHT_INLINE double FinalGather::of_reflected_channels(const Place& place, const Color& light) const {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) { sum += materials_[place.surface].reflectance[k] > 0.0 ? light[k] : 0.0; }
  return sum;
}

HALFLIGHT_INLINE double FinalGather::irradiance_solved(const Place& place) const {
  const Material& material = materials_[place.surface];
  const Color reflected = solved(place).value_or(material.emission) - material.emission;
  return of_reflected_channels(place, reflected / material.reflectance);
}

HALFLIGHT_INLINE FinalGather::Indirect FinalGather::indirect(const Place& place, const GatherRays& effort, std::uint64_t key) const {
  const double error = effort.error;
  const Sobol4 sequence{1, key}, aiming{2, key};
  const double lift = direct_.lift(place.object);
  Sender sender{place,
                direct_.lifted(place.object, place.point.position, place.point.normal),
                lift > 0.0 ? raycast::no_object : place.object,
                place.surface - lookup_.surface(place.object, 0),
                {spots_, place.point}};
  const double solved_light = irradiance_solved(place);
  // Rays are aimed if the spots alone would leave the least number of uniform rays with more than half of the wanted error. The decision
  // uses the solution, not the spread of the rays: rays that all miss the spots agree with each other, and points that come out too dark
  // would be favoured.
  if (const double contrast = sender.spots.contrast(solved_light); contrast > 0.5 * error * std::sqrt(static_cast<double>(effort.least))) {
    sender.aimed = static_cast<std::uint32_t>(std::clamp(0.5 * contrast, 1.0, detail::most_aimed));
  }
  Sum sum;
  std::uint32_t rays = 0;
  const auto mean_of_parts = [&] { return (sum.part[0] + sum.part[1] + sum.part[2] + sum.part[3]) / 4.0; };
  const auto variance_of_mean = [&] {
    const double mean = mean_of_parts();
    double squares = 0.0;
    for (const double p : sum.part) { squares += (p - mean) * (p - mean) / 12.0; }
    return squares;
  };
  // If spots matter but few rays have met them, agreement of the rays is not trusted while the solution shows more light.
  std::optional<Color> direct;  // light from lamps
  const auto all_found = [&] {
    const double wanted = (1.0 - error) * solved_light - of_reflected_channels(place, sum.light) / rays;
    if (sender.aimed == 0 || sum.spots_met >= detail::enough_spots || wanted <= 0.0) { return true; }
    if (!direct) { direct = lit_region({&place, 1}).irradiance(place.point.position, place.point.normal); }
    return of_reflected_channels(place, *direct) >= wanted;
  };
  const auto exact_enough = [&] { return variance_of_mean() <= error * error * mean_of_parts() * mean_of_parts() && all_found(); };
  for (; rays < effort.least || (rays < effort.most && (rays % 64 != 0 || !exact_enough())); rays += 16) {
    cast_evenly(sender, sequence, rays, sum);
    if (rays % 64 != 48) { continue; }
    for (std::uint32_t k = 0; k < sender.aimed; ++k) { cast_at_spots(sender, aiming, (rays / 64 * sender.aimed + k) * 16, sum); }
  }
  const double all = rays;
  double of_near = 0.0;
  if (!sum.near.empty()) { of_near = mend_near(sum, place, std::max(4.0 * mean_of_parts(), all * solved_light), rays, effort, key); }
  const double lit = 4.0 * mean_of_parts();
  const auto few = static_cast<std::ptrdiff_t>(detail::few_rays * all);
  Indirect result{sum.light / all, (16.0 * variance_of_mean() + of_near) / (all * all), sum.nearness / all,
                  lit > 0.0 ? sum.of_light / lit : 0.0};
  if (few < std::ssize(sum.distances)) {
    std::nth_element(sum.distances.begin(), sum.distances.begin() + few, sum.distances.end());
    result.nearest = sum.distances[static_cast<std::size_t>(few)];
  }
  return result;
}

}  // namespace radiosity
