// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/wall_cuts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/split.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/inline.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>

namespace radiosity {

namespace detail {

struct WallFace {
  Polygon polygon;
  glm::dvec3 normal{0.0};
  raycast::Box box;
  double thickness = 0.0;  // distance from this face to the one on the other side of the wall; 0 for a sheet
};

// Share of a line across a face that walls must cover for a cut. About half, but not exactly, because regular models often cover exactly
// half and rounding would then decide.
inline constexpr double share_of_walls = 0.47;
// A few walls on a wide face, of a tent or a house on its ground, cut it even if they are short compared with it, because the area
// between them may be dark. Objects thicker than this share of their length count as blocks, not walls: cutting along a block makes long
// narrow patches, which do more harm than good.
inline constexpr double share_of_few_walls = 0.07, thickness_of_wall = 0.2;
// A wall whose foot is nearer to a face than this share of its height above the face stands on it: files of other programs have feet that
// are rounded, or a millimetre above or below the floor, and a patch that extends under such a wall would be no better than under one
// that touches.
inline constexpr double foot_gap = 0.005;
// close_gap: an object parallel to a face hides it if its distance is at most this share of its own diameter. share_hidden: its outline
// cuts a part of the face if it is at least this share of that part; with smaller objects, long narrow patches would do more harm.
// least_outline: triangles of layers of fine meshes, smaller than this share of the scene's diameter, do not cut each other.
inline constexpr double close_gap = 0.02, share_hidden = 0.03, least_outline = 0.02;
inline constexpr std::ptrdiff_t least_lines = 2, few_lines = 12;  // a single wall encloses nothing

// A line across a face, and the intervals of it on which walls stand.
struct WallLine {
  glm::dvec3 point{0.0}, normal{0.0};  // point and normal of the walls' plane
  glm::dvec3 along{0.0};               // unit
  std::vector<std::pair<double, double>> intervals;
  bool thin = true;     // are all walls on it thin?
  double hidden = 0.0;  // area of the object close to the face whose outline this line is; 0 for walls

