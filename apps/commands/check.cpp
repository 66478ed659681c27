// SPDX-License-Identifier: MIT
// halflight check MESH: counts, components, genus, volume, and every fault that keeps the mesh from being a closed surface.
//
// With --repair, faults that can be repaired are repaired and listed, and -o writes the result; only the remaining ones then
// count as faults. Exit code: 0 without faults, 3 with faults or if the file is invalid, 1 if it cannot be read or written.
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/handles.hpp>
#include <brep/repair.hpp>
#include <brep/statistics.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/mesh_file.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

struct CheckOptions {
  std::string mesh;
  std::string output;  // empty: none
  bool repair = false;
  bool all = false;  // print lists in full
};

constexpr std::size_t first_few = 10;  // lines of a list, unless --all

// The name of a kind of fault and advice about it, in the order of brep::DefectKind.
struct Lesson {
  const char* title;
  const char* text;
};
constexpr Lesson lessons[] = {
    {"index of nothing", "A face or an edge names something that does not exist. Correct the file."},
    {"bad position", "A coordinate must be a finite number. Correct the file."},
    {"face with too few corners", "A face needs three corners. --repair drops such faces."},
    {"face that visits a vertex twice",
     "The corners of a face are different vertices. --repair mends it when they follow each other; otherwise part\n"
     "the face by hand at the vertex that it visits twice."},
    {"broken loop", "The edges of a face must form one closed loop. Correct the file."},
    {"edge without a face", "Every edge lies between two faces. Add the faces, or take the edge away."},
    {"duplicate face", "The same corners in the same order as an earlier face. --repair drops it."},
    {"edge with more than two faces",
     "At an edge of a surface two faces meet, one on each side. Where more meet it cannot be told which two belong\n"
     "together, so this is not repaired: take away inner walls, or part the solids that touch along the edge."},
    {"one-sided surface",
     "The two faces at an edge run along it in opposite directions, so that both are counter-clockwise from the same\n"
     "side. Here no choice of directions does that everywhere, as on a Moebius strip: it bounds no solid."},
    {"flipped faces",
     "The two faces at an edge must run along it in opposite directions; then all are counter-clockwise from the same\n"
     "side. --repair turns the smaller part of each component."},
    {"open border",
     "Here the surface ends: edges with a face on one side only. A closed surface has none. --repair closes each\n"
     "with one face; for a flat sheet that is its back."},
    {"vertex with several fans",
     "Around a vertex the faces follow each other from edge to edge, like a fan, and come back to the first. Here\n"
     "several fans touch in one point. --repair gives each its own vertex at the same place."},
    {"unused vertex", "No face has it as a corner. --repair drops it."},
};

// In the order of brep::RepairKind.
constexpr const char* repair_titles[] = {"repeated corners taken away", "faces dropped", "faces flipped", "holes closed", "vertices split",
                                         "unused vertices dropped"};

static_assert(std::size(lessons) == 1 + static_cast<std::size_t>(brep::DefectKind::unused_vertex));
static_assert(std::size(repair_titles) == 1 + static_cast<std::size_t>(brep::RepairKind::dropped_vertex));

// "468 quadrilaterals, 32 triangles", the most frequent first.
std::string sizes(const brep::Statistics& s) {
  std::vector<std::pair<std::size_t, std::size_t>> list(s.face_sizes.begin(), s.face_sizes.end());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (std::size_t i = 0; i < list.size() && i < 5; ++i) {
    const auto [size, count] = list[i];
    const std::string name = size == 3 ? "triangle" : size == 4 ? "quadrilateral" : std::to_string(size) + "-gon";
    text += (i == 0 ? "" : ", ") + counted(count, name);
  }
  return text + (list.size() > 5 ? ", ..." : "");
}

