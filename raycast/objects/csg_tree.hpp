// SPDX-License-Identifier: MIT
#pragma once

// Union, intersection and difference of solids as a tree, and where a line is inside of it: the spans of all leaves merged (Roth 1982).
//
// The crossings of a line with all leaves are visited in order; every crossing turns its leaf on or off, and where that turns the whole
// tree the line crosses the surface of the result. Leaves whose surfaces coincide are crossed at parameters that differ by rounding; taken
// one by one they would leave a film in front of a window that is cut flush with its wall. So crossings of different leaves that follow
// each other closer than `film`, measured across both surfaces, count as one: layers thinner than `film` are removed, and narrower gaps are
// filled. Of several sheets that coincide the surface is that of the first leaf that bounds the result there, as in brep/csg.
//
// The sheets of all leaves have one numbering, in the order of the leaves. Where a subtracted leaf bounds the result, the surface is that
// of the leaf with its normal reversed.

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

// A tree of solids. A node with a solid is a leaf. The placement acts on the whole node, after those of its parts.
struct CsgNode {
  std::shared_ptr<const Object> solid;
  std::string name;  // of a leaf: its sheets are called name.sheet, or name when there is one; may be empty
  CsgOperation operation = CsgOperation::unite;
  std::vector<CsgNode> parts;
  Placement placement;
};

class CsgTree {
 public:
  struct Leaf {
    PlacedObject solid;  // in the coordinates of the tree
    std::uint32_t first_sheet;
    bool taken_away;  // its complement takes part
  };
  struct Node {
    CsgOperation operation;
    std::vector<std::uint32_t> parts;  // nodes; a leaf has none
    std::uint32_t parent;
    bool first;          // of its parent's parts
    std::uint32_t leaf;  // of a leaf
  };

  // Refused: a node without parts, a leaf that is no solid or is turned inside out, an impossible placement, more than 64 levels.
  static Made<CsgTree> make(const CsgNode& root);

  // How a leaf takes part in a tree that is to be right within a box alone.
  enum class Share : std::uint8_t { all, within, full, none };  // as it is; cut off at the box; the box is in it; the box is outside of it

  // The same solid within the box, and nothing outside of it. Sheets keep their numbers; those of the box come last.
  [[nodiscard]] CsgTree cut(const std::vector<Share>& shares, const std::shared_ptr<const Object>& box) const;

  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  // the root first, parts behind their node
  [[nodiscard]] const Box& bounds() const { return bounds_; }              // empty when the bounds of the leaves leave no room
  [[nodiscard]] double film() const { return film_; }                      // a length

  [[nodiscard]] std::uint32_t sheet_count() const { return static_cast<std::uint32_t>(leaf_of_sheet_.size()); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const { return names_[sheet]; }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const;
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const;
  // What convex solids have in common is convex.
  [[nodiscard]] bool convex() const;
  [[nodiscard]] double work() const;  // as Object::work
  [[nodiscard]] std::uint32_t leaf_of(std::uint32_t sheet) const { return leaf_of_sheet_[sheet]; }
  [[nodiscard]] bool flat_sheet(std::uint32_t sheet) const { return leaves_[leaf_of_sheet_[sheet]].solid.flat(); }

  // As Object::spans. Uses no heap while no more than 32 crossings, 8 leaves and 16 nodes take part.
  void spans(const Segment& line, Spans& out) const;

  // Is the point inside? Of points on a surface it is not said. By the spans of one line through it.
  [[nodiscard]] bool contains(const glm::dvec3& p) const;

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  struct Event {
    Crossing at;  // sheet of the leaf
    std::uint32_t leaf;
    bool enters;
  };

  // Which leaves, and so which nodes, contain the point of the line that has been reached.
  class State {
   public:
    explicit State(const CsgTree& tree);
    [[nodiscard]] bool inside() const { return nodes_[0].inside; }
    void turn(std::uint32_t leaf);

    // The whole differs from `before`: the leaf whose surface is the surface of the whole here. Of parts that coincide it is the first one
    // that goes the way of its node, and what is taken away comes last.
    [[nodiscard]] std::uint32_t cause(const State& before) const;

   private:
    struct Value {
      std::uint32_t others;  // parts besides the first that contain the point
      bool first, inside;
    };
    const CsgTree* tree_;
    InlineVector<Value, 16> nodes_;
    InlineVector<std::uint32_t, 8> leaf_node_;
  };

  CsgTree() = default;

  // Do the events from `first` to before `last` and the last one count as one crossing? Not those of one leaf.
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
