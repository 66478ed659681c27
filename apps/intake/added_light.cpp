// SPDX-License-Identifier: MIT
#include "apps/intake/added_light.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <glm/vec3.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/open_rooms.hpp"
#include "apps/intake/room_lamp.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
namespace {

constexpr std::size_t most_lamps = 64;    // that are added
constexpr std::size_t most_cameras = 16;  // that are asked what they see
// Closed rooms that together are smaller than this share of a model are no rooms: hollows of its parts, such as the tank of a car.
constexpr double least_rooms = 0.5;

}  // namespace

void AddedLight::look_for_light() {
  const LightViews views(file_.scene);
  std::vector<radiosity::Camera>& cameras = file_.cameras;
  std::vector<std::size_t> dark;
  const std::size_t count = std::min(most_cameras, cameras.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (views.lit_share(cameras[i]) < LightViews::tol_dark) { dark.push_back(i); }
    if (cameras[i].name == "inside") { return; }
  }
  if (cameras.empty()) { return choose_view(views); }
  if (dark.empty()) { return; }
  const bool first = !fixed_.eye && dark[0] == 0, all = dark.size() == count;
  std::string sentence = dark.size() == 1 ? "camera '" + cameras[dark[0]].name + "' sees" : counted(dark.size(), "camera") + " see";
  sentence += " next to nothing that a lamp shines on";
  const auto taken_by = [&](const radiosity::Camera& other) {
    return "; the picture is taken by another, '" + other.name + "' (the file's first: --camera '" + cameras[0].name + "')";
  };
  if (first && !all) {
    std::size_t lit = 1;
    while (lit < dark.size() && dark[lit] == lit) { ++lit; }
    note(sentence + taken_by(cameras[lit]));
    std::rotate(cameras.begin(), cameras.begin() + static_cast<std::ptrdiff_t>(lit),
                cameras.begin() + static_cast<std::ptrdiff_t>(lit) + 1);
    return;
  }
  std::optional<radiosity::Camera> better;
  if (first && studio_view_ && views.lit_share(*studio_view_) >= LightViews::tol_dark) { better = studio_view_; }
  if (!better) {
    auto inside = views.inside();
    if (inside && inside->lit >= LightViews::tol_dark) { better = std::move(inside->camera); }
  }
  if (first && !better) {
    radiosity::Camera outside = radiosity::automatic_camera(file_.scene);
    if (views.lit_share(outside) >= LightViews::tol_dark) { better = std::move(outside); }
  }
  if (better && !fixed_.eye) { sentence += first ? taken_by(*better) : "; --camera inside stands in the room of a lamp"; }
  note(std::move(sentence));
  if (better) { cameras.insert(first ? cameras.begin() : cameras.end(), *std::move(better)); }
}

void AddedLight::choose_view(const LightViews& views) {
  auto inside = views.inside();
  const radiosity::Camera automatic = radiosity::automatic_camera(file_.scene);
  const double light = views.usual_light(inside), usual = views.shown_share(automatic, light);
  const auto stand_inside = [&] {
    note("from outside little is seen of its light: the camera stands in the room of a lamp");
    file_.cameras.push_back(std::move(inside->camera));
  };
  if (usual >= LightViews::little_light) {
    const bool lit = inside && inside->reach >= LightViews::of_rooms && views.lamp_share(inside->camera) <= LightViews::in_lantern &&
                     views.lit_share(inside->camera) >= LightViews::much_light;
    const double bright = lit ? views.bright_share(inside->camera, light) : 0.0;
    if (bright >= std::max(LightViews::nearly_all, LightViews::many_times * views.bright_share(automatic, light))) { stand_inside(); }
    return;
  }
  double most = usual;
  radiosity::Camera best = automatic;
  for (const radiosity::Camera& camera : radiosity::outside_cameras(file_.scene)) {
    const double share = views.shown_share(camera, light);
    if (share > most) {
      most = share;
      best = camera;
    }
  }
  const double within = inside ? views.shown_share(inside->camera, light) : 0.0;
  const auto in_nook = [&] {
    const std::size_t seen = LightViews::many_more * views.surfaces(inside->camera);
    return inside->reach < LightViews::nook && (views.surfaces(automatic) >= seen || views.surfaces(best) >= seen);
  };
  if (most < LightViews::hardly_any && !fixed_.light && (within < LightViews::hardly_any || in_nook())) {
    return add_studio("its own lamps light hardly anything of what is seen of it");
  }
  const bool lantern = inside && most >= LightViews::tol_dark && views.lamp_share(inside->camera) > LightViews::in_lantern;
  if (inside && !lantern && within >= std::max(LightViews::tol_dark, LightViews::much_more * most)) {
    stand_inside();
  } else if (most >= LightViews::much_light) {
    note("the camera stands outside, on the side from which most of its light is seen");
    file_.cameras.push_back(std::move(best));
  }
}

