// SPDX-License-Identifier: MIT
#include <radiosity/picture/met.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>

namespace radiosity {

HALFLIGHT_INLINE raycast::ScenePoint met(const raycast::Scene& objects, const DirectLight& direct, const raycast::Hit& hit,
                                         const raycast::Segment& ray) {
  return objects.point({hit.t, direct.whole(hit.object), direct.sheet(hit), hit.front}, ray);
}

}  // namespace radiosity
