// SPDX-License-Identifier: MIT

// No output destroys an input, another output or what is no file; for every command and every option that writes.

#include "catch.hpp"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "json.hpp"
#include "program.hpp"
#include "seed.hpp"

using program::Place;
using program::Run;
namespace fs = std::filesystem;

namespace {

const std::string scene_text =
    "material lamp emission 1\nmaterial grey reflectance 0.5\n"
    "polygon a material lamp {\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n}\n"
    "polygon b material grey {\nvertex 0 0 1\nvertex 0 1 1\nvertex 1 1 1\nvertex 1 0 1\n}\n";
const std::string mesh_text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string script_text = "h0 = make_segment\n";

// A command with its input, and the options that name an output, each with an ending that it takes.
struct Command {
  std::string name, input, ending;  // of the input's name
  std::string text;
  std::string rest;
  std::vector<std::pair<std::string, std::string>> outputs;
};
std::vector<Command> commands() {
  return {
      {"render",
       "input",
       ".scene",
       scene_text,
       " --audit 0 --epsilon 0.5 --quiet --size 8x8",
       {{"-o", ".png"}, {"-o", ".ply"}, {"--json", ".json"}}},
      {"factors", "input", ".scene", scene_text, " --error 0.1", {{"--csv", ".csv"}, {"--json", ".json"}, {"--total-exchange", ".csv"}}},
      {"mesh", "input", ".scene", scene_text, "", {{"-o", ".obj"}, {"-o", ".ply"}, {"-o", ".off"}, {"--json", ".json"}}},
      {"check", "input", ".obj", mesh_text, " --repair", {{"-o", ".obj"}, {"-o", ".ply"}, {"-o", ".off"}}},
      {"euler", "input", ".euler", script_text, "", {{"-o", ".svg"}, {"-o", ".html"}}},
      {"stress", "", "", "", " materials", {{"--json", ".json"}}}};
}

// Another name of the file: itself, through '.', '..', an absolute path, a symbolic or a hard link. Makes what it needs.
std::string alias(const Place& place, const std::string& file, const std::string& ending, std::mt19937& random) {
  static int counter = 0;
  const std::string fresh = "alias" + std::to_string(counter++) + ending;
  fs::create_directories(place.path() / "folder");
  switch (std::uniform_int_distribution<int>(0, 6)(random)) {
    case 0:
      return "./" + file;
    case 1:
      return "folder/../" + file;
    case 2:
      return (place.path() / file).string();
    case 3:
      fs::create_symlink(file, place.path() / fresh);
      return fresh;
    case 4:
      fs::create_symlink("../" + file, place.path() / "folder" / fresh);
      return "folder/" + fresh;
    case 5:
      if (!fs::exists(place.path() / file)) { return ".//" + file; }
      fs::create_hard_link(place.path() / file, place.path() / fresh);
      return fresh;
    default: {  // a link to a link
      fs::create_symlink((place.path() / file).string(), place.path() / ("one" + fresh));
      fs::create_symlink("one" + fresh, place.path() / fresh);
      return fresh;
    }
  }
}

}  // namespace

TEST_CASE("an output that is the input by any name is refused with exit code 2, and the input keeps its bytes") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (const Command& c : commands()) {
    if (c.input.empty()) { continue; }
    for (const auto& [option, ending] : c.outputs) {
      const Place place;
      // So that the ending of a link to it or of the file itself is one that the option takes.
      const bool any = option.starts_with("--");
      const std::string input = c.input + (any ? c.ending : c.name == "check" ? ".obj" : ending);
      place.write(input, c.text);
      for (int i = 0; i < 3; ++i) {
        const std::string output = alias(place, input, ending, random);
        const bool given_by_link = i == 2;
        const std::string arguments =
            given_by_link ? "'" + output + "'" + c.rest + " " + option + " " + input : input + c.rest + " " + option + " '" + output + "'";
        if (c.name == "check" && !(input.ends_with(ending) || (!given_by_link && output.ends_with(ending)))) { continue; }
        const Run run = place.run(c.name + " " + arguments);
        INFO(c.name << " " << arguments << "\n" << run.err);
        CHECK(run.code == 2);
        CHECK(run.err.find("each output needs a file of its own") != std::string::npos);
        CHECK(place.read(input) == c.text);
      }
    }
  }
}

