// SPDX-License-Identifier: MIT
#include <raycast/objects/csg_boundary.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/csg/booleans.hpp>
#include <brep/csg/grid.hpp>
#include <brep/csg/make_solid.hpp>
#include <brep/csg/slits.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/to_brep.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>
#include <brep/result.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/csg_faces.hpp>
#include <raycast/objects/csg_leaf.hpp>
#include <raycast/objects/csg_place.hpp>
#include <raycast/objects/csg_plan.hpp>
#include <raycast/objects/csg_region.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

namespace detail {

// The rotation in a placement that is a similarity (times -1 if it mirrors); nullopt for any other placement.
HALFLIGHT_INLINE std::optional<glm::dmat3> rotation_of(const glm::dmat3& m) {
  const glm::dmat3 square = glm::transpose(m) * m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(square[i][j] - (i == j ? square[0][0] : 0.0)) <= tol_rotation * square[0][0])) { return std::nullopt; }
    }
  }
  return m / std::copysign(std::sqrt(square[0][0]), glm::determinant(m));
}

class CsgEvaluation {
 public:
  using Solid = brep::csg::Solid<std::uint32_t>;

  // `most_faces`: limit for the faces of all curved leaves together.
  CsgEvaluation(const CsgPlan& plan, double most_faces)
      : most_faces_(most_faces), plan_(plan), tree_(plan.tree), chords_(tree_.leaves().size(), 0.0) {}

  CsgBoundaryResult run() {
    CsgBoundary result;
    if (!attempt(result.brep)) {  // a result finished in a frame of its own may be invalid after it is snapped again: then all on one grid
      nested_ = false;
      if (!too_many_) { refusal_.clear(); }
      if (too_many_ || !attempt(result.brep)) { return {std::nullopt, std::move(refusal_), too_many_}; }
    }
    for (const brep::FaceId f : brep::faces(result.brep)) {
      for (const brep::HalfedgeId h : brep::halfedges_of(result.brep, f)) {
        const glm::dvec3& p = result.brep.data(result.brep.vertex(h)).position;
        result.off = std::max(result.off, glm::length(tree_.project(result.brep.data(f).sheet, p).position - p));
      }
    }
    result.near = near_;
    for (const double chord : chords_) { result.chord = std::max(result.chord, chord); }
    return {std::move(result), {}, false};
  }

 private:
  bool attempt(CsgBRep& out) {
    near_ = 0.0;
    faces_ = 0;
    const Exact whole = evaluate(0);
    return refusal_.empty() && finish(whole, out);
  }

  // A solid on a grid that may be rotated relative to the tree's coordinates.
  struct Exact {
    Solid solid;
    glm::dmat3 frame{1.0};
    double near = 0.0;  // four cells of the grid
  };

  // The frame of a node is that of its first leaf with flat sheets, so that coincident faces lie on the grid together.
  [[nodiscard]] glm::dmat3 frame_of(std::uint32_t index) const {
    const CsgTree::Node& node = tree_.nodes()[index];
    for (const std::uint32_t part : node.parts) {
      const glm::dmat3 frame = frame_of(part);
      if (frame != glm::dmat3(1.0)) { return frame; }
      if (tree_.nodes()[part].parts.empty() && leaf_of(part).solid.flat()) { return frame; }
    }
    if (!node.parts.empty() || !leaf_of(index).solid.flat()) { return glm::dmat3(1.0); }
    return rotation_of(leaf_of(index).solid.placement().linear).value_or(glm::dmat3(1.0));
  }
  [[nodiscard]] const CsgTree::Leaf& leaf_of(std::uint32_t node) const { return tree_.leaves()[tree_.nodes()[node].leaf]; }
  static bool same(const glm::dmat3& a, const glm::dmat3& b) {
    double difference = 0.0;
    for (int i = 0; i < 3; ++i) { difference = std::max(difference, glm::length(a[i] - b[i])); }
    return difference < tol_frame;
  }

