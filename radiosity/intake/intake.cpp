// SPDX-License-Identifier: MIT
#include <radiosity/intake/intake.hpp>

#include <cstdint>
#include <span>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/intake/backs.hpp>
#include <radiosity/intake/clean.hpp>
#include <radiosity/intake/facing.hpp>
#include <radiosity/intake/join.hpp>
#include <radiosity/intake/merge.hpp>
#include <radiosity/intake/objects.hpp>
#include <radiosity/intake/t_joints.hpp>
#include <radiosity/intake/tilings.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/unfold.hpp>
#include <radiosity/intake/weld.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity {

HALFLIGHT_INLINE Intake take_in(const PolygonView& input, std::span<const Material> materials, const IntakeOptions& options) {
  intake::Working mesh;
  intake::weld(input, materials, options.weld, mesh);
  intake::unfold_fans(mesh);
  intake::drop_degenerate(mesh);
  intake::drop_duplicates(mesh);
  intake::match_tilings(mesh);
  intake::drop_duplicates(mesh);  // including parts
  intake::match_diagonals(mesh);
  intake::join_backs(mesh);
  intake::close_t_joints(mesh);
  intake::drop_duplicates(mesh);  // including those that had no T-joint
  intake::join_backs(mesh);
  intake::join_groups(mesh);
  intake::join_backs(mesh);  // including those of two groups
  intake::split_faulty(mesh, false);
  intake::orient(mesh);
  intake::turn_to_light(mesh, materials, options);
  const intake::Topology before = intake::topology_of(mesh, true);
  intake::settle_backs(mesh, before);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) { mesh.faces[f].shell = before.component[f]; }
  if (options.merge) { intake::merge_coplanar(mesh, before); }
  intake::flatten(mesh);
  intake::split_faulty(mesh, true);
  const intake::Topology topology = intake::topology_of(mesh, true);
  Intake result;
  intake::MadeObjects made = intake::make_objects(mesh, topology, input, materials, options);
  result.objects = std::move(made.objects);
  result.rooms = std::move(made.rooms);
  result.parts = intake::parts_of(mesh, made.sheets, input.count());
  result.polygons = input.count();
  for (const SceneObject& object : result.objects) { result.faces += object.shape->sheet_count(); }
  for (const Change& change : mesh.changes) {
    if (change.count > 0) { result.changes.push_back(change); }
  }
  return result;
}

}  // namespace radiosity
