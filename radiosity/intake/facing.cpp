// SPDX-License-Identifier: MIT
#include <radiosity/intake/facing.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/line_query.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>

#include <radiosity/intake/backs.hpp>
#include <radiosity/intake/clean.hpp>
#include <radiosity/intake/side_light.hpp>

namespace radiosity::intake {
namespace detail {

// The pieces, numbered consecutively, and their borders.
struct PieceBorders {
  std::vector<std::uint32_t> piece;  // by face: its piece
  std::uint32_t pieces = 0;
  std::vector<double> length, met;  // by piece: length of its border, and of the part of it on which other faces lie
  std::vector<double> divides;      // by piece: length of border with another face on each side
  std::vector<double> area, backs;  // by piece: its area, and the area of its faces with polygons for both sides
  std::vector<raycast::Box> box;    // by piece
  std::vector<bool> twins;          // by piece: does each of its faces coincide with another one, or have polygons for both sides?

  explicit PieceBorders(Working& mesh) {
    std::vector<std::uint32_t> number(mesh.faces.size(), none);
    for (const Face& face : mesh.faces) {
      if (number[face.piece] == none) {
        number[face.piece] = pieces++;
        area.push_back(0.0);
        backs.push_back(0.0);
        box.emplace_back();
      }
      piece.push_back(number[face.piece]);
      const double its = brep::area(mesh.outline(face));
      area[piece.back()] += its;
      backs[piece.back()] += face.back != none ? its : 0.0;
      for (const std::uint32_t v : face.corners) { box[piece.back()].extend(mesh.positions[v]); }
    }
    length.assign(pieces, 0.0);
    met.assign(pieces, 0.0);
    divides.assign(pieces, 0.0);
    find_twins(mesh);
    for (std::uint32_t p = 0; p < pieces; ++p) { twins[p] = twins[p] || backs[p] > 0.9 * area[p]; }
    measure_across_faces(mesh, measure(mesh));
  }

  // Do closed pieces lie in the bounds of this one? Then it is probably the walls of a room rather than a part of a solid.
  [[nodiscard]] bool surrounds(std::uint32_t p) const {
    for (std::uint32_t q = 0; q < pieces; ++q) {
      if (length[q] == 0.0 && q != p && box[p].contains(box[q].lo) && box[p].contains(box[q].hi)) { return true; }
    }
    return false;
  }

 private:
  void find_twins(const Working& mesh) {
    std::vector<std::pair<std::vector<std::uint32_t>, std::uint32_t>> places;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      places.emplace_back(mesh.faces[f].corners, f);
      std::sort(places.back().first.begin(), places.back().first.end());
    }
    std::sort(places.begin(), places.end());
    twins.assign(pieces, true);
    place_.resize(places.size());
    for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
      while (end < places.size() && places[end].first == places[first].first) { ++end; }
      for (std::size_t i = first; i < end; ++i) { place_[places[i].second] = static_cast<std::uint32_t>(first); }
      if (end == first + 1) { twins[piece[places[first].second]] = false; }
    }
  }

  struct Side {
    std::uint32_t low, high, piece, place, face;
  };

  // An edge is met if a face of another piece lies on it, other than a face with the same corners. Returns the border edges that are not
  // met.
  std::vector<Side> measure(const Working& mesh) {
    std::vector<Side> sides, open;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const std::vector<std::uint32_t>& corners = mesh.faces[f].corners;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto [low, high] = std::minmax(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]);
        sides.push_back({low, high, piece[f], place_[f], f});
      }
    }
    const auto key = [](const Side& s) { return std::tie(s.low, s.high, s.piece, s.place); };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return key(a) < key(b); });
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
      while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high) { ++end; }
      const std::span<const Side> edge = std::span<const Side>(sides).subspan(first, end - first);
      const double size = glm::length(mesh.positions[edge[0].high] - mesh.positions[edge[0].low]);
      for (std::size_t i = 0, next = 0; i < edge.size(); i = next) {
        while (next < edge.size() && edge[next].piece == edge[i].piece) { ++next; }
        if (next == i + 2) { continue; }
        const auto elsewhere = [&](const Side& s) { return s.piece != edge[i].piece && s.place != edge[i].place; };
        length[edge[i].piece] += size;
        const auto other = std::find_if(edge.begin(), edge.end(), elsewhere);
        if (other == edge.end()) {
          open.push_back(edge[i]);
          continue;
        }
        met[edge[i].piece] += size;
        const bool third = std::any_of(other, edge.end(), [&](const Side& s) { return elsewhere(s) && s.place != other->place; });
        divides[edge[i].piece] += third ? size : 0.0;
      }
    }
    return open;
  }

  // An edge is also met if it crosses a face: a leg without end faces stands on the floor far from the floor's edges. That face continues
  // on both sides of it. A face that lies flat on another one does not cross it.
  void measure_across_faces(Working& mesh, const std::vector<Side>& open) {
    if (open.empty()) { return; }
    std::vector<raycast::Box> boxes;
    std::vector<raycast::Plane> plane;
    for (const Face& face : mesh.faces) {
      const std::span<const glm::dvec3> outline = mesh.outline(face);
      plane.push_back(raycast::plane_of(outline));
      boxes.emplace_back();
      for (const glm::dvec3& p : outline) { boxes.back().extend(p); }
      boxes.back() = boxes.back().grown(2.0 * mesh.tolerance);
    }
    const raycast::Bvh bvh(boxes);
    constexpr int places = 4;
    constexpr double tol_flat = 0.98;  // cosine of the angle between faces that lie on each other
    for (const Side& side : open) {
      const glm::dvec3 &a = mesh.positions[side.low], &b = mesh.positions[side.high];
      for (int k = 0; k < places; ++k) {
        const glm::dvec3 at = a + (k + 0.5) / places * (b - a), across = 4.0 * mesh.tolerance * plane[side.face].normal;
        const bool crosses = raycast::any_along(bvh, raycast::SlabTest({at - across, 2.0 * across}), 0.0, 1.0, [&](std::uint32_t f) {
          const glm::dvec3& normal = plane[f].normal;
          if (piece[f] == side.piece || std::abs(glm::dot(at - plane[f].point, normal)) > 2.0 * mesh.tolerance) { return false; }
          if (std::abs(glm::dot(normal, plane[side.face].normal)) > tol_flat) { return false; }
          return raycast::RayFrame({at - mesh.tolerance * normal, 2.0 * mesh.tolerance * normal}).winding(mesh.outline(mesh.faces[f])) != 0;
        });
        const double size = crosses ? glm::length(b - a) / places : 0.0;
        met[side.piece] += size;
        divides[side.piece] += size;
      }
    }
  }

  std::vector<std::uint32_t> place_;  // by face: an equal number for faces with the same corners
};

