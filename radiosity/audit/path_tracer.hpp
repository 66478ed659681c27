// SPDX-License-Identifier: MIT
#pragma once

// Unbiased radiosity at a point of a true surface, by path tracing on the original objects. It shares nothing with the
// solver but the scene: no mesh, no form factors, no links.
//
// B(x) = E(x) + rho(x) * mean of B(y) over the points y seen from x in cosine-distributed directions. At each vertex of a path the
// emitted light is estimated twice: in a direction towards an emitter (emitters.hpp), and in the cosine-distributed direction in which
// the path continues. The balance heuristic weighs the two (Veach and Guibas 1995). With p the density of the first per solid angle,
// light that arrives at the angle t to the normal counts E / (p + cos t / pi) * cos t / pi, which is at most E. So no lamp, however
// small, near or bright, makes a rare path count much.
//
// Where small bright places hold much of the light, aimed() returns a tracer that continues a share of its paths towards them
// (bright_places.hpp).
//
// A path ends by Russian roulette, but only once it carries little: when the product of the reflectances along it falls below a tenth, or
// below 1 - rho of the scene's brightest surface if that is larger. With roulette at each bounce, the light of a white closed room would
// be as uncertain as the path length, whose mean is of the order of 1 / (1 - rho) with a standard deviation as large. The certain bounces
// cost at most 3.3 times as many rays, and the variance of the length falls to a hundredth.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/audit/bright_places.hpp>
#include <radiosity/audit/emitters.hpp>
#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

class PathTracer {
 public:
  // `surfaces`: boundaries of the compiled objects in the frame; coarser ones are faster. They may be freed after this call.
  PathTracer(const Scene& scene, const raycast::Scene& objects, const std::vector<Surface>& surfaces) : objects_{&objects} {
    std::vector<Color> emission;
    for (const InputSurface& s : radiosity::surfaces(scene)) {
      materials_.push_back(scene.materials[s.material]);
      emission.push_back(materials_.back().emission);
    }
    for (const Material& material : scene.materials) {
      const Color& rho = material.reflectance;
      brightest_ = std::max(brightest_, brightest(rho));
    }
    for (const Surface& surface : surfaces) { first_surface_.push_back(surface.first_surface); }
    emitters_ = Emitters{surfaces, emission};
    if (emitters_.empty()) { return; }
    emitters_.guide(photons_by_lamp(surfaces, emission, meet_front(), objects.ray_work()), objects.diameter());
  }

  // The same tracer with some paths aimed at bright places; nothing if no such place matters. `surfaces`: as above. Whether aiming pays
  // depends on where paths begin (aimed_paths.hpp).
  [[nodiscard]] std::optional<PathTracer> aimed(const std::vector<Surface>& surfaces) const {
    if (emitters_.empty()) { return std::nullopt; }
    std::vector<Color> emission;
    for (const Material& material : materials_) { emission.push_back(material.emission); }
    std::vector<BrightPlaces::Reflected> light;
    for (const LampPhoton& photon : lamp_photons(surfaces, emission, meet_front(), objects_->ray_work())) {
      const Color& rho = of(photon.landed).reflectance;
      light.push_back({photon.landed, photon.power * sum_of_channels(rho)});
    }
    BrightPlaces::Use use{0.0, objects_->diameter()};
    for (const Surface& surface : surfaces) {
      for (const brep::FaceId f : brep::faces(surface.brep)) { use.area += brep::area(surface.brep, f); }
    }
    // Paths that are not aimed are weighted by 1 / (1 - share) at every reflection, which multiplies over the many reflections of a white
    // room.
    constexpr double most_share = 0.25;
    use.share = std::min(most_share, 0.5 * (1.0 - brightest_ * brightest_));
    constexpr double most_microseconds = 3e4, most_photons = 1 << 14, least_photons = 1 << 11;
    use.photons = static_cast<std::uint32_t>(std::clamp(most_microseconds / objects_->ray_work(), least_photons, most_photons));
    PathTracer result = *this;
    result.places_ = BrightPlaces{std::move(light), use, meet_front()};
    return result.places_.empty() ? std::nullopt : std::optional{std::move(result)};
  }

  [[nodiscard]] std::uint32_t surface(std::uint32_t object, std::uint32_t sheet) const { return first_surface_[object] + sheet; }
  [[nodiscard]] const Material& material(std::uint32_t surface) const { return materials_[surface]; }
  [[nodiscard]] const Material& of(const raycast::ScenePoint& x) const { return materials_[surface(x.object, x.sheet)]; }

  struct Light {
    Color all{0.0};     // B
    Color direct{0.0};  // the part of it that is emitted or was reflected once
  };
  // Counts rays and their cost (raycast::Scene::ray_work, Emitters::work). The counting takes about as long as the rays themselves.
  struct RayCost {
    std::uint64_t rays = 0;
    double work = 0.0;

