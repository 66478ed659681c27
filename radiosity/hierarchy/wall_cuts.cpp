// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/wall_cuts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/split.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/lamp_frames.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>
#include <radiosity/hierarchy/wall_lines.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// Share of a line across a face that walls must cover for a cut. About half, but not exactly, because regular models often cover exactly
// half and rounding would then decide.
inline constexpr double share_of_walls = 0.47;
// A few thin walls on a wide face, of a tent or a house on its ground, cut it even if they are short compared with it, because the area
// between them may be dark.
inline constexpr double share_of_few_walls = 0.07;
inline constexpr std::ptrdiff_t least_lines = 2, few_lines = 12;  // a single wall encloses nothing
// share_hidden: the outline of an object close to a face cuts a part of it if it is at least this share of that part; with smaller
// objects, long narrow patches would do more harm. least_outline: triangles of layers of fine meshes, smaller than this share of the
// scene's diameter, do not cut each other.
inline constexpr double share_hidden = 0.03, least_outline = 0.02;

// Cuts one face along its lines. `tolerance`: a length.
HALFLIGHT_INLINE void cut_along(SurfaceBRep& brep, brep::FaceId face, std::vector<WallLine>& lines, double tolerance) {
  for (WallLine& line : lines) { line.join_intervals(tolerance); }
  // Frames around lamps are cut by a rule of their own, so they do not make the other walls many.
  const auto thin = std::count_if(lines.begin(), lines.end(), [](const WallLine& line) { return line.thin; });
  const auto others = std::count_if(lines.begin(), lines.end(), [](const WallLine& line) { return line.thin && !line.beside_lamp; });
  const bool few = thin >= least_lines && others <= few_lines;
  std::size_t frame_cuts = 0;
  const auto place = [&](const SurfaceBRep& b, brep::FaceId part) {
    if (frame_cuts < most_frame_cuts) {
      const brep::Cut cut = cut_at_frame(b, part, lines);
      if (cut.a.valid()) {
        ++frame_cuts;
        return cut;
      }
    }
    for (const WallLine& line : lines) {
      const brep::Cut cut = brep::AlongPlane{line.point, line.normal}(b, part);
      if (!cut.a.valid()) { continue; }
      const auto [p, q] = line.ends(b, cut);
      const bool outline = line.hidden > 0.0;
      if (outline && line.hidden < share_hidden * glm::length(vector_area(corner_polygon(b, part)))) { continue; }
      const double least = outline || (few && line.thin) ? share_of_few_walls : share_of_walls;
      if (line.covered(std::min(p, q), std::max(p, q)) >= least * std::abs(p - q)) { return cut; }
    }
    return brep::Cut{};
  };
  // If the operators refuse, the face stays whole, which is less exact but valid.
  (void)brep::split_recursively(
      brep, face, place, [](const SurfaceBRep&, brep::FaceId) { return false; }, 1024 + 2 * most_frame_cuts);
}

// Limit of the pairs of faces of an object and its partner that are examined.
inline constexpr std::size_t most_face_pairs = 10'000'000;

// May faces of this object intersect each other? Not those of a solid. Large open surfaces are not examined, because they are usually one
// sheet.
[[nodiscard]] HALFLIGHT_INLINE bool may_cross_itself(const Surface& surface) {
  const std::size_t faces = surface.object->sheet_count();
  return !surface.object->solid() && faces > 1 && faces * faces <= most_face_pairs;
}

// Pairs of objects with flat faces whose bounds meet.
struct WallPairs {
  std::vector<std::uint32_t> order;                  // objects that can be cut or can cut others
  std::vector<std::vector<std::uint32_t>> partners;  // by object, ascending
  std::size_t not_looked_at = 0;                     // number of objects not examined because there are too many pairs
};