// Is the piece a wall without thickness between two rooms or parts of a room? Light falls on both of its sides, and the other side has no
// polygon of its own.
inline bool is_divider(const PieceBorders& borders, const PieceView& view, std::uint32_t p) {
  constexpr double tol_dark = 1e-9, much_lighter = 10.0, tol_covered = 0.01;
  const double f = view.front.light, b = view.back.light;
  return 2.0 * borders.divides[p] >= borders.length[p] && view.covered < tol_covered && std::min(f, b) > tol_dark &&
         std::max(f, b) <= much_lighter * std::min(f, b);
}

// 1: the front is the visible side, -1: the back is, 0: undecided.
inline int seen_side(const PieceView& view, bool twins) {
  constexpr double tol_dark = 1e-9, much_longer = 2.0;
  const double much_lighter = twins ? 100.0 : 10.0, f = view.front.light, b = view.back.light;
  if (std::max(f, b) > tol_dark) { return f > much_lighter * b ? 1 : b > much_lighter * f ? -1 : 0; }
  if (twins) { return 0; }
  return view.front.way > much_longer * view.back.way ? 1 : view.back.way > much_longer * view.front.way ? -1 : 0;
}

}  // namespace detail

HALFLIGHT_INLINE void turn_to_light(Working& mesh, std::span<const Material> materials, const IntakeOptions& options) {
  const detail::PieceBorders borders(mesh);
  const auto asks = [&](std::uint32_t p) { return borders.length[p] > 0.0 && 2.0 * borders.met[p] >= borders.length[p]; };
  bool any = false;
  for (std::uint32_t p = 0; p < borders.pieces; ++p) { any = any || asks(p); }
  if (!any) { return; }
  std::vector<glm::dvec3> eyes = options.eyes;
  for (const auto& lamp : options.lamps) { eyes.push_back(std::accumulate(lamp.begin(), lamp.end(), glm::dvec3(0.0)) / 6.0); }
  const std::vector<PieceView> views = SideLight(mesh, borders.piece, borders.pieces).solve(materials, eyes);
  std::vector<int> side_of(borders.pieces, 0);
  for (std::uint32_t p = 0; p < borders.pieces; ++p) {
    if (!asks(p)) { continue; }
    side_of[p] = detail::seen_side(views[p], borders.twins[p]);
    // A house is lit more strongly outside, by the sun, than in its rooms; its walls must stay visible from inside all the same.
    const bool outwards = side_of[p] < 0 && views[p].back.way > views[p].front.way;
    if (outwards && borders.surrounds(p)) { side_of[p] = 0; }
  }
  std::vector<bool> asked(mesh.faces.size()), turned(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::uint32_t p = borders.piece[f];
    asked[f] = asks(p);
    const int side = side_of[p];
    Face& face = mesh.faces[f];
    if (side == 0 && asked[f] && !face.mixed && face.back == none && is_black(materials[face.material].emission) &&
        detail::is_divider(borders, views[p], p)) {
      face.back = face.material;
      mesh.changed(ChangeKind::dividing, face.polygon);
    }
    // A lamp with a polygon for its back keeps both: it shines as given, however dark the gap behind it.
    const auto shines = [&](std::uint32_t material) { return !is_black(materials[material].emission); };
    if (side == 0 || (face.back != none && (shines(face.material) || shines(face.back)))) { continue; }
    if (side < 0) {
      face.turn();
      turned[f] = true;
      mesh.changed(ChangeKind::to_light, face.polygon);
    }
    face.mixed = false;
    if (face.back != none) { leave_out_backs(mesh, face); }
    face.back = none;
  }
  // A polygon that was given for the dark side of a sheet has been turned onto the one that was given for its light side, such as the
  // black back of a lamp onto the lamp. The latter stays.
  drop_duplicates(mesh, asked, turned);
}

}  // namespace radiosity::intake
