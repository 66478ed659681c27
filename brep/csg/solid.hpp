// SPDX-License-Identifier: MIT
#pragma once

// Solid<F>: an exact solid, a value that is never changed. Faces carry an attribute of the user's type F (copyable, with ==).
//
// make_solid makes one from a BRep, the operations of csg.hpp make new ones, to_brep gives the BRep back. A copy is a handle to the
// same arrays. The empty solid has no faces.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/grid.hpp>

namespace brep::csg {

template <class F = std::uint32_t>
class Solid {
 public:
  Solid() : Solid(Grid(glm::dvec3{0.0}, glm::dvec3{1.0}), {}, {}, {}) {}
  // For the operations: whoever calls this answers for the invariants of boundary.hpp. Attributes are numbers in the list. `largest`
  // is the same with faces as large as they can be, where that differs.
  Solid(Grid grid, Boundary boundary, std::optional<Boundary> largest, std::vector<F> attributes)
      : grid_(std::move(grid)),
        boundary_(std::make_shared<const Boundary>(std::move(boundary))),
        largest_(largest ? std::make_shared<const Boundary>(std::move(*largest)) : boundary_),
        attributes_(std::make_shared<const std::vector<F>>(std::move(attributes))) {}

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] bool empty() const { return largest_->faces.empty(); }
  [[nodiscard]] std::size_t face_count() const { return largest_->faces.size(); }
  [[nodiscard]] const F& attribute(std::size_t face) const { return (*attributes_)[largest_->faces[face].attribute]; }

  // The faces as large as they can be: what is exported and measured. Differs from boundary() where the solid touches itself along an edge.
  [[nodiscard]] const Boundary& faces() const { return *largest_; }
  [[nodiscard]] const Boundary& boundary() const { return *boundary_; }
  [[nodiscard]] const std::vector<F>& attributes() const { return *attributes_; }

 private:
  Grid grid_;
  std::shared_ptr<const Boundary> boundary_, largest_;
  std::shared_ptr<const std::vector<F>> attributes_;
};

// Where a face lies with respect to another solid.
enum class Side : std::uint8_t {
  outside,
  inside,
  on_same,     // on its boundary, looking the same way
  on_opposite  // on its boundary, looking the other way
};

}  // namespace brep::csg