// The bounds of the closed rooms that can be seen: from outside, like a doll's house, unless they are within walls with a thickness;
// else from inside, by a camera of the file, or by an added one if there is none.
std::vector<raycast::Box> AddedLight::closed_rooms() const {
  std::vector<raycast::Box> rooms;
  const auto seen = [&](const radiosity::Room& room) {
    return !room.within_walls || file_.cameras.empty() ||
           std::any_of(file_.cameras.begin(), file_.cameras.end(), [&](const radiosity::Camera& c) { return room.bounds.contains(c.eye); });
  };
  if (std::none_of(rooms_.begin(), rooms_.end(), seen)) { return rooms; }
  raycast::Box all;
  for (const radiosity::Room& room : rooms_) { all.extend(room.bounds); }
  if (all.diameter() < least_rooms * radiosity::bounds_without_strays(file_.scene).diameter()) { return rooms; }
  for (const radiosity::Room& room : rooms_) { rooms.push_back(room.bounds); }
  return rooms;
}

// Nothing if the first camera, which draws the picture, stands in none.
std::vector<raycast::Box> AddedLight::rooms_of_cameras() const {
  std::vector<raycast::Box> rooms;
  const OpenRooms open(file_.scene);
  for (const radiosity::Camera& camera : std::span(file_.cameras).first(std::min(most_lamps, file_.cameras.size()))) {
    const auto around = [&](const raycast::Box& room) { return room.contains(camera.eye); };
    if (std::any_of(rooms.begin(), rooms.end(), around)) { continue; }
    const std::optional<raycast::Box> room = open.around(camera.eye);
    if (room) { rooms.push_back(*room); }
    if (rooms.empty()) { break; }
  }
  return rooms;
}

bool AddedLight::add_room_lamps(const std::vector<raycast::Box>& rooms) {
  const raycast::Scene objects(radiosity::placed_objects(file_.scene));
  std::vector<std::shared_ptr<const raycast::Object>> lamps;
  for (std::size_t i = 0; i < std::min(most_lamps, rooms.size()); ++i) {
    if (auto lamp = room_lamp(objects, rooms[i])) { lamps.push_back(std::move(lamp)); }
  }
  if (lamps.empty()) { return false; }
  const auto material = static_cast<std::uint32_t>(file_.scene.materials.size());
  file_.scene.materials.push_back({"room lamp", radiosity::Color(0.0), radiosity::Color(100.0)});
  for (auto& lamp : lamps) {
    file_.scene.objects.push_back({"room lamp", std::move(lamp), {}, {material}});
    file_.origins.push_back({"polygon", {}});
  }
  note((rooms.size() == 1 ? std::string("nothing shines in this closed room: a lamp of 100 W/m2 hangs under its ceiling")
                          : "nothing shines in these " + std::to_string(rooms.size()) +
                                " closed rooms: lamps of 100 W/m2 hang under the ceilings of " + std::to_string(lamps.size())) +
       "; to have lamps of its own: " + advice_);
  return true;
}

