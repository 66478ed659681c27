// SPDX-License-Identifier: MIT
#include <radiosity/picture/met.hpp>

#include <cstdint>

#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>

namespace radiosity {

HALFLIGHT_INLINE Met met(const raycast::Scene& objects, const DirectLight& direct, const raycast::Hit& hit, const raycast::Segment& ray) {
  const std::uint32_t object = direct.whole(hit.object), sheet = direct.sheet(hit);
  return {objects.object(object).project(sheet, ray.at(hit.t)), object, sheet};
}

}  // namespace radiosity
