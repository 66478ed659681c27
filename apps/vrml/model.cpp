// SPDX-License-Identifier: MIT
// Makes a model of a VRML scene by a walk over its graph. Cube or Box, Sphere, Cylinder and Cone become analytic solids with a placement;
// face sets become polygons. The diffuse colour is the reflectance; the emissive colour is a radiance L, so the exitance is pi L.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/cone.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/transform.hpp>

#include "apps/graph_walk.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {
namespace {

constexpr std::size_t most_corners = 50'000'000;  // for all uses of all face sets together
constexpr int sides_of_part = 32;                 // of a cylinder or cone that lacks a part and so is not a solid

class ModelMaker {
 public:
  ModelMaker(const SideFile& side_file, OtherFiles& others, Errors& errors, Notes& notes)
      : side_file_(side_file), others_(others), errors_(errors), notes_(notes) {}

  Model model;

  // --- the meaning of nodes for the walk (apps/graph_walk.hpp)
  bool enter(const std::shared_ptr<const Node>& at, State& state) {
    const Node& node = *at;
    if (change(state, node)) { return true; }
    if (is_camera(node)) {
      add_camera(model, node, state, notes_);
    } else if (node.type.ends_with("Light")) {
      add_light(model, node, state);
    } else if (node.version == Version::v97) {
      const Node* const geometry = node.node("geometry");
      if (geometry != nullptr) { shape(*geometry, state_of_shape(node, *geometry, state)); }
    } else if (node.children.empty() && !is_inline(node)) {
      shape(node, state);
    }
    return true;
  }
  std::vector<std::shared_ptr<const Node>> children(const std::shared_ptr<const Node>& node) {
    if (!is_inline(*node)) { return walked_children(*node); }
    auto file = inlined(*node);
    return file == nullptr ? node->children : std::vector{std::move(file)};
  }
  static void leave(const std::shared_ptr<const Node>& node, const State& before, State& state) { restore(state, before, *node); }

 private:
  using Made = raycast::Made<raycast::Object>;

  static bool is_inline(const Node& node) { return node.type == "WWWInline" || node.type == "Inline"; }

  void shape(const Node& node, const State& state) {
    if (errors_.full()) { return; }
    constexpr std::array<std::string_view, 4> surfaceless{"IndexedLineSet", "PointSet", "AsciiText", "Text"};
    if (node.type == "Cube" || node.type == "Box") {
      box(node, state);
    } else if (node.type == "Sphere") {
      add(raycast::Sphere::make(glm::dvec3(0.0), node.number("radius", 1.0)), "sphere", {0}, node, state);
    } else if (node.type == "Cylinder") {
      cylinder(node, state);
    } else if (node.type == "Cone") {
      cone(node, state);
    } else if (node.type == "IndexedFaceSet") {
      const Field* const points = state.coordinates != nullptr ? state.coordinates->find("point") : nullptr;
      face_set(node, node.find("coordIndex"), points, state);
    } else if (node.type == "ElevationGrid") {
      made_face_set(node, elevation_grid(node), state);
    } else if (node.type == "Extrusion") {
      made_face_set(node, extrusion(node), state);
    } else if (contains(surfaceless, node.type)) {
      notes_.add("lines, points and texts have no surface: left out", at_line_of(node));
    }
  }

  // The content of the file that an Inline node names; null if there is none. A file that inlines itself is later refused as too deep.
  std::shared_ptr<const Node> inlined(const Node& node) {
    const std::string_view url = node.word(node.version == Version::v97 ? "url" : "name", "");
    const std::string name = name_beside(node.file, url);
    if (name.empty()) {
      notes_.add("the file " + mesh_file::shown(url) + " is not beside this one: left out", at_line_of(node));
      return nullptr;
    }
    const ParsedFile* const file = others_.read(name, at_line_of(node));
    if (file == nullptr) { return nullptr; }
    auto& root = inlines_[name];
    if (root == nullptr) {
      auto made = std::make_shared<Node>();
      made->type = "Separator";
      made->children.push_back(file->root);
      root = std::move(made);
    }
    return root;
  }

