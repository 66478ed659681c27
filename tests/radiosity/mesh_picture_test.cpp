// SPDX-License-Identifier: MIT
#include "catch.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "radiosity/scenes.hpp"
#include "small_mesh.hpp"

namespace {

using radiosity::Color;
using std::numbers::pi;

// Looks along -z from (0, 0, 1): at z = 0 the picture shows x and y from -1 to 1, y upwards.
radiosity::View view(std::uint32_t pixels) {
  const radiosity::Camera camera{.eye = {0.0, 0.0, 1.0}, .forward = {0.0, 0.0, -1.0}, .up = {0.0, 1.0, 0.0}, .field_of_view = 90.0};
  return radiosity::make_view(camera, {pixels, pixels});
}

radiosity::Picture picture(const radiosity::Mesh& mesh, std::uint32_t pixels, unsigned samples = 1, double exposure = 1.0) {
  return radiosity::draw(mesh, view(pixels), exposure, samples).value();
}

// A quadrilateral in the plane z = 0 that faces the camera.
void add_rectangle(radiosity::Mesh& mesh, const glm::dvec2& lo, const glm::dvec2& hi, const Color& color, std::uint32_t surface = 0) {
  add_face(mesh, {{{lo, 0.0}, color}, {{hi.x, lo.y, 0.0}, color}, {{hi, 0.0}, color}, {{lo.x, hi.y, 0.0}, color}}, surface);
}

// Surface 0 is a wall, surface 1 a lamp, as are the materials.
radiosity::Scene wall_and_lamp() {
  radiosity::Scene scene;
  scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.1}, Color{1000.0}}};
  scene.objects = {scenes::square("wall", {0, 0, 0}, 1.0, true, 0), scenes::square("lamp", {9, 0, 0}, 1.0, true, 1)};
  return scene;
}

}  // namespace

TEST_CASE("a rectangle covers exactly its pixels, the right way up") {
  radiosity::Mesh mesh;
  add_rectangle(mesh, {-0.5, 0.0}, {0.25, 0.75}, Color(pi));  // columns 2 to 4, rows 1 to 3 of 8
  const radiosity::Picture p = picture(mesh, 8);
  for (std::uint32_t y = 0; y < 8; ++y) {
    for (std::uint32_t x = 0; x < 8; ++x) {
      const bool inside = x >= 2 && x < 5 && y >= 1 && y < 4;
      CHECK(int{p.pixel(x, y)[0]} == (inside ? 255 : 0));
    }
  }
}

TEST_CASE("back faces are not drawn") {
  radiosity::Mesh mesh;
  add_face(mesh, {{{-1.0, -1.0, 0.0}, Color(pi)}, {{-1.0, 1.0, 0.0}, Color(pi)}, {{1.0, 1.0, 0.0}, Color(pi)}});
  for (const glm::vec3& shown : picture(mesh, 16).shown) { CHECK(shown == glm::vec3{0.0f}); }
}

// Every sample of a fan of triangles belongs to exactly one of them: each alone covers its share, together they
// leave no gap, and the shares add up, so none is covered twice. Corners lie on samples and off them.
TEST_CASE("triangles that share edges leave no gap and no double pixel") {
  constexpr std::uint32_t n = 32;
  std::mt19937 random(7);
  INFO("seed 7");
  for (int run = 0; run < 50; ++run) {
    const bool on_samples = run % 2 == 0;
    const auto coordinate = [&](double range) {
      const double x = range * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0);
      return on_samples ? (std::round(x * n / 2) + 0.5) / (n / 2.0) : x;
    };
    const glm::dvec3 centre(coordinate(0.5), coordinate(0.5), 0.0);
    const std::array<glm::dvec3, 4> corner = {glm::dvec3(-1.5, -1.5, 0.0), glm::dvec3(1.5, -1.5, 0.0), glm::dvec3(1.5, 1.5, 0.0),
                                              glm::dvec3(-1.5, 1.5, 0.0)};
    std::vector<int> count(n * n, 0);
    radiosity::Mesh all;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3 middle = 0.5 * (corner[i] + corner[(i + 1) % 4]) + glm::dvec3(coordinate(0.3), coordinate(0.3), 0.0);
      for (int half = 0; half < 2; ++half) {
        const glm::dvec3& a = half == 0 ? corner[i] : middle;
        const glm::dvec3& b = half == 0 ? middle : corner[(i + 1) % 4];
        radiosity::Mesh one;
        add_face(one, {{centre, Color(pi)}, {a, Color(pi)}, {b, Color(pi)}});
        add_face(all, {{centre, Color(pi)}, {a, Color(pi)}, {b, Color(pi)}});
        const radiosity::Picture p = picture(one, n);
        for (std::size_t k = 0; k < n * n; ++k) { count[k] += p.shown[k].x > 0.999f ? 1 : 0; }
      }
    }
    const radiosity::Picture together = picture(all, n);
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < n * n; ++k) { wrong += count[k] == 1 && together.shown[k].x > 0.999f ? 0 : 1; }
    // The outer border may be pulled inwards by `middle`, but never as far as the picture (1.5 - 0.3 > 1).
    CHECK(wrong == 0);
  }
}

