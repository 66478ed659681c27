// SPDX-License-Identifier: MIT
#include <radiosity/intake/objects.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/planar.hpp>

#include <radiosity/intake/backs.hpp>
#include <radiosity/intake/decals.hpp>
#include <radiosity/intake/lamps.hpp>
#include <radiosity/intake/layers.hpp>
#include <radiosity/intake/open_surfaces.hpp>
#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/subset.hpp>

namespace radiosity::intake {
namespace detail {

class ObjectMaker {
 public:
  ObjectMaker(Working& mesh, const Topology& topology, const PolygonView& input, std::span<const Material> materials,
              const IntakeOptions& options)
      : mesh_(mesh),
        topology_(topology),
        input_(input),
        options_(options),
        flush_(lay_lamps(mesh, topology, materials)),
        decals_(lay_decals(mesh, topology, materials)),
        shells_(mesh, topology, materials, options),
        subsets_(mesh, topology) {
    layer_.assign(mesh.faces.size(), 0);
    shells_.find_roles();
    if (options.sides_unknown || options.open_sides_unknown) { show_both_sides(mesh, topology, options.sides_unknown, shells_); }
    const std::vector<bool> from_behind = show_backs();
    const std::vector<bool> two_sided = faces_with_backs();
    turn_lamps(mesh, topology, materials, flush_, two_sided, options.open_sides_unknown, shells_);
    mark_decals(mesh, topology, decals_, two_sided, shells_);
    for (std::uint32_t c = 0; c < shells_.components().size(); ++c) {
      const Component& component = shells_.components()[c];
      if (component.role != Role::surface || component.one_sided) { continue; }
      const auto polygon = [&](std::uint32_t f) { return mesh.faces[f].polygon; };
      const auto first =
          std::min_element(component.faces.begin(), component.faces.end(), [&](auto a, auto b) { return polygon(a) < polygon(b); });
      const bool any_back = std::any_of(component.faces.begin(), component.faces.end(), [&](std::uint32_t f) { return two_sided[f]; });
      if (component.both_sides) {
        mesh.changed(from_behind[c] ? ChangeKind::from_behind : ChangeKind::open, polygon(*first));
      } else if (options.open_sides_unknown && !component.flush && !shells_.turned(c) && !any_back && shells_.shines(component)) {
        mesh.changed(ChangeKind::lamp_front, polygon(*first));
      }
    }
  }

  MadeObjects run() {
    std::vector<Group> groups = sort_by_group();
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
      group_ = g;
      for (const Component* const component : groups[g].closed) { add_closed(*component); }
      add_surfaces(groups[g].front, groups[g].back);
    }
    // After the surfaces on which they lie, so that they cover these; and the smaller after the larger, as paper on a rug.
    std::vector<std::uint32_t> order(groups.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return groups[a].largest_flush > groups[b].largest_flush; });
    for (const std::uint32_t g : order) {
      group_ = g;
      add_surfaces(groups[g].flush_front, groups[g].flush_back);
    }
    name_objects();
    return {std::move(objects_), std::move(sheets_), {shells_.rooms().begin(), shells_.rooms().end()}};
  }

 private:
  struct Group {
    std::vector<const Component*> closed;
    std::vector<std::uint32_t> front, back, flush_front, flush_back;
    double largest_flush = 0.0;  // area of a component
  };

