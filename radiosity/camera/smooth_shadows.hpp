// SPDX-License-Identifier: MIT
#pragma once

// Finds the fragments of a gathered picture that the edge of a shadow crosses, and replaces their direct light by the mean over the part of
// the pixel that each covers.
//
// First the light of each fragment is compared with that of the same piece of surface in the neighbouring pixels: where it bends, the
// fragment is looked at in several places. If there is a step between these, so are the fragments towards which the light changes, and so
// on: a shadow narrower than a pixel, in which the middles of few pixels lie, is followed along its length. These generations are
// separated, so that the result does not depend on the order of the blocks, nor on the number of threads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/shadow_edges.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

class SmoothShadows {
 public:
  using Lights = std::vector<std::vector<Color>>;  // of the fragments, by block
  // `irradiance`: all light at the fragments' places, `indirect` that part of it that is not direct. All arguments must outlive this.
  SmoothShadows(const FinalGather& light, const View& view, const PictureBlocks& blocks, const SeenSurfaces& seen, const Lights& indirect,
                Lights& irradiance);

  // Replaces the irradiance where shadows have edges. False when cancelled.
  [[nodiscard]] bool smooth(double from, double to);

 private:
  enum class Tested : unsigned char { no, few, many };  // whether the light is known at several places, and of how many
  // A fragment whose light is wanted, and its places. `few` is empty if it is to be known at many at once.
  struct Asked {
    std::uint32_t fragment = 0;
    std::vector<PixelPlace> few, many;
  };
  struct OfBlock {
    std::vector<Tested> tested;                               // by fragment
    std::vector<double> direct;                               // by fragment: light at its place, sum of the channels
    std::vector<std::uint32_t> wanted;                        // fragments that this generation looks at, ascending
    std::vector<std::pair<std::size_t, std::uint32_t>> next;  // block and fragment: for the next generation
  };

  void begin(std::size_t block);
  // The first generation: fragments of the block at which the light bends.
  void seek(std::size_t block);
  [[nodiscard]] bool bends(std::size_t block, std::uint32_t fragment) const;
  // Averages the light of the wanted fragments of the block.
  void average(std::size_t block);
  // Makes the next generation of what all blocks found. False if that is nothing.
  [[nodiscard]] bool follow();
  // Wants the fragments beside this one towards which its light changes.
  void look_beside(std::size_t block, const Asked& own, const MeanLight& mean);

  // Calls visit(block, fragment) for those of the same piece of surface in the neighbouring pixels.
  template <class Visit>
  void each_beside(const Fragment& own, const Visit& visit) const;
  [[nodiscard]] std::vector<Asked> asked(std::size_t block) const;
  // The place where the ray through this point of the fragment's pixel meets its surface, which fills the pixel.
  [[nodiscard]] std::optional<FinalGather::Place> within(const Fragment& fragment, const glm::dvec2& at) const;
  // What the rays through `sixteen_` see in the fragment's pixel.
  [[nodiscard]] std::array<std::optional<FinalGather::Place>, 16> seen16(const Fragment& fragment) const;

  const FinalGather& light_;
  const View& view_;
  const PictureBlocks& blocks_;
  const SeenSurfaces& seen_;
  const Lights& indirect_;
  Lights& irradiance_;
  std::vector<std::uint32_t> first_;  // by pixel: its first fragment
  std::vector<OfBlock> of_;           // by block
  std::array<glm::dvec2, 16> sixteen_ = SeenSurfaces::points<4>();
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/smooth_shadows.cpp>
#endif
