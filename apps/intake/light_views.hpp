// SPDX-License-Identifier: MIT
#pragma once

// Determines how much of a model's light cameras see, and finds a camera inside if the automatic one sees almost none of it, as for
// a house with lamps in its rooms.
//
// A camera can be judged by what lamps shine on directly, or by what its picture will show as more than black, in light reflected by
// other surfaces, too: a room whose lamp shines at the ceiling is bright all over. The exposure is chosen by what is brightest in the
// picture, so a surface five hundred times darker is black. And a surface must reflect at least a hundredth of what is usual in the scene:
// of a house whose light leaks out through a slit, the automatic exposure would show the leak.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/seen_light.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"

namespace apps {

class LightViews {
 public:
  // If less than this share of what a camera sees is lit, that is almost nothing.
  static constexpr double tol_dark = 0.02;
  // A room into whose window the sun shines may show the camera nothing but reflected light. If less than this share of what its surfaces
  // see in it is lit by a lamp, as through a crack, the room counts as dark. A window of a square metre makes some .002 of it.
  static constexpr double tol_dark_reflected = 0.0005;
  // Seen from outside, a house shows its light only through some windows. If less than `little_light` of what the automatic view sees is
  // shown, a view from inside replaces it, if that shows at least `much_more` times as large a part of what it sees as any from outside;
  // else a view from another side, if it shows `much_light`. A corridor with an open end shows much light there, but in a small part of the
  // picture: a view from inside replaces that, too, if `nearly_all` of its pixels show light, and `many_times` more than from outside, and
  // it sees as far as `of_rooms` of the size of what is lit: not the spot before a lamp in a model that fills little of its picture.
  static constexpr double little_light = 0.4, much_light = 0.5, much_more = 1.5, nearly_all = 0.8, many_times = 6.0, of_rooms = 0.1;
  // A view from inside that shows more lamp than this stands in a lantern, not in a room.
  static constexpr double in_lantern = 0.5;
  // If less than this is shown from outside, and from within, too, its lamps are no light to see a model by; nor if from within hardly
  // anything is seen of it: less than `nook` of its size away, and from outside `many_more` times as many surfaces, such as a house with a
  // lantern beside its door. By measurement on models of others: in rooms one sees a tenth of their size and half as many surfaces, at
  // least; in nooks around lamps a twenty-fifth, and a quarter.
  static constexpr double hardly_any = 0.2, nook = 0.06;
  static constexpr std::size_t many_more = 3;

  explicit LightViews(const radiosity::Scene& scene);

  // Of the rays of a coarse picture that meet a surface, the share that meet a lamp or a surface directly lit by one. As in pictures,
  // rays pass through the backs of surfaces.
  [[nodiscard]] double lit_share(const radiosity::Camera& camera) const;

  // Of what is seen from the surfaces that a camera sees, the share that lies in one of these rooms and is directly lit by a lamp.
  [[nodiscard]] double reflected_share(const radiosity::Camera& camera, std::span<const raycast::Box> rooms) const;

  // Of what a camera sees the share that the picture will show as more than black; `usual`: the light of the scene, as usual_light() tells
  // it.
  [[nodiscard]] double shown_share(const radiosity::Camera& camera, double usual) const;
  // The share of the pixels that show it.
  [[nodiscard]] double bright_share(const radiosity::Camera& camera, double usual) const;
  // Of what a camera sees the share that are lamps.
  [[nodiscard]] double lamp_share(const radiosity::Camera& camera) const;

  // The number of surfaces that a camera sees.
  [[nodiscard]] std::size_t surfaces(const radiosity::Camera& camera) const;

  struct Chosen {
    radiosity::Camera camera;
    double lit = 0.0;    // share of its picture that is not black
    double reach = 0.0;  // median of the distances of what it sees, relative to the size of what is lit
  };
  // A view across the room of one of the brightest lamps, from its far end: a view that shows much light. Where the room is open, it looks
  // away from the opening. Nothing if there is no lamp or no suitable place. Does not depend on the order of the polygons of a lamp.
  [[nodiscard]] std::optional<Chosen> inside() const;

  // The light of what is seen around lamps: the median of the view from inside, or by which most light is reflected (SeenLight::usual),
  // whichever is less, because that view might be one into a lampshade. 0: not known.
  [[nodiscard]] double usual_light(const std::optional<Chosen>& inside) const;

 private:
  // What the rays of a picture meet: the shares of them that meet a front first, and a front after any number of backs, and these points.
  struct Seen {
    double fronts = 0.0, met = 0.0;
    std::vector<raycast::ScenePoint> points;
  };
  static constexpr std::uint32_t finest = 48, fine = 24, coarse = 12;  // rays across

  [[nodiscard]] Seen seen(const radiosity::Camera& camera, std::uint32_t across) const;
  // Of these points the number on lamps, and the light that each of the others reflects, without what was reflected more than `most` times.
  struct Light {
    std::size_t lamps = 0;
    std::vector<double> reflected;
  };
  [[nodiscard]] Light light(const std::vector<raycast::ScenePoint>& points, std::uint32_t most) const;
  // The share of these points that a picture shows as more than black.
  [[nodiscard]] double shown(const Seen& of, double usual) const;
  // The distance to the first surface; 0 if its back is seen or there is none, because the point is then not in the air of a room.
  [[nodiscard]] double free_way(const glm::dvec3& from, const glm::dvec3& direction) const;
  // The same, horizontally; in a direction in which the room is open, the distance to the opening.
  [[nodiscard]] double way_in_room(const glm::dvec3& from, const glm::dvec3& direction) const;
  [[nodiscard]] std::optional<radiosity::Camera> across_room(glm::dvec3 middle) const;

  raycast::Scene objects_;
  double size_ = 0.0;                                        // of what is lit
  std::optional<radiosity::SeenLight> light_;                // nothing if nothing emits
  std::set<std::pair<std::uint32_t, std::uint32_t>> shine_;  // object and sheet of all lamps
  std::vector<raycast::ScenePoint> points_;                  // on some of them
  std::vector<std::uint32_t> lamps_;                         // objects, by decreasing power
};

}  // namespace apps