TEST_CASE("an output that the scene reads is refused by any name with exit code 2 before anything is written") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::string obj = "mtllib q.mtl\nusemtl a\n" + mesh_text, mtl = "newmtl a\nKd 1 1 1\nmap_Kd q.png\n";
  const std::string cow = "material m reflectance .5 emission 1\nmesh cow file \"spot.obj\" material m\n";
  const std::string gltf = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"q.bin"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "images":[{"uri":"q.png"}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bin(reinterpret_cast<const char*>(corners), sizeof corners);
  const std::string wrl = "#VRML V1.0 ascii\nSeparator { WWWInline { name \"part.wrl\" } }\n";
  const std::string part = "#VRML V1.0 ascii\nCube {}\n", mgf = "i part.mgf\n";
  const std::string sphere = "m lamp =\n\ted 10\nm lamp\nv a =\n\tp 0 0 0\nsph a 1\n";
  struct Case {
    std::string scene, text, read, bytes, other, other_bytes;  // what the scene reads; what else it needs
    std::vector<std::string> commands;                         // behind a space the output's name is put
  };
  const std::string render = "render --audit 0 --epsilon .5 --quiet --size 8x8 SCENE ", any = render + "--json ";
  const std::vector<Case> cases = {
      {"a.scene",
       cow,
       "spot.obj",
       mesh_text,
       "",
       "",
       {render + "-o ", render + "-o a.png -o ", any, "mesh SCENE -o ", "mesh SCENE --json ", "factors SCENE --csv ",
        "factors SCENE --json ", "factors SCENE --total-exchange ", "explain SCENE -o "}},
      {"a.obj", obj, "q.mtl", mtl, "", "", {any, "mesh SCENE -o b.obj --json ", "factors SCENE --csv "}},
      {"a.obj", obj, "q.png", "no picture", "q.mtl", mtl, {render + "-o ", any}},
      {"a.gltf", gltf, "q.bin", bin, "", "", {any, "mesh SCENE --json "}},
      {"a.gltf", gltf, "q.png", "no picture", "q.bin", bin, {render + "-o "}},
      {"a.wrl", wrl, "part.wrl", part, "", "", {any, "mesh SCENE --json "}},
      {"a.mgf", mgf, "part.mgf", sphere, "", "", {any, "mesh SCENE --json "}},
      {"a.mgf", "i out/index.html\n", "out/index.html", sphere, "", "", {"study --quick SCENE -o out"}}};
  for (const Case& c : cases) {
    for (std::string command : c.commands) {
      const Place place;
      fs::create_directories(place.path() / "out");
      place.write(c.scene, c.text);
      place.write(c.read, c.bytes);
      if (!c.other.empty()) { place.write(c.other, c.other_bytes); }
      command.replace(command.find("SCENE"), 5, random() % 2 == 0 ? c.scene : (place.path() / c.scene).string());
      const std::string ending = fs::path(c.read).extension().string();
      if (command.back() == ' ') { command += "'" + (random() % 4 == 0 ? c.read : alias(place, c.read, ending, random)) + "'"; }
      const std::size_t entries = place.entries();
      const Run run = place.run(command);
      INFO(command << "\n" << run.out << run.err);
      CHECK(run.code == 2);
      CHECK(run.err.find("each output needs a file of its own") != std::string::npos);
      CHECK(place.read(c.read) == c.bytes);
      CHECK(place.entries() == entries);
    }
  }
}

TEST_CASE("two outputs that are one file by any name, old or new, are refused with exit code 2 before the work") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::vector<std::string> pairs[] = {{"render", " --audit 0 --epsilon 0.5 --quiet -o x.png -o ", ".png"},
                                            {"render", " --audit 0 --epsilon 0.5 --quiet -o x.ply --json ", ".ply"},
                                            {"factors", " --csv x.csv --json ", ".csv"},
                                            {"factors", " --total-exchange x.csv --csv ", ".csv"},
                                            {"mesh", " -o x.obj --json ", ".obj"},
                                            {"euler", " -o x.svg -o ", ".svg"}};
  for (const auto& pair : pairs) {
    for (const bool exists : {false, true}) {
      const Place place;
      place.write("input", pair[0] == "euler" ? script_text : scene_text);
      const std::string name = "x" + pair[2];
      if (exists) { place.write(name, "old"); }
      const std::string other = alias(place, name, pair[2], random);
      const Run run = place.run(pair[0] + " input" + pair[1] + "'" + other + "'");
      INFO(pair[0] << pair[1] << other << "\n" << run.err);
      CHECK(run.code == 2);
      CHECK(run.out.empty());
      CHECK(place.has(name) == exists);
      if (exists) { CHECK(place.read(name) == "old"); }
    }
  }
}