  [[nodiscard]] double at(const glm::dvec3& p) const { return glm::dot(p - point, along); }
  // Length of the part between two places that the walls cover.
  [[nodiscard]] double covered(double from, double to) const {
    double sum = 0.0;
    double reached = from;
    for (const auto& [lo, hi] : intervals) {
      sum += std::max(0.0, std::min(hi, to) - std::max(lo, reached));
      reached = std::max(reached, hi);
    }
    return sum;
  }
};

HALFLIGHT_INLINE bool boxes_meet(const raycast::Box& a, const raycast::Box& b, double margin) {
  for (int k = 0; k < 3; ++k) {
    if (!(a.lo[k] - margin <= b.hi[k] && b.lo[k] - margin <= a.hi[k])) { return false; }
  }
  return true;
}

// Sets the thickness: the distance behind each face to the next face that looks the other way. Solids of many faces are no walls.
HALFLIGHT_INLINE void measure_thickness(std::vector<WallFace>& faces) {
  constexpr std::size_t most_faces = 256;
  for (WallFace& face : faces) {
    face.thickness = std::numeric_limits<double>::infinity();
    if (faces.size() > most_faces) { continue; }
    for (const WallFace& other : faces) {
      const double depth = glm::dot(face.normal, face.polygon[0] - other.polygon[0]);
      const bool behind = depth > 0.0 && depth < face.thickness && glm::dot(face.normal, other.normal) < -0.99;
      if (behind && boxes_meet(face.box, other.box, (1.0 + 1e-6) * depth)) { face.thickness = depth; }
    }
  }
}

HALFLIGHT_INLINE std::vector<WallFace> wall_faces(const Surface& surface) {
  std::vector<WallFace> faces;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    WallFace face{corner_polygon(surface.brep, f), {}, {}};
    const glm::dvec3 area = vector_area(face.polygon);
    if (!(glm::length(area) > 0.0)) { continue; }
    face.normal = glm::normalize(area);
    for (const glm::dvec3& p : face.polygon) { face.box.extend(p); }
    faces.push_back(std::move(face));
  }
  if (surface.object->solid()) { measure_thickness(faces); }
  return faces;
}

// Does the plane of `wall` cut off no more than a strip of this width, as the underside of a wall close above the floor cuts off of the
// walls beside it?
HALFLIGHT_INLINE bool along_border(const WallFace& face, const WallFace& wall, double width) {
  double behind = 0.0;
  double before = 0.0;
  for (const glm::dvec3& p : face.polygon) {
    const double at = glm::dot(wall.normal, p - wall.polygon[0]);
    behind = std::max(behind, -at);
    before = std::max(before, at);
  }
  return std::min(behind, before) < width;
}

// Adds the interval on which `wall` stands on the plane of `face` or passes through it, if it rises above the front of the face.
HALFLIGHT_INLINE void add_wall(const WallFace& face, const WallFace& wall, double tolerance, std::vector<WallLine>& lines) {
  const glm::dvec3 across = glm::cross(face.normal, wall.normal);
  if (!(glm::length(across) > 1e-6)) { return; }
  const glm::dvec3 along = glm::normalize(across);
  constexpr double steep = 0.5;  // sine of 30 degrees: the plane of the wall meets the face within 1.8 gaps of the foot
  const Polygon& w = wall.polygon;
  const auto height = [&](const glm::dvec3& p) { return glm::dot(face.normal, p - face.polygon[0]); };
  double top = 0.0;
  for (const glm::dvec3& p : w) { top = std::max(top, height(p)); }
  const double foot = std::max(tolerance, glm::length(across) > steep ? foot_gap * top : 0.0);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  const auto meet = [&](const glm::dvec3& p) {
    from = std::min(from, glm::dot(p - w[0], along));
    to = std::max(to, glm::dot(p - w[0], along));
  };
  for (std::size_t i = 0; i < w.size(); ++i) {
    const glm::dvec3& a = w[i];
    const glm::dvec3& b = w[(i + 1) % w.size()];
    const double ha = height(a);
    const double hb = height(b);
    if (std::abs(ha) <= foot) { meet(a); }
    if ((ha > tolerance && hb < -tolerance) || (ha < -tolerance && hb > tolerance)) { meet(a + ha / (ha - hb) * (b - a)); }
  }
  if (!(top > foot) || !(to - from > tolerance) || along_border(face, wall, foot)) { return; }
  const bool thin = wall.thickness <= thickness_of_wall * (to - from);
  for (WallLine& line : lines) {
    const double cosine = glm::dot(line.normal, wall.normal);
    if (line.hidden > 0.0 || std::abs(cosine) < 1.0 - 1e-12 || std::abs(glm::dot(line.normal, w[0] - line.point)) > tolerance) { continue; }
    const double turn = glm::dot(along, line.along) < 0.0 ? -1.0 : 1.0;
    const double shift = line.at(w[0]);
    line.intervals.emplace_back(shift + std::min(turn * from, turn * to), shift + std::max(turn * from, turn * to));
    line.thin = line.thin && thin;
    return;
  }
  lines.push_back({w[0], wall.normal, along, {{from, to}}, thin});
}

// Adds the outline of `sheet` if it is parallel to `face` and close in front of it, as a lamp under a ceiling: the face is dark behind it
// and bright beside it.
HALFLIGHT_INLINE void add_outline(const WallFace& face, const WallFace& sheet, double tolerance, std::vector<WallLine>& lines) {
  if (std::abs(glm::dot(face.normal, sheet.normal)) < 1.0 - 1e-6) { return; }
  for (const glm::dvec3& p : sheet.polygon) {
    const double height = glm::dot(face.normal, p - face.polygon[0]);
    if (!(height > tolerance && height <= close_gap * sheet.box.diameter())) { return; }
  }
  for (std::size_t i = 0; i < sheet.polygon.size(); ++i) {
    const glm::dvec3& a = sheet.polygon[i];
    const glm::dvec3 edge = sheet.polygon[(i + 1) % sheet.polygon.size()] - a;
    const double length = glm::length(edge);
    if (length > tolerance) {
      lines.push_back({a,
                       glm::normalize(glm::cross(edge, face.normal)),
                       edge / length,
                       {{0.0, length}},
                       false,
                       glm::length(vector_area(sheet.polygon))});
    }
  }
}

// Cuts one face along its lines.
HALFLIGHT_INLINE void cut_along(SurfaceBRep& brep, brep::FaceId face, std::vector<WallLine>& lines) {
  for (WallLine& line : lines) { std::sort(line.intervals.begin(), line.intervals.end()); }
  const auto thin = std::count_if(lines.begin(), lines.end(), [](const WallLine& line) { return line.thin; });
  const bool few = thin >= least_lines && thin <= few_lines;
  const auto place = [&](const SurfaceBRep& b, brep::FaceId part) {
    for (const WallLine& line : lines) {
      const brep::Cut cut = brep::AlongPlane{line.point, line.normal}(b, part);
      if (!cut.a.valid()) { continue; }
      const auto point = [&](brep::HalfedgeId h, double on) {
        return (1.0 - on) * b.data(b.vertex(h)).position + on * b.data(b.target(h)).position;
      };
      const double p = line.at(point(cut.a, cut.on_a));
      const double q = line.at(point(cut.b, cut.on_b));
      const bool outline = line.hidden > 0.0;
      if (outline && line.hidden < share_hidden * glm::length(vector_area(corner_polygon(b, part)))) { continue; }
      const double least = outline || (few && line.thin) ? share_of_few_walls : share_of_walls;
      if (line.covered(std::min(p, q), std::max(p, q)) >= least * std::abs(p - q)) { return cut; }
    }
    return brep::Cut{};
  };
  // If the operators refuse, the face stays whole, which is less exact but valid.
  (void)brep::split_recursively(
      brep, face, place, [](const SurfaceBRep&, brep::FaceId) { return false; }, 1024);
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
  std::vector<std::uint32_t> stack;
  std::size_t i = 0;
  for (; i < boxes.size() && pairs < most_pairs; ++i) {
    std::vector<std::uint32_t>& partners = result.partners[result.order[i]];
    if (may_cross_itself(surfaces[result.order[i]])) { partners.push_back(result.order[i]); }
    stack.assign(1, 0);
    while (!stack.empty()) {
      const raycast::Bvh::Node& node = tree.nodes()[stack.back()];
      stack.pop_back();
      if (!boxes_meet(boxes[i], node.box, tolerance)) { continue; }
      if (node.count == 0) {
        stack.insert(stack.end(), {node.first, node.first + 1});
        continue;
      }
      for (const std::uint32_t k : tree.items(node)) {
        if (k != i && boxes_meet(boxes[i], boxes[k], tolerance)) { partners.push_back(result.order[k]); }
      }
    }
    std::sort(partners.begin(), partners.end());
    pairs += partners.size();
  }
  result.not_looked_at = boxes.size() - i;
  return result;
}

}  // namespace detail

