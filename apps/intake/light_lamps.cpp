// SPDX-License-Identifier: MIT
#include "apps/intake/light_lamps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>

#include "apps/intake/spot_cup.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// In diameters of the scene. From its middle to its rim rays diverge by a sixteenth of the sun's width.
constexpr double suns_away = 1e3;

class LampMaker {
 public:
  explicit LampMaker(SceneFile& file)
      : file_(file), things_(radiosity::placed_objects(file.scene)), lit_(radiosity::lit_bounds(file.scene)), size_(things_.diameter()) {
    for (std::uint32_t i = 0; i < file.scene.objects.size(); ++i) {
      if (is_sky(file.scene.objects[i])) { file.sky.objects.push_back(i); }
    }
  }

  void add(const std::vector<ModelLight>& lights) {
    const auto is_sun = [](const ModelLight& light) { return light.kind == ModelLight::Kind::sun; };
    const auto shines = [](const ModelLight& light) { return !radiosity::is_black(light.intensity) && usable(light); };
    std::vector<const ModelLight*> row;
    for (const ModelLight& light : lights) {
      if (shines(light) && !is_sun(light)) { row.push_back(&light); }
    }
    // In the order of their places along a line that no building is parallel to: lamps close to each other are close in this order, too.
    const auto before = [](const ModelLight* a, const ModelLight* b) { return std::pair{along(*a), a} < std::pair{along(*b), b}; };
    std::sort(row.begin(), row.end(), before);
    std::vector<glm::dvec3> to_suns;
    for (const ModelLight& light : lights) {
      if (shines(light) && is_sun(light)) { to_suns.push_back(-glm::normalize(light.direction)); }
    }
    move_sky_beyond(to_suns);
    for (const ModelLight& light : lights) {
      if (!shines(light)) {
        ++left_out_;
      } else if (is_sun(light)) {
        sun(light);
      } else {
        fade_otherwise_ += light.fades_otherwise ? 1 : 0;
        lamp(row, static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), &light, before) - row.begin()));
      }
    }
    tell();
  }

 private:
  struct Place {
    glm::dvec3 at{0.0};
    double free = 0.0;  // the way to the next surface
  };

  static double along(const ModelLight& light) { return glm::dot(light.position, glm::normalize(glm::dvec3{1.0, 0.618, 0.382})); }

  static bool usable(const ModelLight& light) {
    const bool turned = light.kind == ModelLight::Kind::point || glm::length(light.direction) > 0.0;
    return turned && glm::length(light.direction) < 1e100 && glm::length(light.position) < 1e30;
  }

  // Where a lamp hangs free. The next surface is searched by rays in many directions, each from a little behind the place, so that they
  // meet surfaces through it, too. A lamp that touches a surface is moved off it: into its light, or to the front of the surface,
  // if this has two fronts to the middle of the scene.
  [[nodiscard]] Place free_place(const ModelLight& light) const {
    constexpr int directions = 256;
    const double behind = 1e-4 * size_;
    Place place{light.position, size_};
    glm::dvec3 front(0.0), side(0.0);
    for (int i = 0; i < directions; ++i) {
      const double z = 1.0 - 2.0 * (i + 0.5) / directions, aside = std::sqrt(1.0 - z * z),
                   angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const glm::dvec3 direction{aside * std::cos(angle), aside * std::sin(angle), z};
      const raycast::Segment ray{light.position - behind * direction, direction};
      const auto hit = things_.closest(ray);
      if (!hit) { continue; }
      const double way = std::abs(hit->t - behind);
      if (way < behind) { front += side = things_.point(*hit, ray).normal; }
      place.free = std::min(place.free, way);
    }
    if (place.free >= behind) { return place; }
    glm::dvec3 off = light.kind == ModelLight::Kind::spot ? light.direction : front;
    if (!(glm::length(off) > 1e-9)) { off = glm::dot(side, things_.bounds().centre() - light.position) < 0.0 ? -side : side; }
    place.at += 2.0 * behind * glm::normalize(off);
    place.free = behind;
    return place;
  }

  // Makes a lamp for row[i], and for point lights at the same place that come after it.
  void lamp(const std::vector<const ModelLight*>& row, std::size_t i) {
    const ModelLight& light = *row[i];
    constexpr double most = 0.02, of_free = 0.1;  // limits of the radius: in metres, and relative to the way to what is next
    const double same = 1e-6 * size_, reach = std::max(most / of_free, same);
    const auto near = [&](std::size_t k) { return std::abs(along(*row[k]) - along(light)) <= reach; };
    const auto way = [&](std::size_t k) { return glm::length(row[k]->position - light.position); };
    const auto is_part = [&](std::size_t k) {
      const bool balls = light.kind == ModelLight::Kind::point && row[k]->kind == ModelLight::Kind::point;
      return balls && row[k]->absolute == light.absolute && way(k) <= same;
    };
    double free = size_;
    for (std::size_t k = i; k > 0 && near(k - 1); --k) {
      if (is_part(k - 1)) { return; }
      if (way(k - 1) > same) { free = std::min(free, way(k - 1)); }
    }
    radiosity::Color intensity = light.intensity;
    for (std::size_t k = i + 1; k < row.size() && near(k); ++k) {
      if (is_part(k)) {
        intensity += row[k]->intensity;
      } else if (way(k) > same) {
        free = std::min(free, way(k));
      }
    }
    const Place place = free_place(light);
    const double radius = std::min({most, 0.01 * size_, of_free * std::min(free, place.free)});
    intensity *= light.absolute ? 1.0 : 100.0 * 0.25 * size_ * size_;
    if (light.kind == ModelLight::Kind::spot) { return spot(light, place.at, radius, intensity); }
    if (take(raycast::Sphere::make(place.at, radius).object, intensity / (radius * radius), "sphere")) {
      ++balls_;
      widest_ = std::max(widest_, 2.0 * radius);
    }
  }

  void spot(const ModelLight& light, const glm::dvec3& at, double radius, const radiosity::Color& intensity) {
    constexpr double largest = 2.0;
    const SpotCup& cup = cup_of(light);
    const double ball = radius * std::min(1.0, largest / std::max(cup.rim, cup.depth));
    std::shared_ptr<const raycast::Object> blind = recess(cup, at, light.direction, ball);
    raycast::Made<raycast::Sphere> lamp = raycast::Sphere::make(at, ball);
    if (!blind || !take(std::move(lamp.object), intensity / (ball * ball), "sphere")) { return; }
    if (!blind_) {
      blind_ = static_cast<std::uint32_t>(file_.scene.materials.size());
      file_.scene.materials.push_back({"blind", radiosity::Color(0.0), radiosity::Color(0.0)});
    }
    file_.scene.objects.push_back({"blind", std::move(blind), {}, {*blind_}});
    file_.origins.push_back({"mesh", {}});
    ++spots_;
    spots_differ_ = std::max(spots_differ_, cup.difference);
  }

  // Files have many spots of one kind.
  const SpotCup& cup_of(const ModelLight& light) {
    const std::array kind{light.inner, light.outer, static_cast<double>(light.fade), light.power};
    const auto [place, is_new] = cups_.try_emplace(kind);
    if (is_new) { place->second = spot_cup(light); }
    return place->second;
  }

  void sun(const ModelLight& light) {
    constexpr double half_width = 0.25 * degree;
    const glm::dvec3 up = -glm::normalize(light.direction);
    const double distance = distance_of_suns(), radius = distance * std::tan(half_width);
    const double share = radius * radius / (radius * radius + distance * distance);
    const double unit = light.absolute ? 1.0 : 100.0;
    if (take(raycast::Disk::make(lit_.centre() + distance * up, -up, radius).object, unit / share * light.intensity, "disk")) {
      ++suns_;
      file_.suns.push_back(static_cast<std::uint32_t>(file_.scene.objects.size() - 1));
    }
  }

  [[nodiscard]] double distance_of_suns() const { return suns_away * std::max(lit_.diameter(), 1e-30); }

  // What shines all over, reaches beyond all else, and is large or far away: a dome over the scene, or a panel before a window. Not a lamp,
  // in a room or above a floor.
  [[nodiscard]] bool is_sky(const radiosity::SceneObject& object) const {
    if (!radiosity::shines_all_over(file_.scene, object)) { return false; }
    constexpr double beyond = 0.05, far_away = 0.25, large = 0.1;  // of the diameter of all else
    const double size = lit_.diameter();
    const raycast::Box own = radiosity::placed_bounds(*object.shape, object.placement);
    return !lit_.grown(beyond * size).contains(own) && (!lit_.meets(own, far_away * size) || own.diameter() >= large * size);
  }

  // A light from a direction is infinitely far away, and the sky of a file is not. Where the sky would hide a sun, it is enlarged from the
  // middle of the scene until it lies beyond all suns: seen from there, it looks as before.
  void move_sky_beyond(const std::vector<glm::dvec3>& to_suns) {
    EnlargedSky& sky = file_.sky;
    if (sky.objects.empty()) { return; }
    double factor = 1.0;
    for (const glm::dvec3& up : to_suns) { factor = std::max(factor, factor_of_sky(up)); }
    sky.centre = lit_.centre();
    sky.factor = factor;
    if (factor == 1.0) { return; }
    for (const std::uint32_t i : sky.objects) {
      raycast::Placement& placement = file_.scene.objects[i].placement;
      placement.linear *= factor;
      placement.translation = sky.centre + factor * (placement.translation - sky.centre);
    }
  }

  // By how much the sky must be enlarged so that it does not hide the sun in this direction; 1 if it does not.
  [[nodiscard]] double factor_of_sky(const glm::dvec3& up) const {
    const double distance = distance_of_suns();
    const glm::dvec3 middle = lit_.centre(), half = 0.5 * lit_.size();
    double factor = 1.0;
    const auto lies_at = [&](const glm::dvec3& place) {
      constexpr double margin = 1.5, least = 0.05;  // the sky beyond the sun; its height, of the diameter of what is lit
      const double height = glm::dot(place - middle, up);
      if (height > least * lit_.diameter()) { factor = std::max(factor, margin * distance / height); }
    };
    // The middle of what is lit sees the sun along this line. A part of the sky may hide the sun from some place only if its box, enlarged
    // by half the box of what is lit, meets the line.
    const raycast::SlabTest to_sun({middle, 2.0 * distance * up});
    std::vector<raycast::PlacedObject> placed;
    std::vector<glm::dvec3> centres;
    for (const std::uint32_t i : file_.sky.objects) {
      const radiosity::SceneObject& object = file_.scene.objects[i];
      const raycast::Box box = radiosity::placed_bounds(*object.shape, object.placement);
      double entry = 0.0;
      if (!to_sun({box.lo - half, box.hi + half}, 0.0, 1.0, entry)) { continue; }
      centres.push_back(box.centre());
      placed.emplace_back(object.shape, object.placement);
    }
    if (placed.empty()) { return factor; }
    const raycast::Scene sky(std::move(placed));
    constexpr int steps = 5;  // of places along each side of the scene
    std::vector<bool> met(centres.size(), false);
    for (int k = 0; k < steps * steps * steps; ++k) {
      const glm::dvec3 share = (glm::dvec3(k % steps, k / steps % steps, k / steps / steps) + 0.5) / static_cast<double>(steps);
      const raycast::Segment ray{lit_.lo + share * lit_.size(), 2.0 * distance * up};
      const auto hit = sky.closest(ray);
      if (!hit) { continue; }
      met[hit->object] = true;
      lies_at(ray.at(hit->t));
    }
    for (std::size_t i = 0; i < met.size(); ++i) {
      if (!met[i]) { lies_at(centres[i]); }
    }
    return factor;
  }

  bool take(std::shared_ptr<const raycast::Object> shape, const radiosity::Color& exitance, const char* kind) {
    if (!shape || !(radiosity::brightest(exitance) < 1e100)) {
      ++left_out_;
      return false;
    }
    const auto material = static_cast<std::uint32_t>(file_.scene.materials.size());
    file_.scene.materials.push_back({"light", radiosity::Color(0.0), exitance});
    file_.scene.objects.push_back({"light", std::move(shape), {}, {material}});
    file_.origins.push_back({kind, {}});
    return true;
  }

  void tell() const {
    const auto note = [&](std::string sentence) { file_.notes.push_back(std::move(sentence)); };
    const auto warn = [&](std::string sentence) { file_.warnings.push_back(std::move(sentence)); };
    if (left_out_ > 0) {
      note(counted(left_out_, "light is left out: it has", "lights are left out: they have") +
           " no intensity, place or direction with which one can compute");
    }
    if (balls_ > 0) {
      note(counted(balls_, "light has no surface: a lamp", "lights have no surface: lamps") + " of " + radiosity::length_text(widest_) +
           " across");
    }
    if (fade_otherwise_ > 0) {
      note(counted(fade_otherwise_, "light", "lights") +
           ": not the reach and fading of the file, but those of a lamp: with the square of the distance");
    }
    if (suns_ > 0) { note(counted(suns_, "directional light became a sun", "directional lights became suns") + " half a degree wide"); }
    if (spots_ > 0) {
      note(counted(spots_, "spot light became a small lamp in a black cup", "spot lights became small lamps in black cups"));
      if (spots_differ_ > 0.005) {  // that is told in whole per cent
        std::ostringstream text;
        text << std::round(100.0 * spots_differ_);
        warn(counted(spots_, "spot light sends", "spot lights send") +
             " as much light as in the file, which falls from the axis as that of a round lamp in a black cup: by " + text.str() +
             " % (RMS) otherwise");
      }
    }
    if (file_.sky.factor > 1.0) {
      std::ostringstream factor;
      factor.precision(3);
      factor << file_.sky.factor;
      warn("the sky is enlarged by a factor of " + factor.str() +
           " from the middle of the scene, so that it does not hide the sun: seen from elsewhere, it lies in somewhat other directions");
    }
  }

  SceneFile& file_;
  raycast::Scene things_;
  raycast::Box lit_;  // of what is lit: without sky
  double size_ = 0.0, widest_ = 0.0;
  std::optional<std::uint32_t> blind_;  // the material
  double spots_differ_ = 0.0;           // the largest SpotCup::difference
  std::map<std::array<double, 4>, SpotCup> cups_;
  std::size_t balls_ = 0, spots_ = 0, suns_ = 0, left_out_ = 0, fade_otherwise_ = 0;
};

}  // namespace

void add_light_lamps(SceneFile& file, const std::vector<ModelLight>& lights) {
  if (!lights.empty()) { LampMaker(file).add(lights); }
}

}  // namespace apps
