// SPDX-License-Identifier: MIT
// halflight figures: eight figures, each from a source that is there, and a page that names them all.
#include "catch.hpp"

#include <filesystem>
#include <string>

#include "apps/figures/figures.hpp"
#include "program.hpp"

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
    CHECK(figure.svg.find("nan") == std::string::npos);
    CHECK(figure.caption.size() > 60);
    CHECK(page.find("src='" + figure.file + "'") != std::string::npos);
  }
  // Figure 1: the cube has its eight vertices twice, in space and in the plane.
  for (const char* v : {"v0", "v7"}) {
    CHECK(figures[0].svg.find(std::string("data-of='") + v + "'") != std::string::npos);
    CHECK(figures[0].svg.find(std::string("data-k='") + v + "'") != std::string::npos);
  }
  CHECK(figures[1].svg.find("h12: origin v0, face f0,") != std::string::npos);
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