  // Leaves, and inner nodes of the same frame, are evaluated on the node's own grid. Inner nodes of another frame are evaluated and
  // finished in theirs, and then snapped to this grid.
  Exact evaluate(std::uint32_t index) {
    Exact result{{}, frame_of(index), 0.0};
    std::vector<Operand> operands;
    collect(index, index, result.frame, operands);
    if (!refusal_.empty()) { return result; }
    Box box;
    const glm::dmat3 back = glm::transpose(result.frame);
    for (Operand& operand : operands) {
      for (const brep::VertexId v : brep::vertices(operand.mesh)) { box.extend(back * operand.mesh.data(v).position); }
    }
    const brep::csg::Grid grid(box.lo, box.hi);
    result.near = 4 * grid.spacing();
    near_ = std::max(near_, result.near);
    std::vector<Solid> solids(operands.size());
    for (std::size_t i = 0; i < operands.size(); ++i) {
      const CsgBRep& mesh = operands[i].mesh;
      auto made = brep::csg::make_solid<std::uint32_t>(
          mesh, grid, [&](brep::VertexId v) { return back * mesh.data(v).position; }, [&](brep::FaceId f) { return mesh.data(f).sheet; });
      if (!made) {
        refusal_ = "'" + operands[i].name + "': " + made.refusal().sentence();
        return result;
      }
      solids[i] = std::move(*made);
    }
    std::size_t next = 0;
    result.solid = combine(index, result.frame, solids, next);
    return result;
  }

  struct Operand {
    CsgBRep mesh;  // in the tree's coordinates
    std::string name;
  };

