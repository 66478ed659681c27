// SPDX-License-Identifier: MIT
// A picture that shows next to nothing is told, with what to try.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/camera/picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/result/audit.hpp>

#include "apps/commands/picture_warnings.hpp"
#include "catch.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

// A block with a room, a lamp in it, and a slit through a wall.
const std::string house =
    "material grey reflectance 0.5\nmaterial lamp emission 10\n"
    "difference house material grey {\n box block from -0.2 -0.2 -0.2 to 4.2 3.2 2.7\n box room from 0 0 0 to 4 3 2.5\n"
    " box slit from 1 -1 1 to 1.05 0.1 2\n}\n"
    "polygon lamp material lamp {\n vertex 1 1 2.4\n vertex 1 2 2.4\n vertex 2 2 2.4\n vertex 2 1 2.4\n}\n"
    "camera outside eye -5 -8 5 target 2 1.5 1 fov 40\ncamera within eye 3.5 2.5 1.5 target 1 1 1 fov 70\n";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a picture of which nine tenths are black, or of a light a thousand times dimmer than usual, is told") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  apps::SceneResult scene = apps::parse_scene(house);
  REQUIRE(scene.file);
  const radiosity::View view = radiosity::make_view(scene.file->cameras[1], {32, 24});
  for (int round = 0; round < 40; ++round) {
    const double black = 0.8 + 0.2 * unit(random), light = 100.0 * unit(random), dimmer = std::exp(14.0 * unit(random));
    radiosity::Picture picture(32, 24);
    double blacks = 0.0;
    for (std::size_t p = 0; p < 32 * 24; ++p) {
      const bool is_black = unit(random) < (round % 2 == 0 ? black : 0.3);
      blacks += is_black ? 1.0 / (32 * 24) : 0.0;
      picture.set(p, radiosity::Color(is_black ? 0.001 : 0.5), radiosity::Color(light));
    }
    const radiosity::Tone tone(0.8 * std::numbers::pi / light * dimmer);
    const std::vector<radiosity::SurfaceMean> surfaces{{"house", 10.0, radiosity::Color(light)}, {"lamp", 1.0, radiosity::Color(1e9)}};
    const std::string sentence = apps::warning_of_picture(picture, *scene.file, view, &tone, surfaces);
    CAPTURE(round, blacks, dimmer, sentence);
    CHECK(has(sentence, "is black in the picture") == (blacks >= 0.9));
    CHECK(has(sentence, "extreme") == (blacks < 0.9 && dimmer > 1e3));
    CHECK(has(sentence, "--camera \"eye ") == !sentence.empty());
    CHECK_FALSE(has(apps::warning_of_picture(picture, *scene.file, view, nullptr, surfaces), "extreme"));
  }
}

TEST_CASE("the report of a black picture names a place from which light is seen") {
  const program::Place place;
  place.write("house.scene", house);
  const std::string coarse = " -o a.png --size 64x48 --epsilon 0.1 --quiet --audit 0 --threads 1";
  CHECK_FALSE(has(place.run("render house.scene --camera within" + coarse).out, "is black in the picture"));
  const std::string out = place.run("render house.scene --camera outside" + coarse).out;
  REQUIRE(has(out, "is black in the picture"));
  const std::size_t from = out.find("(--camera \"") + 1, to = out.find(')', from);
  CHECK_FALSE(has(place.run("render house.scene " + out.substr(from, to - from) + coarse).out, "is black in the picture"));
}
