// SPDX-License-Identifier: MIT
#include <raycast/bvh.hpp>

#include <cstdint>
#include <span>
#include <utility>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh_builder.hpp>

namespace raycast {

namespace detail {

// Leaves have at most four items, unless the heuristic expects no gain from dividing a larger one.
struct BvhPolicy {
  using Real = double;
  using Bounds = Box;
  class Grid {
   public:
    template <class References>
    explicit Grid(const References& references) {
      for (const auto& reference : references) { centres_.extend(reference.box.centre()); }
      for (int k = 0; k < 3; ++k) { width_[k] = wide(k) ? centres_.hi[k] - centres_.lo[k] : infinity; }
    }
    [[nodiscard]] bool wide(int axis) const { return centres_.lo[axis] < centres_.hi[axis]; }
    [[nodiscard]] glm::dvec3 position(const Box& box) const {
      return (box.centre() - centres_.lo) / width_ * static_cast<double>(bin_count);
    }
    [[nodiscard]] double position(const Box& box, int axis) const { return position(box)[axis]; }

   private:
    Box centres_;
    glm::dvec3 width_{0.0};
  };
  static constexpr std::uint32_t few = 1;

  double item_cost;

  [[nodiscard]] static double cost(std::uint32_t count) { return count; }
  template <class Iterator>
  [[nodiscard]] static Iterator divide(Iterator, Iterator end) {
    return end;
  }
  [[nodiscard]] bool leaf(double area, std::uint32_t count, double best) const {
    return count <= 4 && !(2.0 * area + item_cost * best < item_cost * area * count);
  }
};

}  // namespace detail

HALFLIGHT_INLINE Bvh::Bvh(std::span<const Box> boxes, double item_cost) {
  BvhBuilder<detail::BvhPolicy> builder({item_cost});
  builder.references.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) { builder.references.push_back({boxes[i], i}); }
  builder.build();
  nodes_ = std::move(builder.nodes);
  items_.reserve(boxes.size());
  for (const auto& reference : builder.references) { items_.push_back(reference.item); }
}

}  // namespace raycast
