// SPDX-License-Identifier: MIT
#pragma once

// Finds what each pixel of a gathered picture shows.
//
// A pixel is sampled by 4 rays, one in each row and column of a grid (n-rooks), and by 16, Hammersley's points, if it or a neighbour shows
// several surfaces (adaptive supersampling; Whitted 1980). 16 rays know the share of either side of an edge to 4 % (RMS over edges of any
// direction), 64 to 1.5 %, 256 to .5 %. Where one side reflects far more than the picture does, like the inside of a lamp shade, that share
// decides: such pixels are sampled by more rays, first those where the solution's light differs most, until the expected error of all
// together is small. Emitted light does not count: most lamps are shown clipped to white, and no error is measured at their edges.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>

namespace radiosity {

class SeenSurfaces {
 public:
  // All arguments must outlive it.
  SeenSurfaces(const FinalGather& light, const View& view, const PictureBlocks& blocks);

  // Finds the fragments of all pixels. False when cancelled.
  [[nodiscard]] bool look();

  // The fragments of a block, by pixel in the order of PictureBlocks::each_pixel.
  [[nodiscard]] const std::vector<Fragment>& of(std::size_t block) const { return fragments_[block]; }
  // The surface that the first four rays of a pixel meet, or no_surface or several_surfaces.
  [[nodiscard]] std::uint32_t surface(std::size_t pixel) const { return surfaces_[pixel]; }
  // The fragments of a pixel.
  [[nodiscard]] std::span<const Fragment> at(std::uint32_t x, std::uint32_t y) const;
  // Do this pixel and its neighbours show more than one surface?
  [[nodiscard]] bool by_an_edge(std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] const FinalGather::Eye& eye() const { return eye_; }
  [[nodiscard]] const PixelSize& pixel_size() const { return pixel_size_; }

  static constexpr std::uint32_t no_surface = 0xffffffff, several_surfaces = 0xfffffffe;
  // Points of a pixel, one in each row and column of a grid.
  static constexpr std::array<glm::dvec2, 4> four{glm::dvec2{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
  template <unsigned Bits>
  [[nodiscard]] static std::array<glm::dvec2, (1u << Bits)> points();  // Hammersley's, 2^Bits of them

 private:
  void glance(std::size_t block);
  // Stores the fragments of a block, and counts their memory if they are more than before.
  void store(std::size_t block, const std::vector<Fragment>& fragments);
  // Samples those pixels of a block for which `wanted(x, y)` by rays through these points instead, a multiple of 16.
  template <class Wanted>
  void look_again(std::size_t block, const Wanted& wanted, std::span<const glm::dvec2> at);

  // The least and the largest reflected radiosity that a pixel shows, in its brightest channel, as the solution has it.
  struct Range {
    double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();  // not known
    void extend(const Range& other) {
      least = std::min(least, other.least);
      most = std::max(most, other.most);
    }
  };
  void compare_sides(std::size_t block, std::vector<Range>& ranges) const;
  // By pixel: 1 if it is to be sampled by 64 rays, 2 by 256, else 0.
  [[nodiscard]] std::vector<std::uint8_t> rounds(const std::vector<Range>& ranges) const;

  const FinalGather& light_;
  const View& view_;
  const PictureBlocks& blocks_;
  FinalGather::Eye eye_;
  PixelSize pixel_size_;
  std::vector<std::vector<Fragment>> fragments_;  // by block
  std::vector<std::uint32_t> surfaces_;           // by pixel
};

template <unsigned Bits>
std::array<glm::dvec2, (1u << Bits)> SeenSurfaces::points() {
  std::array<glm::dvec2, (1u << Bits)> result{};
  for (unsigned k = 0; k < result.size(); ++k) {
    unsigned reversed = 0;
    for (unsigned b = 0; b < Bits; ++b) { reversed |= (k >> b & 1) << (Bits - 1 - b); }
    result[k] = {(k + 0.5) / static_cast<double>(result.size()), (reversed + 0.5) / static_cast<double>(result.size())};
  }
  return result;
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/seen_surfaces.cpp>
#endif
