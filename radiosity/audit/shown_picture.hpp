// SPDX-License-Identifier: MIT
#pragma once

// A picture as its audit sees it.

#include <cstdint>
#include <functional>

#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

// What the audit needs to know of a picture.
struct ShownPicture {
  std::uint32_t width = 0, height = 0;
  // The ray through the point (x, y), in pixels from the top left corner; in scene coordinates, of any length.
  std::function<raycast::Segment(double x, double y)> ray;
  // Mean radiosity that the pixel shows, W/m2 a channel, not clamped.
  std::function<Color(std::uint32_t x, std::uint32_t y)> radiosity;
  // The level, 0 to 255, at which the radiosity of one channel is displayed.
  std::function<double(double radiosity)> level;
  // Does the pixel partly show a lamp? Then it does not count. The picture's samples may find a lamp much smaller than a pixel that the
  // audit's samples miss, and the picture would seem too bright by the light of that lamp. May be empty.
  std::function<bool(std::uint32_t x, std::uint32_t y)> partly_lamp = nullptr;
};

// The picture with rays from where a camera looks whose eye lies on a surface (off_surfaces.hpp). `objects`: in the frame.
[[nodiscard]] ShownPicture from_off_surfaces(const ShownPicture& picture, const raycast::Scene& objects, const Frame& frame);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/shown_picture.cpp>
#endif
