// SPDX-License-Identifier: MIT
#include <radiosity/audit/shown_picture.hpp>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/frame.hpp>
#include <radiosity/visibility/off_surfaces.hpp>

namespace radiosity {

HALFLIGHT_INLINE ShownPicture from_off_surfaces(const ShownPicture& picture, const raycast::Scene& objects, const Frame& frame) {
  const glm::dvec3 eye = (picture.ray(0.0, 0.0).origin - frame.centre) * frame.scale;
  const glm::dvec3 off = off_surfaces(objects, eye);
  if (off == eye) { return picture; }
  ShownPicture result = picture;
  result.ray = [ray = picture.ray, from = off / frame.scale + frame.centre](double x, double y) {
    return raycast::Segment{from, ray(x, y).direction};
  };
  return result;
}

}  // namespace radiosity