bool AddedLight::light_rooms_without_sun(std::vector<std::string>& faults) {
  const std::vector<raycast::Box> closed = closed_rooms(), rooms = closed.empty() ? rooms_of_cameras() : closed;
  if (rooms.empty()) { return true; }
  const LightViews views(file_.scene);
  const auto lit = [&](const radiosity::Camera& camera) {
    return views.lit_share(camera) >= LightViews::tol_dark || views.reflected_share(camera, rooms) >= LightViews::tol_dark_reflected;
  };
  const std::span<const radiosity::Camera> cameras = std::span(file_.cameras).first(std::min(most_cameras, file_.cameras.size()));
  const bool seen = cameras.empty() ? lit(radiosity::automatic_camera(file_.scene)) : std::any_of(cameras.begin(), cameras.end(), lit);
  return seen || add_room_lamps(rooms) || closed.empty() || refused(faults);
}

bool AddedLight::light_model(std::vector<std::string>& faults) {
  const std::vector<raycast::Box> closed = closed_rooms();
  if (!closed.empty()) { return add_room_lamps(closed) || refused(faults); }
  std::vector<raycast::Box> rooms = rooms_of_cameras();
  bool hidden = false;
  if (file_.cameras.empty()) {
    const OpenRooms open(file_.scene);
    const auto room = open.hidden();
    hidden = room.has_value();
    rooms = hidden ? std::vector{room->bounds} : open.seen_through();
  }
  if (!add_room_lamps(rooms)) {
    add_studio("nothing shines in this file");
  } else if (hidden) {
    if (auto inside = LightViews(file_.scene).inside()) {
      note("from outside little is seen of what is in this room: the camera stands in it");
      file_.cameras.push_back(std::move(inside->camera));
    }
  }
  return true;
}

bool AddedLight::refused(std::vector<std::string>& faults) const {
  faults.push_back("nothing shines in this closed room; say which material does: " + advice_);
  return false;
}

void AddedLight::add_studio(const std::string& because) {
  studio_view_ = radiosity::automatic_camera(file_.scene);
  if (file_.cameras.empty()) { file_.cameras.push_back(*studio_view_); }
  const raycast::Box bounds = radiosity::bounds_without_strays(file_.scene);
  const double size = bounds.diameter();
  const auto strays = std::count_if(file_.scene.objects.begin(), file_.scene.objects.end(), [&](const radiosity::SceneObject& object) {
    return !bounds.contains(radiosity::placed_bounds(*object.shape, object.placement).centre());
  });
  if (strays > 0) {
    note(counted(static_cast<std::size_t>(strays), "object") + (strays == 1 ? " lies" : " lie") +
         " ten times as far away as all others reach: outside of the studio, in the dark");
  }
  constexpr double flat = 0.01;  // a model flatter than this fraction of its size is put above the floor, to be distinguished from it
  const double gap = bounds.hi.z - bounds.lo.z < flat * size ? 0.1 * size : 0.0;
  const glm::dvec3 middle{bounds.centre().x, bounds.centre().y, bounds.lo.z - gap};
  const glm::dvec3 reach{1.5 * size, 1.5 * size, 0.0}, top{0.0, 0.0, 2.0 * size};
  std::vector<glm::dvec3> lamp;  // faces down
  for (const glm::dvec3 corner : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0)}) {
    lamp.push_back(middle + top + 0.4 * size * corner);
  }
  const auto material = static_cast<std::uint32_t>(file_.scene.materials.size());
  file_.scene.materials.push_back({"studio", radiosity::Color(0.5), radiosity::Color(0.0)});
  file_.scene.materials.push_back({"studio lamp", radiosity::Color(0.0), radiosity::Color(100.0)});
  raycast::Placement inside;
  inside.inside = true;
  // The studio comes before the model, so that objects on the floor cover it.
  auto& objects = file_.scene.objects;
  objects.insert(objects.begin(), {"studio", raycast::BoxObject::make(middle - reach, middle + reach + top).object, inside, {material}});
  if (file_.given) { file_.given->first_object = 1; }
  objects.push_back({"studio lamp", raycast::Polygon::make(std::move(lamp)).object, {}, {material + 1}});
  file_.origins.insert(file_.origins.begin(), {"box", {}});
  file_.origins.push_back({"polygon", {}});
  note(because + ": put into a studio with a lamp of 100 W/m2 above it; to have lamps of its own: " + advice_);
}

}  // namespace apps
