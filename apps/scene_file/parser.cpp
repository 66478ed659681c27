// SPDX-License-Identifier: MIT
// Statements and blocks; their clauses are in clauses.cpp.
#include "apps/scene_file/parser.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "apps/scene_file/words.hpp"

namespace apps::scene_file {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::array<std::string_view, 13> statements = {"material", "camera", "polygon",      "disk", "box",    "sphere", "cylinder",
                                                         "cone",     "torus",  "superquadric", "mesh", "define", "use"};
constexpr std::array<std::string_view, 2> material_words = {"reflectance", "emission"};
constexpr std::array<std::string_view, 6> camera_words = {"eye", "target", "look", "up", "fov", "size"};
constexpr std::array<std::string_view, 3> use_words = {"move", "rotate", "scale"};
constexpr std::array<std::string_view, 6> polygon_words = {"vertex", "material", "move", "rotate", "scale", "sheet"};
constexpr std::array<std::string_view, 8> box_words = {"from", "to", "material", "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 8> sphere_words = {"center", "radius", "material", "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 9> cylinder_words = {"base", "axis",   "radius", "material", "sheet",
                                                            "move", "rotate", "scale",  "inside"};
constexpr std::array<std::string_view, 8> disk_words = {"center", "normal", "radius", "material", "sheet", "move", "rotate", "scale"};
constexpr std::array<std::string_view, 10> cone_words = {"base",  "axis", "radius", "top",   "material",
                                                         "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 10> torus_words = {"center", "axis", "radius", "tube",  "material",
                                                          "sheet",  "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 10> superquadric_words = {"center", "radii", "exponents", "ring",  "material",
                                                                 "sheet",  "move",  "rotate",    "scale", "inside"};
constexpr std::array<std::string_view, 8> mesh_words = {"vertex", "face", "material", "sheet", "move", "rotate", "scale", "inside"};

Words words_of(Kind kind) {
  switch (kind) {
    case Kind::polygon:
      return polygon_words;
    case Kind::box:
      return box_words;
    case Kind::sphere:
      return sphere_words;
    case Kind::cylinder:
      return cylinder_words;
    case Kind::disk:
      return disk_words;
    case Kind::cone:
      return cone_words;
    case Kind::torus:
      return torus_words;
    case Kind::superquadric:
      return superquadric_words;
    case Kind::mesh:
      break;
  }
  return mesh_words;
}

// Clauses that may stand several times; any other one is refused the second time.
constexpr std::array<std::string_view, 6> repeatable = {"vertex", "face", "sheet", "move", "rotate", "scale"};

bool contains(Words words, std::string_view word) { return std::find(words.begin(), words.end(), word) != words.end(); }

std::size_t index_in(Words words, std::string_view word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

constexpr std::array<Kind, 9> kinds = {Kind::polygon, Kind::disk,  Kind::box,          Kind::sphere, Kind::cylinder,
                                       Kind::cone,    Kind::torus, Kind::superquadric, Kind::mesh};

std::optional<Kind> kind_of(std::string_view word) {
  for (const Kind kind : kinds) {
    if (word == to_string(kind)) { return kind; }
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::polygon:
      return "polygon";
    case Kind::box:
      return "box";
    case Kind::sphere:
      return "sphere";
    case Kind::cylinder:
      return "cylinder";
    case Kind::disk:
      return "disk";
    case Kind::cone:
      return "cone";
    case Kind::torus:
      return "torus";
    case Kind::superquadric:
      return "superquadric";
    case Kind::mesh:
      break;
  }
  return "mesh";
}

Parser::Parser(std::string_view text, Errors& errors) : errors_(errors), lexer_(text, errors) { next(); }

SceneSyntax Parser::scene() {
  SceneSyntax out;
  while (!at(Token::Kind::end_of_file)) { statement(out); }
  out.complete = !errors_.full() && !lexer_.broken();
  return out;
}

void Parser::statement(SceneSyntax& out) {
  if (at(Token::Kind::end_of_line)) { return next(); }
  if (!at(Token::Kind::word) || !contains(statements, token_.text)) { return unknown_statement(); }
  const std::string_view word = token_.text;
  next();
  if (word == "material") {
    material(out);
  } else if (word == "camera") {
    camera(out);
  } else if (word == "define") {
    group(out);
  } else if (word == "use") {
    use(out.items);
  } else {
    object(*kind_of(word), out.items);
  }
  if (at(Token::Kind::close)) { unknown_statement(); }
}

void Parser::unknown_statement() {
  const Token found = token_;
  if (found.kind == Token::Kind::close) {
    error(found.place, "found '}' without an open block");
    next();
    return;
  }
  const bool word = found.kind == Token::Kind::word;
  error(found.place, (word ? "unknown word " : "expected a statement, found ") + describe(found) +
                         (found.kind == Token::Kind::open ? "; a block opens on the line of its statement"
                          : word                          ? "; expected " + list_of(statements) + suggestion(found.text, statements)
                                                          : "; expected " + list_of(statements)));
  skip_statement();
  if (at(Token::Kind::end_of_line)) { next(); }
}

// Reads clauses to the end of the statement's line, or of the block that opens on it. Leaves a '}' that closes no
// block of this statement to the caller.
template <class Clause>
void Parser::clauses(std::string_view statement, Words known, Clause&& clause) {
  std::optional<Place> block;
  bool line_begins = false;
  std::array<std::optional<Place>, 9> given;
  while (true) {
    const bool first_of_line = std::exchange(line_begins, false);
    if (at(Token::Kind::end_of_file)) { return block ? unclosed(*block) : void(); }
    if (at(Token::Kind::end_of_line)) {
      next();
      if (!block) { return; }
      line_begins = true;
    } else if (at(Token::Kind::close)) {
      if (!block) { return; }
      next();
      return expect_end_of_line();
    } else if (at(Token::Kind::open)) {
      if (block) {
        error(token_.place, "found '{' inside the block that begins at " + to_string(*block));
        skip_block();
      } else {
        block = token_.place;
        next();
      }
    } else if (at(Token::Kind::word) && contains(known, token_.text)) {
      const Token keyword = token_;
      std::optional<Place>& earlier = given[index_in(known, keyword.text)];
      if (earlier && !contains(repeatable, keyword.text)) {
        error(keyword.place, quoted(keyword.text) + " is given twice; the first one stands at " + to_string(*earlier));
      }
      earlier = keyword.place;
      next();
      clause(keyword);
    } else if (block && first_of_line && at(Token::Kind::word) && contains(statements, token_.text)) {
      return error(token_.place, "expected '}' before " + quoted(token_.text) + ", to close the block that begins at " + to_string(*block));
    } else {
      if (!errors_.just_reported(token_.place)) {
        error(token_.place, (at(Token::Kind::word) ? "unknown word " : "found ") + describe(token_) + " in this " + std::string(statement) +
                                "; expected " + list_of(known) + (at(Token::Kind::word) ? suggestion(token_.text, known) : std::string()));
      }
      skip_rest();
    }
  }
}

void Parser::material(SceneSyntax& out) {
  MaterialSyntax syntax;
  if (!name("material", syntax.name)) {
    skip_statement();
    return expect_end_of_line();
  }
  clauses("material", material_words, [&](const Token& keyword) { material_clause(keyword, syntax); });
  out.materials.push_back(std::move(syntax));
}

void Parser::camera(SceneSyntax& out) {
  const std::size_t before = errors_.count();
  CameraSyntax syntax;
  Name camera_name;
  if (!name("camera", camera_name)) {
    skip_statement();
    return expect_end_of_line();
  }
  syntax.camera.name = camera_name.text;
  syntax.place = camera_name.place;
  syntax.camera.forward = syntax.camera.up = glm::dvec3(0.0);
  std::optional<Place> eye, target, look;
  clauses("camera", camera_words, [&](const Token& keyword) {
    if (keyword.text == "eye") { eye = keyword.place; }
    if (keyword.text == "target") { target = keyword.place; }
    if (keyword.text == "look") { look = keyword.place; }
    camera_clause(keyword, syntax);
  });
  if (!eye) { error(syntax.place, "camera " + quoted(camera_name.text) + " has no 'eye'"); }
  if (!target && !look) { error(syntax.place, "camera " + quoted(camera_name.text) + " needs 'target' or 'look'"); }
  if (target && look) { error(*look, "a camera has 'target' or 'look', not both"); }
  if (target) { syntax.camera.forward -= syntax.camera.eye; }
  syntax.sound = errors_.count() == before;
  out.cameras.push_back(std::move(syntax));
}

void Parser::object(Kind kind, std::vector<Item>& out) {
  const std::size_t before = errors_.count();
  ObjectSyntax syntax;
  syntax.kind = kind;
  if (!name(to_string(kind), syntax.name)) {
    skip_statement();
    return expect_end_of_line();
  }
  clauses(to_string(kind), words_of(kind), [&](const Token& keyword) { object_clause(keyword, syntax); });
  const auto require = [&](bool given, std::string_view what) {
    if (!given) {
      error(syntax.name.place, std::string(to_string(kind)) + " " + quoted(syntax.name.text) + " has no " + std::string(what));
    }
  };
  if (errors_.count() == before) {
    if (kind == Kind::box) {
      require(syntax.from.has_value(), "'from'");
      require(syntax.to.has_value(), "'to'");
    }
    const auto is_one_of = [kind](std::initializer_list<Kind> list) { return std::find(list.begin(), list.end(), kind) != list.end(); };
    if (is_one_of({Kind::sphere, Kind::disk, Kind::torus, Kind::superquadric})) { require(syntax.center.has_value(), "'center'"); }
    if (is_one_of({Kind::cylinder, Kind::cone})) { require(syntax.base.has_value(), "'base'"); }
    if (is_one_of({Kind::cylinder, Kind::cone, Kind::torus})) { require(syntax.axis.has_value(), "'axis'"); }
    if (kind == Kind::disk) { require(syntax.normal.has_value(), "'normal'"); }
    if (is_one_of({Kind::sphere, Kind::disk, Kind::cylinder, Kind::cone, Kind::torus})) { require(syntax.radius.has_value(), "'radius'"); }
    if (kind == Kind::torus) { require(syntax.tube.has_value(), "'tube'"); }
    if (kind == Kind::superquadric) {
      require(syntax.radii.has_value(), "'radii'");
      require(syntax.exponents.has_value(), "'exponents'");
    }
    if (kind == Kind::polygon || kind == Kind::mesh) { require(!syntax.vertices.empty(), "'vertex'"); }
    if (kind == Kind::mesh) { require(!syntax.faces.empty(), "'face'"); }
    require(syntax.material.has_value() || !syntax.sheets.empty(), "'material'");
  }
  syntax.sound = errors_.count() == before;
  out.emplace_back(std::move(syntax));
}

void Parser::use(std::vector<Item>& out) {
  const std::size_t before = errors_.count();
  UseSyntax syntax;
  bool named = name("group", syntax.group);
  if (named && !at_word("as")) {
    error(token_.place, "expected 'as' and a name for this use of " + quoted(syntax.group.text) + ", found " + describe(token_));
    named = false;
  }
  if (named) { next(); }
  if (!named || !name("use", syntax.name)) {
    skip_statement();
    return expect_end_of_line();
  }
  clauses("use", use_words, [&](const Token& keyword) { placement_clause(keyword, syntax.placement); });
  syntax.sound = errors_.count() == before;
  out.emplace_back(std::move(syntax));
}

void Parser::group(SceneSyntax& out) {
  GroupSyntax syntax;
  if (!name("group", syntax.name)) {
    skip_statement();
    return expect_end_of_line();
  }
  const Place opened = token_.place;
  if (!at(Token::Kind::open)) {
    error(opened, "expected '{' after 'define " + syntax.name.text.substr(0, 40) + "', found " + describe(token_));
    skip_statement();
    return expect_end_of_line();
  }
  next();
  const auto keep = [&] { out.groups.push_back(std::move(syntax)); };
  while (!at(Token::Kind::close)) {
    if (at(Token::Kind::end_of_file)) {
      unclosed(opened);
      return keep();
    }
    const Token found = token_;
    const auto kind = kind_of(found.text);
    if (found.kind == Token::Kind::end_of_line) {
      next();
    } else if (found.kind == Token::Kind::word && (kind || found.text == "use")) {
      next();
      if (kind) {
        object(*kind, syntax.items);
      } else {
        use(syntax.items);
      }
    } else if (found.kind == Token::Kind::word && contains(statements, found.text)) {
      error(found.place, quoted(found.text) +
                             " cannot stand inside a group; expected '}' to close the group "
                             "that begins at " +
                             to_string(opened));
      return keep();
    } else {
      unknown_statement();
    }
  }
  next();
  keep();
  expect_end_of_line();
}

}  // namespace apps::scene_file
