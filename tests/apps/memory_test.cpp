// SPDX-License-Identifier: MIT

// Memory as the user of the program means it: sizes as they are written, the limit on the whole process, the peak of a run.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <radiosity/result/audit.hpp>
#include <radiosity/support/memory.hpp>

#include "apps/memory.hpp"
#include "json.hpp"
#include "program.hpp"
#include "seed.hpp"

#include "catch.hpp"

TEST_CASE("sizes of memory are read as they are written") {
  CHECK(apps::parse_memory("1") == 1u);
  CHECK(apps::parse_memory("300000000") == 300'000'000u);
  CHECK(apps::parse_memory("2G") == 2'000'000'000u);
  CHECK(apps::parse_memory("2GB") == 2'000'000'000u);
  CHECK(apps::parse_memory("512 MB") == 512'000'000u);
  CHECK(apps::parse_memory("1.5GiB") == 1'610'612'736u);
  CHECK(apps::parse_memory("64k") == 64'000u);
  CHECK(apps::parse_memory("64Ki") == 65'536u);
  for (const char* wrong : {"", "G", "0", "-1G", "nan", "inf", "1e300", "2X", "2GG", "2G2", " 2G", "2 G "}) {
    CAPTURE(wrong);
    CHECK_FALSE(apps::parse_memory(wrong));
  }
}

TEST_CASE("render --memory: refused with a sentence, or the best within the limit by the system's own count") {
  const program::Place place;
  const std::string render = "render '" HALFLIGHT_SCENES "/cornell.scene' --quiet --audit 0 --threads 1 ";
  const program::Run whole = place.run(render + "--epsilon .03 --min-area 1e-3");
  REQUIRE(whole.code == 0);
  CHECK(whole.out.find(" at the peak of the process, ") != std::string::npos);
  CHECK(whole.out.find(" held by the result") != std::string::npos);

  const program::Run none = place.run(render + "--memory 2M");
  CHECK(none.code == 1);
  CHECK(none.err.find("--memory allows 2 MB, but the program and the scene hold ") != std::string::npos);
  CHECK(std::count(none.err.begin(), none.err.end(), '\n') == 1);

  const program::Run coarser = place.run(render + "--epsilon .01 --min-area 2.4e-4 --memory 24M --json coarser.json");
  CHECK(coarser.code == 4);
  CHECK(coarser.err.find("a larger epsilon or min_area needs less; the outputs show the best solution so far") != std::string::npos);
  CHECK(coarser.out.find("larger than asked for, to end within the memory") != std::string::npos);
  CHECK(std::count(coarser.err.begin(), coarser.err.end(), '\n') == 1);
  const json::Value of_coarser = json::parse(place.read("coarser.json"));
  CHECK(of_coarser["coarsened"].boolean());
  CHECK(of_coarser["settings"]["epsilon"].number() > 0.01);
  CHECK(of_coarser["peak_bytes"]["process"].number() <= 24e6);

  const program::Run best = place.run("render '" HALFLIGHT_SCENES
                                      "/cornell.scene' --quiet --audit 0 --threads 1 --target .004 "
                                      "--memory 30M --json report.json");
  CHECK(best.code == 4);
  CHECK(best.err.find("the outputs show the best solution so far") != std::string::npos);
  CHECK(best.out.find("OUT OF MEMORY, the best so far") != std::string::npos);
  const json::Value report = json::parse(place.read("report.json"));
  CHECK(report["shortage"].string().find("a larger target needs less") != std::string::npos);
  CHECK(report["peak_bytes"]["process"].number() <= 30e6);
  CHECK(report["peak_bytes"]["process"].number() >= report["bytes"].number());

  const program::Run wrong = place.run(render + "--memory much");
  CHECK(wrong.code == 2);
}

TEST_CASE("render --memory with a picture: within the limit by the system's own count, as without one if it is generous, or refused") {
  const program::Place place;
  int drawn = 0, refused = 0;
  const auto render = [&](const std::string& arguments) {
    return place.run("render '" HALFLIGHT_SCENES "/" + arguments + " --quiet --audit 100 --threads 1 -o a.png --json a.json");
  };
  const auto peak = [&] { return json::parse(place.read("a.json"))["peak_bytes"]["process"].number(); };
  for (const char* scene : {"sphere", "cornell", "room"}) {
    for (const char* picture : {"--size 100x80", "--size 400x300", "--size 500x400 --method mesh"}) {
      const std::string arguments = std::string(scene) + ".scene' " + picture;
      REQUIRE(render(arguments).code == 0);
      const double generous = 2.5 * peak() + 130e6;  // a run predicts up to twice of what it takes
      for (const int megabytes : {30, 60, 110, static_cast<int>(1e-6 * generous) + 1}) {
        CAPTURE(arguments, megabytes, generous);
        for (const char* output : {"a.png", "a.json"}) { std::filesystem::remove(place.path() / output); }
        const program::Run run = render(arguments + " --memory " + std::to_string(megabytes) + "M");
        CAPTURE(run.err);
        if (1e6 * megabytes > generous) { CHECK(run.code == 0); }
        if (run.code == 1) {
          ++refused;
          CHECK(run.err.find("the picture takes ") != std::string::npos);
          CHECK_FALSE(place.has("a.png"));
          continue;
        }
        ++drawn;
        CHECK((run.code == 0 || run.code == 4));
        CHECK(peak() <= 1e6 * megabytes);
      }
    }
  }
  CHECK(drawn > 9);    // all generous ones, and others
  CHECK(refused > 0);  // at least pictures that take more themselves
}

TEST_CASE("render --memory: pictures whose pixels show many things are within the limit by the system's own count, too") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const program::Place place;
  std::string scene =
      "material grey reflectance .6\nmaterial lamp reflectance 0 emission 9\n"
      "camera all eye 9 -19 9 target 0 0 0 fov 30\nsphere light center 3 -3 29 radius .5 material lamp\n";
  for (int i = 0; i < 250; ++i) {  // sticks, narrower than a pixel
    const auto corner = [](double x, double y, double z) { return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z); };
    const double x = uniform(-6, 2), y = uniform(-4, 4), z = uniform(-4, 4);
    scene += "box b" + std::to_string(i) + " from " + corner(x, y, z) + " to " +
             corner(x + uniform(2, 5), y + uniform(.01, .03), z + uniform(.01, .03)) + " material grey\n";
  }
  place.write("sticks.scene", scene);
  const auto render = [&](const std::string& limit) {
    return place.run("render sticks.scene --quiet --audit 0 --threads 1 --size 300x220 " + limit + "-o a.png --json a.json");
  };
  const auto peak = [&] { return json::parse(place.read("a.json"))["peak_bytes"]["process"].number(); };
  REQUIRE(render("").code == 0);
  const double most = peak();
  int drawn = 0;
  for (const double part : {0.6, 0.8, 1.0}) {
    const double limit = std::round(part * most);
    const program::Run run = render("--memory " + std::to_string(static_cast<long>(limit)) + " ");
    CAPTURE(limit, run.err);
    CHECK((run.code == 0 || run.code == 1 || run.code == 4));
    if (run.code == 1) { continue; }
    ++drawn;
    CHECK(peak() <= limit);
  }
  CHECK(drawn > 1);
}

TEST_CASE("render --memory: a picture that cannot be gathered within the limit shows the mesh, and says so") {
  const program::Place place;
  REQUIRE(place.run("render '" HALFLIGHT_SCENES "/sphere.scene' --quiet --audit 0 -o a.light").code == 0);
  const auto render = [&](const std::string& how, const std::string& name) {
    return place.run("render --light a.light --quiet --audit 0 --size 400x300 " + how + " -o " + name);
  };
  REQUIRE(render("--method mesh", "mesh.png").code == 0);
  REQUIRE(render("--method gather", "gathered.png").code == 0);
  REQUIRE((place.read("mesh.png") != place.read("gathered.png")));  // in parentheses: a failure would print the bytes
  CHECK(render("--memory 500M", "generous.png").code == 0);
  CHECK((place.read("generous.png") == place.read("gathered.png")));
  const program::Run narrow = render("--memory 20M", "narrow.png");
  CHECK(narrow.code == 4);
  CHECK(narrow.err.find("so it shows the mesh; allow more or make the picture smaller") != std::string::npos);
  CHECK((place.read("narrow.png") == place.read("mesh.png")));
}

TEST_CASE("whatever the address space is limited to, a picture is drawn or refused with a sentence, and no signal ends the program") {
  const program::Place place;
  int refused = 0;
  for (int kilobytes = 14'000; kilobytes < 60'000; kilobytes += 1500) {
    const program::Run run = place.run("render '" HALFLIGHT_SCENES "/cornell.scene' --quiet --audit 0 --size 64x64 -o a.png",
                                       "ulimit -v " + std::to_string(kilobytes) + "; ");
    CAPTURE(kilobytes, run.err);
    CHECK((run.code == 0 || run.code == 1 || run.code == 4));
    if (run.code == 0) { continue; }
    ++refused;
    CHECK(run.err.find("memory") != std::string::npos);
    CHECK(place.has("a.png") == (run.code == 4));
    if (run.code == 4) { std::filesystem::remove(place.path() / "a.png"); }
  }
  CHECK(refused > 3);
}

TEST_CASE("the peak of a run does not contain what others took before") {
  std::vector<char> before(200'000'000, 1);  // touched, and freed
  const char kept = before[before.size() / 2];
  before = {};
  const apps::PeakMeter meter;
  std::vector<char> during(52'000'000, kept);  // 2 MB more than is asked for: each processor counts pages in batches of its own
  CHECK(during[during.size() / 2] == 1);
  radiosity::Audit audit;
  audit.stages.push_back({"last", 0.0, 0.0, radiosity::peak_memory()});
  during = {};
  const auto taken = meter.taken(audit, "last");
  if (!taken) { return; }  // the system does not tell
  CHECK(*taken >= 50'000'000);
  CHECK(*taken < 60'000'000);
}
