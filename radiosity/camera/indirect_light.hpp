// SPDX-License-Identifier: MIT
#pragma once

// The indirect light of a gathered picture: gathers it at sparse points of what the pixels show, and interpolates it between them
// (indirect_points.hpp).

#include <cstddef>

#include <radiosity/camera/contacts.hpp>
#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/indirect_points.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

class IndirectLight {
 public:
  // All arguments must outlive it; `seen` is known before gather() is called.
  IndirectLight(const FinalGather& light, const PictureSize& size, const PictureBlocks& blocks, const SeenSurfaces& seen)
      : light_{light}, blocks_{blocks}, seen_{seen}, contacts_{blocks, seen}, points_{size.width, size.height} {}

  // Gathers at as many points as the fragments need. Reports progress between `from` and `to`. False when cancelled.
  [[nodiscard]] bool gather(double from, double to);
  // Interpolated irradiance of a fragment, W/m2.
  [[nodiscard]] Color at(const Fragment& fragment) const;
  // The irradiance gathered at this fragment itself.
  [[nodiscard]] FinalGather::Indirect gathered(const Fragment& fragment, const GatherRays& rays) const;

 private:
  [[nodiscard]] IndirectPoint point_at(const Fragment& fragment, const GatherRays& rays) const;

  const FinalGather& light_;
  const PictureBlocks& blocks_;
  const SeenSurfaces& seen_;
  Contacts contacts_;
  IndirectPoints points_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/indirect_light.cpp>
#endif
