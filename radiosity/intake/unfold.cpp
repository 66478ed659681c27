// SPDX-License-Identifier: MIT
#include <radiosity/intake/unfold.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/planar.hpp>

#include <radiosity/intake/clean.hpp>

namespace radiosity::intake {
namespace detail {

class Unfolder {
 public:
  explicit Unfolder(Working& mesh) : mesh_(mesh), taken_(mesh.faces.size(), false) {}

  void run() {
    find_mates();
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t mate = mates_[3 * f + k];
        if (mate == none || mate / 3 < f || taken_[f] || taken_[mate / 3] || !folded(f, mate / 3)) { continue; }
        const std::vector<std::uint32_t>& corners = mesh_.faces[f].corners;
        const std::uint32_t ends[2] = {corners[k], corners[(k + 1) % 3]};  // the apex is at one end of a side at which triangles fold
        Part a = largest_part(f, ends[0]), b = largest_part(f, ends[1]);
        Part& larger = a.faces.size() >= b.faces.size() ? a : b;
        if (!larger.faces.empty()) { keep(std::move(larger)); }
      }
    }
    if (wholes_.empty()) { return; }
    std::erase_if(mesh_.faces, [&](const Face& face) { return taken_[static_cast<std::size_t>(&face - mesh_.faces.data())]; });
    mesh_.faces.insert(mesh_.faces.end(), wholes_.begin(), wholes_.end());
    std::stable_sort(mesh_.faces.begin(), mesh_.faces.end(), [](const Face& a, const Face& b) { return a.polygon < b.polygon; });
  }

 private:
  // In triangles. Fans longer than the first number are left alone, because the search for crossings is quadratic; of fans longer than the
  // second one, only the whole is tried.
  static constexpr std::size_t longest_fan = 1000, longest_in_parts = 20;

  // A fan's triangles, and their corners without the apex: one more than there are triangles.
  struct Fan {
    std::deque<std::uint32_t> faces, rim;
  };

  [[nodiscard]] bool is_triangle(std::uint32_t f) const {
    const std::vector<std::uint32_t>& c = mesh_.faces[f].corners;
    return c.size() == 3 && c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
  }

