// SPDX-License-Identifier: MIT
#pragma once

// Union, intersection and difference of solids as one object. Its sheets are those of the leaves, counted through; so every leaf keeps its
// materials, and the surface of a window that was cut out belongs to what cut it.
//
// Leaves that are all polyhedral: the exact boundary is evaluated once, by brep/csg, and rays meet its faces. With a curved leaf rays meet
// the true surfaces, by merged spans (csg_tree.hpp), and the mesh stands on the exact combination of the leaves' approximations, its
// vertices put back onto the true surfaces; whatever refinement adds is projected there like that of any other object.

#include "csg_boundary.hpp"
#include "mesh.hpp"

namespace raycast {

class Csg final : public Object {
 public:
  // Refused, with a sentence: what CsgTree::make refuses; what brep/csg refuses; a tree that leaves nothing.
  static Made<Csg> make(const CsgNode& root) {
    Made<CsgTree> tree = CsgTree::make(root);
    if (!tree) return std::move(tree.refusal);
    std::shared_ptr<Csg> csg(new Csg(std::move(tree.object)));
    if (std::string refusal = csg->evaluate(); !refusal.empty()) return refusal;
    return std::shared_ptr<const Csg>(std::move(csg));
  }

  [[nodiscard]] const CsgTree& tree() const { return *tree_; }
  // Of the first approximation: its chords are off the true surface by no more.
  [[nodiscard]] double chord_tolerance() const { return tolerance_; }

  [[nodiscard]] Box bounds() const override { return mesh_ ? mesh_->bounds() : tree_->bounds(); }
  [[nodiscard]] bool convex() const override { return mesh_ ? mesh_->convex() : tree_->convex(); }
  [[nodiscard]] bool flat() const override { return mesh_ != nullptr; }
  [[nodiscard]] double slack() const override { return slack_; }
  [[nodiscard]] std::uint32_t sheet_count() const override { return tree_->sheet_count(); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override { return tree_->sheet_name(sheet); }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return tree_->project(sheet, p); }

  void spans(const Segment& line, Spans& out) const override {
    if (!mesh_) return tree_->spans(line, out);
    Spans faces;
    mesh_->spans(line, faces);
    for (Span span : faces) {
      span.in.sheet = polygons_.sheet(span.in.sheet);
      span.out.sheet = polygons_.sheet(span.out.sheet);
      out.push(span);
    }
  }

  void compile(Compiler& compiler) const override {
    if (mesh_) mesh_->compile(compiler);
  }
  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const override {
    return {mesh_->crossing(line, face).t, polygons_.sheet(face)};
  }
  [[nodiscard]] bool enters(const Segment& line, std::uint32_t face) const override { return mesh_->enters(line, face); }

  // Faces are convex where they lie on flat sheets.
  void approximate(double tolerance, brep::Builder& out) const override {
    if (flat() || tolerance >= 0.98 * tolerance_) return append(polygons_, out);  // a placement knows its stretch to 0.2 %
    // What can be done with coarse chords can be done with fine ones, but for features that fall below the grid, or too many faces.
    for (; tolerance < 0.98 * tolerance_; tolerance *= 2) {
      const CsgBoundaryResult finer = csg_boundary(*tree_, region_, tolerance);
      if (finer.boundary && finer.boundary->brep.face_count() > 0) return detail::append(finer.boundary->brep, out);
    }
    append(polygons_, out);
  }

 private:
  explicit Csg(std::shared_ptr<const CsgTree> tree) : tree_(std::move(tree)) {}

  static brep::Builder polygons_of(const CsgBRep& brep) {
    brep::Builder result;
    detail::append(brep, result);
    return result;
  }

  static void append(const brep::Builder& polygons, brep::Builder& out) {
    const std::uint32_t first = out.vertex_count();
    for (std::uint32_t v = 0; v < polygons.vertex_count(); ++v) out.vertex(polygons.position(v));
    std::vector<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < polygons.face_count(); ++f) {
      corners.assign(polygons.corners(f).begin(), polygons.corners(f).end());
      for (std::uint32_t& v : corners) v += first;
      out.face(std::span<const std::uint32_t>(corners), polygons.sheet(f));
    }
  }

