// SPDX-License-Identifier: MIT
// Mesh files: what the formats allow is read, everything else is an error with its place, and nothing brings the readers down.
#include "catch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <brep/builder.hpp>
#include <brep/statistics.hpp>

#include "apps/mesh_file.hpp"
#include "json.hpp"

namespace {

using apps::MeshFormat;

const std::string cube_obj =
    "# a cube\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

brep::Builder cube() { return std::move(apps::read_mesh(cube_obj, MeshFormat::obj).mesh->builder); }

void check_same(const brep::Builder& a, const brep::Builder& b) {
  REQUIRE(a.vertex_count() == b.vertex_count());
  REQUIRE(a.face_count() == b.face_count());
  for (std::uint32_t v = 0; v < a.vertex_count(); ++v) CHECK(a.position(v) == b.position(v));
  for (std::uint32_t f = 0; f < a.face_count(); ++f) {
    CHECK(std::equal(a.corners(f).begin(), a.corners(f).end(), b.corners(f).begin(), b.corners(f).end()));
  }
}
brep::Builder read(const std::string& bytes, MeshFormat format) {
  apps::MeshResult result = apps::read_mesh(bytes, format);
  INFO(apps::to_text(result, "file"));
  REQUIRE(result.mesh.has_value());
  return std::move(result.mesh->builder);
}
// The first error as text, without the file's name.
std::string error(const std::string& bytes, MeshFormat format) {
  const apps::MeshResult result = apps::read_mesh(bytes, format);
  CHECK(result.mesh.has_value() == result.errors.empty());
  const std::string text = apps::to_text(result, "");
  return text.substr(0, text.find('\n'));
}
bool begins(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

// Values for binary files, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class T>
  void put(T value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_ == (std::endian::native == std::endian::little)) std::reverse(bytes.begin(), bytes.end());
    text += bytes;
  }
  std::string text;

 private:
  bool big_;
};

// The cube with odd types, properties and elements around what is read.
template <class Count, class Index, class Real>
std::string odd_ply(bool big, const std::string& count, const std::string& index, const std::string& real) {
  const brep::Builder b = cube();
  Bytes out(big);
  out.text = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\ncomment odd\nelement camera 2\nproperty list " +
             count + " short path\nelement vertex 8\nproperty uchar red\nproperty " + real + " z\nproperty " + real + " x\nproperty list " +
             count + " double weights\nproperty " + real + " y\nelement face 6\nproperty float area\nproperty list " + count + " " + index +
             " vertex_index\nproperty uchar flag\nelement nothing 1000000000000\nend_header\n";
  for (int i = 0; i < 2; ++i) {
    out.put(static_cast<Count>(i));
    for (int k = 0; k < i; ++k) out.put(std::int16_t{-7});
  }
  for (std::uint32_t v = 0; v < 8; ++v) {
    out.put(std::uint8_t{200});
    out.put(static_cast<Real>(b.position(v).z));
    out.put(static_cast<Real>(b.position(v).x));
    out.put(static_cast<Count>(v % 3));
    for (std::uint32_t k = 0; k < v % 3; ++k) out.put(0.5);
    out.put(static_cast<Real>(b.position(v).y));
  }
  for (std::uint32_t f = 0; f < 6; ++f) {
    out.put(1.5F);
    out.put(static_cast<Count>(b.corners(f).size()));
    for (std::uint32_t v : b.corners(f)) out.put(static_cast<Index>(v));
    out.put(std::uint8_t{1});
  }
  return out.text;
}

}  // namespace

TEST_CASE("a mesh that was written reads back exactly, in every format") {
  brep::Builder odd;
  std::mt19937 random(3);
  for (int v = 0; v < 400; ++v) {
    const auto value = [&] { return std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 600) - 300); };
    odd.vertex({value(), value(), value()});
  }
  std::vector<std::uint32_t> large;
  for (std::uint32_t v = 0; v < 300; ++v) large.push_back(v);
  odd.face({1, 2, 399}, 0);
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::off})
    check_same(read(apps::write_mesh(odd, format), format), odd);
  odd.face(large, 0);  // more corners than a byte counts
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::off})
    check_same(read(apps::write_mesh(odd, format), format), odd);
}

