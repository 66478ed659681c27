// SPDX-License-Identifier: MIT
#include <radiosity/intake/subset.hpp>

#include <cstddef>

#include <brep/inline.hpp>

namespace radiosity::intake {

HALFLIGHT_INLINE Subsets::Subsets(const Working& mesh, const Topology& topology)
    : mesh_(mesh),
      topology_(topology),
      face_of_(topology.mate.size()),
      chosen_(mesh.faces.size(), false),
      number_(topology.mate.size(), none) {
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t s = topology.first[f]; s < topology.first[f + 1]; ++s) { face_of_[s] = f; }
  }
}

// Across the side that begins at the vertex, and across the one that ends there.
HALFLIGHT_INLINE void Subsets::number_fan(std::uint32_t side, std::uint32_t number) {
  fan_.assign(1, side);
  number_[side] = number;
  const auto add = [&](std::uint32_t other) {
    if (!chosen_[face_of_[other]] || number_[other] != none) { return; }
    number_[other] = number;
    fan_.push_back(other);
  };
  for (std::size_t i = 0; i < fan_.size(); ++i) {
    const std::uint32_t s = fan_[i], f = face_of_[s], before = (s == topology_.first[f] ? topology_.first[f + 1] : s) - 1;
    if (const std::uint32_t mate = topology_.mate[s]; mate != none) { add(topology_.next(mate, face_of_[mate])); }
    if (topology_.mate[before] != none) { add(topology_.mate[before]); }
  }
}

HALFLIGHT_INLINE Subset Subsets::of(std::span<const std::uint32_t> faces) {
  for (const std::uint32_t f : faces) { chosen_[f] = true; }
  Subset result;
  for (const std::uint32_t f : faces) {
    result.corners.emplace_back();
    for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) {
      if (number_[s] == none) {
        number_fan(s, static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(mesh_.positions[mesh_.faces[f].corners[s - topology_.first[f]]]);
      }
      result.corners.back().push_back(number_[s]);
    }
  }
  for (const std::uint32_t f : faces) {
    chosen_[f] = false;
    for (std::uint32_t s = topology_.first[f]; s < topology_.first[f + 1]; ++s) { number_[s] = none; }
  }
  return result;
}

}  // namespace radiosity::intake
