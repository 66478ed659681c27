// SPDX-License-Identifier: MIT
#include <radiosity/picture/mesh_refiner.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/refine.hpp>
#include <brep/t_vertices.hpp>

#include <raycast/transform.hpp>

#include <radiosity/direct/lit_region.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/irradiance_cache.hpp>
#include <radiosity/picture/outlines.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/picture/viewpoint.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// Distance from a corner at which its light is taken, relative to that to the face's middle.
inline constexpr double inside_of_corner = 1e-3;
inline constexpr double same_colour = 0.01;                 // relative difference below which colours at one vertex are merged
inline constexpr double smooth_normals = 0.999;             // least cosine between normals of merged colours
inline constexpr double least_ball = 0.5, most_ball = 1.5;  // limits of the radius of an indirect point, relative to the side of the face
inline constexpr double least_cell = 1e-8;                  // relative to the total area: smaller faces are not split

// Sets the colour of each marked half-edge to the mean of the others of its face; without others, to that of the face's node.
HALFLIGHT_INLINE void colour_from_face(SurfaceBRep& brep, const std::vector<char>& marked, const std::vector<Color>& of_node) {
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).node == no_node) { continue; }
    Color sum{0.0};
    double count = 0.0;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      if (marked[h.index]) { continue; }
      sum += brep.data(h).radiosity;
      count += 1.0;
    }
    const Color mean = count > 0.0 ? sum / count : of_node[brep.data(f).node];
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      if (marked[h.index]) { brep.data(h).radiosity = mean; }
    }
  }
}

}  // namespace detail

HALFLIGHT_INLINE const Color* MeshRefiner::Cell::at(brep::VertexId v) const {
  const auto found = std::find_if(corners.begin(), corners.end(), [&](const auto& corner) { return corner.first == v; });
  return found != corners.end() ? &found->second : nullptr;
}

HALFLIGHT_INLINE MeshRefiner::MeshRefiner(const FinalGather& light, std::vector<Surface> surfaces, const LeafLight& leaves, Meshing meshing,
                                          unsigned threads, const Control& control)
    : light_{&light},
      surfaces_{std::move(surfaces)},
      leaves_{&leaves},
      meshing_{std::move(meshing)},
      threads_{threads},
      control_{&control},
      indirect_{light, threads},
      cells_(surfaces_.size()) {
  for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
    const SurfaceBRep& brep = surfaces_[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t node = brep.data(f).node;
      if (node == no_node || !(leaves.exposure.area[node] > 0.0)) { continue; }
      fresh_.push_back({o, f});
      total_area_ += glm::length(vector_area(corner_polygon(brep, f)));
    }
  }
  faces_ = fresh_.size();
  measure_outlines();
}

HALFLIGHT_INLINE void MeshRefiner::measure_outlines() {
  if (control_->viewpoint) { outlines_ = outline_errors(*light_, surfaces_, *control_->viewpoint, threads_); }
}

HALFLIGHT_INLINE double MeshRefiner::outlines() const {
  double sum = 0.0;
  for (const std::vector<double>& of : outlines_) { sum = std::accumulate(of.begin(), of.end(), sum); }
  return sum;
}

HALFLIGHT_INLINE MeshRefiner::Places MeshRefiner::places_of(const Face& face) const {
  const Surface& surface = surfaces_[face.surface];
  const std::uint32_t sheet = surface.brep.data(face.face).sheet;
  const Polygon corners = corner_polygon(surface.brep, face.face);
  const std::uint32_t number = surface.first_surface + sheet;
  glm::dvec3 middle{0.0};
  for (const glm::dvec3& p : corners) { middle += p / static_cast<double>(corners.size()); }
  const auto exposed_at = [&](const glm::dvec3& at) -> std::optional<FinalGather::Place> {
    const FinalGather::Place place{light_->objects().object(face.surface).project(sheet, at), face.surface, number};
    if (light_->objects().covered(place.point.position, place.point.normal, face.surface)) { return std::nullopt; }
    return place;
  };
  Places places;
  places.side = std::sqrt(glm::length(vector_area(corners)));
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (const auto place = exposed_at(glm::mix(corners[k], middle, detail::inside_of_corner))) { places.corners.emplace_back(k, *place); }
  }
  // At least four points, equally many on each triangle of the fan as which the face is drawn.
  const std::size_t triangles = corners.size() - 2, on_each = std::max<std::size_t>(2, 4 / triangles);
  Random random{face.surface, face.face.index, static_cast<std::uint64_t>(surface.brep.data(face.face).level)};
  for (std::size_t k = 1; k <= triangles; ++k) {
    const double area = triangle_area(corners[0], corners[k], corners[k + 1]);
    for (std::size_t i = 0; i < on_each; ++i) {
      const double u = (static_cast<double>(i) + random.uniform()) / static_cast<double>(on_each);
      const glm::dvec3 weight = triangle_weights(u, random.uniform());
      const auto place = exposed_at(triangle_point(weight, corners[0], corners[k], corners[k + 1]));
      if (!place) { continue; }
      const double share = seen_share(control_->viewpoint, *light_, *place);
      places.tests.push_back({*place, static_cast<std::uint32_t>(k), weight, share * area / static_cast<double>(on_each)});
    }
  }
  return places;
}