std::string component_table(const brep::Statistics& s, bool all) {
  std::vector<brep::Component> list = s.components;
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.faces > b.faces; });
  std::string text = "components: " + std::to_string(list.size()) + "\n";
  if (list.empty()) { return text; }
  text += "  with face    vertices     edges     faces   v-e+f   borders   genus   volume\n";
  const std::size_t shown = all ? list.size() : std::min(list.size(), first_few);
  for (std::size_t i = 0; i < shown; ++i) {
    const brep::Component& c = list[i];
    std::string remark = c.volume ? formatted("%.6g", *c.volume) + (*c.volume < 0.0 ? " (inside out: the faces look inwards)" : "") : "-";
    if (!c.two_sided) {
      remark = "- (one-sided)";
    } else if (!c.oriented) {
      remark = c.nonmanifold_edges > 0 ? "- (edges with more than two faces)" : "- (flipped faces)";
    }
    text += "  " + right(to_string(c.first), 9, 0) + right(std::to_string(c.vertices), 11) + right(std::to_string(c.edges), 10) +
            right(std::to_string(c.faces), 10) + right(std::to_string(c.euler()), 8) +
            right(c.two_sided ? std::to_string(c.borders) : "-", 10) + right(c.genus ? std::to_string(*c.genus) : "-", 8) + "   " + remark +
            "\n";
  }
  return text + and_more(list.size(), shown, " that are smaller (--all lists them)");
}

std::string summary(const brep::Statistics& s, bool all) {
  std::string text = counted(s.vertices, "vertex", "vertices") + ", " + counted(s.edges, "edge") + ", " + counted(s.faces, "face") +
                     (s.faces > 0 ? ": " : "") + sizes(s) + "\n";
  text += "v - e + f: " + std::to_string(s.euler());
  if (s.vertices > s.used_vertices) {
    text += " (without " + counted(s.vertices - s.used_vertices, "unused vertex", "unused vertices") + ")";
  }
  text += "\nbounds: " + (s.used_vertices > 0 ? triple(s.lo) + "  to  " + triple(s.hi) : std::string("none")) + "\n";
  text += "edges with one face: " + std::to_string(s.border_edges) + ", with more than two: " + std::to_string(s.nonmanifold_edges) + "\n";
  if (s.duplicate_positions > 0) {
    text += "repeated positions: " + std::to_string(s.duplicate_positions) + " (" +
            plural(s.duplicate_positions, "a vertex lies", "vertices lie") +
            " exactly where another one lies; that is legal, and they are never merged)\n";
  }
  return text + component_table(s, all);
}

// The file's line of the first face, or else of the first vertex, among the elements; empty if unknown.
std::string where(const std::vector<brep::Element>& elements, const Mesh& mesh, const std::string& name) {
  for (const char letter : {'f', 'v'}) {
    const auto& lines = letter == 'f' ? mesh.face_line : mesh.vertex_line;
    for (const brep::Element& e : elements) {
      if (e.letter == letter && e.index < lines.size()) { return name + ":" + std::to_string(lines[e.index]) + ": "; }
    }
  }
  return {};
}

// The items of each kind under a heading, at most `first_few` of each unless all are wanted.
template <class Item, class Heading>
std::string by_kind(const std::vector<Item>& items, const Mesh& mesh, const CheckOptions& options, Heading heading) {
  std::map<decltype(Item::kind), std::vector<const Item*>> kinds;
  for (const Item& item : items) { kinds[item.kind].push_back(&item); }
  std::string text;
  for (const auto& [kind, list] : kinds) {
    text += "\n" + heading(kind, list.size());
    const std::size_t shown = options.all ? list.size() : std::min(list.size(), first_few);
    for (std::size_t i = 0; i < shown; ++i) { text += "  " + where(list[i]->elements, mesh, options.mesh) + list[i]->sentence + "\n"; }
    text += and_more(list.size(), shown, " (--all lists them)");
  }
  return text;
}

std::string faults(const std::vector<brep::Defect>& defects, const Mesh& mesh, const CheckOptions& options) {
  return by_kind(defects, mesh, options, [](brep::DefectKind kind, std::size_t count) {
    const Lesson& l = lessons[static_cast<std::size_t>(kind)];
    return std::string(l.title) + ": " + std::to_string(count) + "\n" + l.text + "\n";
  });
}

std::string repairs(const std::vector<brep::Repair>& list, const Mesh& mesh, const CheckOptions& options) {
  return by_kind(list, mesh, options, [](brep::RepairKind kind, std::size_t count) {
    return std::string(repair_titles[static_cast<std::size_t>(kind)]) + ": " + std::to_string(count) + "\n";
  });
}

