// SPDX-License-Identifier: MIT
// The program as its user meets it: exit codes, streams, files.
#include "catch.hpp"

#include <cstdlib>
#include <sstream>
#include <string>

#include "json.hpp"
#include "program.hpp"

using program::Place;
using program::Run;
using program::scene;

TEST_CASE("render writes its files and the report, exit code 0") {
  const Place place;
  const Run run =
      place.run("render " + scene("two_plates") + " -o a.png -o a.ply --json a.json --size 64x48 --audit 50 --epsilon 0.05 --threads 1");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(place.entries() == 3);
  CHECK(place.read("a.png").substr(1, 3) == "PNG");
  CHECK(place.read("a.ply").substr(0, 4) == "ply\n");
  CHECK(run.out.find("row sums") != std::string::npos);
  CHECK(run.out.find("written: a.png") != std::string::npos);
  CHECK(run.err.find("row sums") == std::string::npos);
  CHECK(run.err.find('\r') == std::string::npos);  // no bar: stderr is no terminal
  const json::Value report = json::parse(place.read("a.json"));
  CHECK(report["picture"]["width"].number() == 64);
  CHECK(report["settings"]["epsilon"].number() == 0.05);
  CHECK(report["surfaces"].size() == 2);
}

TEST_CASE("render gathers light for a picture, and draws the mesh when asked to, the report says so") {
  const Place place;
  const std::string arguments = "render " + scene("two_plates") + " -o a.png --json a.json --size 64x48 --audit 0 --epsilon 0.05";
  const Run mesh = place.run(arguments + " --method mesh");
  REQUIRE(mesh.code == 0);
  CHECK(json::parse(place.read("a.json"))["picture"]["method"].string() == "mesh");
  const Run run = place.run(arguments);
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(place.read("a.png").substr(1, 3) == "PNG");
  CHECK(run.out.find("gathered light") != std::string::npos);
  const json::Value report = json::parse(place.read("a.json"));
  CHECK(report["picture"]["method"].string() == "gather");
  CHECK(report["wall_seconds"]["picture"].number() > 0.0);
}

TEST_CASE("a picture that is black all over says what it sees instead of light") {
  const Place place;
  place.write("back.scene",
              "camera front eye 0 0 -5 target 0 0 0 up 0 1 0\n"
              "camera behind eye 0 0 5 target 0 0 0 up 0 1 0\n"
              "material lamp reflectance 0 emission 10\n"
              "polygon panel material lamp {\nvertex -9 -9 0\nvertex -9 9 0\nvertex 9 9 0\nvertex 9 -9 0\n}\n");
  const Run seen = place.run("render back.scene -o a.png --size 32x24 --audit 0 --camera front");
  INFO(seen.err << seen.out);
  CHECK(seen.out.find("picture is black") == std::string::npos);
  const Run behind = place.run("render back.scene -o a.png --size 32x24 --audit 0 --camera behind");
  INFO(behind.err << behind.out);
  CHECK(behind.out.find("100 % first meets the backs of surfaces") != std::string::npos);
  CHECK(behind.out.find("--two-sided") != std::string::npos);
}

TEST_CASE("a target or a time asks for BF-refinement, and the report says what ended it") {
  const Place place;
  const std::string arguments = "render " + scene("two_plates") + " -o a.png --json a.json --size 64x48 --audit 0";
  const Run target = place.run(arguments + " --target 0.05");
  INFO(target.err);
  REQUIRE(target.code == 0);
  CHECK(target.out.find("bf, estimate at most 0.05") != std::string::npos);
  CHECK(json::parse(place.read("a.json"))["estimated_error"].number() <= 0.05);
  const Run time = place.run(arguments + " --time 0.1");
  REQUIRE(time.code == 0);
  CHECK(time.out.find("until the time was used") != std::string::npos);
  REQUIRE(place.run(arguments).code == 0);
  CHECK(json::parse(place.read("a.json"))["estimated_error"].is_null());
}

TEST_CASE("the settings that an error target found repeat its last round") {
  const Place place;
  const std::string arguments = "render " + scene("two_plates") + " --json a.json ";
  REQUIRE(place.run(arguments + "--error 0.05").code == 0);
  const json::Value found = json::parse(place.read("a.json"));
  std::ostringstream again;
  again.precision(17);
  again << "--epsilon " << found["settings"]["epsilon"].number() << " --min-area " << found["settings"]["min_area"].number()
        << " --light-epsilon " << found["settings"]["light_epsilon"].number();
  const Run run = place.run(arguments + again.str());
  INFO(run.err);
  REQUIRE(run.code == 0);
  const json::Value repeated = json::parse(place.read("a.json"));
  CHECK(repeated["links"].number() == found["links"].number());
  for (std::size_t i = 0; i < found["surfaces"].size(); ++i) {
    CHECK(repeated["surfaces"][i]["radiosity"][0].number() == found["surfaces"][i]["radiosity"][0].number());
  }
}

