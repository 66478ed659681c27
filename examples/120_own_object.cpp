// SPDX-License-Identifier: MIT
// An object of your own: derive from raycast::Object, write four methods, and every part of the program takes it. This one is a lens, the
// part that two balls of radius 1 have in common; its sheets are the two spherical caps.

#include <cstdio>

#include <brep/builder_input.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/scene.hpp>
#include <raycast/circle.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>

class Lens final : public raycast::Object {
 public:
  explicit Lens(double thickness) : offset_(1.0 - 0.5 * thickness) {}

  // 1. Where it is.
  raycast::Box bounds() const override { return {{-rim(), -rim(), offset_ - 1.0}, {rim(), rim(), 1.0 - offset_}}; }
  // 2. Where a line is inside: in both balls.
  void spans(const raycast::Segment& line, raycast::Spans& out) const override {
    raycast::Spans upper, lower;
    balls_[0]->spans(line, upper);
    balls_[1]->spans(line, lower);
    if (upper.empty() || lower.empty()) { return; }
    raycast::Span both{{upper[0].in.t, 0}, {upper[0].out.t, 0}};
    if (lower[0].in.t > both.in.t) { both.in = {lower[0].in.t, 1}; }
    if (lower[0].out.t < both.out.t) { both.out = {lower[0].out.t, 1}; }
    out.push(both);  // drops an empty span
  }
  // 3. A mesh that is no farther from it than the tolerance: rings of n points from pole to pole, the rim in the middle.
  void approximate(double tolerance, brep::Builder& out) const override {
    const std::uint32_t n = static_cast<std::uint32_t>(raycast::circle_points(0.5 * tolerance)), rim_row = n / 4, last = 2 * rim_row;
    std::uint32_t pole = 0;
    for (std::uint32_t j = 0; j <= last; ++j) {
      const double angle = std::acos(offset_) * std::min(j, last - j) / rim_row, height = std::cos(angle) - offset_;
      for (std::uint32_t i = 0; i < (j % last == 0 ? 1 : n); ++i) {
        const glm::dvec2 p = std::sin(angle) * raycast::circle_point(static_cast<int>(i), static_cast<int>(n));
        const std::uint32_t vertex = out.vertex({p.x, p.y, j < rim_row ? height : -height});
        if (j == 0) { pole = vertex; }
      }
    }
    const auto at = [&](std::uint32_t j, std::uint32_t i) { return j == 0 ? pole : pole + 1 + (j - 1) * n + (j == last ? 0 : i % n); };
    for (std::uint32_t j = 0; j < last; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        std::vector<std::uint32_t> face{at(j + 1, i), at(j + 1, i + 1), at(j, i + 1), at(j, i)};
        face.erase(std::unique(face.begin(), face.end()), face.end());  // triangles at the poles
        out.face(std::span<const std::uint32_t>(face), j < rim_row ? 0 : 1);
      }
    }
  }
  // 4. The nearest point of a sheet, and the normal there.
  raycast::SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return balls_[sheet]->project(0, p); }
  bool convex() const override { return true; }  // the rest has defaults
  std::uint32_t sheet_count() const override { return 2; }
  std::string_view sheet_name(std::uint32_t sheet) const override { return sheet == 0 ? "upper" : "lower"; }

 private:
  double rim() const { return std::sqrt(1.0 - offset_ * offset_); }
  double offset_;
  std::shared_ptr<const raycast::Object> balls_[2] = {raycast::Sphere::make({0, 0, -offset_}, 1.0).object,
                                                      raycast::Sphere::make({0, 0, offset_}, 1.0).object};
};

int main() {
  const auto lens = std::make_shared<const Lens>(0.8);
  const raycast::Scene rays({raycast::PlacedObject(lens)});
  const auto hit = rays.closest({{0, 0.1, 3}, {0, 0, -1}});
  std::printf("a ray from above meets sheet %s at t = %.4f\n", lens->sheet_name(hit->sheet).data(), hit->t);
  radiosity::Scene scene;
  scene.materials = {{"lamp", {0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}}, {"white", {0.8, 0.8, 0.8}, {0.0, 0.0, 0.0}}};
  scene.objects = {{"sun", raycast::Disk::make({0, 0, 2}, {0, 0, -1}, 0.5).object, {}, {0}}, {"lens", lens, {}, {1}}};
  const radiosity::Outcome outcome = radiosity::solve(scene);
  if (!outcome.solution) { return 1; }
  for (const auto& s : outcome.solution->audit.surfaces) { std::printf("%s: %.3f W/m2\n", s.name.c_str(), s.radiosity.x); }
}