TEST_CASE("line ends, comments, blanks and a missing last line end do not change what is read") {
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off}) {
    const std::string text = format == MeshFormat::obj ? cube_obj : apps::write_mesh(cube(), format);
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
    check_same(read(more + replaced(cube_obj, "f 1 3 4 2", form), MeshFormat::obj), cube());
  }
  check_same(read(replaced(cube_obj, "v 1 1 1", "v 1 1 1 1.0"), MeshFormat::obj), cube());
  check_same(read(replaced(cube_obj, "v 1 1 1", "v +1.0e0 1. 10e-1 0.5 0.5 0.5"), MeshFormat::obj), cube());
  // Faces may stand before their vertices.
  const std::size_t f = cube_obj.find("f ");
  check_same(read(cube_obj.substr(f) + cube_obj.substr(0, f), MeshFormat::obj), cube());
  const auto lines = apps::read_mesh(cube_obj + "l 1 2\nl 2 3\n", MeshFormat::obj);
  REQUIRE(lines.mesh.has_value());
  REQUIRE(lines.mesh->notes.size() == 1);
  CHECK(begins(lines.mesh->notes[0], "2 lines 'l' passed over"));
  CHECK(lines.mesh->vertex_line.front() == 2);
  CHECK(lines.mesh->face_line.back() == 15);
}

TEST_CASE("PLY: odd types, unknown elements and properties, both byte orders") {
  for (const bool big : {false, true}) {
    check_same(read(odd_ply<std::uint8_t, std::int32_t, float>(big, "uchar", "int", "float"), MeshFormat::ply), cube());
    check_same(read(odd_ply<std::int8_t, std::uint8_t, double>(big, "int8", "uint8", "float64"), MeshFormat::ply), cube());
    check_same(read(odd_ply<std::int16_t, std::uint16_t, double>(big, "short", "ushort", "double"), MeshFormat::ply), cube());
    check_same(read(odd_ply<std::uint32_t, std::int8_t, std::int16_t>(big, "uint32", "char", "int16"), MeshFormat::ply), cube());
    check_same(read(odd_ply<std::int32_t, std::uint32_t, float>(big, "int", "uint32", "float32"), MeshFormat::ply), cube());
  }
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nelement face 1\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n\r\n0 1 0\r\n3 0 1 2";
  CHECK(read(text, MeshFormat::ply).face_count() == 1);
}

TEST_CASE("OFF: keywords, counts on the keyword's line, no keyword, colours and normals") {
  const std::string text = apps::write_mesh(cube(), MeshFormat::off);
  for (const char* head : {"OFF 8 6 12\n", "COFF\n8 6 0\n", "NOFF\n8 6\n", "STCNOFF # all\n\n8 6 0 # counts\n", "8 6 12\n"}) {
    check_same(read(replaced(text, "OFF\n8 6 0\n", head), MeshFormat::off), cube());
  }
  check_same(read(replaced(text, "1 1 1\n", "1 1 1 0 0 1 255 255 255 0\n"), MeshFormat::off), cube());
  check_same(read(replaced(text, "4 0 2 3 1\n", "4 0 2 3 1  0.5 0.5 0.5\n"), MeshFormat::off), cube());
}