TEST_CASE("what is no regular file is written through and stays what it was") {
  for (const Command& c : commands()) {
    for (const auto& [option, ending] : c.outputs) {
      const Place place;
      if (!c.input.empty()) { place.write(c.input + c.ending, c.text); }
      const std::string pipe = "pipe" + ending;
      REQUIRE(::mkfifo((place.path() / pipe).c_str(), 0600) == 0);
      fs::create_symlink("/dev/null", place.path() / ("null" + ending));
      const std::string command = c.name + " " + (c.input.empty() ? "" : c.input + c.ending) + c.rest + " " + option + " ";
      const Run through = place.run(command + pipe, "(timeout 20 cat " + pipe + " > got 2>&1 </dev/null &); ");
      INFO(command << "\n" << through.err);
      CHECK(through.code == 0);
      for (int i = 0; i < 200 && place.read("got").empty(); ++i) { ::usleep(10000); }
      CHECK(place.read("got").size() > 10);
      CHECK(fs::is_fifo(place.path() / pipe));
      CHECK(place.run(command + "null" + ending).code == 0);
      CHECK(fs::is_character_file("/dev/null"));
      CHECK(fs::is_symlink(place.path() / ("null" + ending)));
    }
  }
}

TEST_CASE("an output on the standard output comes alone there, the report goes to stderr") {
  const Place place;
  place.write("input.scene", scene_text);
  for (const char* name : {"-", "/dev/stdout", "/proc/self/fd/1", "link"}) {
    if (std::string(name) == "link") { fs::create_symlink("/dev/stdout", place.path() / name); }
    for (const char* command :
         {"factors input.scene --json ", "mesh input.scene --json ", "render input.scene --audit 0 --quiet --json "}) {
      const Run run = place.run(std::string(command) + name);  // into a regular file
      INFO(command << name << "\n" << run.out << run.err);
      CHECK(run.code == 0);
      CHECK(json::parse(run.out).size() > 3);
      CHECK(run.err.find("area") != std::string::npos);
    }
    CHECK(place.run(std::string("factors input.scene --csv - --json ") + name).code == 2);
  }
  const Run appended = place.run("mesh input.scene --json /dev/fd/3", "printf 'old\\n' > log; exec 3>>log; ");
  CHECK(appended.code == 0);
  CHECK(place.read("log").starts_with("old\n{"));
}

TEST_CASE("an output may not lie where the program's own words go") {
  const Place place;
  place.write("input.scene", scene_text);
  CHECK(place.run("factors input.scene --csv stdout.log").code == 2);
  CHECK(place.run("factors input.scene --csv ./stderr.log").code == 2);
}

TEST_CASE("a scene comes from the standard input, too") {
  const Place place;
  place.write("input.scene", scene_text);
  for (const char* name : {"-", "/dev/stdin"}) {
    const Run run = place.run(std::string("mesh ") + name + " --json a.json < input.scene");
    INFO(run.err);
    CHECK(run.code == 0);
    CHECK(place.run(std::string("factors ") + name + " --csv input.scene < input.scene").code == 2);
    CHECK(place.read("input.scene") == scene_text);
  }
}

