// SPDX-License-Identifier: MIT
#include "apps/study/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "apps/study/stroke_font.hpp"

namespace study {
namespace {

class Canvas {
 public:
  Canvas(const Drawing& drawing, double scale) : scale_(scale) {
    picture_.width = static_cast<std::uint32_t>(std::lround(drawing.width * scale));
    picture_.height = static_cast<std::uint32_t>(std::lround(drawing.height * scale));
    picture_.rgb.assign(std::size_t{3} * picture_.width * picture_.height, 255);
    coverage_.assign(std::size_t{picture_.width} * picture_.height, 0.0F);
  }

  void draw(const Shape& shape) {
    if (shape.filled) {
      fill(shape.points);
      blend(shape.fill, shape.opacity);
    }
    if (!(shape.stroke_width > 0.0)) { return; }
    Polyline points = shape.points;
    if (shape.closed && !points.empty()) { points.push_back(points[0]); }
    for (const Polyline& part : dashed(points, shape.dashes)) { stroke(part, shape.stroke_width); }
    blend(shape.stroke, shape.opacity);
  }

  void draw(const Label& label) {
    const double width = text_width(label.text, label.size);
    const double back = label.anchor == Anchor::start ? 0.0 : label.anchor == Anchor::middle ? 0.5 * width : width;
    for (Polyline& part : text_strokes(label.text, label.size)) {
      for (glm::dvec2& p : part) {
        p.x -= back;
        p = label.at + (label.upright ? p : glm::dvec2(p.y, -p.x));
      }
      stroke(part, label.size * (label.bold ? 0.125 : 0.078));
    }
    blend(label.tone, 1.0);
  }

  apps::Picture take() { return std::move(picture_); }

 private:
  // The pixels that reach into [low, high], in pixels.
  struct Window {
    std::int64_t x0, y0, x1, y1;
  };
  [[nodiscard]] Window window(const glm::dvec2& low, const glm::dvec2& high) const {
    const auto clamped = [](double v, std::uint32_t size) {
      return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(size)));
    };
    return {clamped(std::floor(low.x), picture_.width), clamped(std::floor(low.y), picture_.height),
            clamped(std::ceil(high.x), picture_.width), clamped(std::ceil(high.y), picture_.height)};
  }
  void mark(const Window& w) {
    touched_ = {std::min(touched_.x0, w.x0), std::min(touched_.y0, w.y0), std::max(touched_.x1, w.x1), std::max(touched_.y1, w.y1)};
  }
  float& at(std::int64_t x, std::int64_t y) {
    return coverage_[static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x)];
  }

  // Round ends and joins. A line thinner than a pixel is a pixel wide and paler.
  void stroke(const Polyline& points, double width) {
    const double radius = 0.5 * std::max(1.0, width * scale_);
    const double strength = std::min(1.0, width * scale_);
    for (std::size_t i = 0; i + 1 < std::max<std::size_t>(points.size(), 2) && !points.empty(); ++i) {
      const glm::dvec2 a = scale_ * points[i];
      const glm::dvec2 b = scale_ * points[std::min(i + 1, points.size() - 1)];
      const double reach = radius + 1.0;
      const Window w =
          window({std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach}, {std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach});
      mark(w);
      const glm::dvec2 d = b - a;
      const double square = glm::dot(d, d);
      for (std::int64_t y = w.y0; y < w.y1; ++y) {
        for (std::int64_t x = w.x0; x < w.x1; ++x) {
          const glm::dvec2 p(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
          const double t = square > 0.0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
          const double covered = strength * std::clamp(radius + 0.5 - glm::distance(p, a + t * d), 0.0, 1.0);
          at(x, y) = std::max(at(x, y), static_cast<float>(covered));
        }
      }
    }
  }

  // Even-odd; four lines a pixel, exact along each.
  void fill(const Polyline& points) {
    constexpr int lines = 4;
    if (points.size() < 3) { return; }
    glm::dvec2 low = points[0];
    glm::dvec2 high = points[0];
    for (const glm::dvec2& p : points) { low = glm::min(low, p), high = glm::max(high, p); }
    const Window w = window(scale_ * low, scale_ * high);
    mark(w);
    std::vector<double> crossings;
    for (std::int64_t row = w.y0 * lines; row < w.y1 * lines; ++row) {
      const double y = (static_cast<double>(row) + 0.5) / lines;
      crossings.clear();
      for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 a = scale_ * points[i];
        const glm::dvec2 b = scale_ * points[(i + 1) % points.size()];
        if ((a.y <= y) != (b.y <= y)) { crossings.push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))); }
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        for (std::int64_t x = w.x0; x < w.x1; ++x) {
          const auto left = static_cast<double>(x);
          const double covered = std::min(crossings[i + 1], left + 1.0) - std::max(crossings[i], left);
          if (covered > 0.0) { at(x, row / lines) += static_cast<float>(covered / lines); }
        }
      }
    }
  }

  [[nodiscard]] static std::vector<Polyline> dashed(const Polyline& points, const std::vector<double>& dashes) {
    if (dashes.empty()) { return {points}; }
    std::vector<Polyline> parts;
    std::size_t k = 0;
    double left = dashes[0];
    Polyline part;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      glm::dvec2 from = points[i];
      double length = glm::distance(from, points[i + 1]);
      const glm::dvec2 along = length > 0.0 ? (points[i + 1] - from) / length : glm::dvec2(0.0);
      if (k % 2 == 0 && part.empty()) { part.push_back(from); }
      while (length > left) {
        from += left * along;
        length -= left;
        if (k % 2 == 0) {
          part.push_back(from);
          parts.push_back(std::move(part));
          part.clear();
        } else {
          part = {from};
        }
        ++k;
        left = dashes[k % dashes.size()];
      }
      left -= length;
      if (k % 2 == 0) { part.push_back(points[i + 1]); }
    }
    if (part.size() > 1) { parts.push_back(std::move(part)); }
    return parts;
  }

  // Lays the tone over the covered pixels and forgets them. Encoded values are mixed, as browsers do.
  void blend(Tone tone, double opacity) {
    for (std::int64_t y = touched_.y0; y < touched_.y1; ++y) {
      for (std::int64_t x = touched_.x0; x < touched_.x1; ++x) {
        const double part = opacity * std::min(1.0, static_cast<double>(at(x, y)));
        at(x, y) = 0.0F;
        if (!(part > 0.0)) { continue; }
        const std::size_t first = 3 * (static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x));
        for (std::size_t c = 0; c < 3; ++c) {
          const double over = (tone >> (16U - 8U * static_cast<unsigned>(c))) & 255U;
          std::uint8_t& value = picture_.rgb[first + c];
          value = static_cast<std::uint8_t>(std::lround(value + part * (over - value)));
        }
      }
    }
    touched_ = nothing;
  }

  static constexpr Window nothing{1 << 30, 1 << 30, 0, 0};

  double scale_;
  apps::Picture picture_;
  std::vector<float> coverage_;  // of the shape that is being drawn
  Window touched_ = nothing;
};

}  // namespace

apps::Picture rasterize(const Drawing& drawing, double scale) {
  Canvas canvas(drawing, scale);
  for (const auto& item : drawing.items) {
    std::visit([&canvas](const auto& shape) { canvas.draw(shape); }, item);
  }
  return canvas.take();
}

}  // namespace study