  [[nodiscard]] std::vector<Group> sort_by_group() {
    std::vector<Group> groups(std::max<std::size_t>(input_.names.size(), 1));
    for (const Component& component : shells_.components()) {
      if (component.role == Role::cavity || component.role == Role::nothing) { continue; }
      const std::uint32_t g = mesh_.faces[component.faces[0]].group;
      for (const std::uint32_t f : component.faces) { groups.resize(std::max<std::size_t>(groups.size(), mesh_.faces[f].group + 1)); }
      if (component.role != Role::surface) {
        groups[g].closed.push_back(&component);
        continue;
      }
      bool mixed = false;
      double area = 0.0;
      for (const std::uint32_t f : component.faces) { area += component.flush ? brep::area(mesh_.outline(mesh_.faces[f])) : 0.0; }
      for (const std::uint32_t f : component.faces) {
        groups[mesh_.faces[f].group].largest_flush = std::max(groups[mesh_.faces[f].group].largest_flush, area);
        Group& group = groups[mesh_.faces[f].group];
        (component.flush ? group.flush_front : group.front).push_back(f);
        if (component.one_sided) {
          if (mesh_.faces[f].back != none) { leave_out_backs(mesh_, mesh_.faces[f]); }
          continue;
        }
        if (component.both_sides || has_back(mesh_.faces[f])) { (component.flush ? group.flush_back : group.back).push_back(f); }
        if (mesh_.faces[f].mixed) { mesh_.changed(ChangeKind::both_sides, mesh_.faces[f].polygon, 0.0, mixed ? 0 : 1); }
        mixed = mixed || mesh_.faces[f].mixed;
      }
    }
    return groups;
  }

  void add_closed(const Component& component) {
    std::vector<std::uint32_t> faces = component.faces;
    for (const std::uint32_t cavity : component.cavities) {
      const std::span<const std::uint32_t> walls = shells_.components()[cavity].faces;
      faces.insert(faces.end(), walls.begin(), walls.end());
    }
    for (const std::uint32_t f : faces) {
      if (mesh_.faces[f].back != none) { leave_out_backs(mesh_, mesh_.faces[f]); }
    }
    add(faces, component.role, false);
  }