TEST_CASE("discontinuities: the report says how many edges of shadows were imprinted, and where the limit was reached") {
  const Place place;
  const std::string arguments = "render " + scene("penumbra") + " --json a.json --audit 0 --epsilon 0.04 --threads 1 --quiet";
  const Run cut = place.run(arguments + " --discontinuities 3");
  REQUIRE(cut.code == 0);
  CHECK(cut.out.find("3 imprinted on 1 face; limit reached on 1") != std::string::npos);
  CHECK(json::parse(place.read("a.json"))["discontinuities"]["edges"].number() == 3);
  CHECK(json::parse(place.read("a.json"))["discontinuities"]["limited"].number() == 1);
  REQUIRE(place.run(arguments).code == 0);
  CHECK(json::parse(place.read("a.json"))["discontinuities"].is_null());
}

TEST_CASE("quiet is quiet on stderr, the report stays") {
  const Place place;
  const Run run = place.run("render " + scene("two_plates") + " -o a.ply --audit 0 --quiet --solver jacobi --reconstruction simple");
  CHECK(run.code == 0);
  CHECK(run.err.empty());
  CHECK(run.out.find("not measured") != std::string::npos);
}

TEST_CASE("without an output nothing is reconstructed, the report tells the error of the leaves") {
  const Place place;
  const Run run = place.run("render " + scene("two_plates") + " --json a.json --audit 50 --epsilon 0.05 --quiet");
  CHECK(run.code == 0);
  CHECK(run.out.find("no picture is asked for") != std::string::npos);
  CHECK(run.out.find("exposure") == std::string::npos);
  const json::Value report = json::parse(place.read("a.json"));
  CHECK(report["settings"]["reconstruction"].string() == "none");
  CHECK(report["error"]["leaf"]["relative_l2"].number() > 0.0);
  // The same solution as that of a mesh; the audit of its leaves, led by what is shown, takes other points.
  REQUIRE(place.run("render " + scene("two_plates") + " -o a.ply --json b.json --audit 50 --epsilon 0.05 --quiet").code == 0);
  const json::Value pictured = json::parse(place.read("b.json"));
  for (const char* key : {"leaves", "links", "estimated_leaf_error", "energy_balance", "escaped"}) {
    INFO(key);
    CHECK(pictured[key].number() == report[key].number());
  }
  CHECK(pictured["error"]["leaf"]["low"].number() < report["error"]["leaf"]["high"].number());
  CHECK(report["error"]["leaf"]["low"].number() < pictured["error"]["leaf"]["high"].number());
}

TEST_CASE("the error of a picture does not depend on the unit of light") {
  const Place place;
  double error[3] = {};
  const char* exponents[3] = {"1", "1p-600", "1p600"};  // powers of two
  for (int k = 0; k < 3; ++k) {
    std::ostringstream emission;
    emission.precision(17);
    emission << std::strtod((std::string("0x") + exponents[k]).c_str(), nullptr);
    place.write("a.scene", "material white  reflectance 0.5\nmaterial lamp  reflectance 0  emission " + emission.str() +
                               "\nbox room  from 0 0 0  to 1 1 1  inside  material white { sheet z1 material lamp }\n"
                               "camera eye  eye 0.5 0.1 0.5  target 0.5 1 0.4  fov 70\n");
    const Run run = place.run("render a.scene -o a.png --json a.json --size 40x30 --audit 400 --epsilon 0.1 --quiet --method mesh");
    INFO(run.err);
    REQUIRE(run.code == 0);
    error[k] = json::parse(place.read("a.json"))["error"]["picture"]["relative_l2"].number();
  }
  CHECK(error[0] > 0.0);
  CHECK(error[0] < 0.2);
  CHECK(error[1] == error[0]);
  CHECK(error[2] == error[0]);
}

TEST_CASE("the error of a picture of nothing but lamps is unknown, and the report says so") {
  const Place place;
  place.write("a.scene",
              "material white  reflectance 0.5\nmaterial lamp  reflectance 0  emission 1\n"
              "box room  from 0 0 0  to 1 1 1  inside  material white { sheet y1 material lamp }\n"
              "camera eye  eye 0.5 0.8 0.5  target 0.5 1 0.5  fov 60\n");
  const std::string arguments = "render a.scene -o a.png --json a.json --size 16x16 --epsilon 0.1 --quiet";
  const Run run = place.run(arguments);
  REQUIRE(run.code == 0);
  CHECK(run.out.find("picture eye             unknown: it shows no surface that does not shine") != std::string::npos);
  CHECK(json::parse(place.read("a.json"))["error"]["picture"].is_null());
  CHECK(place.run(arguments + " --audit 0").out.find("unknown") == std::string::npos);  // nobody asked
}

