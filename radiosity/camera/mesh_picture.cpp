// SPDX-License-Identifier: MIT
#include <radiosity/camera/mesh_picture.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/scene/material.hpp>

namespace radiosity {
namespace raster {

inline constexpr std::int64_t snap = 4096;  // steps between two sample points
inline constexpr double guard = 2.0;        // the side planes are this many half-widths from the middle of the view
// Distance of the near plane, relative to that of the nearest vertex ahead; but no less than the second value, relative to the farthest
// vertex, because the coordinates are rounded.
inline constexpr double near_part = 1e-6, least_near_part = 1e-12;

using Polygon = std::vector<glm::dvec3>;

// Signed "inside" distance to the planes z = near, x = +-guard w z, y = +-guard h z of view space.
struct ClipPlane {
  glm::dvec3 normal{0.0};
  double offset = 0.0;
  [[nodiscard]] double side(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

// Sutherland-Hodgman 1974. The point on a cut edge is computed from the inner to the outer end whichever way the edge
// is walked, so the two triangles at an edge get the same point, bit by bit.
HALFLIGHT_INLINE void clip(Polygon& polygon, const ClipPlane& plane, Polygon& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = plane.side(a);
    const double db = plane.side(b);
    if (da >= 0.0) { scratch.push_back(a); }
    if ((da >= 0.0) == (db >= 0.0)) { continue; }
    const bool a_inside = da >= 0.0;
    const glm::dvec3& in = a_inside ? a : b;
    const glm::dvec3& out = a_inside ? b : a;
    const double din = a_inside ? da : db;
    const double dout = a_inside ? db : da;
    scratch.push_back(in + (out - in) * (din / (din - dout)));
  }
  std::swap(polygon, scratch);
}

struct Grid {
  std::int64_t x = 0;  // in 1/snap of a sample
  std::int64_t y = 0;
};

// One convex piece of a triangle on the sample grid, with the index of its shading data.
struct Piece {
  std::array<Grid, 3> corner;  // clockwise on the screen, whose y points down: twice_area() > 0
  std::uint32_t triangle = 0;
};

// Radiosity and 1/z along the ray r = (x, y, 1) of view space: weight_i . r is the homogeneous barycentric coordinate
// of corner i (Olano and Greer 1997), and inverse_depth . r is 1/z.
struct Triangle {
  std::array<glm::dvec3, 3> weight{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
  std::array<Color, 3> color{Color(0.0), Color(0.0), Color(0.0)};
  glm::dvec3 inverse_depth{0.0};
  std::uint32_t surface = 0;
};

struct Drawing {
  std::vector<Triangle> triangles;
  std::vector<Piece> pieces;
};

class Projector {
 public:
  Projector(const View& view, double near, std::int64_t samples)
      : scale_(0.5 * static_cast<double>(view.size.width * samples * snap) / view.half_width),
        middle_x_(0.5 * static_cast<double>(view.size.width * samples * snap)),
        middle_y_(0.5 * static_cast<double>(view.size.height * samples * snap)) {
    const double w = guard * view.half_width;
    const double h = guard * view.half_height();
    planes_ = {ClipPlane{{0.0, 0.0, 1.0}, near}, ClipPlane{{1.0, 0.0, w}, 0.0}, ClipPlane{{-1.0, 0.0, w}, 0.0},
               ClipPlane{{0.0, 1.0, h}, 0.0}, ClipPlane{{0.0, -1.0, h}, 0.0}};
  }

  // Adds the visible part of the triangle a b c (view space) unless it shows its back.
  void add(const std::array<glm::dvec3, 3>& corner, const Triangle& shading, Drawing& out) {
    polygon_.assign(corner.begin(), corner.end());
    for (const ClipPlane& plane : planes_) { clip(polygon_, plane, scratch_); }
    if (polygon_.size() < 3) { return; }
    const std::size_t before = out.pieces.size();
    const auto index = static_cast<std::uint32_t>(out.triangles.size());
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i) {
      const Piece piece{{project(polygon_[0]), project(polygon_[i + 1]), project(polygon_[i])}, index};
      if (twice_area(piece.corner[0], piece.corner[1], piece.corner[2]) > 0) { out.pieces.push_back(piece); }
    }
    if (out.pieces.size() > before) { out.triangles.push_back(shading); }
  }

