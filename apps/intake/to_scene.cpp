// SPDX-License-Identifier: MIT
#include "apps/intake/to_scene.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <span>

#include <glm/mat3x3.hpp>

#include <brep/finite.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/bounds.hpp>

#include "apps/intake/added_light.hpp"
#include "apps/intake/camera_up.hpp"
#include "apps/intake/enclosure.hpp"
#include "apps/intake/light_lamps.hpp"
#include "apps/intake/materials.hpp"
#include "apps/intake/open_rooms.hpp"
#include "apps/intake/panes.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
namespace {

// From the file's coordinates to metres with z up.
glm::dmat3 to_metres(UpAxis up, double metres) {
  glm::dmat3 turn(1.0);
  if (up == UpAxis::y) { turn = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}; }  // columns: the images of x, y, z
  if (up == UpAxis::x) { turn = {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}; }
  return metres * turn;
}

// A solid that is smaller than this, relative to the model, is lost in rounding beside it.
constexpr double least_size = 1e-11;

bool has_lamp(const radiosity::Scene& scene) {
  return std::ranges::any_of(scene.objects, [&](const auto& object) { return radiosity::shines(scene, object); });
}

class SceneMaker {
 public:
  SceneMaker(Model model, const ModelOptions& options) : model_(std::move(model)), options_(options) {}

  std::optional<SceneFile> scene(UpAxis up_of_format, std::vector<std::string>& faults) {
    const std::optional<UpAxis> of_cameras = options_.up ? std::nullopt : up_of_cameras(model_.cameras, up_of_format);
    const UpAxis up = options_.up.value_or(of_cameras.value_or(up_of_format));
    given_positions_ = model_.positions;
    given_z_up_ = up == UpAxis::z;
    place(to_metres(up, options_.metres));
    sides_unknown_ = !model_.tells_sides;
    if (!part(faults)) { return std::nullopt; }
    AddedLight added(file_, rooms_, "--lamp MATERIAL, one of " + list_of(names_of(file_.scene.materials)),
                     {options_.camera.has_value(), !options_.lamps.empty() || !options_.lamps_wanted || !model_.lights.empty()});
    if (options_.lamps_wanted && !shines() && !added.light_model(faults)) { return std::nullopt; }
    if (options_.lamps_wanted && only_suns_ && !added.light_rooms_without_sun(faults)) { return std::nullopt; }
    added.look_for_light();
    const auto letter = [](UpAxis axis) { return std::string(1, "xyz"[static_cast<std::size_t>(axis)]); };
    if (of_cameras) {
      note("its cameras stand upright about " + letter(up) + ", not about " + letter(up_of_format) + " as this format wants it; --up " +
           letter(up_of_format) + " takes the file at its word");
    }
    note(letter(up) + " is taken as up (--up), one unit as " + radiosity::length_text(options_.metres) + " (--units)");
    return std::move(file_);
  }
  std::optional<SceneFile> part_alone(const std::vector<glm::dvec3>& eyes, std::vector<std::string>& faults) {
    model_.cameras.clear();
    eyes_ = eyes;
    whole_ = false;
    return part(faults) ? std::optional(std::move(file_)) : std::nullopt;
  }

