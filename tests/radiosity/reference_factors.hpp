// SPDX-License-Identifier: MIT
#pragma once

// The scenes of the reference form factors of curved surfaces, made from their description in the file.

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/objects/cone.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/disk.hpp>

#include "json.hpp"
#include "scenes.hpp"

namespace reference {

inline glm::dvec3 position(const json::Value& v) { return {v[0].number(), v[1].number(), v[2].number()}; }
inline std::vector<glm::dvec3> positions(const json::Value& v) {
  std::vector<glm::dvec3> result;
  for (const json::Value& p : v.array()) { result.push_back(position(p)); }
  return result;
}

struct WantedFactor {
  std::size_t from, to;
  const char* key;
};
struct CurvedCase {
  radiosity::Scene scene;
  std::vector<WantedFactor> wanted;  // empty: the family is not known
};

inline CurvedCase curved_case(const json::Value& c) {
  CurvedCase result;
  radiosity::Scene& scene = result.scene;
  std::vector<WantedFactor>& wanted = result.wanted;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}};
  const std::string family = c["family"].string();
  const json::Value& shape = c["shape"];
  const auto add = [&](const char* name, std::shared_ptr<const raycast::Object> object, bool inside) {
    scene.objects.push_back(scenes::object(name, std::move(object), 0, inside));
  };
  if (family == "coaxial_disks") {
    for (const char* k : {"disk1", "disk2"}) {
      add(k, raycast::Disk::make(position(shape[k]["center"]), position(shape[k]["normal"]), shape[k]["radius"].number()).object, false);
    }
    wanted = {{0, 1, "F12"}, {1, 0, "F21"}};
  } else if (family == "sphere_to_disk") {
    const json::Value& disk = shape["disk"];
    add("ball", raycast::Sphere::make(position(shape["sphere"]["center"]), shape["sphere"]["radius"].number()).object, false);
    add("disk", raycast::Disk::make(position(disk["center"]), position(disk["normal"]), disk["radius"].number()).object, false);
    wanted = {{0, 1, "F_sphere_disk"}, {1, 0, "F_disk_sphere"}};
  } else if (family == "sphere_interior") {
    add("hollow", raycast::Sphere::make({0, 0, 0}, 1.0).object, true);
    wanted = {{0, 0, "F_whole"}};
  } else if (family == "cylinder_interior") {
    add("can", raycast::Cylinder::make({0, 0, 0}, {0, 0, shape["cylinder"]["height"].number()}, 1.0).object, true);
    wanted = {{1, 2, "F_end_end"}, {1, 0, "F_end_side"}, {0, 1, "F_side_end"}, {0, 0, "F_side_side"}};
  } else if (family == "cone_interior") {
    add("cone", raycast::Cone::make({0, 0, 0}, {0, 0, 1}, 1.0, 0.0).object, true);
    wanted = {{1, 0, "F_base_cone"}, {0, 1, "F_cone_base"}, {0, 0, "F_cone_cone"}};
  } else if (family == "hemisphere_interior") {
    const raycast::CsgNode ball{raycast::Sphere::make({0, 0, 0}, 1.0).object, "ball", {}, {}, {}};
    const raycast::CsgNode above{scenes::box({-2, -2, 0}, {2, 2, 2}), "above", {}, {}, {}};
    add("half", raycast::Csg::make({{}, {}, raycast::CsgOperation::intersect, {ball, above}, {}}).object, true);
    wanted = {{0, 0, "F_hemi_hemi"}, {0, 1, "F_hemi_disk"}, {1, 0, "F_disk_hemi"}};  // the other sides of the box are cut away
  } else if (family == "concentric_spheres") {
    add("inner", raycast::Sphere::make({0, 0, 0}, 1.0).object, false);
    add("outer", raycast::Sphere::make({0, 0, 0}, 2.0).object, true);
    wanted = {{0, 1, "F12"}, {1, 0, "F21"}, {1, 1, "F22"}, {0, 0, "F11"}};
  } else if (family == "cube_interior") {
    add("box", scenes::box({0, 0, 0}, {1, 1, 1}), true);
    wanted = {{0, 1, "F_opposite"}, {0, 2, "F_adjacent"}};
  } else if (family == "cuboid_interior") {
    add("box", scenes::box({0, 0, 0}, {1, 2, 3}), true);
    wanted = {{0, 1, "x0_x1"}, {0, 2, "x0_y"},  {0, 4, "x0_z"}, {2, 3, "y0_y1"}, {2, 0, "y0_x"},
              {2, 4, "y0_z"},  {4, 5, "z0_z1"}, {4, 0, "z0_x"}, {4, 2, "z0_y"}};
  } else if (family == "tetrahedron_interior") {
    std::vector<glm::dvec3> v = positions(shape["vertices"]);
    for (const auto& [a, b, d] : {std::tuple{0, 1, 2}, std::tuple{0, 2, 3}, std::tuple{0, 3, 1}, std::tuple{1, 3, 2}}) {
      std::vector<glm::dvec3> face{v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)], v[static_cast<std::size_t>(d)]};
      if (glm::dot(glm::cross(face[1] - face[0], face[2] - face[0]), face[0]) > 0.0) { std::swap(face[1], face[2]); }  // to the middle
      add(("f" + std::to_string(a) + std::to_string(b)).c_str(), scenes::polygon(face), false);
    }
    wanted = {{0, 1, "F_ij"}, {2, 3, "F_ij"}};
  }
  return result;
}

}  // namespace reference
