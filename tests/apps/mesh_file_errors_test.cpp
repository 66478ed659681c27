// SPDX-License-Identifier: MIT
// Mesh files: what a format does not allow is an error with its place, and nothing brings the readers down.
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/mesh_file/reading.hpp"
#include "mesh_files.hpp"

using namespace mesh_files;

TEST_CASE("errors say where they lie, what was expected and what was found") {
  CHECK(begins(error("", as_obj), ":1:1: error: the file has no faces"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 99 2"), as_obj), ":10:7: error: there is no vertex 99, the file has 8"));
  CHECK(begins(error("\xef\xbb\xbf# \xc3\xa4\r\n\rf 1 \\\r\n 7 8\nv 0 0 0", as_obj), ":4:2: error: there is no vertex 7"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 0 2"), as_obj), ":10:7: error: vertices are counted from 1"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 -9 4 2"), as_obj), ":10:5: error: the corner -9 counts back"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3/x 4 2"), as_obj), ":10:5: error: expected a corner such as"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 \\\n4/1/1/1 2"), as_obj), ":11:1: error: expected a corner such as"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 99999999999 3 4 2"), as_obj), ":10:3: error: there is no vertex 99999999999"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f"), as_obj), ":10:2: error: expected the corners"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 nan 1"), as_obj),
               ":9:5: error: expected a coordinate, a finite number, found 'nan'"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 1e999 1"), as_obj), ":9:5: error: expected a coordinate"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 1"), as_obj), ":9:6: error: expected a coordinate, found the end of the line"));
  CHECK(begins(error("\x7f\x45LF\x01\n", as_obj), ":1:1: error: expected a statement such as v, f or vn, found '?ELF?'"));
  CHECK(begins(error(cube_obj + "vw 0 0 1.0\nv2 1 2 3\n", as_obj), ":17:1: error: expected a statement such as v, f or vn, found 'v2'"));
  CHECK(begins(error("room size 5 4 3\n", as_obj), ":1:1: error: the file has no faces"));
  CHECK(begins(error(std::string("v 0 0 0\nv \0", 11), as_obj), ":2:3: error: expected text, found a zero byte"));
  CHECK(begins(error("# \xc3\xa4\xc3\xb6\nv \xc3\xa4 x 0\n", as_obj), ":2:3: error:"));

  const std::string off = apps::write_mesh(cube(), as_off);
  CHECK(begins(error("", as_off), ":1:1: error: the file is empty"));
  CHECK(begins(error("OFF\n8 0 0\n", as_off), ":2:3: error: the file has no faces"));
  CHECK(begins(error("OFF BINARY\n", as_off), ":1:5: error: binary OFF is not read"));
  CHECK(begins(error("4OFF\n", as_off), ":1:1: error: positions in more than three dimensions"));
  CHECK(begins(error(replaced(off, "8 6 0\n", "8 -6 0\n"), as_off), ":2:3: error: expected the number of faces, found '-6'"));
  CHECK(begins(error(replaced(off, "8 6 0\n", "8 7 0\n"), as_off), ":16:10: error: the file ends before face 7 of 7"));
  CHECK(begins(error(replaced(off, "4 0 2 3 1", "4 0 2 8 1"), as_off), ":11:7: error: expected a vertex, a number from 0 to 7, found '8'"));
  CHECK(begins(error(replaced(off, "4 0 2 3 1", "5 0 2 3 1"), as_off), ":11:10: error: the face has 4 of the 5 corners"));

  // Points and lines alone: what the file has is said, in one sentence.
  CHECK(error("v 0 0 0\nv 1 0 0\np 1\nl 1 2\nl 2 1\n", as_obj) ==
        ":1:1: error: the file has no faces, but 2 vertices and 2 lines 'l', 1 line 'p': points and lines have no surface that light could "
        "fall on");
  CHECK(begins(error("v 0 0 0\n", as_obj), ":1:1: error: the file has no faces, but 1 vertex: points have no surface"));
  CHECK(begins(error("OFF\n8 0 0\n", as_off), ":2:3: error: the file has no faces, but 8 vertices: points have no surface"));
  const std::string points = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  CHECK(error(points, as_ply).find("the file has no faces, but 3 vertices: points have no surface") != std::string::npos);

  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(begins(error("plyx\n", as_ply), ":1:1: error: expected ply"));
  CHECK(begins(error(head.substr(0, 40), as_ply), ":4:"));
  CHECK(begins(error(replaced(head, "ascii", "text") + body, as_ply), ":2:8: error: expected ascii"));
  CHECK(begins(error(replaced(head, "float y", "float w") + body, as_ply), ":9:1: error: expected an element vertex with"));
  CHECK(begins(error(replaced(head, "float y", "float x") + body, as_ply), ":5:16: error: 'x' is declared twice"));
  CHECK(begins(error(replaced(head, "uchar int", "float int") + body, as_ply), ":8:15: error: expected an integer type"));
  CHECK(begins(error(replaced(head, "uchar int", "uchar float") + body, as_ply), ":8:10: error: the corners of faces must be"));
  CHECK(begins(error(replaced(head, "face 1", "face -1") + body, as_ply), ":7:14: error: expected 'element NAME COUNT'"));
  CHECK(begins(error(replaced(head, "face 1", "tristrips 1") + replaced(body, "3 0 1 2", "3 0 1 -2"), as_ply),
               ":13:7: error: expected a vertex, a number from 0 to 2, found '-2'"));
  CHECK(begins(error(replaced(head, "face 1", "tristrips 0") + body, as_ply), ":9:1: error: the file has no faces"));
  CHECK(begins(error(replaced(head, "face 1", "tristrips 1") + replaced(body, "3 0 1 2", "3 0 1 0"), as_ply),
               ":13:1: error: the file has no faces, but 3 vertices"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "3 0 1 3"), as_ply),
               ":13:7: error: expected a vertex, a number from 0 to 2, found '3'"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "3 0 1"), as_ply), ":13:6: error: the line of face 1 of 1 has too few values"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "-3 0 1 2"), as_ply), ":13:1: error: expected the length of a list"));
  CHECK(begins(error(head + replaced(body, "1 0 0", "1 0 0 0"), as_ply), ":11:7: error: the line of vertex 2 of 3 has too many values"));
  CHECK(begins(error(replaced(head, "vertex 3", "vertex 999999999999") + body, as_ply),
               ":13:7: error: the line of vertex 4 of 999999999999 has too many values"));
}