  // Objects get the name of their group, with a number if the group has several objects. A solid of several groups gets their
  // names, at most three.
  void name_objects() {
    std::vector<std::size_t> count(std::max<std::size_t>(input_.names.size(), 1)), number(count.size());
    for (const std::uint32_t g : group_of_) {
      count.resize(std::max<std::size_t>(count.size(), g + 1));
      number.resize(count.size());
      ++count[g];
    }
    const auto name_of = [&](std::uint32_t g) { return g < input_.names.size() ? input_.names[g] : std::string("mesh"); };
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const std::uint32_t g = group_of_[i];
      objects_[i].name = count[g] == 1 ? name_of(g) : name_of(g) + "." + std::to_string(++number[g]);
      for (const std::uint32_t other : others_[i]) { objects_[i].name += "+" + name_of(other); }
    }
  }

  // Up to two further groups of these faces, besides the current one.
  [[nodiscard]] std::vector<std::uint32_t> other_groups(const std::vector<std::uint32_t>& faces) const {
    std::vector<std::uint32_t> groups;
    for (const std::uint32_t f : faces) {
      const std::uint32_t g = mesh_.faces[f].group;
      if (g != group_ && groups.size() < 2 && std::find(groups.begin(), groups.end(), g) == groups.end()) { groups.push_back(g); }
    }
    return groups;
  }

  [[nodiscard]] bool is_turned(std::uint32_t face) const { return shells_.turned(topology_.component[face]); }

  [[nodiscard]] bool has_back(const Face& face) const {
    return options_.two_sided || face.mixed || face.back != none ||
           (face.material < input_.two_sided.size() && input_.two_sided[face.material] != 0);
  }

  // Gives two sides to open surfaces that are seen from behind (IntakeOptions). The result: which components these are.
  [[nodiscard]] std::vector<bool> show_backs() {
    std::vector<std::uint32_t> seen = options_.seen_from_behind;
    std::sort(seen.begin(), seen.end());
    const auto is_seen = [&](std::uint32_t f) {
      return !has_back(mesh_.faces[f]) && std::binary_search(seen.begin(), seen.end(), mesh_.faces[f].polygon);
    };
    std::vector<bool> from_behind(shells_.components().size(), false);
    for (std::uint32_t c = 0; c < from_behind.size(); ++c) {
      const Component& component = shells_.components()[c];
      if (component.role != Role::surface || component.one_sided || component.both_sides || shells_.shines(component)) { continue; }
      from_behind[c] = std::any_of(component.faces.begin(), component.faces.end(), is_seen);
      if (from_behind[c]) { shells_.show_both_sides(c); }
    }
    return from_behind;
  }

  [[nodiscard]] std::vector<bool> faces_with_backs() const {
    std::vector<bool> result;
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      result.push_back(has_back(mesh_.faces[f]) || shells_.components()[topology_.component[f]].both_sides);
    }
    return result;
  }

  // A surface without a border would be taken for a solid, so one of its faces becomes a separate object.
  void add_surface(std::vector<std::uint32_t> faces, bool back) {
    const auto on_border = [&](std::uint32_t f) {
      for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
        const std::uint32_t mate = topology_.mate[s];
        if (mate == none || mesh_.faces[subsets_.face_of(mate)].group != mesh_.faces[f].group) { return true; }
      }
      return false;
    };
    if (faces.size() > 1 && std::none_of(faces.begin(), faces.end(), on_border)) {
      add({faces.back()}, Role::surface, back);
      faces.pop_back();
    }
    if (!faces.empty()) { add(faces, Role::surface, back); }
  }

  // The surfaces of a group, and the backs of those faces that show them; one layer after the other, because later objects are seen.
  void add_surfaces(const std::vector<std::uint32_t>& front, const std::vector<std::uint32_t>& back) {
    const std::vector<std::uint32_t> layer = layers_of(mesh_, front);
    const std::uint32_t layers = layer.empty() ? 0 : *std::max_element(layer.begin(), layer.end()) + 1;
    for (std::size_t i = 0; i < front.size(); ++i) {
      layer_[front[i]] = layer[i];
      if (layer[i] > 0) { mesh_.changed(ChangeKind::overlapping, mesh_.faces[front[i]].polygon); }
    }
    const auto of_layer = [&](const std::vector<std::uint32_t>& faces, std::uint32_t k) {
      std::vector<std::uint32_t> own;
      std::copy_if(faces.begin(), faces.end(), std::back_inserter(own), [&](std::uint32_t f) { return layer_[f] == k; });
      return own;
    };
    for (std::uint32_t k = 0; k < layers; ++k) {
      add_surface(of_layer(front, k), false);
      add_surface(of_layer(back, k), true);
    }
  }

  // The faces of a room are reversed like those of a back, because its normals are those of the solid whose inside it is.
  void add(const std::vector<std::uint32_t>& faces, Role role, bool back) {
    Subset subset = subsets_.of(faces);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if ((role == Role::room) != (back != is_turned(faces[i]))) { std::reverse(subset.corners[i].begin(), subset.corners[i].end()); }
    }
    raycast::Placement placement;
    placement.inside = role == Role::room;
    if (raycast::Made<raycast::Mesh> made = raycast::Mesh::make(subset.positions, subset.corners)) {
      std::vector<std::uint32_t> material;
      for (std::uint32_t sheet = 0; sheet < faces.size(); ++sheet) {
        came_from(faces[sheet], sheet, back);
        material.push_back(material_of(faces[sheet], back));
      }
      if (std::all_of(material.begin(), material.end(), [&](auto m) { return m == material[0]; })) { material.resize(1); }
      objects_.push_back({{}, std::move(made.object), placement, std::move(material)});
      group_of_.push_back(group_);
      others_.push_back(other_groups(faces));
      return;
    }
    std::vector<std::uint32_t> sound, faulty;
    for (const std::uint32_t f : faces) { (raycast::polygon_fault(mesh_.outline(mesh_.faces[f])) ? faulty : sound).push_back(f); }
    if (!faulty.empty() && !sound.empty()) {
      role == Role::surface ? add_surface(std::move(sound), back) : add(sound, Role::surface, back);
      sound.clear();
    }
    for (const std::vector<std::uint32_t>* const list : {&sound, &faulty}) {
      for (const std::uint32_t f : *list) { add_loose(f, back); }
    }
  }

  // Adds a face as an object of its own, or in triangles, if it is no valid polygon.
  void add_loose(std::uint32_t face, bool back) {
    const std::span<const glm::dvec3> corners = mesh_.outline(mesh_.faces[face]);
    std::vector<glm::dvec3> outline(corners.begin(), corners.end());
    if (back != is_turned(face)) { std::reverse(outline.begin(), outline.end()); }
    const auto add_polygon = [&](std::vector<glm::dvec3> polygon) {
      raycast::Made<raycast::Polygon> made = raycast::Polygon::make(std::move(polygon));
      if (!made) { return false; }
      came_from(face, 0, back);
      objects_.push_back({{}, std::move(made.object), {}, {material_of(face, back)}});
      group_of_.push_back(group_);
      others_.emplace_back();
      return true;
    };
    bool added = add_polygon(outline);
    if (!added) {
      for (const auto& [a, b, c] : brep::ears(outline)) { added = add_polygon({outline[a], outline[b], outline[c]}) || added; }
    }
    mesh_.changed(added ? ChangeKind::loose : ChangeKind::unusable, mesh_.faces[face].polygon);
  }

  [[nodiscard]] std::uint32_t material_of(std::uint32_t face, bool back) const {
    const Face& its = mesh_.faces[face];
    return its.back != none && back != is_turned(face) ? its.back : its.material;
  }

  // Records the origin of a sheet of the object that will be added next.
  void came_from(std::uint32_t face, std::uint32_t sheet, bool back) {
    sheets_.push_back({{static_cast<std::uint32_t>(objects_.size()), sheet, back != is_turned(face)}, face});
  }

  Working& mesh_;
  const Topology& topology_;
  const PolygonView& input_;
  const IntakeOptions& options_;
  std::vector<FlushFace> flush_;  // found before shells are measured, because finding them moves vertices; so are decals_
  std::vector<DecalFace> decals_;
  Shells shells_;
  Subsets subsets_;
  std::vector<std::uint32_t> layer_;  // by face, of those that have been added
  std::vector<SceneObject> objects_;
  std::vector<std::uint32_t> group_of_;             // by object
  std::vector<std::vector<std::uint32_t>> others_;  // by object: further groups of its faces
  std::uint32_t group_ = 0;                         // the group whose objects are being made
  std::vector<SheetOrigin> sheets_;
};

}  // namespace detail