  static std::int64_t twice_area(const Grid& a, const Grid& b, const Grid& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

 private:
  [[nodiscard]] Grid project(const glm::dvec3& p) const {
    return {std::llround(middle_x_ + scale_ * (p.x / p.z)), std::llround(middle_y_ + scale_ * (p.y / p.z))};
  }

  double scale_;
  double middle_x_;
  double middle_y_;
  std::array<ClipPlane, 5> planes_;
  Polygon polygon_;
  Polygon scratch_;
};

HALFLIGHT_INLINE Triangle shade(const std::array<glm::dvec3, 3>& p, const glm::dvec3& normal, double volume) {
  Triangle triangle;
  triangle.inverse_depth = normal / volume;
  for (std::size_t i = 0; i < 3; ++i) { triangle.weight[i] = glm::cross(p[(i + 1) % 3], p[(i + 2) % 3]) / volume; }
  return triangle;
}

HALFLIGHT_INLINE Drawing project(const Mesh& mesh, const View& view, std::int64_t samples) {
  std::vector<glm::dvec3> points;
  double nearest = raycast::infinity, farthest = 0.0;
  points.reserve(mesh.positions.size());
  for (const glm::dvec3& position : mesh.positions) {
    points.push_back(view.to_view(position));
    farthest = std::max(farthest, points.back().z);
    if (points.back().z > 0.0) { nearest = std::min(nearest, points.back().z); }
  }
  Drawing drawing;
  if (!(farthest > 0.0)) { return drawing; }
  Projector projector(view, std::max(near_part * nearest, least_near_part * farthest), samples);
  for (const MeshFace& face : mesh.faces) {
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const std::array<const MeshCorner*, 3> corner = {&mesh.corners[face.first_corner], &mesh.corners[face.first_corner + k],
                                                       &mesh.corners[face.first_corner + k + 1]};
      const std::array<glm::dvec3, 3> p = {points[corner[0]->vertex], points[corner[1]->vertex], points[corner[2]->vertex]};
      // right x down = forward: view space is right-handed, so a face shows its front where normal . p < 0.
      const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double volume = glm::dot(normal, p[0]);
      if (!(volume < 0.0)) { continue; }
      Triangle triangle = shade(p, normal, volume);
      for (std::size_t i = 0; i < 3; ++i) { triangle.color[i] = corner[i]->radiosity; }
      triangle.surface = face.surface;
      projector.add(p, triangle, drawing);
    }
  }
  return drawing;
}

struct Sample {
  double inverse_depth = 0.0;
  std::uint32_t triangle = brep::invalid_index;
};

// Rows of samples from `first_row` on.
class Band {
 public:
  Band(std::int64_t width, std::int64_t first_row, std::int64_t rows, const View& view)
      : width_(width),
        first_row_(first_row),
        rows_(rows),
        samples_(static_cast<std::size_t>(width * rows)),
        view_(&view),
        pixel_(static_cast<double>(view.size.width) / static_cast<double>(width)) {}

  void draw(const Drawing& drawing, const Piece& piece);
  [[nodiscard]] const Sample& at(std::int64_t x, std::int64_t row) const {
    return samples_[static_cast<std::size_t>((row - first_row_) * width_ + x)];
  }
  // The ray through sample (x, y), as (x/z, y/z, 1).
  [[nodiscard]] glm::dvec3 ray(std::int64_t x, std::int64_t y) const {
    return view_->ray((static_cast<double>(x) + 0.5) * pixel_, (static_cast<double>(y) + 0.5) * pixel_);
  }

