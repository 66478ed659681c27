// SPDX-License-Identifier: MIT
// What goes out to other programs: the light of the solution, on its own mesh or on the user's polygons.

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/models.hpp"
#include "apps/program.hpp"
#include "apps/scene_file.hpp"
#include "json.hpp"

namespace {

radiosity::Solution solved(const radiosity::Scene& scene) {
  const radiosity::Options options{.epsilon = 0.05, .min_area = 2e-3, .audit_points = 0, .threads = 1};
  radiosity::Outcome outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}

// A room with a lamp in its ceiling, a ball, and a box that stands on the floor, far from the origin.
apps::SceneFile room() {
  const apps::SceneResult result = apps::parse_scene(R"(
material wall reflectance 0.7 0.6 0.5
material lamp reflectance 0 emission 20
camera from_the_door eye 1001 0.1 1 look 0 1 0 fov 60 size 640 480
box room from 1000 0 0 to 1002 2 2 inside material wall
sphere ball center 1000.6 1.4 0.5 radius 0.3 material wall
box stool from 1001.2 0.7 0 to 1001.6 1.1 0.5 material wall
polygon lamp vertex 1000.7 0.7 2 vertex 1000.7 1.3 2 vertex 1001.3 1.3 2 vertex 1001.3 0.7 2 material lamp
)");
  INFO(apps::to_text(result, "room"));
  REQUIRE(result.file);
  return *result.file;
}

std::size_t triangles(const radiosity::Mesh& mesh) {
  std::size_t count = 0;
  for (const radiosity::MeshFace& face : mesh.faces) { count += face.corner_count - 2; }
  return count;
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  REQUIRE(at + 4 <= bytes.size());
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::vector<std::string> lines_of(const std::string& text, const std::string& begin) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(begin)) { lines.push_back(line); }
  }
  return lines;
}

}  // namespace

// Positions of covered leaves lie 1e-4 of the scene's size deeper; those of GLB are floats.
TEST_CASE("export: what is written stands, when it is read, as the scene did: up is up") {
  const apps::SceneFile file = room();
  const radiosity::Solution solution = solved(file.scene);
  for (const std::string name : {"a.obj", "a.glb"}) {
    INFO(name);
    const std::string bytes = apps::export_format(name)->write(apps::solution_mesh(file, solution, solution.mesh), 1.0);
    apps::Model model = models::read(name, bytes);
    std::vector<std::string> faults;
    const auto read = apps::to_scene(std::move(model), models::format(name).up, {}, faults);
    REQUIRE(read);
    raycast::Box scene, again;
    for (const auto& object : file.scene.objects) { scene.extend(object.shape->bounds()); }
    for (const auto& object : read->scene.objects) {
      if (object.name.find("studio") == std::string::npos && object.name != "room lamp") { again.extend(object.shape->bounds()); }
    }
    const double near = 5e-4 * scene.diameter();
    CHECK(glm::length(scene.lo - again.lo) < near);
    CHECK(glm::length(scene.hi - again.hi) < near);
  }
}