TEST_CASE("an empty name is no output, names that lead nowhere are known before the work") {
  const Place place;
  place.write("input.scene", scene_text);
  place.write("input.obj", mesh_text);
  place.write("input.euler", script_text);
  for (const Command& c : commands()) {
    for (const auto& [option, ending] : c.outputs) {
      const std::string command = c.name + " " + (c.input.empty() ? "" : c.input + c.ending) + c.rest + " " + option + " ";
      const std::size_t before = place.entries();
      const Run empty = place.run(command + "''");
      INFO(command << "\n" << empty.err);
      CHECK(empty.code == 2);
      for (const std::string& name : std::vector<std::string>{"none/a", "input.scene/a", "/dev/full/a", std::string(300, 'x'), "loop"}) {
        if (name == "loop" && !fs::is_symlink(place.path() / ("loop" + ending))) {
          fs::create_symlink("loop" + ending, place.path() / ("loop" + ending));
        }
        const std::size_t entries = place.entries();
        const Run run = place.run(command + name + ending);
        INFO(name << "\n" << run.err);
        CHECK(run.code == 1);
        CHECK(run.out.empty());
        CHECK(place.entries() == entries);
      }
      CHECK(place.entries() <= before + 1);
    }
  }
}

TEST_CASE("a mesh to check, a script to play, a scene to render that is the wrong file gets one sentence") {
  const Place place;
  std::string stl(84 + 50, '\0');
  stl[80] = 1;
  const std::pair<const char*, std::string> files[] = {{"a.scene", scene_text},
                                                       {"a.obj", "# by hand\n" + mesh_text},
                                                       {"a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"},
                                                       {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
                                                       {"a.euler", script_text},
                                                       {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\n"},
                                                       {"b.stl", stl},
                                                       {"a.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)},
                                                       {"a.jpg", "\xff\xd8\xff\xe0"},
                                                       {"a.bin", std::string("\x01\x02\0\x03", 4)},
                                                       {"a.html", "<!doctype html>\n<p>words"},
                                                       {"a.txt", "Dear reader,\nthis is prose.\nIt goes on\nand on\n"},
                                                       {"empty.scene", ""},
                                                       {"blank.obj", " \n\n"}};
  for (const auto& [name, bytes] : files) { place.write(name, bytes); }
  for (const auto& [name, bytes] : files) {
    const std::string file = name;
    for (const std::string command : {"render", "info", "mesh", "factors", "study -o out", "check", "euler"}) {
      const bool mesh = file == "a.obj" || file == "a.off" || file == "a.ply";
      const bool model = file == "a.obj" || file == "a.off";  // a scene, too; a.ply has nothing in it
      const bool right = command == "check" ? mesh : command == "euler" ? file == "a.euler" : file == "a.scene" || model;
      if (right || (command == "euler" && (file == "empty.scene" || file == "blank.obj"))) { continue; }  // a script of no steps is sound
      const Run run = place.run(command + " " + file);
      INFO(command << " " << file << "\n" << run.err);
      CHECK(run.code == (command == "check" && !file.ends_with(".obj") ? 2 : 3));
      CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
      CHECK(run.err.find(file) != std::string::npos);
      CHECK(run.out.empty());
    }
  }
  for (const char* command : {"render", "info", "mesh", "factors", "euler"}) {
    const Run run = place.run(std::string(command) + " .");
    CHECK(run.code == 1);
    CHECK(run.err == "halflight: . is a folder; expected a file\n");
    CHECK(place.run(std::string(command) + " none").code == 1);
  }
  // One fault in a scene is told where it lies, as ever.
  place.write("typo.scene", "materail a reflectance 0.5\n");
  CHECK(place.run("info typo.scene").err.starts_with("typo.scene:1:1: error: "));
}

TEST_CASE("names of files that are no text make valid JSON") {
  const Place place;
  place.write("in\xff\xc3(.scene", scene_text);
  const Run run = place.run("mesh 'in\xff\xc3(.scene' -o 'out\xfe.obj' --json");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(json::parse(run.out)["scene"].string() == "in\xef\xbf\xbd\xef\xbf\xbd(.scene");
  CHECK(json::parse(run.out)["files"][0].string() == "out\xef\xbf\xbd.obj");
  CHECK(place.has("out\xfe.obj"));
}

TEST_CASE("a folder that cannot be made is told with the reason") {
  const Place place;
  place.write("there", "");
  CHECK(place.run("figures -o there").err == "halflight: cannot make the folder there: Not a directory\n");
  CHECK(place.run("figures -o there/in").err == "halflight: cannot make the folder there/in: Not a directory\n");
}
