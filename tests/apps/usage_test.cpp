// SPDX-License-Identifier: MIT

// A wrong command line gets a sentence that a person would write.

#include "catch.hpp"

#include <string>

#include "program.hpp"

using program::Place;
using program::Run;

TEST_CASE("a wrong command line is told in one sentence with the nearest known word") {
  const Place place;
  place.write("x.scene", "");
  const std::pair<const char*, const char*> cases[] = {
      {"", "a command is missing; the commands are render, info, mesh,"},
      {"rendr x.scene", "there is no command 'rendr'; did you mean 'render'?"},
      {"paint x.scene", "there is no command 'paint'; the commands are render, info,"},
      {"x.scene", "'x.scene' is no command; to solve a scene: halflight render x.scene"},
      {"--foo", "there is no option '--foo' before a command; the commands are"},
      {"render", "render needs SCENE, the scene: a .scene file, or .obj, .gltf, .glb, .ply, .off, .stl, .wrl or .mgf"},
      {"render x.scene y.scene", "'y.scene' is one too many: render takes SCENE"},
      {"render x.scene --epsilo 1", "render has no option '--epsilo'; did you mean '--epsilon'?"},
      {"render x.scene --epsilo=1", "render has no option '--epsilo'; did you mean '--epsilon'?"},
      {"render x.scene --method pain", "--method: expected mesh or gather, found 'pain'"},
      {"render x.scene --method gahter", "--method: expected mesh or gather, found 'gahter'; did you mean 'gather'?"},
      {"render x.scene --method 1", "--method: expected mesh or gather, found '1'"},
      {"render x.scene --solver gaus-seidel", "did you mean 'gauss-seidel'?"},
      {"render x.scene --reconstruction simpel", "did you mean 'simple'?"},
      {"render x.scene --size 0x0", "--size: expected WIDTHxHEIGHT, each 1 to 16384, found '0x0'"},
      {"render x.scene --size", "--size needs a value: WxH"},
      {"render x.scene --size 1x1 --size 2x2", "--size is given more than once"},
      {"render x.scene --seed -1", "--seed: expected a whole number from 0 to 18446744073709551615, found '-1'"},
      {"render x.scene --seed 18446744073709551616", "found '18446744073709551616'"},
      {"render x.scene --seed 1.5", "found '1.5'"},
      {"render x.scene --memory 2X", "--memory: expected a number of bytes such as 500M or 2G, found '2X'"},
      {"render x.scene --threads 0", "--threads: expected a whole number from 1 to 1024, found '0'"},
      {"render x.scene --threads true", "found 'true'"},
      {"render x.scene --audit -5", "--audit: expected a whole number from 0 to 100000000, found '-5'"},
      {"render x.scene --error 0.1 --epsilon 0.1", "cannot be given together"},
      {"render x.scene --json ''", "the value after --json is empty"},
      {"render x.scene --json=", "--json needs a value"},
      {"render x.scene --json", "--json needs a value: FILE"},
      {"render x.scene --exposure nan", "--exposure: expected a number above 0"},
      {"factors x.scene --error 0", "--error: expected a number above 0 and at most 1, found '0'"},
      {"factors x.scene --error abc", "found 'abc'"},
      {"factors x.scene --threads -1", "--threads: expected a whole number from 0 to 1024, found '-1'"},
      {"mesh x.scene --json ''", "the value after --json is empty"},
      {"check x.obj -o y.obj", "--output needs --repair"},
      {"euler", "euler needs SCRIPT or --interactive"},
      {"study x.scene", "study needs --output DIR"},
      {"study x.scene -o ''", "the value after -o is empty"},
      {"study x.scene -o y --paths 1", "--paths: expected a whole number from 8 to 100000000, found '1'"},
      {"study x.scene -o y --threads -1", "found '-1'"},
      {"stress toruss", "there is no case 'toruss'; did you mean 'torus'?"},
  };
  for (const auto& [arguments, sentence] : cases) {
    const Run run = place.run(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.code == 2);
    CHECK(run.err.starts_with("halflight: "));
    CHECK(run.err.find(sentence) != std::string::npos);
    CHECK(run.err.find("FAILED") == std::string::npos);
    CHECK(run.err.find("->") == std::string::npos);
    CHECK(run.out.empty());
  }
  CHECK(place.entries() == 1);
}
