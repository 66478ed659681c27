// SPDX-License-Identifier: MIT
#include <raycast/objects/csg.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/csg_boundary.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Csg> Csg::make(const CsgNode& root) {
  Made<CsgTree> tree = CsgTree::make(root);
  if (!tree) { return std::move(tree.refusal); }
  std::shared_ptr<Csg> csg(new Csg(std::move(tree.object)));
  if (std::string refusal = csg->evaluate(); !refusal.empty()) { return refusal; }
  return std::shared_ptr<const Csg>(std::move(csg));
}

HALFLIGHT_INLINE void Csg::spans(const Segment& line, Spans& out) const {
  if (!mesh_) { return tree_->spans(line, out); }
  Spans faces;
  mesh_->spans(line, faces);
  for (Span span : faces) {
    span.in.sheet = polygons_.sheet(span.in.sheet);
    span.out.sheet = polygons_.sheet(span.out.sheet);
    out.push(span);
  }
}

HALFLIGHT_INLINE void Csg::approximate(double tolerance, brep::Builder& out) const {
  if (flat() || tolerance >= 0.98 * tolerance_) {
    return append(polygons_, out);  // not compared exactly: a placement knows its stretch to 0.2 %
  }
  // If coarse chords give a boundary, fine ones do as well, unless features fall below the grid or there are too many faces; then the
  // tolerance is doubled.
  for (; tolerance < 0.98 * tolerance_; tolerance *= 2) {
    const CsgBoundaryResult finer = csg_boundary(*tree_, region_, tolerance);
    if (finer.boundary && finer.boundary->brep.face_count() > 0) { return detail::append(finer.boundary->brep, out); }
  }
  append(polygons_, out);
}

HALFLIGHT_INLINE brep::Builder Csg::polygons_of(const CsgBRep& brep) {
  brep::Builder result;
  detail::append(brep, result);
  return result;
}

HALFLIGHT_INLINE void Csg::append(const brep::Builder& polygons, brep::Builder& out) {
  const std::uint32_t first = out.vertex_count();
  for (std::uint32_t v = 0; v < polygons.vertex_count(); ++v) { out.vertex(polygons.position(v)); }
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < polygons.face_count(); ++f) {
    corners.assign(polygons.corners(f).begin(), polygons.corners(f).end());
    for (std::uint32_t& v : corners) { v += first; }
    out.face(std::span<const std::uint32_t>(corners), polygons.sheet(f));
  }
}

HALFLIGHT_INLINE std::string Csg::evaluate() {
  if (tree_->bounds().empty()) { return "nothing is left: the parts of an intersection do not meet"; }
  const auto& leaves = tree_->leaves();
  const bool curved = !std::all_of(leaves.begin(), leaves.end(), [](const CsgTree::Leaf& leaf) { return leaf.solid.flat(); });
  region_ = curved ? csg_region(*tree_) : CsgRegion{tree_->bounds(), {}};
  if (region_.whole.empty()) { return "nothing is left of the solid"; }
  tolerance_ = tol_chord * region_.whole.diameter();
  CsgBoundaryResult result = csg_boundary(*tree_, region_, tolerance_);
  // Parts that are thinner than the chord error may get lost, or may be artefacts of it.
  for (int finer = 0; finer < 2 && curved && result.boundary && !holds_solid(result.boundary->brep); ++finer) {
    CsgBoundaryResult next = csg_boundary(*tree_, region_, 0.25 * tolerance_);
    if (!next.boundary) { break; }
    tolerance_ *= 0.25;
    result = std::move(next);
  }
  if (!result.boundary) { return std::move(result.refusal); }
  if (curved ? !holds_solid(result.boundary->brep) : result.boundary->brep.face_count() == 0) {
    return curved ? "nothing is left of the solid that is thicker than " + std::to_string(tolerance_) : "nothing is left of the solid";
  }
  polygons_ = polygons_of(result.boundary->brep);
  if (curved) { return {}; }
  Made<Mesh> mesh = Mesh::make(result.boundary->brep);
  if (!mesh) { return "the faces of the result are too thin: " + mesh.refusal; }
  mesh_ = std::move(mesh.object);
  if (std::string film = find_film(result.boundary->near); !film.empty()) { return film; }
  // If vertices are off their sheets by more than a placement rounds, they are known only to the resolution of the grid.
  const Box box = mesh_->bounds();
  slack_ = result.boundary->off > eps_vertex * box.magnitude() ? result.boundary->off : mesh_->slack();
  return {};
}

HALFLIGHT_INLINE bool Csg::holds_solid(const CsgBRep& brep) const {
  for (const brep::FaceId f : brep::faces(brep)) {
    Spans spans;
    const glm::dvec3 normal = brep::normal(brep, f);
    if (normal != glm::dvec3(0.0)) { tree_->spans(Segment{brep::centroid(brep, f), normal}, spans); }
    if (spans.size() > 0) { return true; }
  }
  return false;
}

HALFLIGHT_INLINE std::string Csg::find_film(double near) const {
  for (std::uint32_t f = 0; f < polygons_.face_count(); ++f) {
    glm::dvec3 centre(0.0);
    for (const std::uint32_t v : polygons_.corners(f)) {
      centre += polygons_.position(v) / static_cast<double>(polygons_.corners(f).size());
    }
    const std::uint32_t sheet = polygons_.sheet(f);
    const Segment line{centre, -tree_->project(sheet, centre).normal};  // t is a length because the direction is a unit vector
    Spans spans;
    tree_->spans(line, spans);
    if (std::none_of(spans.begin(), spans.end(), [&](const Span& s) { return std::abs(s.in.t) <= near; })) {
      return "the surface of '" + std::string(sheet_name(sheet)) +
             "' nearly coincides with that of another part that is turned otherwise: closer than 2^-22 of the size, but not equal";
    }
  }
  return {};
}

}  // namespace raycast
