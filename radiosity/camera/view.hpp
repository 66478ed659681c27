// SPDX-License-Identifier: MIT
#pragma once

// The view of a picture: a pinhole camera whose field of view is given horizontally; pixels are square.
//
// View space: x to the right, y down, z forward; a point (x, y, z) falls on the image at (x/z, y/z), and the image
// spans -half_width..half_width and -half_height..half_height.

#include <cstdint>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include <radiosity/scene/scene.hpp>

namespace radiosity {

struct PictureSize {
  std::uint32_t width = 800;
  std::uint32_t height = 600;
};

struct Camera {
  std::string name;
  glm::dvec3 eye{0.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};  // not normalised, not zero
  glm::dvec3 up{0.0, 0.0, 1.0};       // not normalised, not parallel to forward
  double field_of_view = 50.0;        // horizontal, in degrees
  std::optional<PictureSize> size;    // of the picture, unless the caller says otherwise
};

struct View {
  glm::dvec3 eye{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 down{0.0, 0.0, -1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};  // the three are orthonormal
  double half_width = 1.0;
  PictureSize size;

  [[nodiscard]] double pixel_area() const { return 4.0 * half_width * half_width / size.width / size.width; }  // of the image
  [[nodiscard]] double half_height() const { return half_width * size.height / size.width; }
  [[nodiscard]] glm::dvec3 to_view(const glm::dvec3& world) const;
  // What falls on the point (x, y) of the picture, in pixels from its top left corner, lies along this ray of view space, whose z is 1.
  [[nodiscard]] glm::dvec3 ray(double x, double y) const;
  // The same direction in the world; it goes 1 forward.
  [[nodiscard]] glm::dvec3 direction(double x, double y) const;
  // The area of the image, in view space, that a unit of area takes at a place with this unit normal; 0 outside the picture or seen from
  // behind.
  [[nodiscard]] double share(const glm::dvec3& world, const glm::dvec3& normal) const;
};

// `camera` is sound: forward is not zero and up not parallel to it.
[[nodiscard]] View make_view(const Camera& camera, const PictureSize& size);

// Looks at the whole scene from outside, slightly from above (z is up). Back faces are not drawn, so this looks into a
// room as into a doll's house; from the one of four sides from which clearly more fronts are seen first, if there is one. A lamp far
// outside, beside which all else would look less than half as large, is left out of the view.
[[nodiscard]] Camera automatic_camera(const Scene& scene);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/view.cpp>
#endif
