// SPDX-License-Identifier: MIT
#pragma once

// Contacts: the places where the picture shows that something stands out of a surface, such as a sill under its window, a shelf on a wall
// or a box on the floor.
//
// Beside a contact indirect light changes over the distance from it. A point of indirect light that lies farther away than the sill stands
// out meets it with few rays or none, so its rays allow a sphere that reaches to the sill, and the sill's shade is lost. So a sphere must
// end where the nearest contact is: where the sill meets the wall or hides it from the camera, one pixel shows the wall and the next one
// shows what lies above the wall's plane.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>

namespace radiosity {

class Contacts {
 public:
  // All arguments must outlive it.
  Contacts(const PictureBlocks& blocks, const SeenSurfaces& seen) : blocks_{blocks}, seen_{seen}, of_{blocks.count()} {}

  // Finds the contacts in this block; different blocks may be searched in parallel.
  void find(std::size_t block);

  // Distance from the fragment to the nearest contact of its surface, in the frame; `most` if none is nearer than that.
  [[nodiscard]] double distance(const Fragment& fragment, double most) const;

 private:
  struct Contact {
    glm::dvec3 position{0.0}, normal{0.0};
    std::uint32_t object = 0;
  };
  [[nodiscard]] bool is_contact(const Fragment& fragment) const;

  const PictureBlocks& blocks_;
  const SeenSurfaces& seen_;
  std::vector<std::vector<Contact>> of_;  // by block
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/contacts.cpp>
#endif