constexpr const char* numbering = "v0 v1 ... and f0 f1 ... are the vertices and faces of the file, counted from 0.\n";

std::string verdict(std::size_t faults, const brep::Statistics& s) {
  if (faults == 0 && s.components.empty()) { return "NOT SOUND: nothing is left, none of the faces could be used\n"; }
  if (faults == 0) {
    return "sound: " + counted(s.components.size(), "closed oriented shell") + ", every edge has two faces and every vertex one fan\n";
  }
  return "NOT SOUND: " + counted(faults, "fault") + ". " + numbering;
}

std::optional<Mesh> load(const std::string& path, ExitCode& code) {
  const MeshFormat* const format = mesh_format(path);
  std::string ignored;
  const auto bytes = format ? load_text(path, code) : read_text(path, ignored);
  if (!format) {
    const auto sentence = bytes ? wrong_kind(path, *bytes, FileKind::mesh, mesh_formats().front()) : std::nullopt;
    const bool known = sentence && guess_kind(*bytes).kind != FileKind::unknown;
    code = complain(known ? *sentence : path + ": expected a name that ends with " + mesh_endings(), ExitCode::usage);
    return std::nullopt;
  }
  if (!bytes) { return std::nullopt; }
  MeshResult result = read_mesh(*bytes, *format);
  if (!result.mesh) {
    const auto sentence = wrong_kind(path, *bytes, FileKind::mesh, format);
    sentence ? complain(*sentence) : static_cast<void>(std::fputs(to_text(result, path).c_str(), stderr));
    code = ExitCode::invalid_input;
  }
  return std::move(result.mesh);
}

ExitCode run(const CheckOptions& options) {
  ExitCode code = check_mesh_output(options.output, {}, options.mesh);
  if (code != ExitCode::ok) { return code; }
  const auto mesh = load(options.mesh, code);
  if (!mesh) { return code; }

  const brep::Statistics before = brep::statistics(mesh->builder);
  std::string text = options.mesh + "\n" + summary(before, options.all);
  for (const std::string& note : mesh->notes) { text += "note: " + note + "\n"; }
  std::vector<brep::Defect> remaining = brep::close<brep::BRep<>>(mesh->builder).defects;
  text += "\n" + verdict(remaining.size(), before);
  bool nothing_left = false;
  brep::RepairResult repaired;
  const bool mended = options.repair && !remaining.empty();
  if (mended) {
    repaired = brep::repair(mesh->builder);
    text += "\n--- repaired: " + (repaired.repairs.empty() ? "nothing" : counted(repaired.repairs.size(), "step")) + "\n" +
            repairs(repaired.repairs, *mesh, options);
    remaining = std::move(repaired.remaining);
    brep::Statistics after = brep::statistics(repaired.builder);
    nothing_left = after.components.empty();
    // The first face of a component is numbered as in the file.
    for (brep::Component& c : after.components) { c.first = brep::FaceId{repaired.old_face[c.first.index]}; }
    text += "\n--- the mesh now\n" + summary(after, options.all) + "\n" + verdict(remaining.size(), after);
  }
  text += faults(remaining, *mesh, options);
  if (!options.output.empty()) {
    const brep::Builder& result = mended ? repaired.builder : mesh->builder;
    if (!save(options.output, write_mesh(result, *mesh_format(options.output)))) { return ExitCode::failure; }
    text += "\nwritten: " + options.output + "\n";
  }
  if (!print(text, {options.output})) { return ExitCode::failure; }
  return remaining.empty() && !nothing_left ? ExitCode::ok : ExitCode::invalid_input;
}

}  // namespace

Command check_command() {
  const auto options = std::make_shared<CheckOptions>();
  return {
      "check",
      "say what a polygon mesh is and everything that is wrong with it",
      {text("mesh", "MESH", options->mesh, "the mesh: " + mesh_endings()).must(),
       flag("--repair", options->repair, "flip faces, close holes, part fans, drop duplicates and what is unused; the file stays as it is"),
       text("-o,--output", "FILE", options->output, "where to write the repaired mesh: " + mesh_endings()).needing("--repair"),
       flag("--all", options->all, "list every fault, not only the first " + std::to_string(first_few) + " of each kind")},
      [options] { return run(*options); }};
}

}  // namespace apps