  // Triangles are neighbours across sides that they alone have, in opposite directions. Side 3 f + k begins at corner k of triangle f.
  void find_mates() {
    struct EdgeUse {
      std::uint32_t low, high, side;
      bool up;
    };
    std::vector<EdgeUse> uses;
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<std::uint32_t>& c = mesh_.faces[f].corners;
      const bool usable = is_triangle(f);
      for (std::uint32_t k = 0; k < c.size(); ++k) {
        const std::uint32_t a = c[k], b = c[(k + 1) % c.size()];
        uses.push_back({std::min(a, b), std::max(a, b), usable ? 3 * f + k : none, a < b});
      }
    }
    std::sort(uses.begin(), uses.end(),
              [](const EdgeUse& a, const EdgeUse& b) { return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side); });
    mates_.assign(3 * mesh_.faces.size(), none);
    crowded_.assign(3 * mesh_.faces.size(), false);
    for (std::size_t first = 0, end = 0; first < uses.size(); first = end) {
      while (end < uses.size() && uses[end].low == uses[first].low && uses[end].high == uses[first].high) { ++end; }
      for (std::size_t i = first; i < end && end - first > 2; ++i) {
        if (uses[i].side != none) { crowded_[uses[i].side] = true; }
      }
      const EdgeUse &a = uses[first], &b = uses[end - 1];
      if (end - first != 2 || a.side == none || b.side == none || a.up == b.up) { continue; }
      mates_[a.side] = b.side;
      mates_[b.side] = a.side;
    }
  }

  // The height above the plane of another triangle within which a corner counts as lying in it.
  [[nodiscard]] double most_height(std::span<const glm::dvec3> outline) const {
    return std::min(mesh_.tolerance, 1e-4 * brep::extent(outline));
  }
  [[nodiscard]] bool fits(std::uint32_t f, std::uint32_t other, const raycast::Plane& plane, double height) const {
    const Face &a = mesh_.faces[f], &b = mesh_.faces[other];
    return a.material == b.material && a.group == b.group && std::all_of(a.corners.begin(), a.corners.end(), [&](std::uint32_t v) {
             return std::abs(glm::dot(mesh_.positions[v] - plane.point, plane.normal)) <= height;
           });
  }
  // Do two neighbours lie in one plane with opposite orientations?
  [[nodiscard]] bool folded(std::uint32_t f, std::uint32_t g) {
    const glm::dvec3 a = brep::vector_area(mesh_.outline(mesh_.faces[f])), b = brep::vector_area(mesh_.outline(mesh_.faces[g]));
    if (!(glm::dot(a, b) < 0.0)) { return false; }
    const bool f_is_larger = glm::dot(a, a) >= glm::dot(b, b);
    const std::span<const glm::dvec3> larger = mesh_.outline(mesh_.faces[f_is_larger ? f : g]);
    return fits(f_is_larger ? g : f, f_is_larger ? f : g, raycast::plane_of(larger), most_height(larger));
  }

  [[nodiscard]] std::uint32_t corner_at(std::uint32_t f, std::uint32_t vertex) const {
    const std::vector<std::uint32_t>& c = mesh_.faces[f].corners;
    return static_cast<std::uint32_t>(std::find(c.begin(), c.end(), vertex) - c.begin());
  }

  // The triangles around the apex that are connected with `start` and lie in its plane; empty if they go all around it or are too many.
  [[nodiscard]] Fan fan_of(std::uint32_t start, std::uint32_t apex) {
    const raycast::Plane plane = raycast::plane_of(mesh_.outline(mesh_.faces[start]));
    const double height = most_height(mesh_.outline(mesh_.faces[start]));
    const auto rim = [&](std::uint32_t f, std::uint32_t step) { return mesh_.faces[f].corners[(corner_at(f, apex) + step) % 3]; };
    Fan fan{{start}, {rim(start, 1), rim(start, 2)}};
    for (const bool forwards : {true, false}) {
      for (std::uint32_t f = start;;) {
        const std::uint32_t mate = mates_[3 * f + (corner_at(f, apex) + (forwards ? 2 : 0)) % 3], next = mate == none ? none : mate / 3;
        if (next == none || taken_[next] || !fits(next, start, plane, height)) { break; }
        if (next == start || fan.faces.size() == longest_fan) { return {}; }
        forwards ? fan.faces.push_back(next) : fan.faces.push_front(next);
        forwards ? fan.rim.push_back(rim(next, 2)) : fan.rim.push_front(rim(next, 1));
        f = next;
      }
    }
    return fan;
  }

  struct Part {
    std::vector<std::uint32_t> faces, outline;
  };

  // The part of the fan that has a simple outline and is folded, all of it if possible; empty if there is none, or if this fan has been
  // tried before. Smaller parts are tried only in short fans, because there are many.
  [[nodiscard]] Part largest_part(std::uint32_t start, std::uint32_t apex) {
    const Fan fan = fan_of(start, apex);
    if (fan.faces.size() < 2 || !tried_.insert(std::uint64_t{apex} << 32U | fan.faces.front()).second) { return {}; }
    std::vector<std::size_t> folds(1, 0);  // by triangle: folds before it
    for (std::size_t i = 0; i + 1 < fan.faces.size(); ++i) { folds.push_back(folds[i] + (folded(fan.faces[i], fan.faces[i + 1]) ? 1 : 0)); }
    const std::size_t least = fan.faces.size() > longest_in_parts ? fan.faces.size() : 2;
    for (std::size_t count = fan.faces.size(); count >= least; --count) {
      for (std::size_t first = 0; first + count <= fan.faces.size(); ++first) {
        if (folds[first + count - 1] == folds[first]) { continue; }
        const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(first + count);
        Part part{{fan.faces.begin() + from, fan.faces.begin() + to}, {apex}};
        part.outline.insert(part.outline.end(), fan.rim.begin() + from, fan.rim.begin() + to + 1);
        if (nearly_sound(mesh_.outline(part.outline), mesh_.tolerance) && stands_alone(part, apex)) { return part; }
      }
    }
    return {};
  }

  // Is nothing else folded on it? At the border of a sheet that is given for both sides, triangles of its front fold on those of its back;
  // then more than two meet at sides within the sheet, and across the others lie triangles of the other orientation.
  [[nodiscard]] bool stands_alone(const Part& part, std::uint32_t apex) {
    const glm::dvec3 normal = brep::vector_area(mesh_.outline(part.outline));
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
      const std::uint32_t f = part.faces[i], at = corner_at(f, apex);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const bool within = (k == 0 && i > 0) || (k == 2 && i + 1 < part.faces.size());
        const std::uint32_t side = 3 * f + (at + k) % 3, mate = mates_[side];
        if (within) { continue; }
        if (crowded_[side]) { return false; }
        if (mate == none) { continue; }
        const std::span<const glm::dvec3> own = mesh_.outline(mesh_.faces[f]);
        const raycast::Plane plane = raycast::plane_of(own);
        const bool in_plane = fits(mate / 3, f, plane, most_height(own));
        if (in_plane && glm::dot(brep::vector_area(mesh_.outline(mesh_.faces[mate / 3])), normal) < 0.0) { return false; }
      }
    }
    return true;
  }

  void keep(Part part) {
    const std::uint32_t least = *std::min_element(part.faces.begin(), part.faces.end());
    Face whole = mesh_.faces[least];
    whole.corners = std::move(part.outline);
    for (const std::uint32_t f : part.faces) {
      if (f != least) { whole.stand_for(mesh_.faces[f]); }
      taken_[f] = true;
    }
    mesh_.changed(ChangeKind::unfolded, whole.polygon);
    wholes_.push_back(std::move(whole));
  }

  Working& mesh_;
  std::vector<std::uint32_t> mates_;         // by side
  std::vector<bool> crowded_;                // by side: do more than two faces meet there?
  std::unordered_set<std::uint64_t> tried_;  // fans, by apex and first triangle
  std::vector<bool> taken_;                  // by face: is it part of a polygon that was made whole?
  std::vector<Face> wholes_;
};

}  // namespace detail

HALFLIGHT_INLINE void unfold_fans(Working& mesh) { detail::Unfolder(mesh).run(); }

}  // namespace radiosity::intake