// The reader of glTF has been written from the specification, so what it makes of our file others do, too.
TEST_CASE("export: a GLB holds the triangles of the solution, their light, and the cameras") {
  const apps::SceneFile file = room();
  const radiosity::Solution solution = solved(file.scene);
  const double exposure = 0.3;
  const std::string glb = apps::export_format("a.GLB")->write(apps::solution_mesh(file, solution, solution.mesh), exposure);

  const apps::Model model = models::read("a.glb", glb);
  CHECK(model.polygons() == triangles(solution.mesh));
  REQUIRE(model.cameras.size() == 1);
  // In the file y is up: scene (x, y, z) is file (x, z, -y). Positions are floats about the scene's centre; it is some 3.5 across, so they
  // are off by at most 2^-24 of that, and covered leaves lie 1e-4 of it deeper.
  const auto to_file = [](const glm::dvec3& p) { return glm::dvec3(p.x, p.z, -p.y); };
  CHECK(glm::length(model.cameras[0].eye - to_file(file.cameras[0].eye)) < 1e-9);
  CHECK(glm::length(glm::normalize(model.cameras[0].forward) - to_file({0, 1, 0})) < 1e-9);
  CHECK(model.cameras[0].field_of_view == Approx(60.0).epsilon(1e-9));
  std::size_t triangle = 0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    const bool lamp = face.surface + 1 == radiosity::surfaces(file.scene).size();  // a little before the ceiling
    const double off = lamp || apps::is_covered(solution, face.node) ? 4e-4 : 1e-6;
    for (std::uint32_t k = 2; k < face.corner_count; ++k, ++triangle) {
      std::size_t i = 0;
      for (const std::uint32_t c : {0U, k - 1, k}) {
        const glm::dvec3 p = solution.mesh.positions[solution.mesh.corners[face.first_corner + c].vertex];
        CHECK(glm::length(models::corner(model, triangle, i++) - to_file(p)) < off);
      }
    }
  }

  const std::uint32_t json_bytes = word(glb, 12);
  const json::Value description = json::parse(glb.substr(20, json_bytes));
  CHECK(word(glb, 8) == glb.size());
  const std::size_t binary = 20 + json_bytes + 8, view = static_cast<std::size_t>(description["bufferViews"][0]["byteLength"].number());
  CHECK(description["asset"]["extras"]["exposure"].number() == exposure);
  CHECK(description["materials"][0]["extensions"]["KHR_materials_unlit"].is_null() == false);
  double brightest = 0.0;
  for (std::size_t v = 0; v < view / 12; ++v) {
    const auto number = [&](std::size_t list, std::size_t k) {
      float value = 0.0F;
      std::memcpy(&value, glb.data() + binary + list * view + 12 * v + 4 * k, 4);
      return static_cast<double>(value);
    };
    double length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      length += number(1, k) * number(1, k);
      CHECK(number(2, k) == Approx(std::clamp(number(3, k) * exposure / std::numbers::pi, 0.0, 1.0)).margin(1e-6));
      brightest = std::max(brightest, number(3, k));
    }
    CHECK(length == Approx(1.0).epsilon(1e-6));
  }
  CHECK(brightest == Approx(20.0).epsilon(1e-6));  // the lamp, which reflects nothing
}

TEST_CASE("export: the mesh has the true normals, and a place one vertex for each normal and light") {
  const apps::SceneFile file = room();
  const radiosity::Solution solution = solved(file.scene);
  const apps::ExportMesh mesh = apps::solution_mesh(file, solution, solution.mesh);
  REQUIRE(mesh.groups.size() == 4);
  CHECK(mesh.groups[1].name == "ball");
  std::set<std::vector<double>> known;
  for (std::uint32_t v = mesh.groups[1].first_vertex; v < mesh.groups[2].first_vertex; ++v) {
    const apps::ExportVertex& vertex = mesh.vertices[v];
    // Vertices of the ball lie on it; what is covered none of it is.
    const glm::dvec3 out = glm::normalize(vertex.position - glm::dvec3(1000.6, 1.4, 0.5));
    CHECK(glm::length(out - vertex.normal) < 1e-9);
    CHECK(
        known.insert({vertex.position.x, vertex.position.y, vertex.position.z, vertex.radiosity.x, vertex.radiosity.y, vertex.radiosity.z})
            .second);
  }
  for (std::uint32_t f = 0; f < mesh.groups[1].first_face; ++f) {  // the room is seen from inside
    for (const std::uint32_t v : mesh.face(f)) {
      CHECK(v < mesh.groups[1].first_vertex);
      CHECK(glm::dot(glm::dvec3(1001, 1, 1) - mesh.vertices[v].position, mesh.vertices[v].normal) > 0.9);
    }
  }
}