HALFLIGHT_INLINE MadeObjects make_objects(Working& mesh, const Topology& topology, const PolygonView& input,
                                          std::span<const Material> materials, const IntakeOptions& options) {
  return detail::ObjectMaker(mesh, topology, input, materials, options).run();
}

HALFLIGHT_INLINE PolygonParts parts_of(const Working& mesh, std::span<const SheetOrigin> sheets, std::size_t polygons) {
  std::vector<std::pair<std::uint32_t, PolygonPart>> list;  // polygon and part
  for (const SheetOrigin& sheet : sheets) {
    const Face& face = mesh.faces[sheet.face];
    const auto add = [&](const Source& source) {
      list.push_back({source.polygon, sheet.part});
      list.back().second.back = sheet.part.back != source.turned;
    };
    add({face.polygon, face.turned});
    for (const Source& source : face.more) { add(source); }
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto same = [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.object == b.second.object && a.second.sheet == b.second.sheet && a.second.back == b.second.back;
  };
  list.erase(std::unique(list.begin(), list.end(), same), list.end());  // a sheet may refer to the same polygon twice
  PolygonParts result;
  result.first.assign(polygons + 1, 0);
  for (const auto& [polygon, part] : list) {
    ++result.first[polygon + 1];
    result.all.push_back(part);
  }
  for (std::size_t p = 0; p < polygons; ++p) { result.first[p + 1] += result.first[p]; }
  return result;
}

}  // namespace radiosity::intake