    // Mean cost of a ray, in microseconds.
    [[nodiscard]] double mean() const { return rays > 0 ? work / static_cast<double>(rays) : 0.0; }
  };

  // One estimate of B at the point x. `random` supplies numbers by uniform(): independent ones, or those of a low-discrepancy path
  // (sobol.hpp). Light that was reflected more than `most` times is left out. `rays`: a counter or a RayCost.
  template <class Numbers, class Rays>
  [[nodiscard]] Light radiosity(raycast::ScenePoint x, Numbers& random, Rays& rays,
                                std::uint32_t most = std::numeric_limits<std::uint32_t>::max()) const {
    const Material* material = &of(x);
    Light result{material->emission, material->emission};
    Color throughput{1.0}, reflected{1.0};  // reflected: product of the reflectances alone, for the roulette
    for (std::uint32_t reflections = 0; reflections < most; ++reflections) {
      const bool first = reflections == 0;
      const auto arrives = [&](const Color& light) {
        result.all += light;
        if (first) { result.direct += light; }
      };
      const Color& rho = material->reflectance;
      throughput *= rho;
      reflected *= rho;
      if (is_black(throughput)) { return result; }
      const BrightPlaces::From places{places_, x.position, x.normal};
      const std::optional<glm::dvec3> onwards = places.direction(random);
      if constexpr (std::is_same_v<Rays, RayCost>) { rays.work += places_.work(); }
      if (const std::optional<Emitters::Sample> lamp = emitters_.sample(x.position, x.normal, random)) {
        const std::optional<raycast::Hit> hit = first_front(x, lamp->direction, rays);
        if (hit) {
          arrives(throughput * emission(*hit) *
                  balance(lamp->density + places.density(lamp->direction), glm::dot(x.normal, lamp->direction)));
        }
        count_emitters(x, lamp->direction, rays);
      }
      if (!first) {
        const double carried = brightest(reflected);
        const double survival = std::min(1.0 - 1.0 / most_bounces, carried / std::max(0.1, 1.0 - brightest_));
        if (!(random.uniform() < survival)) { return result; }
        throughput /= survival;
        reflected /= survival;
      }

      if (!onwards) { return result; }
      const std::optional<raycast::Hit> hit = first_front(x, *onwards, rays);
      if (!hit) { return result; }
      const double density = places.density(*onwards), cosine = glm::dot(x.normal, *onwards);
      if (!is_black(emission(*hit))) {
        arrives(throughput * emission(*hit) * balance(emitters_.density(x.position, x.normal, *onwards) + density, cosine));
        count_emitters(x, *onwards, rays);
      }
      throughput *= balance(density, cosine);
      x = objects_->point(*hit, ray(x, *onwards));
      material = &of(x);
    }
    return result;
  }

 private:
  [[nodiscard]] raycast::Segment ray(const raycast::ScenePoint& from, const glm::dvec3& direction) const {
    return {from.position, direction * objects_->diameter()};
  }
  [[nodiscard]] const Color& emission(const raycast::Hit& hit) const { return materials_[surface(hit.object, hit.sheet)].emission; }

  // The first hit of the ray from x; nothing if that hit shows its back.
  template <class Rays>
  [[nodiscard]] std::optional<raycast::Hit> first_front(const raycast::ScenePoint& x, const glm::dvec3& direction, Rays& rays) const {
    const glm::dvec3 reach = direction * objects_->diameter();
    const auto hit = objects_->closest(x, reach);
    if constexpr (std::is_same_v<Rays, RayCost>) {
      ++rays.rays;
      rays.work += objects_->ray_work({x.position, reach * (hit ? hit->t : 1.0)});
    } else {
      ++rays;
    }
    return hit && hit->front ? hit : std::nullopt;
  }

  // Adds the cost of evaluating the emitters' density in this direction.
  template <class Rays>
  void count_emitters(const raycast::ScenePoint& x, const glm::dvec3& direction, Rays& rays) const {
    if constexpr (std::is_same_v<Rays, RayCost>) { rays.work += emitters_.work(x.position, x.normal, direction); }
  }

  // Weight of the light of a direction: cosine / pi over the density of all ways to sample it.
  [[nodiscard]] static double balance(double density, double cosine) {
    return density > 0.0 ? std::max(0.0, cosine) * std::numbers::inv_pi / density : 0.0;
  }

  [[nodiscard]] MeetFront meet_front() const {
    return [this](const raycast::ScenePoint& from, const glm::dvec3& direction) -> std::optional<raycast::ScenePoint> {
      std::uint64_t rays = 0;
      const auto hit = first_front(from, direction, rays);
      return hit ? std::optional{objects_->point(*hit, ray(from, direction))} : std::nullopt;
    };
  }

  const raycast::Scene* objects_;
  std::vector<Material> materials_;           // one a surface
  std::vector<std::uint32_t> first_surface_;  // one an object
  Emitters emitters_;
  BrightPlaces places_;
  double brightest_ = 0.0;
};

}  // namespace radiosity
