// SPDX-License-Identifier: MIT
// Mesh files: what the formats allow is read, and what is written reads back.
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/statistics.hpp>

#include "apps/file_kind.hpp"
#include "apps/scene_file.hpp"
#include "json.hpp"
#include "mesh_files.hpp"

using namespace mesh_files;

TEST_CASE("a mesh that was written reads back exactly, in every format") {
  brep::Builder odd;
  std::mt19937 random(3);
  for (int v = 0; v < 400; ++v) {
    const auto value = [&] { return std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 600) - 300); };
    odd.vertex({value(), value(), value()});
  }
  std::vector<std::uint32_t> large;
  for (std::uint32_t v = 0; v < 300; ++v) { large.push_back(v); }
  odd.face({1, 2, 399}, 0);
  for (const MeshFormat& format : {as_obj, as_ply, as_off}) { check_same(read(apps::write_mesh(odd, format), format), odd); }
  odd.face(large, 0);  // more corners than a byte counts
  for (const MeshFormat& format : {as_obj, as_ply, as_off}) { check_same(read(apps::write_mesh(odd, format), format), odd); }
}

TEST_CASE("line ends, comments, blanks and a missing last line end do not change what is read") {
  for (const MeshFormat& format : {as_obj, as_off}) {
    const std::string text = format.ending == ".obj" ? cube_obj : apps::write_mesh(cube(), format);
    for (const std::string& variant :
         {replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), replaced(text, "\n", "\n\n"), replaced(text, "\n", " # said\n"),
          replaced(text, " ", " \t "), text.substr(0, text.size() - 1), "\xef\xbb\xbf" + text}) {
      check_same(read(variant, format), cube());
    }
  }
}

TEST_CASE("OBJ: every form of a corner, numbers from the end, continued lines, statements that do not matter") {
  const std::string more = "o cube\ng a b\ns off\nusemtl steel\nvt 0 0\nvn 0 0 1\n";
  for (const char* form :
       {"f 1/1 3/1 4/1 2/1", "f 1//1 3//1 4//1 2//1", "f 1/1/1 3/1/1 4/1/1 2/1/1", "f -8 -6 -5 -7", "f 1 3 \\\n4 2", "f 1/-1 3 4/ 2"}) {
    check_same(read(more + replaced(cube_obj, "f 1 3 4 2", form), as_obj), cube());
  }
  check_same(read(replaced(cube_obj, "v 1 1 1", "v 1 1 1 1.0"), as_obj), cube());
  check_same(read(replaced(cube_obj, "v 1 1 1", "v +1.0e0 1. 10e-1 0.5 0.5 0.5"), as_obj), cube());
  // Faces may stand before their vertices.
  const std::size_t f = cube_obj.find("f ");
  check_same(read(cube_obj.substr(f) + cube_obj.substr(0, f), as_obj), cube());
  const auto lines = apps::read_mesh(cube_obj + "l 1 2\nl 2 3\n", as_obj);
  REQUIRE(lines.mesh.has_value());
  REQUIRE(lines.mesh->notes.size() == 1);
  CHECK(begins(lines.mesh->notes[0], "2 lines 'l' passed over"));
  CHECK(lines.mesh->vertex_line.front() == 2);
  CHECK(lines.mesh->face_line.back() == 15);
}

TEST_CASE("OBJ: statements of other programs are passed over, and told in one sentence, however many words they have") {
  const apps::MeshResult result = apps::read_mesh("t crease 2/1/0 0 1 2.0\n" + cube_obj + "vw 0 0 1.0\nvw 1 0 0.5 1 0.5\n", as_obj);
  REQUIRE(result.mesh.has_value());
  check_same(result.mesh->builder, cube());
  CHECK(result.mesh->notes == std::vector<std::string>{"3 lines that are no statements of OBJ passed over, the first 't' at line 1"});
  std::string many = cube_obj;
  for (int i = 0; i < 1000; ++i) { many += std::string(1000, 'a') + std::string(i, 'b') + " 1\n"; }
  const apps::MeshResult long_words = apps::read_mesh(many, as_obj);
  REQUIRE(long_words.mesh.has_value());
  REQUIRE(long_words.mesh->notes.size() == 1);
  CHECK(begins(long_words.mesh->notes[0], "1000 lines that are no statements of OBJ passed over"));
  CHECK(long_words.mesh->notes[0].size() < 200);
}

