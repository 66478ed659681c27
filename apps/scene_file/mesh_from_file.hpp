// SPDX-License-Identifier: MIT
#pragma once

// A `mesh` of a scene whose polygons stand in a file of another program. What encloses a camera or a lamp of the scene is seen from inside,
// as within a file of its own: so a mesh is made anew where one of them lies within its bounds. A mesh of a group is made twice at most,
// for its uses with and without something within.

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/scene.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// The objects of the file, in its own coordinates, as to_part() has them. Nothing after an error.
[[nodiscard]] std::optional<SceneFile> mesh_from_file(const ObjectSyntax& object, const SideFile& side_file,
                                                      const std::vector<glm::dvec3>& eyes, Errors& errors);

// Around all parts of a mesh.
[[nodiscard]] raycast::Box bounds_of(const std::vector<radiosity::SceneObject>& parts);

// The point in the coordinates of what is placed; nothing when the placement has no inverse.
[[nodiscard]] std::optional<glm::dvec3> point_within(const raycast::Placement& placement, const glm::dvec3& point);

// Points of a scene that must be seen: the eyes of cameras, and places before lamps.
class Eyes {
 public:
  void add(const radiosity::Camera& camera) { points_.push_back({camera.eye, nullptr, count_++}); }
  // A point before each sheet of the object that shines. `of`: the statement that it comes from.
  void add_lamps(const radiosity::SceneObject& placed, const std::vector<radiosity::Material>& materials, const ObjectSyntax* of);

  // Those in this box of a mesh, in the coordinates of the mesh. Of its own lamps the file itself tells. A lamp counts when half of its
  // points are there: one that stands on a thing has its foot in it.
  [[nodiscard]] std::vector<glm::dvec3> within(const raycast::Box& box, const raycast::Placement& placement,
                                               const ObjectSyntax* mesh) const;

 private:
  static constexpr std::size_t most = 1000;
  struct Point {
    glm::dvec3 position{0.0};
    const ObjectSyntax* of = nullptr;
    std::size_t lamp = 0;  // number of its camera or lamp
  };
  std::vector<Point> points_;  // those of a lamp in a row
  std::size_t count_ = 0;      // of cameras and lamps
};

}  // namespace apps::scene_file