HALFLIGHT_INLINE std::size_t cut_at_walls(std::vector<Surface>& surfaces, double diameter, std::size_t most_pairs) {
  const double tolerance = 1e-9 * diameter;
  const auto [order, partners, not_looked_at] = detail::wall_pairs(surfaces, tolerance, most_pairs);
  std::size_t left_whole = not_looked_at;
  std::vector<std::vector<detail::WallFace>> walls(surfaces.size());  // before any cut
  for (const std::uint32_t o : order) {
    if (!partners[o].empty()) { walls[o] = detail::wall_faces(surfaces[o]); }
  }
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
      for (const std::uint32_t w : partners[o]) {
        for (const detail::WallFace& wall : walls[w]) {
          const double size = wall.box.diameter();
          if (!detail::boxes_meet(walls[o][k].box, wall.box, detail::close_gap * size)) { continue; }
          if (size >= detail::least_outline * diameter) { detail::add_outline(walls[o][k], wall, tolerance, lines); }
          if (detail::boxes_meet(walls[o][k].box, wall.box, std::max(tolerance, detail::foot_gap * size))) {
            detail::add_wall(walls[o][k], wall, tolerance, lines);
          }
        }
      }
      if (!lines.empty()) { detail::cut_along(brep, faces[k], lines); }
    }
  }
  return left_whole;
}

}  // namespace radiosity
