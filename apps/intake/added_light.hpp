// SPDX-License-Identifier: MIT
#pragma once

// Gives a model of another program light, if it has none, and a camera that sees its light, if its own do not.

#include <optional>
#include <string>
#include <vector>

#include <raycast/box.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/intake/polygons.hpp>

#include "apps/intake/light_views.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Every decision is a sentence in SceneFile::notes. The scene is in metres, z up.
class AddedLight {
 public:
  // What must not be changed.
  struct Fixed {
    bool eye = false;    // the first camera, because the user chose it
    bool light = false;  // what shines, because the user chose it, or wants no lamp, or because the file has lights besides
  };
  // `rooms`: closed shells that are seen from inside. `advice`: how to name lamps of the file's own.
  AddedLight(SceneFile& file, const std::vector<radiosity::Room>& rooms, std::string advice, Fixed fixed)
      : file_(file), rooms_(rooms), advice_(std::move(advice)), fixed_(fixed) {}

  // A model without any lamp gets lamps under the ceilings of its closed rooms, or of the rooms that its cameras stand in, or of one that
  // nobody sees from outside, because light from outside would not reach these. If it has none, it is put into a studio, so that it can be
  // seen: floor, walls, and a lamp in the ceiling. Returns false, and a fault, if no lamp fits into its closed rooms. Hollows of its parts,
  // much smaller than it, are no rooms.
  bool light_model(std::vector<std::string>& faults);

  // Such rooms get lamps, too, if a sun lights nothing that is seen.
  bool light_rooms_without_sun(std::vector<std::string>& faults);

  // If the automatic view sees little of the light, adds a camera that sees more, on another side or inside a lit room; if there is none,
  // as of a model with some shining windows, puts it into a studio, too. Of cameras of the file the first that sees a lit surface becomes
  // the first of all, which draws the picture. If all of them see almost none, adds one that sees the model in its studio, or stands
  // inside, or the automatic one: also as the first.
  void look_for_light();

 private:
  void choose_view(const LightViews& views);
  [[nodiscard]] std::vector<raycast::Box> closed_rooms() const;
  [[nodiscard]] std::vector<raycast::Box> rooms_of_cameras() const;
  bool add_room_lamps(const std::vector<raycast::Box>& rooms);  // false if no lamp fits into them
  bool refused(std::vector<std::string>& faults) const;
  void add_studio(const std::string& because);
  void note(std::string sentence) { file_.notes.push_back(std::move(sentence)); }

  SceneFile& file_;
  const std::vector<radiosity::Room>& rooms_;
  std::string advice_;
  Fixed fixed_;
  std::optional<radiosity::Camera> studio_view_;  // of the model alone
};

}  // namespace apps
