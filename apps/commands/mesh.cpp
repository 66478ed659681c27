// SPDX-License-Identifier: MIT
// halflight mesh SCENE [-o OUT.obj]: the polygons of each object as the solver sees them before it refines them (paper 4.1: the
// approximation), with counts, shells, genus, area and volume.
//
// It writes the faces that give and receive light: a closed object is a closed mesh, a polygon is one face without its black back. The
// numbers are those of the written mesh, so `halflight check OUT` reports the same ones. Vertices and faces of different objects are
// never merged. Nothing is solved, and the coordinates are those of the scene, not rounded.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/statistics.hpp>

#include <raycast/transform.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/json.hpp"
#include "apps/mesh_file.hpp"
#include "apps/process.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

struct MeshOptions {
  ModelOptions model;
  std::string scene;
  std::string output;               // empty: none
  std::optional<std::string> json;  // empty: standard output, instead of the text
};

struct Measure {
  std::size_t vertices = 0, edges = 0, faces = 0, shells = 0, borders = 0;
  long genus = 0;
  double area = 0.0;
  std::optional<double> volume;  // of the closed shells; nothing if there is none

  Measure& operator+=(const Measure& other) {
    vertices += other.vertices, edges += other.edges, faces += other.faces, shells += other.shells, borders += other.borders;
    genus += other.genus;
    area += other.area;
    if (other.volume) { volume = volume.value_or(0.0) + *other.volume; }
    return *this;
  }
  [[nodiscard]] long euler() const { return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces); }
};

// The faces of a surface that belong to a sheet, and their vertices.
brep::Builder radiating(const radiosity::Surface& surface) {
  brep::Builder out;
  const radiosity::SurfaceBRep& brep = surface.brep;
  std::vector<std::uint32_t> number(brep.vertex_end(), brep::invalid_index);
  std::vector<std::uint32_t> corners;
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).sheet == brep::no_sheet) { continue; }
    corners.clear();
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      const brep::VertexId v = brep.vertex(h);
      if (number[v.index] == brep::invalid_index) { number[v.index] = out.vertex(brep.data(v).position); }
      corners.push_back(number[v.index]);
    }
    out.face(corners, brep.data(f).sheet);
  }
  return out;
}

Measure measure(const brep::Builder& mesh) {
  Measure result;
  const brep::Statistics statistics = brep::statistics(mesh);
  for (const brep::Component& c : statistics.components) {
    result += {c.vertices, c.edges, c.faces, 1, c.borders, c.genus.value_or(0), 0.0, c.volume};
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t v : mesh.corners(f)) { corners.push_back(mesh.position(v)); }
    result.area += brep::area(corners);
  }
  return result;
}

void append(brep::Builder& out, const brep::Builder& part) {
  const std::uint32_t first = out.vertex_count();
  for (std::uint32_t v = 0; v < part.vertex_count(); ++v) { out.vertex(part.position(v)); }
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < part.face_count(); ++f) {
    corners.assign(part.corners(f).begin(), part.corners(f).end());
    for (std::uint32_t& v : corners) { v += first; }
    out.face(corners, part.sheet(f));
  }
}

struct SceneMesh {
  brep::Builder builder;
  std::vector<MeshGroup> groups;  // one per object
  std::vector<Measure> measures;  // one per object
  Measure total;
};

std::optional<SceneMesh> make_mesh(const SceneFile& file, const std::string& name) {
  SceneMesh result;
  std::vector<std::string> faults;
  for (const radiosity::SceneObject& object : file.scene.objects) {
    const raycast::PlacedObject placed(object.shape, object.placement);
    const radiosity::SurfaceResult made = radiosity::make_surface(placed, 0);
    if (!made.surface) {
      faults.push_back("object '" + object.name + "': " + made.fault);
      continue;
    }
    const brep::Builder part = radiating(*made.surface);
    result.groups.push_back({result.builder.face_count(), object.name});
    result.measures.push_back(measure(part));
    result.total += result.measures.back();
    append(result.builder, part);
  }
  complain_of(name, faults);
  return faults.empty() ? std::optional(std::move(result)) : std::nullopt;
}