  // Collects the operands of a part of the node `whole`, in the order in which combine() takes them.
  void collect(std::uint32_t whole, std::uint32_t index, const glm::dmat3& frame, std::vector<Operand>& out) {
    const CsgTree::Node& node = tree_.nodes()[index];
    if (!refusal_.empty()) { return; }
    if (node.parts.empty()) {
      out.emplace_back();
      const CsgTree::Leaf& leaf = tree_.leaves()[node.leaf];
      out.back().name = tree_.sheet_name(leaf.first_sheet);
      approximate(node.leaf, out.back());
    } else if (index != whole && own_grid(index, frame)) {
      out.emplace_back();
      Exact part = evaluate(index);
      if (refusal_.empty()) { finish(part, out.back().mesh); }
      const CsgTree::Node& first = tree_.nodes()[node.parts[0]];
      out.back().name = "a nested part";
      if (is_cut(index) && first.parts.empty()) { out.back().name = tree_.sheet_name(tree_.leaves()[first.leaf].first_sheet); }
    } else {
      for (const std::uint32_t part : node.parts) { collect(whole, part, frame, out); }
    }
  }
  void approximate(std::uint32_t index, Operand& out) {
    const CsgTree::Leaf& leaf = tree_.leaves()[index];
    const auto close = [&](const brep::Builder& builder) {
      auto closed = brep::close<CsgBRep>(builder);
      if (closed.brep) {
        out.mesh = std::move(*closed.brep);
      } else {
        refusal_ = "'" + out.name + "': its approximation is not a closed boundary: " + closed.defects.front().sentence;
      }
      return refusal_.empty();
    };
    brep::Builder builder;
    const double tolerance = plan_.tolerances[index], coarse = tol_coarse_chord * leaf.solid.bounds().diameter();
    leaf.solid.approximate(std::max(tolerance, coarse), builder);
    if (!leaf.solid.flat()) {
      // The number of faces is inversely proportional to the tolerance.
      if (tolerance < coarse && take(builder.face_count() * coarse / tolerance, out.name)) {
        builder = brep::Builder();
        leaf.solid.approximate(tolerance, builder);
      }
      std::vector<CsgPlace> places;
      for (const CsgPlace& place : plan_.places) {
        if (place.tolerance < 0.5 * tolerance && meet(place.box, leaf.solid.bounds())) { places.push_back(place); }
      }
      if (!refusal_.empty() || !close(builder)) { return; }
      if (!places.empty()) {
        CsgRefinement refinement(leaf.solid, places, out.mesh, static_cast<std::size_t>(most_faces_));
        if (refinement.changed()) {
          builder = brep::Builder();
          append(out.mesh, builder);
        }
      }
      if (!take(static_cast<double>(out.mesh.face_count()), out.name)) { return; }
      faces_ += out.mesh.face_count();
      for (const brep::FaceId f : brep::faces(out.mesh)) {
        chords_[index] = std::max(chords_[index], chord_error(leaf.solid, out.mesh, f));
      }
      chords_[index] = std::min(tolerance, 1.1 * chords_[index]);
    }
    if (!close(fans(builder))) { return; }
    for (const brep::FaceId f : brep::faces(out.mesh)) { out.mesh.data(f).sheet += leaf.first_sheet; }
  }
  // Counts so many more faces; false, with a refusal, if they exceed the limit.
  bool take(double faces, const std::string& name) {
    if (!(static_cast<double>(faces_) + faces > most_faces_)) { return true; }
    too_many_ = true;
    refusal_ = "its curved parts need more than " + std::to_string(static_cast<long long>(most_faces_)) +
               " faces in all (the last one was '" + name + "'): make several objects of it, or its parts more alike in size";
    return false;
  }
  static bool meet(const Box& a, const Box& b) {
    const glm::dvec3 lo = glm::max(a.lo, b.lo), hi = glm::min(a.hi, b.hi);
    return lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z;
  }
  // Divides convex faces of more than four corners into triangles, because after a rotation they are not planar on the grid. If they are,
  // brep/csg merges them again.
  static brep::Builder fans(const brep::Builder& polygons) {
    brep::Builder result;
    for (std::uint32_t v = 0; v < polygons.vertex_count(); ++v) { result.vertex(polygons.position(v)); }
    std::vector<glm::dvec3> positions;
    for (std::uint32_t f = 0; f < polygons.face_count(); ++f) {
      const std::span<const std::uint32_t> corners = polygons.corners(f);
      positions.clear();
      for (const std::uint32_t v : corners) { positions.push_back(polygons.position(v)); }
      if (corners.size() <= 4 || !brep::is_convex(positions)) {
        result.face(corners, polygons.sheet(f));
        continue;
      }
      for (std::size_t i = 2; i < corners.size(); ++i) { result.face({corners[0], corners[i - 1], corners[i]}, polygons.sheet(f)); }
    }
    return result;
  }
  // Is the node a leaf of the given tree that the plan intersects with a box first?
  [[nodiscard]] bool is_cut(std::uint32_t index) const {
    return index < plan_.given_nodes && !tree_.nodes()[index].parts.empty() && tree_.nodes()[index].parts[0] >= plan_.given_nodes;
  }
  [[nodiscard]] bool own_grid(std::uint32_t index, const glm::dmat3& frame) const {
    return is_cut(index) || (nested_ && !same(frame_of(index), frame));
  }

  template <class Operation>
  Solid apply(Operation&& operation, const Solid& a, const Solid& b) {
    auto result = operation(a, b);
    if (result) { return std::move(*result); }
    if (refusal_.empty()) { refusal_ = result.refusal().sentence(); }
    return a;
  }

  // Combines two at a time, so that no solid takes part in more than log n operations.
  template <class Operation>
  Solid reduce(std::vector<Solid> parts, Operation&& operation) {
    while (parts.size() > 1) {
      std::vector<Solid> pairs;
      for (std::size_t i = 0; i + 1 < parts.size(); i += 2) { pairs.push_back(apply(operation, parts[i], parts[i + 1])); }
      if (parts.size() % 2 == 1) { pairs.push_back(parts.back()); }
      parts = std::move(pairs);
    }
    return parts[0];
  }