TEST_CASE("the nearer face hides the farther one, and of coplanar ones the later surface is seen") {
  radiosity::Mesh mesh;
  const Color red(pi, 0.0, 0.0);
  const Color green(0.0, pi, 0.0);
  add_face(mesh, {{{-1.0, -1.0, 0.5}, green}, {{0.0, -1.0, 0.5}, green}, {{0.0, 1.0, 0.5}, green}, {{-1.0, 1.0, 0.5}, green}}, 1);
  add_rectangle(mesh, {-1.0, -1.0}, {1.0, 1.0}, red, 2);
  const radiosity::Picture p = picture(mesh, 8);
  CHECK(p.pixel(1, 4) == radiosity::Rgb8{0, 255, 0});
  CHECK(p.pixel(6, 4) == radiosity::Rgb8{255, 0, 0});

  // A lamp in a ceiling that is cut differently, seen at a grazing angle.
  radiosity::Mesh ceiling;
  add_rectangle(ceiling, {0.1, 0.1}, {0.7, 0.8}, green, 5);
  for (int i = -7; i < 7; ++i) {
    for (int j = -7; j < 7; ++j) { add_rectangle(ceiling, {i / 7.0, j / 7.0}, {(i + 1) / 7.0, (j + 1) / 7.0}, red, 4); }
  }
  const radiosity::Camera camera{.eye = {-3.0, 0.3, 0.11}, .forward = {3.0, 0.1, -0.11}, .field_of_view = 30.0};
  const radiosity::Picture grazing = radiosity::draw(ceiling, radiosity::make_view(camera, {300, 100}), 1.0, 1).value();
  std::size_t green_seen = 0;
  for (const glm::vec3& shown : grazing.shown) {
    CHECK(shown.x + shown.y <= 1.0f);
    green_seen += shown.y == 1.0f ? 1 : 0;
  }
  radiosity::Mesh lamp_alone;
  add_rectangle(lamp_alone, {0.1, 0.1}, {0.7, 0.8}, green, 5);
  const radiosity::Picture alone = radiosity::draw(lamp_alone, radiosity::make_view(camera, {300, 100}), 1.0, 1).value();
  std::size_t expected = 0;
  for (const glm::vec3& shown : alone.shown) { expected += shown.y == 1.0f ? 1 : 0; }
  CHECK(green_seen == expected);
  CHECK(expected > 50);
}

TEST_CASE("radiosity is linear in space, not on the screen") {
  // A strip that runs from distance 1 to distance 3 along the line of sight; its radiosity falls from pi to 0.
  radiosity::Mesh mesh;
  const Color bright(pi);
  const Color dark(0.0);
  add_face(mesh, {{{-9.0, -0.5, -2.0}, dark}, {{-9.0, -0.5, 0.0}, bright}, {{9.0, -0.5, 0.0}, bright}, {{9.0, -0.5, -2.0}, dark}});
  const radiosity::Picture p = picture(mesh, 512);
  // A ray through image height -h meets y = -0.5 at distance 0.5 / h.
  for (const double distance : {1.1, 1.5, 2.0, 2.7}) {
    const double row = 256.0 * (1.0 + 0.5 / distance);
    const double seen = 0.5 / ((std::floor(row) + 0.5) / 256.0 - 1.0);  // at the pixel's own centre
    const double linear = 1.0 - (seen - 1.0) / 2.0;
    CHECK(std::abs(int{p.pixel(256, static_cast<std::uint32_t>(row))[0]} - int{radiosity::to_byte(linear)}) <= 1);
  }
}

