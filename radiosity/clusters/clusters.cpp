// SPDX-License-Identifier: MIT
#include <radiosity/clusters/clusters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/transform.hpp>

#include <radiosity/clusters/face_clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE std::vector<std::uint32_t> children_of(const Grouping& tree, std::uint32_t top, const std::vector<std::uint32_t>& sizes) {
  constexpr std::size_t most = 8;
  std::vector<std::uint32_t> children = tree.members(top);
  for (;;) {
    std::size_t largest = children.size();
    for (std::size_t k = 0; k < children.size(); ++k) {
      if (!tree.is_group(children[k])) { continue; }
      if (largest == children.size() || sizes[children[k]] > sizes[children[largest]]) { largest = k; }
    }
    if (largest == children.size() || children.size() - 1 + tree.members(children[largest]).size() > most) { return children; }
    const std::vector<std::uint32_t>& members = tree.members(children[largest]);
    children.insert(children.begin() + static_cast<std::ptrdiff_t>(largest) + 1, members.begin() + 1, members.end());
    children[largest] = members.front();
  }
}

// The number of items below every item and group. Members come before their groups.
HALFLIGHT_INLINE std::vector<std::uint32_t> sizes_of(const Grouping& tree) {
  std::vector<std::uint32_t> sizes(tree.items, 1);
  for (const std::vector<std::uint32_t>& members : tree.groups) {
    std::uint32_t sum = 0;
    for (const std::uint32_t m : members) { sum += sizes[m]; }
    sizes.push_back(sum);
  }
  return sizes;
}

HALFLIGHT_INLINE std::vector<raycast::Box> bounds_of(const Grouping& tree, const Hierarchy& roots,
                                                     const std::vector<std::uint32_t>& numbers) {
  std::vector<raycast::Box> boxes;
  for (const std::uint32_t i : numbers) {
    const Node& node = roots[i];
    boxes.push_back({node.centre - node.radius, node.centre + node.radius});
  }
  for (const std::vector<std::uint32_t>& members : tree.groups) {
    raycast::Box box;
    for (const std::uint32_t m : members) { box.extend(boxes[m]); }
    boxes.push_back(box);
  }
  return boxes;
}

// The groups of a bounding volume hierarchy.
HALFLIGHT_INLINE Grouping group_boxes(const std::vector<raycast::Box>& boxes) {
  const raycast::Bvh bvh{boxes};
  Grouping result{static_cast<std::uint32_t>(boxes.size()), {}, {}};
  const auto& nodes = bvh.nodes();
  std::vector<std::uint32_t> number(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    std::vector<std::uint32_t> members;
    if (nodes[i].count == 0) {
      members = {number[nodes[i].first], number[nodes[i].first + 1]};
    } else {
      const auto items = bvh.items(nodes[i]);
      members.assign(items.begin(), items.end());
    }
    number[i] = members.size() == 1 ? members.front() : result.items + static_cast<std::uint32_t>(result.groups.size());
    if (members.size() > 1) { result.groups.push_back(std::move(members)); }
  }
  if (!nodes.empty()) { result.tops.push_back(number[0]); }
  return result;
}

// Writes the nodes of a tree given by the faces and by groups of faces and groups.
class ClusterWriter {
 public:
  ClusterWriter(std::vector<Surface>& surfaces, Hierarchy faces) : surfaces_{&surfaces}, faces_{std::move(faces)} {}

  // Adds a group and returns its number. Numbers below the count of faces denote faces, others groups.
  std::uint32_t group(std::vector<std::uint32_t> members) {
    groups_.push_back(std::move(members));
    return static_cast<std::uint32_t>(faces_.size() + groups_.size() - 1);
  }

  // Adds the groups below `top` of a grouping whose items are the faces `numbers`, except those removed by flattening. Returns
  // the number of the top group.
  std::uint32_t enter(const Grouping& tree, std::uint32_t top, const std::vector<std::uint32_t>& numbers) {
    const std::vector<std::uint32_t> sizes = sizes_of(tree);
    std::vector<std::uint32_t> order{top};  // groups that are kept, parents first
    std::vector<std::vector<std::uint32_t>> children;
    std::vector<std::uint32_t> number_of(sizes.size());
    if (!tree.is_group(top)) { return numbers[top]; }
    for (std::size_t i = 0; i < order.size(); ++i) {
      children.push_back(children_of(tree, order[i], sizes));
      for (const std::uint32_t c : children.back()) {
        if (tree.is_group(c)) { order.push_back(c); }
      }
    }
    for (std::size_t i = order.size(); i-- > 0;) {
      for (std::uint32_t& c : children[i]) { c = tree.is_group(c) ? number_of[c] : numbers[c]; }
      number_of[order[i]] = group(std::move(children[i]));
    }
    return number_of[top];
  }