TEST_CASE("errors say where they lie, what was expected and what was found") {
  CHECK(begins(error("", MeshFormat::obj), ":1:1: error: the file has no faces"));
  CHECK(
      begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 99 2"), MeshFormat::obj), ":10:7: error: there is no vertex 99, the file has 8"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 0 2"), MeshFormat::obj), ":10:7: error: vertices are counted from 1"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 -9 4 2"), MeshFormat::obj), ":10:5: error: the corner -9 counts back"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3/x 4 2"), MeshFormat::obj), ":10:5: error: expected a corner such as"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 1 3 \\\n4/1/1/1 2"), MeshFormat::obj), ":11:1: error: expected a corner such as"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f 99999999999 3 4 2"), MeshFormat::obj),
               ":10:3: error: there is no vertex 99999999999"));
  CHECK(begins(error(replaced(cube_obj, "f 1 3 4 2", "f"), MeshFormat::obj), ":10:2: error: expected the corners"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 nan 1"), MeshFormat::obj),
               ":9:5: error: expected a coordinate, a finite number, found 'nan'"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 1e999 1"), MeshFormat::obj), ":9:5: error: expected a coordinate"));
  CHECK(begins(error(replaced(cube_obj, "v 1 1 1", "v 1 1"), MeshFormat::obj),
               ":9:6: error: expected a coordinate, found the end of the line"));
  CHECK(begins(error("\x7f\x45LF\x01\n", MeshFormat::obj), ":1:1: error: expected a statement such as v, f or vn, found '?ELF?'"));
  CHECK(begins(error(std::string("v 0 0 0\nv \0", 11), MeshFormat::obj), ":2:3: error: expected text, found a zero byte"));
  CHECK(begins(error("# \xc3\xa4\xc3\xb6\nv \xc3\xa4 x 0\n", MeshFormat::obj), ":2:3: error:"));

  const std::string off = apps::write_mesh(cube(), MeshFormat::off);
  CHECK(begins(error("", MeshFormat::off), ":1:1: error: the file is empty"));
  CHECK(begins(error("OFF\n8 0 0\n", MeshFormat::off), ":2:3: error: the file has no faces"));
  CHECK(begins(error("OFF BINARY\n", MeshFormat::off), ":1:5: error: binary OFF is not read"));
  CHECK(begins(error("4OFF\n", MeshFormat::off), ":1:1: error: positions in more than three dimensions"));
  CHECK(begins(error(replaced(off, "8 6 0\n", "8 -6 0\n"), MeshFormat::off), ":2:3: error: expected the number of faces, found '-6'"));
  CHECK(begins(error(replaced(off, "8 6 0\n", "8 7 0\n"), MeshFormat::off), ":16:10: error: the file ends before face 7 of 7"));
  CHECK(begins(error(replaced(off, "4 0 2 3 1", "4 0 2 8 1"), MeshFormat::off),
               ":11:7: error: expected a vertex, a number from 0 to 7, found '8'"));
  CHECK(begins(error(replaced(off, "4 0 2 3 1", "5 0 2 3 1"), MeshFormat::off), ":11:10: error: the face has 4 of the 5 corners"));

  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(begins(error("plyx\n", MeshFormat::ply), ":1:1: error: expected ply"));
  CHECK(begins(error(head.substr(0, 40), MeshFormat::ply), ":4:"));
  CHECK(begins(error(replaced(head, "ascii", "text") + body, MeshFormat::ply), ":2:8: error: expected ascii"));
  CHECK(begins(error(replaced(head, "float y", "float w") + body, MeshFormat::ply), ":9:1: error: expected an element vertex with"));
  CHECK(begins(error(replaced(head, "float y", "float x") + body, MeshFormat::ply), ":5:16: error: 'x' is declared twice"));
  CHECK(begins(error(replaced(head, "uchar int", "float int") + body, MeshFormat::ply), ":8:15: error: expected an integer type"));
  CHECK(begins(error(replaced(head, "uchar int", "uchar float") + body, MeshFormat::ply), ":8:10: error: the corners of faces must be"));
  CHECK(begins(error(replaced(head, "face 1", "face -1") + body, MeshFormat::ply), ":7:14: error: expected 'element NAME COUNT'"));
  CHECK(begins(error(replaced(head, "face 1", "tristrips 1") + body, MeshFormat::ply), ":9:1: error: triangle strips are not read"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "3 0 1 3"), MeshFormat::ply),
               ":13:7: error: expected a vertex, a number from 0 to 2, found '3'"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "3 0 1"), MeshFormat::ply),
               ":13:6: error: the line of face 1 of 1 has too few values"));
  CHECK(begins(error(head + replaced(body, "3 0 1 2", "-3 0 1 2"), MeshFormat::ply), ":13:1: error: expected the length of a list"));
  CHECK(begins(error(head + replaced(body, "1 0 0", "1 0 0 0"), MeshFormat::ply),
               ":11:7: error: the line of vertex 2 of 3 has too many values"));
  CHECK(begins(error(replaced(head, "vertex 3", "vertex 999999999999") + body, MeshFormat::ply),
               ":13:7: error: the line of vertex 4 of 999999999999 has too many values"));
}