// Stanford's and Georgia Tech's scanned models are strips. A strip of n corners, cut anywhere by -1 and with the two corners before
// the cut said again, is the same triangles, all of them seen from the same side.
TEST_CASE("PLY: triangle strips are the triangles that they stand for, wherever they are cut, in text and binary") {
  std::mt19937 random(29);
  INFO("seed 29");
  for (int run = 0; run < 50; ++run) {
    const std::uint32_t n = 3 + static_cast<std::uint32_t>(random() % 12);
    brep::Builder zigzag;  // of two rows in the plane z = 0; every triangle looks down
    for (std::uint32_t v = 0; v < n; ++v) { zigzag.vertex({v / 2, v % 2, 0}); }
    std::vector<std::int32_t> strip{0, 1};
    for (std::uint32_t v = 2; v < n; ++v) {
      zigzag.face(v % 2 == 0 ? std::vector{v - 2, v - 1, v} : std::vector{v - 1, v - 2, v}, 0);
      const auto last = static_cast<std::int32_t>(v);
      if (random() % 3 == 0 && v % 2 == 0) { strip.insert(strip.end(), {-1, last - 2, last - 1}); }
      strip.push_back(last);
    }
    for (const bool binary : {false, true}) {
      Bytes bytes(true);
      bytes.text = std::string("ply\nformat ") + (binary ? "binary_big_endian" : "ascii") + " 1.0\nelement vertex " + std::to_string(n) +
                   "\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
                   "property list int int vertex_indices\nend_header\n";
      const auto put = [&](auto value) { binary ? bytes.put(value) : void(bytes.text += std::to_string(value) + " "); };
      const auto end_line = [&] { bytes.text += binary ? "" : "\n"; };
      for (std::uint32_t v = 0; v < n; ++v) {
        for (int i = 0; i < 3; ++i) { put(static_cast<float>(zigzag.position(v)[i])); }
        end_line();
      }
      put(static_cast<std::int32_t>(strip.size()));
      for (const std::int32_t corner : strip) { put(corner); }
      end_line();
      const brep::Builder back = read(bytes.text, as_ply);
      REQUIRE(back.face_count() == zigzag.face_count());
      for (std::uint32_t f = 0; f < back.face_count(); ++f) {
        std::vector<std::uint32_t> is(back.corners(f).begin(), back.corners(f).end());
        std::vector<std::uint32_t> wanted(zigzag.corners(f).begin(), zigzag.corners(f).end());
        std::rotate(is.begin(), std::min_element(is.begin(), is.end()), is.end());
        std::rotate(wanted.begin(), std::min_element(wanted.begin(), wanted.end()), wanted.end());
        CHECK(is == wanted);
      }
    }
  }
}

TEST_CASE("PLY: odd types, unknown elements and properties, both byte orders") {
  for (const bool big : {false, true}) {
    check_same(read(odd_ply<std::uint8_t, std::int32_t, float>(big, "uchar", "int", "float"), as_ply), cube());
    check_same(read(odd_ply<std::int8_t, std::uint8_t, double>(big, "int8", "uint8", "float64"), as_ply), cube());
    check_same(read(odd_ply<std::int16_t, std::uint16_t, double>(big, "short", "ushort", "double"), as_ply), cube());
    check_same(read(odd_ply<std::uint32_t, std::int8_t, std::int16_t>(big, "uint32", "char", "int16"), as_ply), cube());
    check_same(read(odd_ply<std::int32_t, std::uint32_t, float>(big, "int", "uint32", "float32"), as_ply), cube());
  }
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nelement face 1\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n\r\n0 1 0\r\n3 0 1 2";
  CHECK(read(text, as_ply).face_count() == 1);
}

TEST_CASE("OFF: keywords, counts on the keyword's line, no keyword, colours and normals") {
  const std::string text = apps::write_mesh(cube(), as_off);
  for (const char* head : {"OFF 8 6 12\n", "COFF\n8 6 0\n", "NOFF\n8 6\n", "STCNOFF # all\n\n8 6 0 # counts\n", "8 6 12\n"}) {
    check_same(read(replaced(text, "OFF\n8 6 0\n", head), as_off), cube());
  }
  check_same(read(replaced(text, "1 1 1\n", "1 1 1 0 0 1 255 255 255 0\n"), as_off), cube());
  check_same(read(replaced(text, "4 0 2 3 1\n", "4 0 2 3 1  0.5 0.5 0.5\n"), as_off), cube());
  check_same(read(replaced(text, "4 0 2 3 1\n", "4 0 \n2 # more\n\n3 1\n"), as_off), cube());
}

// Minutes when the column of each corner is counted from the start of its line.

TEST_CASE("OBJ: a face of 200000 corners may stand before its vertices, in one line or in many") {
  constexpr int n = 200000;
  for (const char* blank : {" ", " \\\n"}) {
    std::string face = "f", vertices = "\n";
    for (int i = 1; i <= n; ++i) {
      face += blank + std::to_string(i);
      vertices += "v 0 0 " + std::to_string(i) + "\n";
    }
    CHECK(read(face + vertices, as_obj).corners(0).size() == n);
  }
}

TEST_CASE("what a format writes is recognised as that format, whatever the mesh, and as no other") {
  std::mt19937 random(17);
  INFO("seed 17");
  for (int run = 0; run < 50; ++run) {
    brep::Builder mesh;
    for (int v = 0; v < 6; ++v) { mesh.vertex({1e-3 * static_cast<double>(random()), -static_cast<double>(random() % 9), 0.5}); }
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % 6); };
    mesh.face({corner(), corner(), corner()}, 0);
    for (const MeshFormat* const format : apps::mesh_formats()) {
      const std::string bytes = apps::write_mesh(mesh, *format);
      const apps::FileGuess guess = apps::guess_kind(bytes);
      CHECK(guess.kind == apps::FileKind::mesh);
      CHECK(guess.format == format);
      CHECK(apps::mesh_format(std::string("m").append(format->ending)) == format);
      for (const MeshFormat* const wanted : apps::mesh_formats()) {
        CHECK(apps::wrong_kind("m", bytes, apps::FileKind::mesh, wanted).has_value() == (wanted != format));
      }
    }
  }
}

