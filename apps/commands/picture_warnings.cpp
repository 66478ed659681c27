// SPDX-License-Identifier: MIT
#include "apps/commands/picture_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>

#include <raycast/scene.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/light_views.hpp"

namespace apps {
namespace {

constexpr double most_black = 0.9;

bool is_shown(const glm::vec3& pixel) {
  constexpr float black_below = 0.0016f;  // 5 of 255 levels
  return std::max({pixel.x, pixel.y, pixel.z}) >= black_below;
}

// What the rays of a coarse picture meet: `fronts` and `backs` count what they meet first, `seen` those that meet a front after any number
// of backs, `black` those of them whose pixels are black.
struct Coarse {
  static constexpr int across = 32, down = 24, rays = across * down;
  int fronts = 0, backs = 0, seen = 0, black = 0;

  Coarse(const radiosity::Picture& picture, const SceneFile& file, const radiosity::View& view) {
    const raycast::Scene objects(radiosity::placed_objects(file.scene));
    for (int i = 0; i < rays; ++i) {
      const double x = (i % across + 0.5) / across * view.size.width, y = (i / across + 0.5) / down * view.size.height;
      raycast::Segment ray{view.eye, view.direction(x, y)};
      const auto hit = objects.closest(ray);
      if (hit) { ++(hit->front ? fronts : backs); }
      if (!hit || !radiosity::seen_front(objects, ray)) { continue; }
      ++seen;
      black += is_shown(picture.shown[static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x)]) ? 0 : 1;
    }
  }
};

std::string percent_of(int count, int all) { return std::to_string(std::lround(100.0 * count / all)) + " %"; }

std::string advice(const SceneFile& file) {
  const auto inside = LightViews(file.scene).inside();
  const std::string place = inside ? "try a place in the room of a lamp (--camera \"" + camera_text(inside->camera) + "\")"
                                   : "try another place (--camera \"eye X Y Z target X Y Z\")";
  return place + " or a brighter picture (--exposure 4ev)";
}

// The radiosity such that surfaces at least as bright reflect nine tenths of all reflected light. Surfaces that shine do not count; each
// other one counts with its mean.
double usual_light(const radiosity::Scene& scene, const std::vector<radiosity::SurfaceMean>& means) {
  struct Reflected {
    double level = 0.0, power = 0.0;
  };
  std::set<std::string> lamps;
  for (const radiosity::InputSurface& input : radiosity::surfaces(scene)) {
    if (!radiosity::is_black(scene.materials[input.material].emission)) { lamps.insert(input.name); }
  }
  std::vector<Reflected> reflected;
  double all = 0.0;
  for (const radiosity::SurfaceMean& mean : means) {
    if (lamps.contains(mean.name)) { continue; }
    const double level = radiosity::brightest(mean.radiosity);
    reflected.push_back({level, level * mean.area});
    all += level * mean.area;
  }
  std::ranges::sort(reflected, [](const Reflected& a, const Reflected& b) { return a.level > b.level; });
  double brighter = 0.0;
  for (const Reflected& one : reflected) {
    brighter += one.power;
    if (brighter >= 0.9 * all) { return one.level; }
  }
  return 0.0;
}

// Says how much of the picture shows backs of surfaces, dark surfaces or nothing.
std::string of_no_light(const Coarse& coarse) {
  std::string text = "the picture is black: no pixel of it sees any light. Of its area " + percent_of(coarse.backs, Coarse::rays) +
                     " first meets the backs of surfaces, " + percent_of(coarse.fronts, Coarse::rays) + " the fronts of dark ones, " +
                     percent_of(Coarse::rays - coarse.fronts - coarse.backs, Coarse::rays) + " nothing; try another place (--camera)";
  if (coarse.backs > 0) { text += ", or give the surfaces two sides (--two-sided, or two-sided after a mesh of a scene)"; }
  return text;
}

}  // namespace

std::string warning_of_picture(const radiosity::Picture& picture, const SceneFile& file, const radiosity::View& view,
                               const radiosity::Tone* automatic, const std::vector<radiosity::SurfaceMean>& surfaces) {
  double most = 0.0;
  for (const radiosity::Material& material : file.scene.materials) { most = std::max(most, radiosity::brightest(material.emission)); }
  const auto lit = [&](const glm::dvec3& radiosity) { return radiosity::brightest(radiosity) > 1e-9 * most; };
  if (std::none_of(picture.radiosity.begin(), picture.radiosity.end(), lit)) { return of_no_light(Coarse(picture, file, view)); }
  // If clearly more than a tenth of all pixels is not black, the warning cannot apply, so no rays are cast.
  const auto shown = static_cast<double>(std::count_if(picture.shown.begin(), picture.shown.end(), is_shown));
  if (shown <= 2.0 * (1.0 - most_black) * static_cast<double>(picture.shown.size())) {
    const Coarse coarse(picture, file, view);
    if (coarse.seen > 0 && coarse.black >= most_black * coarse.seen) {
      return "of what the camera sees, " + percent_of(coarse.black, coarse.seen) + " is black in the picture: the light is elsewhere; " +
             advice(file);
    }
  }
  constexpr double least_light = 1e-3;
  if (automatic != nullptr && 0.8 * std::numbers::pi / automatic->exposure < least_light * usual_light(file.scene, surfaces)) {
    return "the picture shows only what little light comes here, less than a thousandth of what is usual in the scene, so its exposure is "
           "extreme and its error may be large; " +
           advice(file);
  }
  return {};
}

}  // namespace apps