// A furnace, so that the light of every vertex is known: E / (1 - rho) = 2. What the file has is there, all of it, in its order.
TEST_CASE("export: the light goes back onto the vertices of the user's file, in its own order and coordinates") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::size_t>> quads;
    for (int axis = 0; axis < 3; ++axis) {
      for (int end = 0; end < 2; ++end) {
        for (int i = 0; i < 9; ++i) {
          std::vector<std::size_t> quad;
          for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            glm::dvec3 p(0.0);
            p[axis] = end;
            p[(axis + 1) % 3] = (i % 3 + a) / 3.0;
            p[(axis + 2) % 3] = (i / 3 + b) / 3.0;  // NOLINT(bugprone-integer-division)
            quad.push_back(points.size());
            points.push_back(p);
          }
          if (end == 1) { std::reverse(quad.begin(), quad.end()); }
          quads.push_back(quad);
        }
      }
    }
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) { order[i] = i; }
    std::shuffle(order.begin(), order.end(), random);
    std::shuffle(quads.begin(), quads.end(), random);
    std::ostringstream obj, faces;
    obj << "mtllib m.mtl\nusemtl oven\nv 7 7 7\n";  // one that nobody uses
    for (const std::size_t i : order) { obj << "v " << points[i].x << ' ' << points[i].y << ' ' << points[i].z << '\n'; }
    for (const std::vector<std::size_t>& quad : quads) {
      faces << 'f';
      for (const std::size_t i : quad) {
        const auto v = std::find(order.begin(), order.end(), i) - order.begin() + 2;
        faces << ' ' << v << "//" << v;
      }
      faces << '\n';
    }
    obj << faces.str();
    const apps::SceneFile file =
        models::scene("a.obj", obj.str(), {{"m.mtl", "newmtl oven\nKd 0.5 0.5 0.5\nKe 0.31830988618 0.31830988618 0.31830988618\n"}});
    const radiosity::Solution solution = solved(file.scene);
    const auto given = apps::given_mesh(file, solution);
    REQUIRE(given);
    REQUIRE(given->vertices.size() == points.size() + 1);
    CHECK_FALSE(given->z_up);
    for (std::size_t i = 0; i < order.size(); ++i) {
      CHECK(glm::length(given->vertices[i + 1].position - points[order[i]]) < 1e-5);  // the stream wrote six digits
      CHECK(given->vertices[i + 1].radiosity.x == Approx(2.0).epsilon(1e-6));
    }
    CHECK(given->vertices[0].radiosity.x == 0.0);
    const std::string written = apps::export_format("b.obj")->write(*given, std::numbers::pi / 4.0);
    std::string again;
    for (const std::string& line : lines_of(written, "f ")) { again += line + "\n"; }
    CHECK(again == faces.str());
    CHECK(lines_of(written, "v ").size() == points.size() + 1);
    CHECK(lines_of(written, "v ")[1].ends_with(" 0.7354 0.7354 0.7354"));  // sRGB of a half
    CHECK(models::read("b.obj", written).polygons() == quads.size());
  }
  CHECK_FALSE(apps::given_mesh(room(), solved(room().scene)));
}