TEST_CASE("a camera in words shows what the same camera in the scene shows, to the bit") {
  const program::Place place;
  const std::string scene =
      "material wall reflectance 0.5\nmaterial lamp emission 5\nbox room from 0 0 0 to 3 2 1 inside material wall\n"
      "polygon lamp material lamp {\n vertex 1 1 0.9\n vertex 1 1.5 0.9\n vertex 1.5 1.5 0.9\n vertex 1.5 1 0.9\n}\n";
  const std::string words = "eye 0.2 0.3 0.5 target 2 1.5 0.4 up 0.1 0 1 fov 70 size 24 16";
  place.write("with.scene", scene + "camera one " + words + "\ncamera given eye 1 1 0.5 look 1 0 0\n");
  place.write("without.scene", scene + "camera given eye 1 1 0.5 look 1 0 0\n");
  const std::string coarse = " --epsilon 0.1 --quiet --audit 0 --threads 1";
  REQUIRE(place.run("render with.scene -o with.pfm" + coarse).code == 0);
  REQUIRE(place.run("render without.scene -o without.pfm --camera '" + words + "'" + coarse).code == 0);
  CHECK(place.read("with.pfm") == place.read("without.pfm"));
  const std::string commas = "eye 0.2,0.3,0.5 target 2, 1.5, 0.4 up 0.1,0,1 fov 70 size 24,16";
  REQUIRE(place.run("render without.scene -o commas.pfm --camera '" + commas + "'" + coarse).code == 0);
  CHECK(place.read("with.pfm") == place.read("commas.pfm"));
  // What the report says of the picture's camera can be given back.
  const program::Run told = place.run("render with.scene -o with.pfm --json a.json" + coarse);
  REQUIRE(told.code == 0);
  CHECK(told.out.find("--camera \"eye 0.2 0.3 0.5 target 2 1.5 0.4 up 0.0995") != std::string::npos);
  const json::Value picture = json::parse(place.read("a.json"))["picture"];
  CHECK(picture["camera"].string() == "one");
  for (const auto& [key, x] : {std::pair{"eye", 0.2}, std::pair{"target", 2.0}, std::pair{"up", 0.1}}) {
    CHECK(picture[key][0].number() == Approx(x));
  }
  CHECK(picture["fov"].number() == 70.0);
  const auto refused = [&](const std::string& camera, const std::string& reason) {
    const program::Run run = place.run("render with.scene -o no.pfm --camera '" + camera + "'");
    CHECK(run.code == 2);
    CHECK(run.err.find(reason) != std::string::npos);
    CHECK_FALSE(place.has("no.pfm"));
  };
  refused("eye 1 1 0.5", "needs 'target' or 'look'");
  refused("eye 1 1 0.5 look 0 0 0", "looks nowhere");
  refused("eye 1 1 0.5 look 1 0", "expected number 3, found the end");
  refused("eye 1 1 x look 1 0 0", "found 'x'");
  refused("eye 1 1 0.5 look 1 0 0\nmaterial m reflectance 0.5", "one line");
}

TEST_CASE("info says what is in a scene") {
  const Place place;
  const Run run = place.run("info " + scene("room"));
  CHECK(run.code == 0);
  CHECK(run.out.find("objects: 4 with 11 surfaces") != std::string::npos);
  CHECK(run.out.find("cameras: 2") != std::string::npos);
}

TEST_CASE("wrong usage is exit code 2 and writes nothing") {
  const Place place;
  for (const std::string& arguments : {std::string(),
                                       std::string("--foo"),
                                       std::string("draw x"),
                                       std::string("render"),
                                       "render " + scene("room") + " -o a.jpg",
                                       "render " + scene("room") + " -o a.png -o a.png",
                                       "render " + scene("room") + " -o a.png --size 0x5",
                                       "render " + scene("room") + " -o a.png --size 5",
                                       "render " + scene("room") + " -o a.png --epsilon nan",
                                       "render " + scene("room") + " -o a.png --epsilon 0",
                                       "render " + scene("room") + " -o a.png --error 0.1 --epsilon 0.1",
                                       "render " + scene("room") + " -o a.png --error 0.1 --audit 0",
                                       "render " + scene("room") + " -o a.png --target 0.1 --epsilon 0.1",
                                       "render " + scene("room") + " -o a.png --time 1 --target 0.1",
                                       "render " + scene("room") + " -o a.png --time 0",
                                       "render " + scene("room") + " -o a.png --camera none",
                                       "render " + scene("room") + " -o a.png --threads 0",
                                       "render " + scene("room") + " -o a.png --exposure -1",
                                       "render " + scene("room") + " -o a.png --solver magic",
                                       "render " + scene("room") + " -o a.png --method paint"}) {
    const Run run = place.run(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.code == 2);
    CHECK(run.err.size() > 10);
    CHECK(run.out.empty());
  }
  CHECK(place.entries() == 0);
}

