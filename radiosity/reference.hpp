// SPDX-License-Identifier: MIT
#pragma once

// Unbiased radiosity at a point of a true surface, by path tracing on the original objects. It shares nothing with the
// solver but the scene: no mesh, no form factors, no links.
//
// B(x) = E(x) + rho(x) * mean of B(y) over the points y seen from x in cosine-distributed directions. Paths end by Russian
// roulette with the largest channel of rho, so they take 1 / (1 - rho) bounces on average: see most_bounces. When the
// lights are flat and small they are sampled directly (next event),
// and paths that run into them do not count their emission twice.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/scene.hpp>

#include <radiosity/patch.hpp>
#include <radiosity/random.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

// A closed scene with a reflectance above 1 - 1 / most_bounces is not path-traced: it would take too long, and to end paths earlier
// would make their variance infinite. In a scene not proven closed paths leave; those that do not are ended at this length
// on average, so that a white room pieced together from polygons ends too.
inline constexpr double most_bounces = 1000.0;

class PathTracer {
 public:
  // `surfaces` are boundaries of the compiled objects (refined or not) in the frame.
  PathTracer(const Scene& scene, const raycast::Scene& objects, const std::vector<Surface>& surfaces) : objects_{&objects} {
    for (const InputSurface& s : radiosity::surfaces(scene)) { materials_.push_back(&scene.materials[s.material]); }
    for (const Material& material : scene.materials) {
      const Color& rho = material.reflectance;
      brightest_ = std::max({brightest_, rho.x, rho.y, rho.z});
    }
    for (const Surface& surface : surfaces) { first_surface_.push_back(surface.first_surface); }
    collect_lights(surfaces);
  }

  // Largest reflectance of the scene.
  [[nodiscard]] double brightest() const { return brightest_; }

  struct Light {
    Color all{0.0};     // B
    Color direct{0.0};  // the part of it that is emitted, or was reflected once
  };
  // One estimate of B at the point x of a surface with unit normal n (into the air). `random` gives numbers by uniform(): independent
  // ones, or those of a path of an even sequence (sobol.hpp).
  template <class Numbers>
  [[nodiscard]] Light radiosity(glm::dvec3 x, glm::dvec3 n, std::uint32_t object, std::uint32_t sheet, Numbers& random,
                                std::uint64_t& rays) const {
    const Material* material = materials_[first_surface_[object] + sheet];
    Light result{material->emission, material->emission};
    Color throughput{1.0};
    for (bool first = true;; first = false) {
      const auto arrives = [&](const Color& light) {
        result.all += light;
        if (first) { result.direct += light; }
      };
      const Color& rho = material->reflectance;
      const double survival = std::min(1.0 - 1.0 / most_bounces, std::max({rho.x, rho.y, rho.z}));
      throughput *= rho;
      if (survival > 0.0 && light_area_ > 0.0) { arrives(throughput * direct(x, n, object, random, rays)); }
      if (!(random.uniform() < survival)) { return result; }
      throughput /= survival;

      const double u = random.uniform();
      const raycast::Segment ray{x, cosine_direction(n, u, random.uniform()) * objects_->diameter()};
      ++rays;
      const auto hit = objects_->closest(ray, object);
      if (!hit || !hit->front) { return result; }
      const raycast::SurfacePoint point = objects_->object(hit->object).project(hit->sheet, ray.at(hit->t));
      x = point.position;
      n = point.normal;
      object = hit->object;
      const std::uint32_t surface = first_surface_[object] + hit->sheet;
      material = materials_[surface];
      if (!sampled_[surface]) { arrives(throughput * material->emission); }
    }
  }

 private:
  struct Lamp {
    glm::dvec3 a{0.0}, ab{0.0}, ac{0.0}, normal{0.0};
    double cumulative_area = 0.0;
    std::uint32_t object = 0;
    Color emission{0.0};
  };

  // Flat emitters are sampled by area, unless they cover more than a tenth of the scene: then paths find them anyway.
  void collect_lights(const std::vector<Surface>& surfaces) {
    sampled_.assign(materials_.size(), false);
    double total = 0.0;
    double area = 0.0;
    for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
      const SurfaceBRep& brep = surfaces[o].brep;
      for (const brep::FaceId f : brep::faces(brep)) {
        if (brep.data(f).sheet == brep::no_sheet) { continue; }
        const Polygon polygon = loop_polygon(brep, f);
        total += glm::length(vector_area(polygon));
        const std::uint32_t surface = surfaces[o].first_surface + brep.data(f).sheet;
        if (is_black(materials_[surface]->emission) || !surfaces[o].object->flat()) { continue; }
        sampled_[surface] = true;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
          const glm::dvec3 ab = polygon[i] - polygon[0];
          const glm::dvec3 ac = polygon[i + 1] - polygon[0];
          const double twice = glm::length(glm::cross(ab, ac));
          if (!(twice > 0.0)) { continue; }
          area += 0.5 * twice;
          lamps_.push_back({polygon[0], ab, ac, glm::cross(ab, ac) / twice, area, o, materials_[surface]->emission});
        }
      }
    }
    light_area_ = area;
    if (area > 0.1 * total) {
      light_area_ = 0.0;
      lamps_.clear();
      sampled_.assign(materials_.size(), false);
    }
  }

  [[nodiscard]] static Polygon loop_polygon(const SurfaceBRep& brep, brep::FaceId f) {
    Polygon polygon;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { polygon.push_back(brep.data(brep.vertex(h)).position); }
    return polygon;
  }

  // Irradiance / 1 from one point on the lights: E cos cos / (pi r^2) times the area, when nothing blocks it.
  template <class Numbers>
  [[nodiscard]] Color direct(const glm::dvec3& x, const glm::dvec3& n, std::uint32_t object, Numbers& random, std::uint64_t& rays) const {
    const double pick = random.uniform() * light_area_;
    auto lamp = std::upper_bound(lamps_.begin(), lamps_.end(), pick, [](double p, const Lamp& l) { return p < l.cumulative_area; });
    if (lamp == lamps_.end()) { --lamp; }
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const glm::dvec3 y = lamp->a + u * lamp->ab + v * lamp->ac;
    const glm::dvec3 d = y - x;
    const double r2 = glm::dot(d, d);
    const double cosines = glm::dot(n, d) * -glm::dot(lamp->normal, d);
    if (!(glm::dot(n, d) > 0.0) || !(cosines > 0.0)) { return Color{0.0}; }
    ++rays;
    if (objects_->occluded({x, d}, object, lamp->object)) { return Color{0.0}; }
    if (objects_->covered(y, lamp->normal, lamp->object)) { return Color{0.0}; }  // this part of the lamp is buried
    return lamp->emission * (cosines / (r2 * r2) * light_area_ / std::numbers::pi);
  }

  const raycast::Scene* objects_;
  std::vector<const Material*> materials_;    // one a surface
  std::vector<std::uint32_t> first_surface_;  // one an object
  std::vector<Lamp> lamps_;
  std::vector<bool> sampled_;  // one a surface: its emission is found by direct()
  double light_area_ = 0.0;
  double brightest_ = 0.0;
};

}  // namespace radiosity