  // Adds an analytic solid; `parts`: by sheet, the part of the node to which it belongs.
  template <class MadeObject>
  void add(MadeObject made, const char* kind, const std::vector<std::size_t>& parts, const Node& node, const State& state) {
    if (model.objects.size() > max_objects) { return; }  // exceeds the limit of a scene, which is reported later
    raycast::Placement placement{glm::dmat3(state.transform), glm::dvec3(state.transform[3]), false};
    if (!made.object || raycast::check(*made.object, placement)) {
      return notes_.add("shapes without size, or flattened by their transform, are left out", at_line_of(node));
    }
    const bool by_part = state.binding == Binding::per_part || state.binding == Binding::per_part_indexed;
    std::vector<std::uint32_t> materials;
    for (const std::size_t part : parts) { materials.push_back(looks_.material(state, {by_part ? part : 0})); }
    if (!by_part) { materials.resize(1); }
    model.objects.push_back({name_of(node, state, kind), std::move(made.object), placement, std::move(materials)});
    model.origins.push_back({kind, node.place});
  }

  void box(const Node& node, const State& state) {
    const glm::dvec3 sides(node.number("width", 2.0), node.number("height", 2.0), node.number("depth", 2.0));
    const glm::dvec3 half = 0.5 * node.vector("size", sides);
    // Parts: front, back, left, right, top, bottom. Sheets: x0 x1 y0 y1 z0 z1.
    add(raycast::BoxObject::make(-half, half), "box", {2, 3, 5, 4, 1, 0}, node, state);
  }

  // Which of these parts exist, in this order? "ALL" means every part. In VRML 97 each has a field of its own.
  template <std::size_t n>
  static std::array<bool, n> parts(const Node& node, const std::array<std::string_view, n>& names,
                                   const std::array<std::string_view, n>& fields) {
    std::array<bool, n> there{};
    const Field* const field = node.find("parts");
    for (std::size_t i = 0; i < n; ++i) {
      there[i] = field == nullptr || std::any_of(field->words.begin(), field->words.end(),
                                                 [&](const std::string& word) { return word == names[i] || word == "ALL"; });
      there[i] = there[i] && !node.is_false(fields[i]);
    }
    return there;
  }

  void cylinder(const Node& node, const State& state) {
    const double radius = node.number("radius", 1.0), height = node.number("height", 2.0);
    const auto [sides, top, bottom] = parts<3>(node, {"SIDES", "TOP", "BOTTOM"}, {"side", "top", "bottom"});
    if (sides && top && bottom) {  // sheets: side, bottom, top
      return add(raycast::Cylinder::make({0.0, -0.5 * height, 0.0}, {0.0, height, 0.0}, radius), "cylinder", {0, 2, 1}, node, state);
    }
    open_parts(node, state, {radius, radius, height, sides, top, bottom});
  }

  void cone(const Node& node, const State& state) {
    const double radius = node.number("bottomRadius", 1.0), height = node.number("height", 2.0);
    const auto [sides, bottom] = parts<2>(node, {"SIDES", "BOTTOM"}, {"side", "bottom"});
    if (sides && bottom) {
      return add(raycast::Cone::make({0.0, -0.5 * height, 0.0}, {0.0, height, 0.0}, radius, 0.0), "cone", {0, 1}, node, state);
    }
    open_parts(node, state, {radius, 0.0, height, sides, false, bottom});
  }

  // Parts of a cylinder or a cone, with the radii at both ends.
  struct OpenParts {
    double low, high, height;
    bool sides, top, bottom;
  };