HALFLIGHT_INLINE MeshRefiner::Cell MeshRefiner::light_of(const Face& face, const Places& places) const {
  Cell cell;
  std::vector<FinalGather::Place> all;
  for (const auto& [number, place] : places.corners) { all.push_back(place); }
  for (const Test& test : places.tests) { all.push_back(test.place); }
  cell.exposed = !all.empty();
  if (!cell.exposed) { return cell; }
  const Material& material = light_->material(all[0].surface);
  const bool black = is_black(material.reflectance);
  std::optional<LitRegion> region;
  if (!black) { region.emplace(light_->lit_region(all)); }
  const auto light_at = [&](const FinalGather::Place& place) {
    if (black) { return material.emission; }
    const Color direct = region->irradiance(place.point.position, place.point.normal);
    return material.emission + material.reflectance * (direct + indirect_.at(place).value_or(Color{0.0}));
  };
  const SurfaceBRep& brep = surfaces_[face.surface].brep;
  const auto corners = brep::corners(brep, face.face);
  Color mean{0.0};  // mean of the corners that are not buried; buried corners get it
  for (const auto& [number, place] : places.corners) {
    cell.corners.emplace_back(brep.vertex(corners[number]), light_at(place));
    mean += cell.corners.back().second / static_cast<double>(places.corners.size());
  }
  const auto shown_at = [&](std::size_t number) {
    const Color* color = cell.at(brep.vertex(corners[number]));
    return color != nullptr ? *color : mean;
  };
  for (const Test& test : places.tests) {
    const Color truth = light_at(test.place);
    const Color error =
        test.weight.x * shown_at(0) + test.weight.y * shown_at(test.second) + test.weight.z * shown_at(test.second + 1) - truth;
    cell.error += test.area * glm::dot(error, error);
    cell.square += test.area * glm::dot(truth - material.emission, truth - material.emission);
  }
  return cell;
}

HALFLIGHT_INLINE bool MeshRefiner::gather() {
  for (std::size_t o = 0; o < surfaces_.size(); ++o) { cells_[o].resize(surfaces_[o].brep.face_end()); }
  std::vector<Places> places(fresh_.size());
  parallel_for(
      fresh_.size(), threads_, [&](std::size_t i) { places[i] = places_of(fresh_[i]); }, 16);
  std::vector<IrradianceCache::Wanted> wanted;
  for (const Places& of : places) {
    const auto want = [&](const FinalGather::Place& place) {
      if (!is_black(light_->material(place.surface).reflectance)) {
        wanted.push_back({place, detail::least_ball * of.side, detail::most_ball * of.side});
      }
    };
    for (const auto& [number, place] : of.corners) { want(place); }
    for (const Test& test : of.tests) { want(test.place); }
  }
  if (!indirect_.extend(wanted, *control_)) { return false; }
  const auto light = [&](std::size_t k) { cells_[fresh_[k].surface][fresh_[k].face.index] = light_of(fresh_[k], places[k]); };
  if (!parallel_in_batches(*control_, threads_, fresh_.size(), {4096, 8}, light)) { return false; }
  fresh_.clear();
  measure_outlines();
  return true;
}

HALFLIGHT_INLINE double MeshRefiner::error() const {
  double error = outlines(), square = 0.0;
  for (const std::vector<Cell>& of : cells_) {
    for (const Cell& cell : of) { error += cell.error, square += cell.square; }
  }
  return square > 0.0 ? std::sqrt(error / square) : 0.0;
}

