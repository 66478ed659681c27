// SPDX-License-Identifier: MIT
#pragma once

// Union, intersection and difference of solids as one object. Its sheets are those of the leaves, numbered consecutively, so every leaf
// keeps its materials, and the walls of a window belong to the solid that was subtracted.
//
// If all leaves are polyhedral, the exact boundary is computed once by brep/csg, and rays meet its faces. If a leaf is curved, rays meet
// the true surfaces by merged spans (csg_tree.hpp). The mesh is then made from the exact combination of the leaves' approximations, with
// its vertices projected back onto the true surfaces; later refinement projects new vertices like those of any other object.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>

#include <raycast/box.hpp>
#include <raycast/compile.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

class Csg final : public Object {
 public:
  // Refuses, with a sentence: what CsgTree::make refuses, what brep/csg refuses, and a tree that leaves nothing.
  static Made<Csg> make(const CsgNode& root);

  [[nodiscard]] const CsgTree& tree() const { return *tree_; }
  // The chord tolerance of the first approximation: its faces are off the true surface by at most this.
  [[nodiscard]] double chord_tolerance() const { return tolerance_; }

  [[nodiscard]] Box bounds() const override { return mesh_ ? mesh_->bounds() : region_.whole; }
  [[nodiscard]] bool convex() const override { return mesh_ ? mesh_->convex() : tree_->convex(); }
  [[nodiscard]] bool flat() const override { return mesh_ != nullptr; }
  [[nodiscard]] double slack() const override { return slack_; }
  [[nodiscard]] double work() const override { return mesh_ ? mesh_->work() : tree_->work(); }
  [[nodiscard]] std::uint32_t sheet_count() const override { return tree_->sheet_count(); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override { return tree_->sheet_name(sheet); }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return tree_->project(sheet, p); }
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const override { return tree_->vertex(sheet, p); }

  void spans(const Segment& line, Spans& out) const override;

  void compile(Compiler& compiler) const override {
    if (mesh_) { mesh_->compile(compiler); }
  }
  [[nodiscard]] std::uint32_t sheet_of(std::uint32_t face) const override { return polygons_.sheet(face); }
  [[nodiscard]] Crossing crossing(const Segment& line, std::uint32_t face) const override {
    return {mesh_->crossing(line, face).t, polygons_.sheet(face)};
  }
  [[nodiscard]] int winding(const Segment& line, std::uint32_t face) const override { return mesh_->winding(line, face); }

  // The faces are convex if they lie on flat sheets.
  void approximate(double tolerance, brep::Builder& out) const override;

 private:
  explicit Csg(std::shared_ptr<const CsgTree> tree) : tree_(std::move(tree)) {}

  static brep::Builder polygons_of(const CsgBRep& brep);

  static void append(const brep::Builder& polygons, brep::Builder& out);

  std::string evaluate();

  // Is there a face with part of the true solid behind it?
  [[nodiscard]] bool holds_solid(const CsgBRep& brep) const;

  // If faces of different solids nearly coincide, but not on the grid, the mesh has films between them that are no part of the true solid
  // and that the merged spans remove. So every face must have the solid's true surface in front of it. Returns a sentence about the first
  // face that has not.
  [[nodiscard]] std::string find_film(double near) const;

  std::shared_ptr<const CsgTree> tree_;
  brep::Builder polygons_;            // the boundary with a chord tolerance of 1 %
  std::shared_ptr<const Mesh> mesh_;  // the same, if all leaves are polyhedral; else null
  CsgRegion region_;
  double tolerance_ = 0.0, slack_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg.cpp>
#endif