TEST_CASE("a face that passes the camera is cut at the near plane") {
  radiosity::Mesh mesh;  // a floor under the camera that reaches far behind it
  add_face(mesh, {{{-50.0, -0.5, 50.0}, Color(pi)},
                  {{50.0, -0.5, 50.0}, Color(pi)},
                  {{50.0, -0.5, -50.0}, Color(pi)},
                  {{-50.0, -0.5, -50.0}, Color(pi)}});
  const radiosity::Picture p = picture(mesh, 64);
  for (std::uint32_t x = 0; x < 64; ++x) {
    CHECK(int{p.pixel(x, 20)[0]} == 0);
    CHECK(int{p.pixel(x, 40)[0]} == 255);
    CHECK(int{p.pixel(x, 63)[0]} == 255);
  }
}

TEST_CASE("exposure is linear in light, pixels are sRGB") {
  // IEC 61966-2-1: linear 0.5 is 188, 0.18 is 118, 0.001 is 3.
  CHECK(int{radiosity::to_byte(0.5)} == 188);
  CHECK(int{radiosity::to_byte(0.18)} == 118);
  CHECK(int{radiosity::to_byte(0.001)} == 3);
  CHECK(int{radiosity::to_byte(0.0)} == 0);
  CHECK(int{radiosity::to_byte(1.0)} == 255);
  radiosity::Mesh mesh;
  add_rectangle(mesh, {-1.0, -1.0}, {1.0, 1.0}, Color(0.25 * pi, 0.05 * pi, 40.0));
  CHECK(picture(mesh, 4, 1, 2.0).pixel(1, 1) == radiosity::Rgb8{radiosity::to_byte(0.5), radiosity::to_byte(0.1), 255});
  CHECK(picture(mesh, 4, 4, 0.5).pixel(1, 1)[0] == radiosity::to_byte(0.125));
}

TEST_CASE("samples are clamped before they are averaged: the edge of a bright lamp stays smooth") {
  radiosity::Mesh mesh;
  add_rectangle(mesh, {-1.0, -1.0}, {0.125, 1.0}, Color(1000.0 * pi));  // half of column 4 of 8
  const radiosity::Picture p = picture(mesh, 8, 4);
  CHECK(int{p.pixel(3, 3)[0]} == 255);
  CHECK(int{p.pixel(4, 3)[0]} == int{radiosity::to_byte(0.5)});
  CHECK(int{p.pixel(5, 3)[0]} == 0);
}