 private:
  void put(const Drawing& drawing, std::uint32_t index, std::int64_t x, std::int64_t y);

  std::int64_t width_;
  std::int64_t first_row_;
  std::int64_t rows_;
  std::vector<Sample> samples_;
  const View* view_;
  double pixel_;  // width of a sample, in pixels
};

HALFLIGHT_INLINE void Band::put(const Drawing& drawing, std::uint32_t index, std::int64_t x, std::int64_t y) {
  const Triangle& triangle = drawing.triangles[index];
  const double inverse_depth = glm::dot(triangle.inverse_depth, ray(x, y));
  Sample& sample = samples_[static_cast<std::size_t>((y - first_row_) * width_ + x)];
  const double margin = 1e-7 * std::abs(sample.inverse_depth);
  const bool nearer = inverse_depth > sample.inverse_depth + margin;
  const bool tie = !nearer && inverse_depth >= sample.inverse_depth - margin;
  if (nearer || sample.triangle == brep::invalid_index || (tie && triangle.surface >= drawing.triangles[sample.triangle].surface)) {
    sample = {inverse_depth, index};
  }
}

// First and last sample whose centre, (i + 1/2) snap, lies within lo..hi.
HALFLIGHT_INLINE std::pair<std::int64_t, std::int64_t> covered(std::int64_t lo, std::int64_t hi) {
  const auto floor_div = [](std::int64_t a) { return a >= 0 ? a / snap : -((-a + snap - 1) / snap); };
  return {floor_div(lo + snap / 2 - 1), floor_div(hi - snap / 2)};
}

HALFLIGHT_INLINE void Band::draw(const Drawing& drawing, const Piece& piece) {
  const auto& c = piece.corner;
  const auto [x_lo, x_hi] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [y_lo, y_hi] = std::minmax({c[0].y, c[1].y, c[2].y});
  auto [x_first, x_last] = covered(x_lo, x_hi);
  auto [y_first, y_last] = covered(y_lo, y_hi);
  x_first = std::max<std::int64_t>(x_first, 0);
  x_last = std::min(x_last, width_ - 1);
  y_first = std::max(y_first, first_row_);
  y_last = std::min(y_last, first_row_ + rows_ - 1);
  if (x_first > x_last || y_first > y_last) { return; }

  // Edge i runs from corner i to corner i + 1; a sample is inside where all three functions are >= 0. One on the very
  // edge belongs to the triangle for which it is a left or top edge: the function of any other edge is lowered by 1.
  std::array<std::int64_t, 3> row{};
  std::array<std::int64_t, 3> step_x{};
  std::array<std::int64_t, 3> step_y{};
  const Grid start{x_first * snap + snap / 2, y_first * snap + snap / 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const Grid& a = c[i];
    const Grid& b = c[(i + 1) % 3];
    const bool top_left = (a.y == b.y && b.x > a.x) || b.y < a.y;
    row[i] = Projector::twice_area(a, b, start) - (top_left ? 0 : 1);
    step_x[i] = -(b.y - a.y) * snap;
    step_y[i] = (b.x - a.x) * snap;
  }
  for (std::int64_t y = y_first; y <= y_last; ++y) {
    std::array<std::int64_t, 3> e = row;
    for (std::int64_t x = x_first; x <= x_last; ++x) {
      if ((e[0] | e[1] | e[2]) >= 0) { put(drawing, piece.triangle, x, y); }
      for (std::size_t i = 0; i < 3; ++i) { e[i] += step_x[i]; }
    }
    for (std::size_t i = 0; i < 3; ++i) { row[i] += step_y[i]; }
  }
}

HALFLIGHT_INLINE Color color_at(const Triangle& triangle, const glm::dvec3& ray) {
  std::array<double, 3> weight{};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = std::max(0.0, glm::dot(triangle.weight[i], ray));
    sum += weight[i];
  }
  Color result(0.0);
  for (std::size_t i = 0; i < 3 && sum > 0.0; ++i) { result += (weight[i] / sum) * triangle.color[i]; }
  return result;
}

}  // namespace raster

HALFLIGHT_INLINE std::optional<Picture> draw(const Mesh& mesh, const View& view, const Tone& tone, unsigned samples,
                                             const std::atomic<bool>* cancel) {
  const std::int64_t n = samples;
  const std::int64_t width = view.size.width * n;
  const raster::Drawing drawing = raster::project(mesh, view, n);
  Picture picture{view.size.width, view.size.height};
  // Bands keep memory small: about a million samples each.
  const auto band_pixels = std::clamp<std::int64_t>((1 << 20) / (width * n), 1, view.size.height);
  for (std::int64_t top = 0; top < view.size.height; top += band_pixels) {
    if (cancel != nullptr && cancel->load()) { return std::nullopt; }
    const std::int64_t pixels = std::min<std::int64_t>(band_pixels, view.size.height - top);
    raster::Band band(width, top * n, pixels * n, view);
    for (const raster::Piece& piece : drawing.pieces) { band.draw(drawing, piece); }
    for (std::int64_t y = top; y < top + pixels; ++y) {
      for (std::int64_t x = 0; x < view.size.width; ++x) {
        Color sum(0.0), radiosity(0.0);
        for (std::int64_t s = 0; s < n * n; ++s) {
          const std::int64_t sx = x * n + s % n;
          const std::int64_t sy = y * n + s / n;
          const std::uint32_t index = band.at(sx, sy).triangle;
          if (index == brep::invalid_index) { continue; }
          const Color color = raster::color_at(drawing.triangles[index], band.ray(sx, sy));
          radiosity += color;
          sum += tone(color);
        }
        const auto all = static_cast<double>(n * n);
        picture.set(static_cast<std::size_t>(y * view.size.width + x), sum / all, radiosity / all);
      }
    }
  }
  return picture;
}

HALFLIGHT_INLINE double automatic_exposure(const Mesh& mesh, const Scene& scene, const View& view) {
  const std::vector<InputSurface> surfaces = radiosity::surfaces(scene);
  View small = view;  // some ten thousand samples give the percentile accurately enough for the eye
  const std::uint32_t shrink = std::max(1u, std::max(view.size.width, view.size.height) / 256);
  small.size = {std::max(1u, view.size.width / shrink), std::max(1u, view.size.height / shrink)};
  const raster::Drawing drawing = raster::project(mesh, small, 1);
  raster::Band band(small.size.width, 0, small.size.height, small);
  for (const raster::Piece& piece : drawing.pieces) { band.draw(drawing, piece); }
  std::vector<double> reflected, glowing;
  double emitted = 0.0;
  for (std::int64_t y = 0; y < small.size.height; ++y) {
    for (std::int64_t x = 0; x < small.size.width; ++x) {
      const std::uint32_t index = band.at(x, y).triangle;
      if (index == brep::invalid_index) { continue; }
      const raster::Triangle& triangle = drawing.triangles[index];
      const Material& material = scene.materials[surfaces[triangle.surface].material];
      emitted = std::max(emitted, brightest(material.emission));
      if (is_black(material.reflectance)) { continue; }
      const Color radiosity = raster::color_at(triangle, band.ray(x, y));
      const double value = luminance(radiosity - material.emission);
      // The light that a lamp reflects does not tell how bright the scene is. But what glows less than it is lit is no lamp.
      (value > luminance(material.emission) ? reflected : glowing).push_back(luminance(radiosity));
    }
  }
  if (glowing.size() > reflected.size() && !reflected.empty()) { reflected.insert(reflected.end(), glowing.begin(), glowing.end()); }
  if (reflected.empty()) { return emitted > 0.0 ? std::numbers::pi / emitted : 1.0; }
  const auto place = reflected.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(reflected.size() - 1));
  std::nth_element(reflected.begin(), place, reflected.end());
  return 0.8 * std::numbers::pi / *place;
}

}  // namespace radiosity
