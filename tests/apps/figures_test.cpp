// SPDX-License-Identifier: MIT
// halflight figures: eight figures, each from a source that is there, and a page that names them all.
#include "catch.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/figures/figures.hpp"
#include "program.hpp"

namespace {

// How often two of the dashed lines of a drawing cross.
int crossings(const std::string& svg) {
  std::vector<std::array<double, 4>> lines;
  for (std::size_t dashes = svg.find("stroke-dasharray"); dashes != svg.npos; dashes = svg.find("stroke-dasharray", dashes + 1)) {
    std::array<double, 4> line{};
    const std::size_t path = svg.rfind("d=\"M", dashes);
    REQUIRE(std::sscanf(svg.c_str() + path, "d=\"M%lf %lfL%lf %lf\"", &line[0], &line[1], &line[2], &line[3]) == 4);
    lines.push_back(line);
  }
  CHECK(lines.size() == 28);
  const auto side = [](const std::array<double, 4>& l, double x, double y) {
    return (l[2] - l[0]) * (y - l[1]) - (l[3] - l[1]) * (x - l[0]);
  };
  const auto parts = [&](const auto& l, const auto& m) { return side(l, m[0], m[1]) * side(l, m[2], m[3]) < 0.0; };
  int found = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) { found += parts(lines[i], lines[j]) && parts(lines[j], lines[i]) ? 1 : 0; }
  }
  return found;
}

// Images in base64 may hold any word.
std::string without_images(std::string svg) {
  for (std::size_t at = 0; (at = svg.find("base64,", at)) != std::string::npos;) {
    at += 7;
    svg.erase(at, svg.find_first_of("'\"", at) - at);
  }
  return svg;
}

}  // namespace

TEST_CASE("figures: all eight are drawn from files of examples/, and say what they show") {
  const std::vector<apps::figures::Figure> figures = apps::figures::make();
  REQUIRE(figures.size() == 8);
  const std::string page = apps::figures::page(figures);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const apps::figures::Figure& figure = figures[i];
    INFO(figure.file);
    CHECK(figure.file == "figure" + std::to_string(i + 1) + ".svg");
    CHECK(std::filesystem::exists(std::string(HALFLIGHT_SOURCE "/examples/") + figure.source));
    CHECK(figure.svg.find("</svg>") != std::string::npos);
    CHECK(without_images(figure.svg).find("nan") == std::string::npos);
    CHECK(figure.caption.size() > 60);
    CHECK(page.find("src='" + figure.file + "'") != std::string::npos);
  }
  // Figure 1: the cube has its eight vertices twice, in space and in the plane.
  for (const char* v : {"v0", "v7"}) {
    CHECK(figures[0].svg.find(std::string("data-of='") + v + "'") != std::string::npos);
    CHECK(figures[0].svg.find(std::string("data-k='") + v + "'") != std::string::npos);
  }
  CHECK(figures[1].svg.find("h12: origin v0, face f0,") != std::string::npos);
  CHECK(crossings(figures[2].svg) < 28);  // 28 leaves, an arrow each: fewer crossings than arrows
  CHECK(figures[3].svg.find(">T<") != std::string::npos);
  CHECK(figures[4].svg.find("weight 1.00") != std::string::npos);
  CHECK(figures[4].svg.find("weight 0.00") != std::string::npos);
  // Figures 7 and 8 are one solution, reconstructed in two ways.
  CHECK(figures[6].svg.size() > 10000);
  CHECK(figures[6].svg != figures[7].svg);
}

TEST_CASE("figures writes its page into a folder that it makes") {
  program::Place place;
  CHECK(place.run("figures -o out/figures").code == 0);
  CHECK(place.has("out/figures/index.html"));
  CHECK(place.has("out/figures/figure8.svg"));
  CHECK(place.run("figures").code == 2);
}