 private:
  bool part(std::vector<std::string>& faults) {
    file_.notes = std::move(model_.notes);
    file_.scene.materials = scene_materials(model_, options_, whole_ && options_.lamps_wanted, file_.notes, faults);
    if (!faults.empty()) { return false; }
    for (const ModelMaterial& given : model_.materials) { two_sided_.push_back(given.two_sided ? 1 : 0); }
    if (!options_.opaque) { panes_ = Panes(model_, file_.scene.materials); }
    if (auto sentence = panes_.sentence(model_); !sentence.empty()) { note(std::move(sentence)); }
    if (whole_) {
      if (auto sentence = take_enclosure(model_, panes_, file_); !sentence.empty()) { note(std::move(sentence)); }
    }
    const double vanishing = model_.objects.empty() ? 0.0 : least_size * model_size();  // before the polygons are taken out of the model
    take_polygons();
    std::size_t vanished = 0;
    for (std::size_t i = 0; i < model_.objects.size(); ++i) {
      const radiosity::SceneObject& object = model_.objects[i];
      if (panes_.has(object)) { continue; }
      if (!(radiosity::placed_bounds(*object.shape, object.placement).diameter() > vanishing)) {
        ++vanished;
        continue;
      }
      if (object.placement.inside) { rooms_.push_back({radiosity::placed_bounds(*object.shape, object.placement), false}); }
      file_.scene.objects.push_back(std::move(model_.objects[i]));
      file_.origins.push_back(model_.origins[i]);
    }
    if (vanished > 0) {
      note(counted(vanished, "solid is", "solids are") + " smaller than " + formatted("%g", least_size) + " of the model: left out");
    }
    if (file_.scene.objects.empty()) {
      std::string sentence = "nothing in this file has a surface";
      for (const std::string& told : file_.notes) { sentence += "; " + told; }
      faults.push_back(std::move(sentence));
      return false;
    }
    if (file_.scene.objects.size() > max_model_objects) {
      faults.push_back("the file has more than " + std::to_string(max_model_objects) + " objects");
      return false;
    }
    only_suns_ = !model_.lights.empty() && !shines() && std::all_of(model_.lights.begin(), model_.lights.end(), [](const auto& light) {
      return light.kind == ModelLight::Kind::sun;
    });
    add_light_lamps(file_, model_.lights);
    only_suns_ = only_suns_ && shines();
    rename();
    return true;
  }

  [[nodiscard]] double model_size() const {
    raycast::Box box;
    for (const std::uint32_t corner : model_.corners) {
      if (corner < model_.positions.size() && brep::is_finite(model_.positions[corner])) { box.extend(model_.positions[corner]); }
    }
    for (const radiosity::SceneObject& object : model_.objects) { box.extend(radiosity::placed_bounds(*object.shape, object.placement)); }
    return box.diameter();
  }

  void place(const glm::dmat3& linear) {
    for (glm::dvec3& p : model_.positions) { p = linear * p; }
    for (radiosity::SceneObject& object : model_.objects) {
      object.placement = raycast::compose({linear, glm::dvec3(0.0), false}, object.placement);
    }
    for (radiosity::Camera& camera : model_.cameras) {
      camera.eye = linear * camera.eye;
      camera.forward = linear * camera.forward;
      camera.up = linear * camera.up;
    }
    file_.cameras = std::move(model_.cameras);
    if (options_.camera) { file_.cameras.insert(file_.cameras.begin(), *options_.camera); }
    for (ModelLight& light : model_.lights) {
      light.position = linear * light.position;
      light.direction = linear * light.direction;
    }
  }

  void note(std::string sentence) { file_.notes.push_back(std::move(sentence)); }

  void take_polygons() {
    if (model_.polygons() == 0) { return; }
    radiosity::IntakeOptions options{.merge = options_.merge, .two_sided = options_.two_sided};
    const std::vector<radiosity::Material>& materials = file_.scene.materials;
    const bool any_lamp = std::any_of(materials.begin(), materials.end(), [](const auto& m) { return !radiosity::is_black(m.emission); });
    options.open_sides_unknown = sides_unknown_;
    options.sides_unknown = sides_unknown_ && !any_lamp;
    options.eyes = eyes_;
    for (const radiosity::Camera& camera : file_.cameras) { options.eyes.push_back(camera.eye); }
    for (const ModelLight& light : model_.lights) {
      if (light.kind != ModelLight::Kind::sun) { options.eyes.push_back(light.position); }
    }
    for (const radiosity::SceneObject& object : model_.objects) {
      if (radiosity::shines(file_.scene, object) && !object.placement.inside) {
        options.lamps.push_back(radiosity::placed_sides(*object.shape, object.placement));
      }
    }
    const auto take = [&] { return radiosity::take_in(panes_.others(model_, two_sided_), file_.scene.materials, options); };
    radiosity::Intake intake = take();
    options.seen_from_behind = roofs(intake);
    if (!options.seen_from_behind.empty()) { intake = take(); }
    panes_.renumber(intake);
    for (const radiosity::Change& change : intake.changes) {
      const bool worst = radiosity::tells_size(change);
      note(radiosity::sentence(change) +
           (change.count == 1 ? ", "
            : worst           ? ", worst "
                              : ", first ") +
           model_.place(worst ? change.worst : change.first));
    }
    note(counted(intake.polygons, "polygon") + " became " + counted(intake.faces, "face") + " of " +
         counted(intake.objects.size(), "object"));
    file_.scene.objects = std::move(intake.objects);
    rooms_ = std::move(intake.rooms);
    if (!given_positions_.empty()) {
      file_.given =
          std::make_shared<GivenPolygons>(GivenPolygons{std::move(given_positions_), std::move(model_.positions), std::move(model_.corners),
                                                        std::move(model_.first_corner), std::move(intake.parts), 0, given_z_up_});
    }
    file_.origins.assign(file_.scene.objects.size(), {"mesh", {}});
  }