std::string row(const std::string& name, const Measure& m, std::size_t width, bool room) {
  std::string line = left("  " + name, width + 2, 0);
  for (const std::size_t n : {m.vertices, m.edges, m.faces}) { line += right(std::to_string(n), 10, 1); }
  line += right(std::to_string(m.euler()), 9, 1) + right(std::to_string(m.shells), 8, 1) + right(std::to_string(m.borders), 9, 1) +
          right(std::to_string(m.genus), 7, 1) + right(formatted("%.9g", m.area), 15, 1) +
          right(m.volume ? formatted("%.9g", *m.volume) : "-", 15, 1);
  return line + (room ? "  (seen from inside)\n" : "\n");
}

std::string to_text(const SceneFile& file, const SceneMesh& mesh, const MeshOptions& options) {
  std::size_t width = 6;
  const std::size_t shown = std::min(longest_list, mesh.measures.size());
  for (std::size_t i = 0; i < shown; ++i) { width = std::max(width, file.scene.objects[i].name.size()); }
  std::string text = options.scene + "\n  object" + std::string(width - 6, ' ') +
                     "  vertices     edges     faces    v-e+f  shells  borders  genus           area         volume\n";
  for (std::size_t i = 0; i < shown; ++i) {
    text += row(file.scene.objects[i].name, mesh.measures[i], width, file.scene.objects[i].placement.inside);
  }
  text += and_more(mesh.measures.size(), shown, "; --json has all");
  text += row("total", mesh.total, width, false);
  return text + (options.output.empty() ? "" : "written: " + options.output + "\n");
}

void write(JsonWriter& json, const Measure& m) {
  json.fields("vertices", m.vertices, "edges", m.edges, "faces", m.faces, "shells", m.shells, "borders", m.borders, "genus", m.genus,
              "area", m.area, "volume", m.volume);
}

std::string to_json(const SceneFile& file, const SceneMesh& mesh, const MeshOptions& options) {
  JsonWriter json;
  json.open_object().fields("program", "halflight", "version", version, "scene", options.scene);
  json.key("objects").list(mesh.measures, [&](const Measure& measure) {
    const auto i = static_cast<std::size_t>(&measure - mesh.measures.data());
    const radiosity::SceneObject& object = file.scene.objects[i];
    json.open_object().fields("name", object.name, "kind", file.origins[i].kind, "inside", object.placement.inside);
    write(json, measure);
    json.close();
  });
  json.key("total").open_object();
  write(json, mesh.total);
  json.close();
  const std::vector<std::string> files(options.output.empty() ? 0 : 1, options.output);
  json.fields("files", files).close();
  return json.text();
}

ExitCode run(const MeshOptions& options) {
  ExitCode code = check_mesh_output(options.output, {options.json.value_or("")}, options.scene);
  if (code != ExitCode::ok) { return code; }
  const auto file = load_scene(options.scene, {options.output, options.json.value_or("")}, code, options.model);
  if (!file) { return code; }
  const auto mesh = make_mesh(*file, options.scene);
  if (!mesh) { return ExitCode::invalid_input; }
  const bool json_file = options.json && !options.json->empty();
  if (!options.output.empty() && !save(options.output, write_mesh(mesh->builder, *mesh_format(options.output), mesh->groups))) {
    return ExitCode::failure;
  }
  if (json_file && !save(*options.json, to_json(*file, *mesh, options))) { return ExitCode::failure; }
  const bool numbers = options.json && !json_file;
  const std::string text = numbers ? to_json(*file, *mesh, options) : to_text(*file, *mesh, options);
  if (!print(text, {options.output, options.json.value_or("")})) { return ExitCode::failure; }
  return ExitCode::ok;
}

}  // namespace

Command mesh_command() {
  const auto options = std::make_shared<MeshOptions>();
  options->model.lamps_wanted = false;
  Argument json = text("--json", "[FILE]", options->json, "the numbers as JSON: into FILE, or in place of the text");
  json.values = Argument::Values::optional;
  return {"mesh", "the polygons of each object: counts, genus, area, volume, and a mesh file",
          with_model_arguments({scene_argument(options->scene),
                                text("-o,--output", "FILE", options->output, "where to write the mesh: " + mesh_endings()), json},
                               options->model),
          [options] { return run(*options); }};
}

}  // namespace apps