HALFLIGHT_INLINE WallPairs wall_pairs(const std::vector<Surface>& surfaces, double tolerance, std::size_t most_pairs) {
  WallPairs result;
  result.partners.resize(surfaces.size());
  std::vector<bool> covered(surfaces.size(), false);
  for (const auto& pair : twins(surfaces)) { covered[pair[0]] = true; }
  std::vector<raycast::Box> boxes;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (!surfaces[o].object->flat() || covered[o]) { continue; }
    result.order.push_back(o);
    const raycast::Box box = surfaces[o].object->bounds();
    boxes.push_back(box.grown(close_gap * box.diameter()));
  }
  if (boxes.empty()) { return result; }
  const raycast::Bvh tree{boxes};
  std::size_t pairs = 0;
  std::size_t i = 0;
  for (; i < boxes.size() && pairs < most_pairs; ++i) {
    std::vector<std::uint32_t>& partners = result.partners[result.order[i]];
    if (may_cross_itself(surfaces[result.order[i]])) { partners.push_back(result.order[i]); }
    const auto look = [&](std::uint32_t k) {
      if (k != i && boxes[k].meets(boxes[i], tolerance)) { partners.push_back(result.order[k]); }
      return false;  // false: visit all
    };
    raycast::any_within(
        tree, [&](const raycast::Box& box) { return box.meets(boxes[i], tolerance); }, look);
    std::sort(partners.begin(), partners.end());
    pairs += partners.size();
  }
  result.not_looked_at = boxes.size() - i;
  return result;
}

// The faces of all objects, to find those near a given one.
class WallTree {
 public:
  explicit WallTree(const std::vector<std::vector<WallFace>>& walls) {
    for (std::uint32_t o = 0; o < walls.size(); ++o) {
      for (const WallFace& wall : walls[o]) {
        places_.push_back({o, &wall});
        boxes_.push_back(wall.box.grown(close_gap * wall.box.diameter()));
      }
    }
    tree_ = raycast::Bvh{boxes_};
  }

  // Faces of these objects (ascending) that are as near to the box as close_gap of their own size, in their order.
  [[nodiscard]] std::vector<const WallFace*> near(const raycast::Box& box, const std::vector<std::uint32_t>& objects) const {
    std::vector<std::uint32_t> found;
    const auto look = [&](std::uint32_t i) {
      if (boxes_[i].meets(box) && std::binary_search(objects.begin(), objects.end(), places_[i].object)) { found.push_back(i); }
      return false;  // false: visit all
    };
    raycast::any_within(
        tree_, [&](const raycast::Box& other) { return other.meets(box); }, look);
    std::sort(found.begin(), found.end());
    std::vector<const WallFace*> faces;
    for (const std::uint32_t i : found) { faces.push_back(places_[i].face); }
    return faces;
  }

 private:
  struct Place {
    std::uint32_t object;
    const WallFace* face;
  };
  std::vector<Place> places_;  // sorted by object
  std::vector<raycast::Box> boxes_;
  raycast::Bvh tree_;
};

}  // namespace detail

HALFLIGHT_INLINE std::size_t cut_at_walls(std::vector<Surface>& surfaces, double diameter, std::size_t most_pairs,
                                          const std::vector<Color>& emission) {
  const double tolerance = 1e-9 * diameter;
  const auto [order, partners, not_looked_at] = detail::wall_pairs(surfaces, tolerance, most_pairs);
  std::size_t left_whole = not_looked_at;
  const detail::LampBoxes lamps{surfaces, emission};
  std::vector<std::vector<detail::WallFace>> walls(surfaces.size());  // before any cut
  for (const std::uint32_t o : order) {
    if (partners[o].empty()) { continue; }
    walls[o] = detail::wall_faces(surfaces[o]);
    for (detail::WallFace& wall : walls[o]) { wall.lamps = lamps.beside(wall); }
  }
  const detail::WallTree tree(walls);
  for (const std::uint32_t o : order) {
    SurfaceBRep& brep = surfaces[o].brep;
    std::vector<brep::FaceId> faces;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (!partners[o].empty() && brep.data(f).sheet != brep::no_sheet) { faces.push_back(f); }
    }
    std::size_t face_pairs = 0;
    for (const std::uint32_t w : partners[o]) { face_pairs += w == o ? 0 : faces.size() * walls[w].size(); }
    left_whole += face_pairs > detail::most_face_pairs ? 1 : 0;
    if (faces.size() != walls[o].size() || face_pairs > detail::most_face_pairs) { continue; }
    for (std::size_t k = 0; k < faces.size(); ++k) {
      std::vector<detail::WallLine> lines;
      for (const detail::WallFace* const wall : tree.near(walls[o][k].box, partners[o])) {
        const double size = wall->box.diameter();
        if (size >= detail::least_outline * diameter) { detail::add_outline(walls[o][k], *wall, tolerance, lines); }
        if (walls[o][k].box.meets(wall->box, std::max(tolerance, detail::foot_gap * size))) {
          detail::add_wall(walls[o][k], *wall, tolerance, lines);
        }
      }
      if (!lines.empty()) { detail::cut_along(brep, faces[k], lines, tolerance); }
    }
  }
  return left_whole;
}

}  // namespace radiosity