TEST_CASE("the format follows from the name") {
  CHECK(apps::mesh_format("a.obj") == &as_obj);
  CHECK(apps::mesh_format("dir/A.PLY") == &as_ply);
  CHECK(apps::mesh_format("x.Off") == &as_off);
  for (const char* name : {"", ".obj", "obj", "a.obj.gz", "a.stl"}) { CHECK(apps::mesh_format(name) == nullptr); }
}

TEST_CASE("real meshes have the counts and the manifold status that independent software found") {
  const std::filesystem::path folder = std::filesystem::path(HALFLIGHT_REFERENCE_DATA) / "meshes";
  if (!std::filesystem::exists(folder / "manifest.json")) { SKIP_TEST("no meshes of others in " << folder.string()); }
  const json::Value manifest = json::parse_file((folder / "manifest.json").string());
  CHECK(manifest.size() == 4);
  for (const json::Value& entry : manifest.array()) {
    const std::string path = (folder / (entry["name"].string() + ".obj")).string();
    INFO(path);
    std::string fault;
    const auto bytes = apps::read_text(path, fault);
    REQUIRE(bytes.has_value());
    const brep::Builder builder = read(*bytes, as_obj);
    const brep::Statistics s = brep::statistics(builder);
    const auto number = [&](const char* key) { return static_cast<std::size_t>(entry[key].number()); };
    CHECK(s.vertices == number("vertices"));
    CHECK(s.used_vertices == number("used_vertices"));
    CHECK(s.faces == number("faces"));
    CHECK(s.edges == number("edges"));
    CHECK(s.border_edges == number("boundary_edges"));
    CHECK(s.nonmanifold_edges == number("nonmanifold_edges"));
    CHECK(s.components.size() == number("components"));
    CHECK(s.euler() == static_cast<long>(entry["euler_characteristic"].number()));
    CHECK(s.oriented == entry["consistently_oriented"].boolean());
    CHECK(s.closed() == entry["closed"].boolean());
    CHECK(s.duplicate_positions == number("duplicate_positions"));
    CHECK(s.unusable_faces == number("degenerate_faces"));
    for (const auto& [size, count] : entry["face_sizes"].object()) {
      CHECK(s.face_sizes.at(std::stoul(size)) == static_cast<std::size_t>(count.number()));
    }
    for (int i = 0; i < 3; ++i) {
      CHECK(s.lo[i] == entry["bbox"][0][i].number());
      CHECK(s.hi[i] == entry["bbox"][1][i].number());
    }
    const auto closed = brep::close<brep::BRep<>>(builder);
    CHECK(closed.brep.has_value() == entry["closed_2_manifold"].boolean());
    std::size_t fans = 0, edges = 0;
    for (const brep::Defect& d : closed.defects) {
      fans += d.kind == brep::DefectKind::several_fans ? 1U : 0U;
      edges += d.kind == brep::DefectKind::nonmanifold_edge ? 1U : 0U;
    }
    CHECK(fans == number("nonmanifold_vertices"));
    CHECK(edges == number("nonmanifold_edges"));
    if (entry["total_genus"].is_number()) {
      long genus = 0;
      for (const brep::Component& c : s.components) { genus += c.genus.value(); }
      CHECK(genus == static_cast<long>(entry["total_genus"].number()));
      // 5856 terms of at most 1 m3 / 1000 each: rounding stays far below 1e-12.
      CHECK(s.components[0].volume.value() == Approx(entry["signed_volume"].number()).epsilon(1e-12));
    }
  }
}

TEST_CASE("OBJ: of a file with nothing but free-form surfaces it is told that these are not read") {
  const apps::MeshResult read = apps::read_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\n",
                                                *apps::mesh_format("a.obj"));
  REQUIRE_FALSE(read.mesh);
  CHECK(read.errors.at(0).sentence.find("free-form surfaces (surf), which are not read") != std::string::npos);
}

TEST_CASE("OBJ: what editors leave at the end of lines and of the file changes nothing") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const char* const faces :
       {"f 1 2 3 4\n", "f 1 2 \\\n3 4\n", "f 1 2 \\ \t\n3 4\n", "f 1 2 3 4\n\x1a", "f 1 2 3 4\x1a", "f 1 2 3 4 \\ \n"}) {
    CAPTURE(faces);
    const apps::MeshResult read = apps::read_mesh(vertices + faces, *apps::mesh_format("a.obj"));
    REQUIRE(read.mesh);
    REQUIRE(read.mesh->builder.face_count() == 1);
    CHECK(read.mesh->builder.corners(0).size() == 4);
  }
}
