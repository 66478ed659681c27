// SPDX-License-Identifier: MIT
#pragma once

// Union, intersection and difference of solids as a tree, and the spans of a line inside it: the merged spans of all leaves (Roth 1982).
//
// The crossings of a line with all leaves are visited in order. Every crossing toggles its leaf, and if this toggles the whole tree, the
// line crosses the surface of the result. Leaves whose surfaces coincide are crossed at parameters that differ by rounding; taken one by
// one they would leave a film in front of a window that is flush with its wall. Therefore crossings of different leaves that are closer
// together than `film`, measured perpendicular to both surfaces, count as one: layers thinner than `film` are removed, and narrower gaps
// are filled. Of several coincident sheets the surface is that of the first leaf that bounds the result there, as in brep/csg.
//
// The sheets of all leaves are numbered consecutively, in the order of the leaves. Where a subtracted leaf bounds the result, the surface
// is that of the leaf with its normal reversed.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

namespace raycast {

enum class CsgOperation : std::uint8_t { unite, intersect, subtract };  // subtract: the first part without all others

// A tree of solids. A node with a solid is a leaf. The placement applies to the whole node, after the placements of its parts.
struct CsgNode {
  std::shared_ptr<const Object> solid;
  std::string name;  // of a leaf: its sheets are called name.sheet, or just name if there is only one; may be empty
  CsgOperation operation = CsgOperation::unite;
  std::vector<CsgNode> parts;
  Placement placement;
};

class CsgTree {
 public:
  struct Leaf {
    PlacedObject solid;  // in the coordinates of the tree
    std::uint32_t first_sheet;
    bool taken_away;  // is its complement used?
  };
  struct Node {
    CsgOperation operation;
    std::vector<std::uint32_t> parts;  // nodes; a leaf has none
    std::uint32_t parent;
    bool first;          // is it the first of its parent's parts?
    std::uint32_t leaf;  // index of the leaf; only of leaf nodes
  };

  // Refuses: a node without parts, a leaf that is not a solid or is turned inside out, an impossible placement, more than 64 levels.
  static Made<CsgTree> make(const CsgNode& root);

  // How cut() represents a leaf within a box.
  // Unchanged; intersected with the box; contains the box; disjoint from the box.
  enum class Share : std::uint8_t { all, within, full, none };

  // A tree with the same solid within the box, and nothing outside. Sheets keep their numbers; those of the box come last.
  [[nodiscard]] CsgTree cut(const std::vector<Share>& shares, const std::shared_ptr<const Object>& box) const;

  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  // the root comes first, nodes before their parts
  [[nodiscard]] const Box& bounds() const { return bounds_; }              // empty if the bounds of the leaves leave no room for the solid

  [[nodiscard]] std::uint32_t sheet_count() const { return static_cast<std::uint32_t>(leaf_of_sheet_.size()); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const { return names_[sheet]; }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const;
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const;
  // True for intersections of convex solids.
  [[nodiscard]] bool convex() const;
  [[nodiscard]] double work() const;  // as Object::work
  [[nodiscard]] std::uint32_t leaf_of(std::uint32_t sheet) const { return leaf_of_sheet_[sheet]; }
  [[nodiscard]] bool flat_sheet(std::uint32_t sheet) const { return leaves_[leaf_of_sheet_[sheet]].solid.flat(); }

  // As Object::spans. Allocates nothing on the heap for up to 32 crossings, 8 leaves and 16 nodes.
  void spans(const Segment& line, Spans& out) const;

  // Is the point inside? Undefined for points on a surface. Found by the spans of one line through the point.
  [[nodiscard]] bool contains(const glm::dvec3& p) const;

 private:
  struct Event {
    Crossing at;  // sheet: of the leaf
    std::uint32_t leaf;
    bool enters;
  };

  // Which leaves, and therefore which nodes, contain the point that has been reached on the line.
  class State {
   public:
    explicit State(const CsgTree& tree);
    [[nodiscard]] bool inside() const { return nodes_[0].inside; }
    void turn(std::uint32_t leaf);

    // If the whole differs from `before`: the leaf whose surface is that of the whole here. Of coincident parts it is the first one that
    // has changed; subtracted parts come last.
    [[nodiscard]] std::uint32_t cause(const State& before) const;

   private:
    struct Value {
      std::uint32_t others;  // number of parts after the first that contain the point
      bool first, inside;
    };
    const CsgTree* tree_;
    InlineVector<Value, 16> nodes_;
    InlineVector<std::uint32_t, 8> leaf_node_;
  };

  CsgTree() = default;

  // Do the events from `first` up to and including `last` count as one crossing? Not if `last` has the same leaf as one before it.
  [[nodiscard]] bool coincide(const Segment& line, const Event* first, const Event* last) const;

  std::string take(const CsgNode& given, const Placement& outer, std::uint32_t parent, bool first, bool taken_away, std::size_t depth);

  [[nodiscard]] Box bounds_of(std::uint32_t index) const;

  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_sheet_;
  std::vector<std::string> names_;
  Box bounds_;
  double film_ = 0.0;
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/objects/csg_tree.cpp>
#endif