TEST_CASE("the picture does not depend on its bands and stops when asked to") {
  radiosity::Mesh mesh;
  add_face(mesh,
           {{{-0.9, -0.8, 0.0}, Color(pi, 0.0, 0.0)}, {{0.9, -0.3, 0.0}, Color(0.0, pi, 0.0)}, {{-0.2, 0.9, 0.0}, Color(0.0, 0.0, pi)}});
  // 1600 x 1600 at 4 x 4 samples takes many bands; every 2 x 2 block averages to the picture at half the size, whose
  // samples are every second one of it only up to colour, so compare coverage alone.
  const radiosity::Picture large = picture(mesh, 1600, 1);
  const radiosity::Picture small = picture(mesh, 400, 4);
  std::size_t wrong = 0;
  for (std::uint32_t y = 0; y < 400; ++y) {
    for (std::uint32_t x = 0; x < 400; ++x) {
      bool any = false;
      for (std::uint32_t k = 0; k < 16; ++k) {
        const radiosity::Rgb8 rgb = large.pixel(4 * x + k % 4, 4 * y + k / 4);
        any = any || rgb != radiosity::Rgb8{0, 0, 0};
      }
      wrong += any == (small.pixel(x, y) != radiosity::Rgb8{0, 0, 0}) ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
  const std::atomic<bool> cancel = true;
  CHECK_FALSE(radiosity::draw(mesh, view(64), 1.0, 4, &cancel));
  CHECK(radiosity::draw(radiosity::Mesh{}, view(4), 1.0));
}

TEST_CASE("automatic exposure shows the 98th percentile of what is seen as 0.8, whatever lies outside the view or shines") {
  const radiosity::Scene scene = wall_and_lamp();
  const auto exposure = [&](const Color& light, bool lit) {
    radiosity::Mesh mesh;
    if (!radiosity::is_black(light)) { add_rectangle(mesh, {-1.0, -1.0}, {1.0, 1.0}, light, 0); }
    add_rectangle(mesh, {5.0, 5.0}, {9.0, 9.0}, Color(1e6), 0);  // beside the view
    if (lit) { add_rectangle(mesh, {-0.5, -0.5}, {0.5, 0.5}, Color(1000.0), 1); }
    return radiosity::automatic_exposure(mesh, scene, view(100));
  };
  const Color light{1.0, 0.5, 0.0};
  const double expected = 0.8 * pi / radiosity::luminance(light);
  CHECK(exposure(light, false) == test::Approx(expected));
  CHECK(exposure(2.0 * light, true) == test::Approx(0.5 * expected));
  CHECK(exposure(Color{0.0}, true) == test::Approx(pi / 1000.0));
  CHECK(exposure(Color{0.0}, false) == 1.0);
  // A bright corner counts when it takes more than 2 % of the view: 0.25 x 0.25 of 2 x 2 is 1.6 %, 0.4 x 0.4 is 4 %.
  for (const double side : {0.25, 0.4}) {
    radiosity::Mesh mesh;
    add_rectangle(mesh, {-1.0, -1.0}, {1.0, 1.0}, Color(1.0), 0);
    add_rectangle(mesh, {1.0 - side, 1.0 - side}, {1.0, 1.0}, Color(4.0), 0);  // the later of coplanar ones, for it is drawn later
    CHECK(radiosity::automatic_exposure(mesh, scene, view(200)) == test::Approx(0.8 * pi / (side < 0.3 ? 1.0 : 4.0)));
  }
}

TEST_CASE("automatic exposure takes what glows less than it is lit as a surface, and what glows more as a lamp") {
  const radiosity::Scene scene = wall_and_lamp();
  const Color emission = scene.materials[1].emission;
  const auto exposure = [&](double reflected) {  // by what glows, relative to what it emits; beside it is a wall of the same light
    radiosity::Mesh mesh;
    add_rectangle(mesh, {-1.0, -1.0}, {0.0, 1.0}, emission, 0);
    add_rectangle(mesh, {0.0, -1.0}, {1.0, 1.0}, (1.0 + reflected) * emission, 1);
    return radiosity::automatic_exposure(mesh, scene, view(100));
  };
  const double by_wall = 0.8 * pi / radiosity::luminance(emission);
  CHECK(exposure(0.9) == test::Approx(by_wall));
  CHECK(exposure(1.1) == test::Approx(by_wall / 2.1));
  CHECK(exposure(30.0) == test::Approx(by_wall / 31.0));
}

TEST_CASE("automatic exposure shows paint that glows and fills most of the picture, however dark the rest") {
  const radiosity::Scene scene = wall_and_lamp();
  const Color emission = scene.materials[1].emission;
  for (const double edge : {-0.8, -0.2, 0.2, 0.8}) {  // between the glow on the left and a dark wall on the right
    radiosity::Mesh mesh;
    add_rectangle(mesh, {-1.0, -1.0}, {edge, 1.0}, 1.2 * emission, 1);
    add_rectangle(mesh, {edge, -1.0}, {1.0, 1.0}, 0.1 * emission, 0);
    const double by_glow = 0.8 * pi / radiosity::luminance(1.2 * emission), by_wall = 12.0 * by_glow;
    CHECK(radiosity::automatic_exposure(mesh, scene, view(100)) == test::Approx(edge > 0.0 ? by_glow : by_wall));
  }
}

TEST_CASE("tones rise with light, from 0 to 1, filmic below linear where it is bright") {
  for (const radiosity::ToneCurve curve : {radiosity::ToneCurve::linear, radiosity::ToneCurve::filmic}) {
    const radiosity::Tone tone{2.0, curve};
    CHECK(tone(0.0) == 0.0);
    double last = 0.0;
    for (double b = 1e-6; b < 1e12; b *= 1.1) {
      CHECK(tone(b) >= last);
      last = tone(b);
      CHECK(last <= 1.0);
    }
    CHECK(last == 1.0);
    CHECK(std::abs(tone(0.4 * pi) - (curve == radiosity::ToneCurve::linear ? 0.8 : 0.7523)) < 1e-4);
  }
}
