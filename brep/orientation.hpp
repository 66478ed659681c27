// SPDX-License-Identifier: MIT
#pragma once

// Which faces must be flipped so that neighbours agree, and where that is impossible.
//
// Two faces agree when they run along their common edge in opposite directions. Over the edges with exactly two faces the
// agreement is carried from face to face; so the faces fall into patches, and in each patch every face runs with the first one or
// against it. The minority is flipped, in a tie those who run against the first face. A patch where two ways around lead to
// different answers has only one side, as a Moebius strip has; nothing in it is flipped.

#include <cstdint>
#include <vector>

#include <brep/edge_uses.hpp>

namespace brep::detail {

struct Orientation {
  std::vector<std::uint32_t> patch;  // of each face; invalid_index for skipped faces
  std::vector<bool> flip;            // of each face
  std::vector<bool> one_sided;       // of each patch

  Orientation(const Builder& builder, const EdgeUses& uses, const std::vector<bool>& skip)
      : patch(builder.face_count(), invalid_index), flip(builder.face_count(), false) {
    std::vector<std::uint32_t> members;
    for (std::uint32_t seed = 0; seed < builder.face_count(); ++seed) {
      if (skip[seed] || patch[seed] != invalid_index) continue;
      const auto id = static_cast<std::uint32_t>(one_sided.size());
      one_sided.push_back(false);
      patch[seed] = id;
      members.assign(1, seed);
      std::size_t against = 0;
      for (std::size_t i = 0; i < members.size(); ++i) {
        const std::uint32_t f = members[i], first = builder.first_corner(f);
        against += flip[f] ? 1 : 0;
        for (std::uint32_t c = first; c < first + builder.corners(f).size(); ++c) {
          const auto pair = uses.of(uses.edge(c));
          if (pair.size() != 2) continue;
          const std::uint32_t g = uses.face(pair[pair[0].corner == c ? 1 : 0].corner);
          const bool expected = flip[f] != (pair[0].forward == pair[1].forward);
          if (patch[g] == invalid_index) {
            patch[g] = id;
            flip[g] = expected;
            members.push_back(g);
          } else if (flip[g] != expected) {
            one_sided[id] = true;
          }
        }
      }
      const bool majority = 2 * against > members.size();
      for (std::uint32_t f : members) flip[f] = !one_sided[id] && flip[f] != majority;
    }
  }
};

}  // namespace brep::detail