  std::string evaluate() {
    if (tree_->bounds().empty()) return "nothing is left: the parts of an intersection do not meet";
    const auto& leaves = tree_->leaves();
    const bool curved = !std::all_of(leaves.begin(), leaves.end(), [](const CsgTree::Leaf& leaf) { return leaf.solid.flat(); });
    region_ = curved ? csg_region(*tree_) : CsgRegion{tree_->bounds(), {}};
    if (region_.whole.empty()) return "nothing is left of the solid";
    tolerance_ = 0.01 * region_.whole.diameter();
    CsgBoundaryResult result = csg_boundary(*tree_, region_, tolerance_);
    // What is thinner than the chords are inexact may get lost between them, or be nothing else.
    for (int finer = 0; finer < 2 && curved && result.boundary && !holds_solid(result.boundary->brep); ++finer) {
      CsgBoundaryResult next = csg_boundary(*tree_, region_, 0.25 * tolerance_);
      if (!next.boundary) break;
      tolerance_ *= 0.25;
      result = std::move(next);
    }
    if (!result.boundary) return std::move(result.refusal);
    if (curved ? !holds_solid(result.boundary->brep) : result.boundary->brep.face_count() == 0)
      return curved ? "nothing is left of the solid that is thicker than " + std::to_string(tolerance_) : "nothing is left of the solid";
    polygons_ = polygons_of(result.boundary->brep);
    if (curved) return {};
    Made<Mesh> mesh = Mesh::make(result.boundary->brep);
    if (!mesh) return "the faces of the result are too thin: " + mesh.refusal;
    mesh_ = std::move(mesh.object);
    if (std::string film = find_film(result.boundary->near); !film.empty()) return film;
    // Off the sheets by more than a placement rounds: known to the grid only.
    const Box box = mesh_->bounds();
    slack_ = result.boundary->off > 32 * unit_roundoff * box.magnitude() ? result.boundary->off : mesh_->slack();
    return {};
  }

  // Is there a face with something of the true solid behind it?
  [[nodiscard]] bool holds_solid(const CsgBRep& brep) const {
    for (const brep::FaceId f : brep::faces(brep)) {
      Spans spans;
      const glm::dvec3 normal = brep::normal(brep, f);
      if (normal != glm::dvec3(0.0)) tree_->spans(Segment{brep::centroid(brep, f), normal}, spans);
      if (spans.size() > 0) return true;
    }
    return false;
  }

  // Faces of different solids that nearly coincide, but not on the grid, leave films between them that are no part of the true solid: the
  // merged spans do not know them. In front of each face must be the surface of the solid.
  [[nodiscard]] std::string find_film(double near) const {
    for (std::uint32_t f = 0; f < polygons_.face_count(); ++f) {
      glm::dvec3 centre(0.0);
      for (const std::uint32_t v : polygons_.corners(f)) centre += polygons_.position(v) / static_cast<double>(polygons_.corners(f).size());
      const std::uint32_t sheet = polygons_.sheet(f);
      const Segment line{centre, -tree_->project(sheet, centre).normal};  // t is a length
      Spans spans;
      tree_->spans(line, spans);
      if (std::none_of(spans.begin(), spans.end(), [&](const Span& s) { return std::abs(s.in.t) <= near; }))
        return "the surface of '" + std::string(sheet_name(sheet)) +
               "' nearly coincides with that of another part that is turned otherwise: closer than 2^-22 of the size, but not equal";
    }
    return {};
  }

  std::shared_ptr<const CsgTree> tree_;
  brep::Builder polygons_;            // the boundary with chords of 1 %
  std::shared_ptr<const Mesh> mesh_;  // the same, when all leaves are polyhedral
  CsgRegion region_;
  double tolerance_ = 0.0, slack_ = 0.0;
};

}  // namespace raycast