TEST_CASE("a binary file that ends too early, or whose counts lie, is an error at its byte and costs nothing") {
  const std::string whole = apps::write_mesh(cube(), as_ply);
  const std::size_t data = whole.find("end_header\n") + 11;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const apps::MeshResult result = apps::read_mesh(whole.substr(0, size), as_ply);
    REQUIRE(result.errors.size() == 1);
    if (size >= data) { CHECK(result.errors[0].place.line == 0); }
  }
  CHECK(begins(error(replaced(whole, "vertex 8", "vertex 4611686018427387904"), as_ply), ":byte "));
  CHECK(begins(error(replaced(whole, "face 6", "face 4611686018427387904"), as_ply), ":byte "));
  std::string lie = replaced(whole, "list uchar", "list uint");  // the first length takes in three corners
  CHECK(begins(error(lie, as_ply), ":byte "));
  const auto more = apps::read_mesh(whole + "x", as_ply);
  CHECK((more.mesh.has_value() && more.mesh->notes.size() == 1));
  std::string nan = whole;
  for (int i = 0; i < 8; ++i) { nan[data + static_cast<std::size_t>(i)] = '\xff'; }
  CHECK(begins(error(nan, as_ply), ":byte " + std::to_string(data + 1) + ": error: a coordinate is not a finite number"));
}

TEST_CASE("errors are given up after a number of them") {
  std::string text;
  for (int i = 0; i < 1000; ++i) { text += "1\n"; }
  const auto result = apps::read_mesh(text, as_obj);
  CHECK((result.more_errors && result.errors.size() == apps::max_errors));
}

TEST_CASE("damaged files of every format never bring the readers down, and give a mesh or an error") {
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::vector<std::pair<std::string, MeshFormat>> seeds{
      {cube_obj, as_obj},
      {apps::write_mesh(cube(), as_off), as_off},
      {ascii, as_ply},
      {apps::write_mesh(cube(), as_ply), as_ply},
      {odd_ply<std::uint16_t, std::int32_t, float>(true, "ushort", "int", "float"), as_ply}};
  const std::vector<std::string> words{"-1",
                                       "0",
                                       "99999999999999999999",
                                       "1e999",
                                       "nan",
                                       "/",
                                       "//",
                                       "\\\n",
                                       "#",
                                       "\r",
                                       "list",
                                       "uchar",
                                       "f ",
                                       "element face 9\n",
                                       "property int8 q\n",
                                       "\xff\xff\xff\xff",
                                       std::string(1, '\0'),
                                       "end_header\n",
                                       " "};
  std::size_t read = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 150000; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    auto [bytes, format] = seeds[random() % seeds.size()];
    for (auto k = 1 + random() % 6; k > 0 && !bytes.empty(); --k) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 5) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.insert(at, words[random() % words.size()]);
          break;
        case 2:
          bytes.erase(at, 1 + random() % 8);
          break;
        case 3:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 40));
          break;
        default:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      }
    }
    if (random() % 8 == 0) format = *apps::mesh_formats()[random() % apps::mesh_formats().size()];  // taken for another format
    const apps::MeshResult result = apps::read_mesh(bytes, format);
    REQUIRE(result.mesh.has_value() == result.errors.empty());
    REQUIRE(result.errors.size() <= apps::max_errors);
    ++(result.mesh ? read : refused);
    if (!result.mesh) { continue; }
    const apps::Mesh& mesh = *result.mesh;
    REQUIRE(mesh.builder.face_count() > 0);
    for (std::uint32_t f = 0; f < mesh.builder.face_count(); ++f) {
      for (std::uint32_t v : mesh.builder.corners(f)) { REQUIRE(v < mesh.builder.vertex_count()); }
    }
    check_same(std::move(apps::read_mesh(apps::write_mesh(mesh.builder, format), format).mesh->builder), mesh.builder);
  }
  CHECK((read > 1000 && refused > 1000));
}

TEST_CASE("a word in a message keeps its characters of any language, and what controls a terminal or is no character is a question mark") {
  using apps::mesh_file::shown;
  CHECK(shown("") == "''");
  CHECK(shown("Stra\xc3\x9f"
              "e") ==
        "'Stra\xc3\x9f"
        "e'");
  CHECK(shown("\xed\x83\x81\xec\x9e\x90.142") == "'\xed\x83\x81\xec\x9e\x90.142'");
  CHECK(shown("a\x1b[2Jb\x7f") == "'a?[2Jb?'");
  CHECK(shown("\xc2\x9b"
              "2J\xc2\xa0") == "'?2J\xc2\xa0'");  // U+009B begins a command of terminals
  CHECK(shown("\xff.\xc3") == "'?.?'");
  std::string umlauts, forty;
  for (int i = 0; i < 41; ++i) { umlauts += "\xc3\xa4"; }
  for (int i = 0; i < 40; ++i) { forty += "\xc3\xa4"; }
  CHECK(shown(umlauts) == "'" + forty + "...'");
  CHECK(shown(forty) == "'" + forty + "'");
}