  // A cylinder or cone without all its parts encloses nothing: it becomes polygons seen from both sides.
  void open_parts(const Node& node, const State& state, const OpenParts& shape) {
    const bool by_part = state.binding == Binding::per_part || state.binding == Binding::per_part_indexed;
    std::array<std::vector<std::uint32_t>, 2> rings;
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i < sides_of_part; ++i) {
        const double a = 2.0 * std::numbers::pi * i / sides_of_part, r = end == 0 ? shape.low : shape.high;
        rings[static_cast<std::size_t>(end)].push_back(static_cast<std::uint32_t>(model.positions.size()));
        model.positions.push_back(placed(state, {r * std::sin(a), (end - 0.5) * shape.height, r * std::cos(a)}));
      }
    }
    const std::uint32_t group = new_group(node, state);
    const auto polygon = [&](std::vector<std::uint32_t> corners, std::size_t part) {
      if (mirrored(state)) { std::reverse(corners.begin(), corners.end()); }
      model.polygon(corners, looks_.material(state, {by_part ? part : 0}, true), group, node.place.line);
    };
    for (std::size_t i = 0; shape.sides && i < sides_of_part; ++i) {
      const std::size_t next = (i + 1) % sides_of_part;
      polygon({rings[0][i], rings[0][next], rings[1][next], rings[1][i]}, 0);
    }
    if (shape.top) { polygon(rings[1], 1); }
    if (shape.bottom) { polygon({rings[0].rbegin(), rings[0].rend()}, shape.high > 0.0 ? 2 : 1); }
  }

  static std::string name_of(const Node& node, const State& state, std::string otherwise) {
    if (!node.name.empty()) { return node.name; }
    return state.named != nullptr ? state.named->name : std::move(otherwise);
  }
  static bool mirrored(const State& state) { return glm::determinant(glm::dmat3(state.transform)) < 0.0; }
  std::uint32_t new_group(const Node& node, const State& state) {
    model.begin_part(node.file == nullptr ? "" : *node.file);
    model.groups.push_back(name_of(node, state, "faces" + std::to_string(model.groups.size())));
    return static_cast<std::uint32_t>(model.groups.size() - 1);
  }

  void made_face_set(const Node& node, const std::optional<Faces>& faces, const State& state) {
    if (!faces) {
      return notes_.add("grids and extrusions with fewer numbers than they need, or too many, are left out", at_line_of(node));
    }
    face_set(node, &faces->index, &faces->points, state);
  }

  void face_set(const Node& node, const Field* given, const Field* points, const State& state) {
    if (given == nullptr || points == nullptr || points->numbers.size() < 3) {
      return notes_.add("face sets without coordinates are left out", at_line_of(node));
    }
    if (state.creased) {
      notes_.add("a creaseAngle changes how polygons are shaded, not where they are: they stay flat", at_line_of(node));
    }
    const Field& index = *given;
    const auto count = static_cast<double>(points->numbers.size() / 3);
    const std::uint32_t group = new_group(node, state);
    const bool turn = state.clockwise != mirrored(state), two_sided = !(state.ordered && state.solid);
    std::map<std::uint32_t, std::uint32_t> vertices;  // from vertex numbers of the file to those of the model
    std::vector<std::uint32_t> corners;
    Looks::FaceCorners of{given};
    for (std::size_t i = 0; i <= index.numbers.size(); ++i) {
      const double number = i < index.numbers.size() ? index.numbers[i] : -1.0;
      if (number >= 0.0) {
        if (!(number < count) || number != std::floor(number)) {
          return errors_.add(index.places[i],
                             "there is no vertex " + mesh_file::shown(std::to_string(static_cast<std::int64_t>(std::min(number, 1e15)))) +
                                 "; the coordinates have " + std::to_string(static_cast<std::int64_t>(count)) + ", counted from 0");
        }
        const auto v = static_cast<std::uint32_t>(number);
        const auto [known, is_new] = vertices.emplace(v, static_cast<std::uint32_t>(model.positions.size()));
        if (is_new) {
          model.positions.push_back(placed(state, {points->numbers[3 * v], points->numbers[3 * v + 1], points->numbers[3 * v + 2]}));
        }
        corners.push_back(known->second);
        continue;
      }
      if (model.corners.size() > most_corners) {
        return errors_.add(node.place, "uses of uses make more than " + std::to_string(most_corners) + " corners of faces");
      }
      if (corners.size() >= 3) {
        if (turn) { std::reverse(corners.begin(), corners.end()); }
        of.count = corners.size();
        model.polygon(corners, looks_.material(state, looks_.numbers(node, state, of), two_sided), group, index.places[of.first].line);
      }
      of.face += corners.empty() ? 0 : 1;
      of.before += corners.size();
      corners.clear();
      of.first = i + 1;
    }
  }

  const SideFile& side_file_;
  OtherFiles& others_;
  Errors& errors_;
  Notes& notes_;
  Looks looks_{model, side_file_, notes_};
  std::map<std::string, std::shared_ptr<const Node>> inlines_;  // by the name of the file
};

ModelResult read_vrml(std::string_view bytes, const SideFile& side_file) {
  Errors errors;
  Notes notes;
  OtherFiles others(side_file, notes);
  const auto root = parse(bytes, errors, notes, others).root;
  ModelMaker maker(side_file, others, errors, notes);
  State state;
  if (root != nullptr && !GraphWalk<ModelMaker, State>(maker, graph_limits).visit(root, state)) {
    errors.add(root->place, "uses of uses make more than " + std::to_string(graph_limits.most_visits) +
                                " nodes of this file, or a way through it is longer than " + std::to_string(graph_limits.deepest));
  }
  maker.model.notes = notes.take();
  return read_result(std::move(maker.model), errors);
}

bool begins_vrml(std::string_view bytes) { return without_mark(bytes).starts_with("#VRML"); }

}  // namespace
}  // namespace apps::vrml

namespace apps::intake {

constinit const ModelFormat wrl{".wrl", "VRML", UpAxis::y, vrml::begins_vrml, vrml::read_vrml};

}  // namespace apps::intake
