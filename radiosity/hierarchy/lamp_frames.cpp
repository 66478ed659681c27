// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/lamp_frames.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_lines.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// A wall is a frame if its distance from a lamp is at most `near_lamp` of the lamp's diameter, and its own at most `size_of_frame` of
// that: walls of rooms and houses with lamps in them are larger.
inline constexpr double near_lamp = 0.5, size_of_frame = 4.0;
// A frame must cover this share of a cut: with smaller ones, long narrow patches would do more harm.
inline constexpr double share_of_frame = 0.02;
inline constexpr std::size_t most_in_frame = 64;  // within a frame

HALFLIGHT_INLINE LampBoxes::LampBoxes(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  if (emission.empty()) { return; }
  for (const Surface& surface : surfaces) {
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet == brep::no_sheet || is_black(emission[surface.first_surface + sheet])) { continue; }
      raycast::Box box;
      for (const glm::dvec3& p : corner_polygon(surface.brep, f)) { box.extend(p); }
      largest_ = std::max(largest_, box.diameter());
      boxes_.push_back(box);
    }
  }
  if (boxes_.empty()) { return; }
  std::vector<raycast::Box> reach;
  for (const raycast::Box& box : boxes_) { reach.push_back(box.grown(near_lamp * box.diameter())); }
  tree_ = raycast::Bvh{reach};
}

HALFLIGHT_INLINE std::vector<raycast::Box> LampBoxes::beside(const WallFace& wall) const {
  std::vector<raycast::Box> found;
  const double size = wall.box.diameter();
  if (boxes_.empty() || size > size_of_frame * largest_) { return found; }
  const auto look = [&](std::uint32_t k) {
    const double lamp = boxes_[k].diameter();
    if (size <= size_of_frame * lamp && wall.box.meets(boxes_[k], near_lamp * lamp)) { found.push_back(boxes_[k]); }
    return found.size() > most_in_frame;
  };
  const bool many = raycast::any_within(
      tree_, [&](const raycast::Box& reach) { return reach.meets(wall.box); }, look);
  return many ? std::vector<raycast::Box>() : found;
}

// A cut along a line, and where it lies.
struct FrameCut {
  brep::Cut cut;
  const WallLine* line = nullptr;
  double from = 0.0, to = 0.0;  // on the line
  glm::dvec3 start{0.0}, end{0.0};
  double share = 0.0;  // that walls cover

  // The number of intervals of another line that this cut divides.
  [[nodiscard]] double divides(const FrameCut& other) const {
    const double tolerance = 1e-7 * glm::length(other.end - other.start);
    const auto side = [&](double on) {
      const double t = (on - other.from) / (other.to - other.from);
      return glm::dot(line->normal, (1.0 - t) * other.start + t * other.end - line->point);
    };
    double sum = 0.0;
    for (const auto& [lo, hi] : other.line->intervals) {
      const double a = side(std::clamp(lo, other.from, other.to)), b = side(std::clamp(hi, other.from, other.to));
      sum += std::min(a, b) < -tolerance && std::max(a, b) > tolerance ? 1.0 : 0.0;
    }
    return sum;
  }
};

HALFLIGHT_INLINE brep::Cut cut_at_frame(const SurfaceBRep& brep, brep::FaceId part, const std::vector<WallLine>& lines) {
  std::vector<FrameCut> cuts;
  for (const WallLine& line : lines) {
    if (!line.beside_lamp) { continue; }
    const brep::Cut cut = brep::AlongPlane{line.point, line.normal}(brep, part);
    if (!cut.a.valid()) { continue; }
    const auto point = [&](brep::HalfedgeId h, double on) {
      return (1.0 - on) * brep.data(brep.vertex(h)).position + on * brep.data(brep.target(h)).position;
    };
    FrameCut c{cut, &line, 0.0, 0.0, point(cut.a, cut.on_a), point(cut.b, cut.on_b)};
    if (line.at(c.start) > line.at(c.end)) { std::swap(c.start, c.end); }
    c.from = line.at(c.start);
    c.to = line.at(c.end);
    c.share = line.covered(c.from, c.to) / (c.to - c.from);
    if (c.share > 0.0) { cuts.push_back(c); }
  }
  constexpr std::size_t most = 64;  // of the longest covered ones
  const auto tried = cuts.begin() + static_cast<std::ptrdiff_t>(std::min(most, cuts.size()));
  std::partial_sort(cuts.begin(), tried, cuts.end(), [](const FrameCut& a, const FrameCut& b) { return a.share > b.share; });
  double best = 0.0;
  brep::Cut result;
  for (auto c = cuts.begin(); c != tried && c->share >= share_of_frame && c->share > best; ++c) {
    double divided = 0.0;
    for (const FrameCut& other : cuts) { divided += c->divides(other); }
    if (const double worth = c->share / (1.0 + divided); worth > best) {
      best = worth;
      result = c->cut;
    }
  }
  return result;
}

}  // namespace detail

}  // namespace radiosity
