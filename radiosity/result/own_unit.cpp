// SPDX-License-Identifier: MIT
#include <radiosity/result/own_unit.hpp>

#include <brep/finite.hpp>
#include <brep/inline.hpp>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE bool to_watts(Color& c, const LightUnit& unit) {
  c = unit.to_watts(c);
  return brep::is_finite(c);
}
HALFLIGHT_INLINE bool to_watts(Mesh& mesh, const LightUnit& unit) {
  bool finite = true;
  for (MeshCorner& corner : mesh.corners) { finite = to_watts(corner.radiosity, unit) && finite; }
  for (MeshFace& face : mesh.faces) { finite = to_watts(face.radiosity, unit) && finite; }
  return finite;
}
HALFLIGHT_INLINE bool to_watts(Solution& solution, const LightUnit& unit) {
  bool finite = to_watts(solution.mesh, unit);
  if (solution.refined) { finite = to_watts(*solution.refined, unit) && finite; }
  for (Color& c : solution.radiosity) { finite = to_watts(c, unit) && finite; }
  for (SurfaceMean& mean : solution.audit.surfaces) { finite = to_watts(mean.radiosity, unit) && finite; }
  if (solution.comparison) {
    finite = to_watts(solution.comparison->other, unit) && finite;
    for (Color& c : solution.comparison->dense) { finite = to_watts(c, unit) && finite; }
  }
  return finite;
}

}  // namespace detail

}  // namespace radiosity
