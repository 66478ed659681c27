// SPDX-License-Identifier: MIT
#include <radiosity/direct/stand_in.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <raycast/objects/mesh.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/flat_parts.hpp>

namespace radiosity {

namespace detail {

// Some faces of a closed boundary as an open mesh. A vertex at which several fans of these faces meet is duplicated, one copy a fan.
[[nodiscard]] HALFLIGHT_INLINE std::shared_ptr<const raycast::Mesh> open_mesh(const brep::Builder& boundary,
                                                                              std::span<const FaceCorners> faces) {
  // By the vertices of the edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> corners_of_edge;
  std::uint32_t count = 0;
  for (const auto& face : faces) {
    const auto size = static_cast<std::uint32_t>(face.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t next = (i + 1) % size;
      corners_of_edge[{face[i], face[next]}] = {count + i, count + next};
    }
    count += size;
  }
  brep::detail::UnionFind fans(count);
  for (const auto& [edge, corners] : corners_of_edge) {
    const auto other = corners_of_edge.find({edge.second, edge.first});
    if (other == corners_of_edge.end()) { continue; }
    fans.unite(corners.first, other->second.second);
    fans.unite(corners.second, other->second.first);
  }
  std::vector<glm::dvec3> positions;
  std::vector<FaceCorners> parted;
  std::map<std::uint32_t, std::uint32_t> vertex_of_fan;
  std::uint32_t corner = 0;
  for (const auto& face : faces) {
    parted.emplace_back();
    for (const std::uint32_t v : face) {
      const auto [fan, is_new] = vertex_of_fan.try_emplace(fans.find(corner++), static_cast<std::uint32_t>(positions.size()));
      if (is_new) { positions.push_back(boundary.position(v)); }
      parted.back().push_back(fan->second);
    }
  }
  return raycast::Mesh::make(positions, parted).object;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<StandIn> open_meshes(const raycast::PlacedObject& object, double tolerance) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  std::vector<FaceCorners> faces;
  std::vector<std::uint32_t> sheets;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const std::span<const std::uint32_t> c = builder.corners(f);
    if (builder.sheet(f) != brep::no_sheet) { append_flat_parts(builder, {c.begin(), c.end()}, faces); }
    sheets.resize(faces.size(), builder.sheet(f));
  }
  std::vector<StandIn> halves;
  const std::size_t half = faces.size() / 2;
  for (const auto& [from, to] : {std::pair{std::size_t{0}, half}, std::pair{half, faces.size()}}) {
    auto mesh = detail::open_mesh(builder, std::span{faces}.subspan(from, to - from));
    if (!mesh) { return {}; }
    halves.push_back(
        {std::move(mesh), {sheets.begin() + static_cast<std::ptrdiff_t>(from), sheets.begin() + static_cast<std::ptrdiff_t>(to)}});
  }
  return halves;
}

}  // namespace radiosity
