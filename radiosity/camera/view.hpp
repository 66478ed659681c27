// SPDX-License-Identifier: MIT
#pragma once

// A pinhole camera with square pixels; the field of view is given horizontally.
//
// View space: x to the right, y down, z forward; a point (x, y, z) falls on the image at (x/z, y/z), and the image
// spans -half_width..half_width and -half_height..half_height.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/scene/scene.hpp>

namespace radiosity {

struct PictureSize {
  std::uint32_t width = 800;
  std::uint32_t height = 600;
};

struct Camera {
  std::string name = {};
  glm::dvec3 eye{0.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};     // not normalised, not zero
  glm::dvec3 up{0.0, 0.0, 1.0};          // not normalised, not parallel to forward
  double field_of_view = 50.0;           // horizontal, in degrees
  std::optional<PictureSize> size = {};  // size of the picture, unless the caller overrides it
};

struct View {
  glm::dvec3 eye{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 down{0.0, 0.0, -1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};  // right, down and forward are orthonormal
  double half_width = 1.0;
  PictureSize size;

  // Area of a pixel on the plane z = 1 of view space.
  [[nodiscard]] double pixel_area() const { return 4.0 * half_width * half_width / size.width / size.width; }
  [[nodiscard]] double half_height() const { return half_width * size.height / size.width; }
  [[nodiscard]] glm::dvec3 to_view(const glm::dvec3& world) const;
  // The ray through the point (x, y) of the picture, in pixels from its top left corner, as a direction of view space with z = 1.
  [[nodiscard]] glm::dvec3 ray(double x, double y) const;
  // The same direction in world coordinates; its component along `forward` is 1.
  [[nodiscard]] glm::dvec3 direction(double x, double y) const;
  // Projected area, on the plane z = 1 of view space, of a unit of area at a place with this unit normal; 0 outside the picture or if
  // seen from behind.
  [[nodiscard]] double share(const glm::dvec3& world, const glm::dvec3& normal) const;
};

// Requires that camera.forward is not zero and camera.up not parallel to it.
[[nodiscard]] View make_view(const Camera& camera, const PictureSize& size);

// What a picture shows along a ray: the first front, for rays pass through backs. The ray then begins at the last of these.
// `owner`, `sheet`: of the surface on which it begins, as in raycast::Scene::closest.
[[nodiscard]] std::optional<raycast::Hit> seen_front(const raycast::Scene& objects, raycast::Segment& ray,
                                                     std::uint32_t owner = raycast::no_object,
                                                     std::uint32_t sheet = raycast::unknown_sheet);

// Views of the whole scene from outside, from four sides, slightly from above (z is up). `forward` reaches to the middle of the scene. Back
// faces are not drawn, so that one looks into a room as into a doll's house. Lamps far outside, which would make all else appear less than
// half as large, are left out of the views.
[[nodiscard]] std::array<Camera, 4> outside_cameras(const Scene& scene);

// The one from which clearly more is seen of the fronts and of the inside of things, if there is one, else the first: a room that is open
// on one side is seen through that side.
[[nodiscard]] Camera automatic_camera(const Scene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/view.cpp>
#endif