TEST_CASE("an invalid scene is exit code 3 with file, line and column") {
  const Place place;
  place.write("bad.scene", "material a reflectance 2\nfoo\n");
  const Run run = place.run("render bad.scene -o a.png");
  CHECK(run.code == 3);
  CHECK(run.err.find("bad.scene:1:24: error: ") == 0);
  CHECK(run.err.find("\nbad.scene:2:1: error: ") != std::string::npos);
  CHECK_FALSE(place.has("a.png"));
  CHECK(place.run("info bad.scene").code == 3);
}

TEST_CASE("a file that cannot be read is exit code 1") {
  const Place place;
  CHECK(place.run("info none.scene").code == 1);
  CHECK(place.run("info /dev/zero").code == 1);
}

TEST_CASE("a target that cannot be written is exit code 1 before the work, and the old file stays") {
  const Place place;
  CHECK(place.run("render " + scene("room") + " -o none/a.png").code == 1);
  place.write("a.ply", "old");
  const Run run = place.run("render " + scene("two_plates") + " -o a.ply --audit 0 --epsilon 0.001", "ulimit -f 1; trap '' XFSZ; ");
  CHECK(run.code != 0);
  CHECK(place.read("a.ply") == "old");
  CHECK(place.entries() == 1);
}

TEST_CASE("a word of one letter suggests no other") {
  const Place place;
  const Run up = place.run("info " + scene("room") + " --up w");
  CHECK(up.code == 2);
  CHECK(up.err.find("did you mean") == std::string::npos);
}

TEST_CASE("a run that does not converge is exit code 4, and what was reached is written") {
  const Place place;
  // Jacobi shrinks the error by the reflectance in each iteration: 1000 of them are far from enough here.
  place.write("hard.scene", "material white reflectance 0.9999 emission 1\nbox b from 0 0 0 to 1 1 1 inside material white\n");
  const Run run = place.run("render hard.scene -o a.ply --audit 0 --solver jacobi --epsilon 0.1");
  INFO(run.out << run.err);
  CHECK(run.code == 4);
  CHECK(run.err.find("not converged") != std::string::npos);
  CHECK(run.out.find("NOT CONVERGED") != std::string::npos);
  CHECK(place.has("a.ply"));
}

TEST_CASE("interrupted, the program writes the best so far and says so") {
  const Place place;
  const Run run = place.run("render " + scene("room") + " -o a.png --epsilon 0.0005 --min-area 1e-7 --quiet", "timeout -s INT 2 ");
  INFO(run.err);
  // timeout itself gives 124; the program's own sentence shows that it ended by itself.
  CHECK(run.code == 124);
  CHECK(run.err.find("interrupted: the outputs show the best solution so far") != std::string::npos);
  CHECK(run.out.find("INTERRUPTED, the best so far") != std::string::npos);
  CHECK(run.out.find("larger than asked for, to end soon") != std::string::npos);
  CHECK(place.has("a.png"));
}

TEST_CASE("help and version are exit code 0") {
  const Place place;
  CHECK(place.run("--help").code == 0);
  CHECK(place.run("render --help").out.find("--reconstruction") != std::string::npos);
  CHECK(place.run("--version").out.find("halflight ") == 0);
}

TEST_CASE("an estimate that is more than 3 times off the audited error says so in the report") {
  const Place place;
  for (int seed = 1; seed <= 12; ++seed) {
    const Run run = place.run("render " + scene("penumbra") + " --quiet --json a.json --seed " + std::to_string(seed));
    REQUIRE(run.code == 0);
    const json::Value report = json::parse(place.read("a.json"));
    const double estimate = report["estimated_leaf_error"].number();
    const auto& leaf = report["error"]["leaf"];  // of an error that is lost in the noise only the upper end is known
    const double error = leaf[leaf["low"].number() > 0.0 ? "relative_l2" : "high"].number();
    const std::string doubt = report["estimate_doubt"].string();
    INFO("seed " << seed << ", estimated " << estimate << ", found " << error << "\n" << run.out);
    CHECK((doubt.find("path tracing found") != std::string::npos) == (estimate > 3.0 * error || error > 3.0 * estimate));
    CHECK((doubt.empty() || run.out.find(doubt) != std::string::npos));
  }
}