  // Writes the nodes. Every face must be one of the tops or below one.
  [[nodiscard]] Hierarchy write(const std::vector<std::uint32_t>& tops) {
    Hierarchy hierarchy(faces_.get_allocator());
    std::vector<std::uint32_t> number{tops};  // face or group of each node
    for (const std::uint32_t top : tops) { hierarchy.push_back(node_of(top, no_node)); }
    for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
      if (number[i] < faces_.size()) { continue; }
      const std::vector<std::uint32_t>& members = groups_[number[i] - faces_.size()];
      hierarchy[i].cluster = clusters_++;
      hierarchy[i].first_child = static_cast<std::uint32_t>(hierarchy.size());
      hierarchy[i].child_count = static_cast<std::uint32_t>(members.size());
      for (const std::uint32_t m : members) {
        hierarchy.push_back(node_of(m, i));
        number.push_back(m);
      }
    }
    // The convex parts of input faces come after all nodes above them.
    const auto above = static_cast<std::uint32_t>(hierarchy.size());
    for (std::uint32_t i = 0; i < above; ++i) {
      if (hierarchy[i].is_cluster() || hierarchy[i].leaf()) { continue; }
      const std::uint32_t part = std::exchange(hierarchy[i].first_child, static_cast<std::uint32_t>(hierarchy.size()));
      for (std::uint32_t k = 0; k < hierarchy[i].child_count; ++k) {
        hierarchy.push_back(faces_[part + k]);
        hierarchy.back().parent = i;
      }
    }
    for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
      if (hierarchy[i].leaf()) { (*surfaces_)[hierarchy[i].object].brep.data(hierarchy[i].face).node = i; }
    }
    for (std::size_t i = hierarchy.size(); i-- > 0;) {
      if (hierarchy[i].is_cluster()) { surround(hierarchy, hierarchy[i]); }
    }
    return hierarchy;
  }

 private:
  [[nodiscard]] Node node_of(std::uint32_t number, std::uint32_t parent) const {
    Node node = number < faces_.size() ? faces_[number] : Node{};
    node.parent = parent;
    return node;
  }
  // Sets area, bounding sphere and common owner from the children.
  static void surround(const Hierarchy& hierarchy, Node& node) {
    const std::uint32_t end = node.first_child + node.child_count;
    node.surface = hierarchy[node.first_child].surface;
    node.object = hierarchy[node.first_child].object;
    raycast::Box box;
    for (std::uint32_t c = node.first_child; c < end; ++c) {
      const Node& child = hierarchy[c];
      node.area += child.area;
      box.extend(child.centre - child.radius);
      box.extend(child.centre + child.radius);
      if (child.surface != node.surface) { node.surface = no_node; }
      if (child.object != node.object) { node.object = no_node; }
    }
    node.centre = box.centre();
    for (std::uint32_t c = node.first_child; c < end; ++c) {
      const Node& child = hierarchy[c];
      node.radius = std::max(node.radius, glm::length(child.centre - node.centre) + child.radius);
    }
  }

  std::vector<Surface>* surfaces_;
  Hierarchy faces_;
  std::vector<std::vector<std::uint32_t>> groups_;
  std::uint32_t clusters_ = 0;
};

}  // namespace detail

