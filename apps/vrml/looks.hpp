// SPDX-License-Identifier: MIT
#pragma once

// Which material a part, a face or a corner has by the binding of its state, and what of it the model needs: the diffuse colour is the
// reflectance, the emissive colour a radiance L, so that the exitance is pi L.

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "apps/intake/model.hpp"
#include "apps/intake/texture.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {

class Looks {
 public:
  // Among the materials of a state; those beyond the last begin again with the first.
  using Numbers = std::vector<std::size_t>;

  // A face of a face set: its number, how many corners the faces before it have, where its first one stands among all indices.
  struct FaceCorners {
    std::size_t face = 0, before = 0, first = 0, count = 0;
  };

  Looks(Model& model, const SideFile& side_file, Notes& notes) : model_(model), side_file_(side_file), notes_(notes) {}

  // The number in the model of the material with these numbers; of several the mean of their colours.
  std::uint32_t material(const State& state, Numbers numbers, bool two_sided = false);

  // Those of a face. Corners of different materials blend into each other; a face has one colour here.
  [[nodiscard]] Numbers numbers(const Node& face_set, const State& state, const FaceCorners& of);

 private:
  [[nodiscard]] ModelMaterial made(const State& state, const Numbers& numbers, std::size_t all);

  Model& model_;
  const SideFile& side_file_;
  Notes& notes_;
  intake::PictureMeans<const Node*> pictures_;
  std::map<std::tuple<const Node*, const Node*, Numbers, bool>, std::uint32_t> known_;
};

}  // namespace apps::vrml