TEST_CASE("a binary file that ends too early, or whose counts lie, is an error at its byte and costs nothing") {
  const std::string whole = apps::write_mesh(cube(), MeshFormat::ply);
  const std::size_t data = whole.find("end_header\n") + 11;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const apps::MeshResult result = apps::read_mesh(whole.substr(0, size), MeshFormat::ply);
    REQUIRE(result.errors.size() == 1);
    if (size >= data) CHECK(result.errors[0].place.line == 0);
  }
  CHECK(begins(error(replaced(whole, "vertex 8", "vertex 4611686018427387904"), MeshFormat::ply), ":byte "));
  CHECK(begins(error(replaced(whole, "face 6", "face 4611686018427387904"), MeshFormat::ply), ":byte "));
  std::string lie = replaced(whole, "list uchar", "list uint");  // the first length takes in three corners
  CHECK(begins(error(lie, MeshFormat::ply), ":byte "));
  const auto more = apps::read_mesh(whole + "x", MeshFormat::ply);
  CHECK((more.mesh.has_value() && more.mesh->notes.size() == 1));
  std::string nan = whole;
  for (int i = 0; i < 8; ++i) nan[data + static_cast<std::size_t>(i)] = '\xff';
  CHECK(begins(error(nan, MeshFormat::ply), ":byte " + std::to_string(data + 1) + ": error: a coordinate is not a finite number"));
}

TEST_CASE("errors are given up after a number of them") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "q\n";
  const auto result = apps::read_mesh(text, MeshFormat::obj);
  CHECK((result.more_errors && result.errors.size() == apps::max_errors));
}

TEST_CASE("the format follows from the name") {
  CHECK(apps::mesh_format("a.obj") == MeshFormat::obj);
  CHECK(apps::mesh_format("dir/A.PLY") == MeshFormat::ply);
  CHECK(apps::mesh_format("x.Off") == MeshFormat::off);
  for (const char* name : {"", ".obj", "obj", "a.obj.gz", "a.stl"}) CHECK_FALSE(apps::mesh_format(name).has_value());
}

TEST_CASE("damaged files of every format never bring the readers down, and give a mesh or an error") {
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::vector<std::pair<std::string, MeshFormat>> seeds{
      {cube_obj, MeshFormat::obj},
      {apps::write_mesh(cube(), MeshFormat::off), MeshFormat::off},
      {ascii, MeshFormat::ply},
      {apps::write_mesh(cube(), MeshFormat::ply), MeshFormat::ply},
      {odd_ply<std::uint16_t, std::int32_t, float>(true, "ushort", "int", "float"), MeshFormat::ply}};
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
    if (random() % 8 == 0) format = static_cast<MeshFormat>(random() % 3);  // taken for another format
    const apps::MeshResult result = apps::read_mesh(bytes, format);
    REQUIRE(result.mesh.has_value() == result.errors.empty());
    REQUIRE(result.errors.size() <= apps::max_errors);
    ++(result.mesh ? read : refused);
    if (!result.mesh) continue;
    const apps::Mesh& mesh = *result.mesh;
    REQUIRE(mesh.builder.face_count() > 0);
    for (std::uint32_t f = 0; f < mesh.builder.face_count(); ++f) {
      for (std::uint32_t v : mesh.builder.corners(f)) REQUIRE(v < mesh.builder.vertex_count());
    }
    check_same(std::move(apps::read_mesh(apps::write_mesh(mesh.builder, format), format).mesh->builder), mesh.builder);
  }
  CHECK((read > 1000 && refused > 1000));
}

TEST_CASE("real meshes have the counts and the manifold status that independent software found") {
  const std::filesystem::path folder = std::filesystem::path(HALFLIGHT_REFERENCE_DATA) / "meshes";
  if (!std::filesystem::exists(folder / "manifest.json")) {
    WARN("no reference meshes in " << folder.string() << "; skipped");
    return;
  }
  const json::Value manifest = json::parse_file((folder / "manifest.json").string());
  CHECK(manifest.size() == 4);
  for (const json::Value& entry : manifest.array()) {
    const std::string path = (folder / (entry["name"].string() + ".obj")).string();
    INFO(path);
    std::string fault;
    const auto bytes = apps::read_text(path, fault);
    REQUIRE(bytes.has_value());
    const brep::Builder builder = read(*bytes, MeshFormat::obj);
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
    for (const auto& [size, count] : entry["face_sizes"].object())
      CHECK(s.face_sizes.at(std::stoul(size)) == static_cast<std::size_t>(count.number()));
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
      for (const brep::Component& c : s.components) genus += c.genus.value();
      CHECK(genus == static_cast<long>(entry["total_genus"].number()));
      // 5856 terms of at most 1 m3 / 1000 each: rounding stays far below 1e-12.
      CHECK(s.components[0].volume.value() == Approx(entry["signed_volume"].number()).epsilon(1e-12));
    }
  }
}