TEST_CASE("export: render writes what the names end with, and says what it cannot") {
  const program::Place place;
  place.write("room.obj", models::room_obj);
  place.write("a.scene", "material m reflectance 0.5 emission 1\nbox b from 0 0 0 to 1 1 1 inside material m\n");
  const std::string quick = " --quiet --audit 0 --epsilon 0.2 --threads 1";
  CHECK(place.run("render a.scene -o a.glb -o a.obj -o a.html" + quick).code == 0);
  CHECK(place.read("a.glb").substr(0, 4) == "glTF");
  CHECK(lines_of(place.read("a.obj"), "o ") == std::vector<std::string>{"o b"});
  program::Run run = place.run("render a.scene -o a.stl" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("a name that ends with .png, .hdr, .pfm, .light, .ply, .glb, .obj or .html") != std::string::npos);
  run = place.run("render a.scene -o b.glb --onto-input" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("a.scene gives no polygons") != std::string::npos);
  CHECK_FALSE(place.has("b.glb"));
  run = place.run("render room.obj -o b.png --onto-input" + quick);
  CHECK(run.code == 2);
  CHECK(run.err.find("there is none") != std::string::npos);
  CHECK(place.run("render room.obj --lamp wall -o b.obj --onto-input" + quick).code == 0);
  CHECK(lines_of(place.read("b.obj"), "v ").size() == 8);
  CHECK(lines_of(place.read("b.obj"), "f ").size() == 6);
  CHECK(place.run("render room.obj --lamp wall -o b.ply --onto-input" + quick).code == 0);
  const apps::Model given = models::read("room.obj", models::room_obj), back = models::read("b.ply", place.read("b.ply"));
  CHECK((back.positions == given.positions && back.corners == given.corners && back.first_corner == given.first_corner));
}

TEST_CASE("export: the page holds everything itself, and no name in it can break out of its data") {
  apps::SceneFile file = room();
  file.cameras[0].name = "</script><script>alert(1)</script>";
  const radiosity::Solution solution = solved(file.scene);
  const std::string page = apps::viewer_page(file, solution, file.cameras[0], 0.3, "a<b>&c", "error");
  for (const std::string outside : {"http:", "https:", " src=", "@import", "fetch("}) { CHECK(page.find(outside) == std::string::npos); }
  CHECK(page.find("alert(1)</script>") == std::string::npos);
  CHECK(page.find("<title>a&lt;b&gt;&amp;c</title>") != std::string::npos);
  const std::string begin = "const data = ";
  const std::size_t at = page.find(begin) + begin.size();
  const json::Value data = json::parse(page.substr(at, page.find("\n;", at) - at));
  const auto bytes = [&](const char* name) {
    const std::string text = data[name].string();
    return text.size() / 4 * 3 - static_cast<std::size_t>(std::count(text.end() - 2, text.end(), '='));
  };
  const radiosity::Mesh& mesh = solution.mesh;
  CHECK(bytes("positions") == 12 * mesh.positions.size());
  CHECK(bytes("cornerVertex") == 4 * mesh.corners.size());
  CHECK(bytes("cornerLight") == 6 * mesh.corners.size());
  CHECK(bytes("faceSize") == mesh.faces.size());
  CHECK(bytes("parent") == 4 * solution.hierarchy.size());
  CHECK(data["cameras"][0]["name"].string() == file.cameras[0].name);
}

// In a furnace every pixel that shows a wall has the same grey, so the mean of the picture is known.
TEST_CASE("export: a browser draws the page", "[chromium]") {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) { SKIP_TEST("there is no chromium"); }
  const program::Place place;
  place.write("a.scene",
              "camera inside eye 0.4 0.2 0.3 look 0 1 0 fov 90\nmaterial m reflectance 0.5 emission 0.5\n"
              "box b from 0 0 0 to 1 1 1 inside material m\n");
  // Radiosity 1 times exposure over pi is a half, which is 188 of 255 in sRGB.
  REQUIRE(place.run("render a.scene -o a.html --quiet --audit 0 --epsilon 0.1 --threads 1 --exposure 1.5707963267948966").code == 0);
  const std::string path = place.path().string();
  const std::string command =
      "timeout 60 chromium --headless --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --user-data-dir=" +
      path + "/profile --window-size=300,200 --dump-dom 'file://" + path + "/a.html#test' >" + path + "/dom 2>" + path + "/log";
  REQUIRE(std::system(command.c_str()) == 0);
  const std::string dom = place.read("dom"), key = "data-mean=\"";
  const std::size_t at = dom.find(key);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(dom.substr(at + key.size())) == Approx(188.0).margin(1.0));
  CHECK(dom.find("data-borders=\"0\"") == std::string::npos);
}