  Solid combine(std::uint32_t index, const glm::dmat3& frame, const std::vector<Solid>& solids, std::size_t& next) {
    const CsgTree::Node& node = tree_.nodes()[index];
    if (node.parts.empty()) { return solids[next++]; }
    std::vector<Solid> parts;
    for (const std::uint32_t part : node.parts) {
      const bool leaf = tree_.nodes()[part].parts.empty() || own_grid(part, frame);
      parts.push_back(leaf ? solids[next++] : combine(part, frame, solids, next));
    }
    const auto unite = [](const Solid& a, const Solid& b) { return brep::csg::unite(a, b); };
    if (node.operation == CsgOperation::unite) { return reduce(std::move(parts), unite); }
    if (node.operation == CsgOperation::intersect) {
      return reduce(std::move(parts), [](const Solid& a, const Solid& b) { return brep::csg::intersect(a, b); });
    }
    if (parts.size() == 1) { return parts[0]; }
    const Solid away = reduce({parts.begin() + 1, parts.end()}, unite);
    return apply([](const Solid& a, const Solid& b) { return brep::csg::subtract(a, b); }, parts[0], away);
  }

  // Makes convex faces on the true sheets, in the tree's coordinates, from the exact solid.
  bool finish(const Exact& exact, CsgBRep& out) {
    out = brep::csg::to_brep<CsgBRep>(brep::csg::close_slits(exact.solid));
    for (const brep::VertexId v : brep::vertices(out)) { out.data(v).position = exact.frame * out.data(v).position; }
    if (!all_flat()) { take_away_slivers(out); }
    if (!cut(out)) { return false; }
    CsgPlacement(tree_, chords_).put_back(out, exact.near);
    for (int round = 0; round < 2 && !all_flat(); ++round) {
      take_away_slivers(out);
      if (!cut(out)) { return false; }
    }
    tell_edges_apart(out);
    return true;
  }

  [[nodiscard]] bool all_flat() const {
    return std::all_of(tree_.leaves().begin(), tree_.leaves().end(), [](const CsgTree::Leaf& leaf) { return leaf.solid.flat(); });
  }
  bool cut(CsgBRep& brep) {
    refusal_ = cut_into_convex_parts(brep, tree_);
    return refusal_.empty();
  }

  double most_faces_;
  const CsgPlan& plan_;
  const CsgTree& tree_;
  double near_ = 0.0;
  std::size_t faces_ = 0;
  bool too_many_ = false;
  std::vector<double> chords_;  // by leaf
  bool nested_ = true;
  std::string refusal_;
};

}  // namespace detail

HALFLIGHT_INLINE CsgBoundaryResult csg_boundary(const CsgTree& tree, const CsgRegion& region, double tolerance) {
  const bool flat = std::all_of(tree.leaves().begin(), tree.leaves().end(), [](const CsgTree::Leaf& leaf) { return leaf.solid.flat(); });
  constexpr double most_faces = 0x1p17;  // about 400 bytes each
  if (flat) {
    const CsgPlan plan{tree, std::vector<double>(tree.leaves().size(), tolerance), {}, tree.nodes().size(), false, {}};
    return detail::CsgEvaluation(plan, most_faces).run();
  }
  // Small parts are approximated as finely as their size asks while there are few faces; if there are many, all become coarser together.
  const double few = std::min(most_faces, 0x1p14 * std::max(1.0, 0.01 * region.whole.diameter() / tolerance));
  for (double relax = 1.0;; relax *= 4.0) {
    const CsgPlan plan = csg_plan(tree, region, tolerance, relax);
    if (!plan.refusal.empty()) { return {std::nullopt, plan.refusal, false}; }
    CsgBoundaryResult result = detail::CsgEvaluation(plan, plan.finer ? few : most_faces).run();
    if (!result.too_many_faces || !plan.finer) { return result; }
  }
}

}  // namespace raycast