  // The polygons, as the intake counts them, of roofs that show their backs to a room: one in which a camera stands, or will stand because
  // nobody sees it from outside.
  [[nodiscard]] std::vector<std::uint32_t> roofs(const radiosity::Intake& intake) const {
    if (std::ranges::all_of(intake.objects, [](const auto& object) { return object.shape->solid(); })) { return {}; }
    radiosity::Scene scene{.materials = file_.scene.materials, .objects = intake.objects};
    std::ranges::copy_if(model_.objects, std::back_inserter(scene.objects), [&](const auto& object) { return !panes_.has(object); });
    std::vector<glm::dvec3> eyes = eyes_;
    for (const radiosity::Camera& camera : file_.cameras) { eyes.push_back(camera.eye); }
    if (eyes.empty() && (!whole_ || !model_.lights.empty() || has_lamp(scene))) { return {}; }
    const OpenRooms rooms(scene);
    if (eyes.empty()) {
      if (const auto hidden = rooms.hidden()) { eyes.push_back(hidden->eye); }
    }
    OpenRooms::Surfaces roof;
    constexpr std::size_t most_eyes = 64;
    for (const glm::dvec3& eye : std::span(eyes).first(std::min(most_eyes, eyes.size()))) { roof.merge(rooms.roof_over(eye)); }
    std::vector<std::uint32_t> polygons;
    for (std::uint32_t p = 0; !roof.empty() && p < intake.polygons; ++p) {
      const auto of_roof = [&](const radiosity::PolygonPart& part) { return roof.contains({part.object, part.sheet}); };
      if (std::ranges::any_of(intake.parts.of(p), of_roof)) { polygons.push_back(p); }
    }
    return polygons;
  }

  // Appends numbers to names that are already used.
  void rename() {
    std::map<std::string, std::size_t> taken;
    for (radiosity::SceneObject& object : file_.scene.objects) {
      const std::string name = object.name.empty() ? "object" : object.name;
      std::size_t& times = taken[name];
      object.name = ++times == 1 ? name : name + "#" + std::to_string(times);
    }
  }

  [[nodiscard]] bool shines() const { return has_lamp(file_.scene); }

  Model model_;
  const ModelOptions& options_;
  SceneFile file_;
  std::vector<std::uint8_t> two_sided_;
  Panes panes_;
  std::vector<glm::dvec3> given_positions_;  // positions in the file
  bool given_z_up_ = false;
  bool sides_unknown_ = false;  // does the format not say which side of an open surface is seen?
  bool only_suns_ = false;      // is all light that of directional lights?
  std::vector<radiosity::Room> rooms_;
  std::vector<glm::dvec3> eyes_;  // of cameras that are not part of the model
  bool whole_ = true;             // is the model all of the scene?
};

}  // namespace

std::optional<SceneFile> to_scene(Model model, UpAxis up, const ModelOptions& options, std::vector<std::string>& faults) {
  return SceneMaker(std::move(model), options).scene(up, faults);
}

std::optional<SceneFile> to_part(Model model, bool two_sided, const std::vector<glm::dvec3>& eyes, std::vector<std::string>& faults) {
  ModelOptions options;
  options.two_sided = two_sided;
  return SceneMaker(std::move(model), options).part_alone(eyes, faults);
}

}  // namespace apps