HALFLIGHT_INLINE std::size_t MeshRefiner::split(double wanted, std::uint64_t most) {
  struct Candidate {
    double error = 0.0;
    Face face;
  };
  std::vector<Candidate> candidates;
  double rest = 0.0, square = 0.0;
  for (std::uint32_t o = 0; o < surfaces_.size(); ++o) {
    for (std::uint32_t f = 0; f < cells_[o].size(); ++f) {
      const Cell& cell = cells_[o][f];
      const double error = cell.error + (outlines_.empty() ? 0.0 : outlines_[o][f]);
      rest += error;
      square += cell.square;
      if (error > 0.0) { candidates.push_back({error, {o, brep::FaceId{f}}}); }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
  std::size_t count = 0;
  for (const Candidate& candidate : candidates) {
    if (!(rest > 0.5 * wanted * wanted * square) || faces_ + 3 > most) { break; }
    rest -= candidate.error;
    Surface& surface = surfaces_[candidate.face.surface];
    if (!(glm::length(vector_area(corner_polygon(surface.brep, candidate.face.face))) > detail::least_cell * total_area_)) { continue; }
    const ChildFaces children = meshing_(LeafFace{surface, candidate.face.face});
    if (children.faces.empty()) { continue; }
    ++count;
    faces_ += children.faces.size() - 1;
    for (const brep::FaceId f : children.faces) { fresh_.push_back({candidate.face.surface, f}); }
  }
  return count;
}

// Sets the colours of a surface's half-edges: at each vertex, the mean over those faces whose colours agree.
HALFLIGHT_INLINE void MeshRefiner::unite_colours(Surface& surface, const std::vector<Cell>& cells,
                                                 const std::vector<brep::FaceId>& origin) const {
  SurfaceBRep& brep = surface.brep;
  struct Group {
    std::uint32_t sheet = 0;
    glm::dvec3 normal{0.0};
    Color representative{0.0}, sum{0.0};
    double count = 0.0;
  };
  std::vector<Group> groups;
  std::vector<std::pair<brep::HalfedgeId, std::size_t>> members;
  std::vector<brep::HalfedgeId> bare;
  std::vector<std::pair<brep::FaceId, std::size_t>> seen;
  std::vector<char> without(brep.halfedge_end(), 0);
  for (const brep::VertexId v : brep::vertices(brep)) {
    groups.clear();
    members.clear();
    bare.clear();
    seen.clear();
    for (const brep::HalfedgeId h : brep::halfedges_from(brep, v)) {
      const SurfaceFace& face = brep.data(brep.face(h));
      if (face.node == no_node) { continue; }
      const brep::FaceId from = origin[brep.face(h).index];
      const Color* color = cells[from.index].at(v);
      if (color == nullptr) {
        bare.push_back(h);
        continue;
      }
      const glm::dvec3& normal = brep.data(h).normal;
      const auto agrees = [&](const Group& group) {
        return group.sheet == face.sheet && glm::dot(group.normal, normal) > detail::smooth_normals &&
               glm::length(group.representative - *color) <=
                   detail::same_colour * std::max(glm::length(group.representative), glm::length(*color));
      };
      auto group = std::find_if(groups.begin(), groups.end(), agrees);
      if (group == groups.end()) { group = groups.insert(group, {face.sheet, normal, *color, Color{0.0}, 0.0}); }
      const auto index = static_cast<std::size_t>(group - groups.begin());
      members.emplace_back(h, index);
      // Another part of the same original face.
      if (std::find(seen.begin(), seen.end(), std::pair(from, index)) != seen.end()) { continue; }
      seen.emplace_back(from, index);
      group->sum += *color;
      group->count += 1.0;
    }
    for (const auto& [h, group] : members) { brep.data(h).radiosity = groups[group].sum / groups[group].count; }
    for (const brep::HalfedgeId h : bare) {  // T-vertices of their faces take the mean of the matching colours at the vertex
      Color sum{0.0};
      double count = 0.0;
      for (const Group& group : groups) {
        if (group.sheet != brep.data(brep.face(h)).sheet || !(glm::dot(group.normal, brep.data(h).normal) > detail::smooth_normals)) {
          continue;
        }
        sum += group.sum;
        count += group.count;
      }
      without[h.index] = !(count > 0.0);
      if (count > 0.0) { brep.data(h).radiosity = sum / count; }
    }
  }
  detail::colour_from_face(brep, without, leaves_->radiosity);  // buried corners, as in reconstruct()
}

HALFLIGHT_INLINE Mesh MeshRefiner::mesh() const {
  std::vector<Surface> surfaces = surfaces_;
  std::vector<std::vector<brep::FaceId>> origin(surfaces.size());  // by face: the face from which it was cut
  for (std::size_t o = 0; o < surfaces.size(); ++o) {
    SurfaceBRep& brep = surfaces[o].brep;
    std::vector<brep::FaceId> faces;
    origin[o].resize(brep.face_end());
    for (const brep::FaceId f : brep::faces(brep)) {
      origin[o][f.index] = f;
      if (brep.data(f).sheet != brep::no_sheet) { faces.push_back(f); }
    }
    for (const brep::FaceId f : faces) {
      (void)brep::eliminate_t_vertices(brep, f);
      origin[o].resize(brep.face_end(), f);
    }
  }
  const auto exposed = [&](std::size_t o, brep::FaceId f) {
    const brep::FaceId from = origin[o][f.index];
    return from.index < cells_[o].size() && cells_[o][from.index].exposed;
  };
  return read_mesh(surfaces, *leaves_, exposed, [&](std::size_t o) { unite_colours(surfaces[o], cells_[o], origin[o]); });
}

}  // namespace radiosity
