// SPDX-License-Identifier: MIT
#pragma once

// Which faces a flat face lies on, such as a lamp flush in a ceiling or a rug on a floor.

#include <cstdint>
#include <vector>

#include <raycast/bvh.hpp>
#include <raycast/planar.hpp>

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>

namespace radiosity::intake {

// A face of another component that is parallel to a given one and near it, and whose outline contains the projection of its centre.
struct Contact {
  std::uint32_t face = 0;
  raycast::Plane plane;
  double height = 0.0;    // of the centre above the plane
  bool opposite = false;  // do the two have opposite orientations?
};

class FacesBeside {
 public:
  FacesBeside(Working& mesh, const Topology& topology);

  // The faces from whose planes no corner of `face` is further than `reach`, the nearest first. Left out are those in front of which the
  // face hangs by more than four tolerances of welding, facing away from them.
  [[nodiscard]] std::vector<Contact> contacts(std::uint32_t face, double reach) const;
  // Moves the vertices of the face into the plane of the contact, unless they belong to another component, too. Counts those moved by more
  // than a thousandth of the tolerance as a change of this kind.
  void lay(std::uint32_t face, const Contact& contact, ChangeKind kind) const;

  [[nodiscard]] const raycast::Bvh& bvh() const { return bvh_; }  // of all faces

 private:
  Working& mesh_;
  const Topology& topology_;
  std::vector<bool> shared_;  // by vertex: does it belong to several components?
  raycast::Bvh bvh_;
};

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/beside.cpp>
#endif