HALFLIGHT_INLINE Hierarchy make_clusters(std::vector<Surface>& surfaces, const Hierarchy& roots) {
  detail::ClusterWriter writer{surfaces, roots};
  std::vector<std::uint32_t> under_root;
  std::vector<std::uint32_t> parts;  // objects that are not rooms
  std::vector<raycast::Box> boxes;   // their bounds
  std::uint32_t first = 0;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    std::uint32_t end = first;
    while (end < roots.size() && roots[end].object == o) { ++end; }
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = first; i < end; ++i) {
      if (roots[i].parent == no_node) { numbers.push_back(i); }
    }
    std::vector<std::uint32_t> tops;
    std::vector<raycast::Box> bounds;  // of the tops
    const bool room = surfaces[o].object->inside();
    if (numbers.size() <= 8) {
      tops = !room && numbers.size() > 1 ? std::vector{writer.group(numbers)} : numbers;
      bounds.assign(tops.size(), surfaces[o].object->bounds());
    } else {
      const Grouping tree = cluster_faces(surfaces[o], roots, numbers);
      const std::vector<raycast::Box> boxes_of_tree = detail::bounds_of(tree, roots, numbers);
      for (const std::uint32_t top : tree.tops) {
        tops.push_back(writer.enter(tree, top, numbers));
        bounds.push_back(boxes_of_tree[top]);
      }
    }
    if (room) {
      under_root.insert(under_root.end(), tops.begin(), tops.end());
    } else {
      parts.insert(parts.end(), tops.begin(), tops.end());
      boxes.insert(boxes.end(), bounds.begin(), bounds.end());
    }
    first = end;
  }
  if (!parts.empty()) {
    const Grouping tree = detail::group_boxes(boxes);
    under_root.push_back(writer.enter(tree, tree.tops.front(), parts));
  }
  return writer.write({writer.group(std::move(under_root))});
}

namespace detail {

// Equal for lamps that may be in one tree. The first number is the larger the brighter.
[[nodiscard]] HALFLIGHT_INLINE std::array<int, 4> kind_of_lamp(const Color& exitance) {
  constexpr double steps = 4.0;
  const double most = brightest(exitance);
  std::array<int, 4> kind{std::ilogb(most) / 2, 0, 0, 0};
  for (int c = 0; c < 3; ++c) { kind[static_cast<std::size_t>(c) + 1] = static_cast<int>(steps * exitance[c] / most); }
  return kind;
}

template <class Visit>
void visit_faces(const Hierarchy& hierarchy, const Node& cluster, const Visit& visit) {
  for (std::uint32_t c = cluster.first_child; c < cluster.first_child + cluster.child_count; ++c) {
    hierarchy[c].is_cluster() ? visit_faces(hierarchy, hierarchy[c], visit) : visit(hierarchy[c]);
  }
}

// Makes the sphere of each cluster one around its faces. One around the spheres of its children, for a bulb, is up to twice as wide.
HALFLIGHT_INLINE void surround_faces(Hierarchy& hierarchy) {
  for (Node& node : hierarchy) {
    if (!node.is_cluster()) { continue; }
    raycast::Box box;
    visit_faces(hierarchy, node, [&](const Node& face) {
      box.extend(face.centre - face.radius);
      box.extend(face.centre + face.radius);
    });
    node.centre = box.centre();
    node.radius = 0.0;
    visit_faces(hierarchy, node,
                [&](const Node& face) { node.radius = std::max(node.radius, glm::length(face.centre - node.centre) + face.radius); });
  }
}

}  // namespace detail

HALFLIGHT_INLINE Hierarchy make_lamp_clusters(std::vector<Surface>& surfaces, const Hierarchy& roots, const std::vector<Color>& exitance) {
  detail::ClusterWriter writer{surfaces, roots};
  std::vector<std::uint32_t> tops;
  std::map<std::array<int, 4>, std::vector<std::uint32_t>, std::greater<>> lamps;  // by kind, brightest first
  for (std::uint32_t i = 0; i < roots.size(); ++i) {
    if (roots[i].parent != no_node) { continue; }
    const Color& e = exitance[roots[i].surface];
    (is_black(e) ? tops : lamps[detail::kind_of_lamp(e)]).push_back(i);
  }
  for (const auto& [kind, numbers] : lamps) {
    std::vector<raycast::Box> boxes;
    for (const std::uint32_t i : numbers) { boxes.push_back({roots[i].centre - roots[i].radius, roots[i].centre + roots[i].radius}); }
    const Grouping tree = detail::group_boxes(boxes);
    tops.push_back(writer.enter(tree, tree.tops.front(), numbers));
  }
  Hierarchy hierarchy = writer.write(tops);
  detail::surround_faces(hierarchy);
  return hierarchy;
}

HALFLIGHT_INLINE double ShownAreas::of(const Node& cluster, const Aim& towards) const {
  const double* const areas = of(cluster);
  double sum = 0.0;
  for (std::size_t j = 0; j < 3; ++j) { sum += towards.weight[j] * areas[towards.direction[j]]; }
  return sum;
}

}  // namespace radiosity
