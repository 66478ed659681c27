// SPDX-License-Identifier: MIT
// Statements and blocks; their clauses are in clauses.cpp.
#include "apps/scene_file/parser.hpp"

#include <algorithm>
#include <utility>

#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps::scene_file {

Parser::Parser(std::string_view text, Errors& errors) : errors_(errors), lexer_(text, errors) { next(); }

SceneSyntax Parser::scene() {
  SceneSyntax out;
  while (!at(Token::Kind::end_of_file)) { statement(out); }
  out.complete = !errors_.full() && !lexer_.broken();
  return out;
}

void Parser::statement(SceneSyntax& out) {
  if (at(Token::Kind::end_of_line)) { return next(); }
  if (!at(Token::Kind::word) || !contains(statements(), token_.text)) { return unknown_statement(); }
  const std::string_view word = token_.text;
  next();
  if (word == "material") {
    material(out);
  } else if (word == "camera") {
    camera(out);
  } else if (word == "define") {
    group(out);
  } else if (word == "use") {
    if (auto read = use()) { out.items.emplace_back(std::move(*read)); }
  } else if (auto read = object(*kind_of(word))) {
    out.items.emplace_back(std::move(*read));
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
                          : word                          ? "; expected " + list_of(statements()) + suggestion(found.text, statements())
                                                          : "; expected " + list_of(statements())));
  skip_statement();
  if (at(Token::Kind::end_of_line)) { next(); }
}

// Reads clauses to the end of the statement's line, or of the block opened on it. A '}' that does not close a block of this
// statement is left to the caller.
template <class Clause>
void Parser::clauses(std::string_view statement, Words known, Clause&& clause) {
  std::optional<Place> block;
  bool line_begins = false;
  std::vector<std::optional<Place>> given(known.size());  // by word: its last place
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
    } else if (at(Token::Kind::word) && contains(known, token_.text) && (block || !is_operand(token_.text))) {
      const Token keyword = token_;
      std::optional<Place>& earlier = given[static_cast<std::size_t>(std::find(known.begin(), known.end(), keyword.text) - known.begin())];
      line_begins = is_operand(keyword.text);  // an operand also reads the end of its line
      if (earlier && !line_begins && !is_repeatable(keyword.text)) {
        error(keyword.place, in_quotes(keyword.text) + " is given twice; the first one stands at " + to_string(*earlier));
      }
      earlier = keyword.place;
      next();
      clause(keyword);
    } else if (!block && at(Token::Kind::word) && contains(known, token_.text)) {
      error(token_.place, "operands stand in a block; expected '{' before " + in_quotes(token_.text));
      skip_statement();
    } else if (block && first_of_line && at(Token::Kind::word) && contains(statements(), token_.text)) {
      return error(token_.place,
                   "expected '}' before " + in_quotes(token_.text) + ", to close the block that begins at " + to_string(*block));
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
  if (!name("material", syntax.name)) { return skip_to_next(); }
  clauses("material", material_words, [&](const Token& keyword) { material_clause(keyword, syntax); });
  out.materials.push_back(std::move(syntax));
}

void Parser::camera(SceneSyntax& out) {
  const std::size_t before = errors_.count();
  CameraSyntax syntax;
  Name camera_name;
  if (!name("camera", camera_name)) { return skip_to_next(); }
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
  if (!eye) { error(syntax.place, "camera " + in_quotes(camera_name.text) + " has no 'eye'"); }
  if (!target && !look) { error(syntax.place, "camera " + in_quotes(camera_name.text) + " needs 'target' or 'look'"); }
  if (target && look) { error(*look, "a camera has 'target' or 'look', not both"); }
  if (target) { syntax.camera.forward -= syntax.camera.eye; }
  syntax.sound = errors_.count() == before;
  out.cameras.push_back(std::move(syntax));
}

// Nothing if there is no name. `depth`: number of unions, intersections and differences around it.
std::optional<ObjectSyntax> Parser::object(const ObjectKind& kind, std::size_t depth) {
  const std::size_t before = errors_.count();
  ObjectSyntax syntax;
  syntax.kind = &kind;
  if (!name(kind.word, syntax.name)) {
    skip_to_next();
    return std::nullopt;
  }
  clauses(kind.word, clause_words(kind), [&](const Token& keyword) {
    if (const ObjectKind* const operand_kind = kind_of(keyword.text)) {
      operand(*operand_kind, syntax, depth + 1);
    } else if (keyword.text == "use") {
      if (const auto read = use()) { syntax.operands.push_back(as_operand(*read)); }
    } else {
      object_clause(keyword, syntax);
    }
  });
  if (errors_.count() == before) { require_clauses(syntax, depth > 0); }
  syntax.sound = errors_.count() == before;
  return syntax;
}

void Parser::operand(const ObjectKind& kind, ObjectSyntax& out, std::size_t depth) {
  if (depth >= max_use_depth) {
    error(token_.place, "unions, intersections and differences are nested deeper than " + std::to_string(max_use_depth));
    return skip_to_next();
  }
  if (auto read = object(kind, depth)) { out.operands.push_back(std::move(*read)); }
}

// Reports missing clauses. Operands may get their material from the statement around them.
void Parser::require_clauses(const ObjectSyntax& object, bool operand) {
  const ObjectKind& kind = *object.kind;
  const auto require = [&](bool given, const std::string& what) {
    if (!given) { error(object.name.place, std::string(kind.word) + " " + in_quotes(object.name.text) + " has no " + what); }
  };
  if (is_csg(kind)) { return require(!object.operands.empty(), "operands; expected solids between '{' and '}'"); }
  if (object.file) {
    require(object.vertices.empty() && object.faces.empty(), "need of 'vertex' and 'face' beside its file");
    require(object.sheets.empty(), "sheets beside its file, which says the materials; 'material' stands for all of them");
    require(!object.inside, "'inside' beside its file: a closed shell around a lamp is a room by itself");
    return require(!operand, "place among operands: what is in its file need not be a solid");
  }
  require(!object.two_sided, "'file'; only a mesh from a file can be 'two-sided'");
  for (const Clause& clause : kind.clauses) {
    const bool given = clause.form == Form::vertex ? !object.vertices.empty()
                       : clause.form == Form::face ? !object.faces.empty()
                                                   : object.find(clause.word) != nullptr;
    require(given || !clause.required, "'" + std::string(clause.word) + "'");
  }
  if (!operand) { require(object.material.has_value() || !object.sheets.empty(), "'material'"); }
}

// Nothing if the name or the group is missing.
std::optional<UseSyntax> Parser::use() {
  const std::size_t before = errors_.count();
  UseSyntax syntax;
  bool named = name("group", syntax.group);
  if (named && !at_word("as")) {
    error(token_.place, "expected 'as' and a name for this use of " + in_quotes(syntax.group.text) + ", found " + describe(token_));
    named = false;
  }
  if (named) { next(); }
  if (!named || !name("use", syntax.name)) {
    skip_to_next();
    return std::nullopt;
  }
  clauses("use", use_words, [&](const Token& keyword) { placement_clause(keyword, syntax.placement); });
  syntax.sound = errors_.count() == before;
  return syntax;
}

void Parser::group(SceneSyntax& out) {
  GroupSyntax syntax;
  if (!name("group", syntax.name)) { return skip_to_next(); }
  const Place opened = token_.place;
  if (!at(Token::Kind::open)) {
    error(opened, "expected '{' after 'define " + syntax.name.text.substr(0, 40) + "', found " + describe(token_));
    return skip_to_next();
  }
  next();
  const auto keep = [&] { out.groups.push_back(std::move(syntax)); };
  while (!at(Token::Kind::close)) {
    if (at(Token::Kind::end_of_file)) {
      unclosed(opened);
      return keep();
    }
    const Token found = token_;
    const ObjectKind* const kind = kind_of(found.text);
    if (found.kind == Token::Kind::end_of_line) {
      next();
    } else if (found.kind == Token::Kind::word && (kind != nullptr || found.text == "use")) {
      next();
      if (kind == nullptr) {
        if (auto read = use()) { syntax.items.emplace_back(std::move(*read)); }
      } else if (auto read = object(*kind)) {
        syntax.items.emplace_back(std::move(*read));
      }
    } else if (found.kind == Token::Kind::word && contains(statements(), found.text)) {
      error(found.place,
            in_quotes(found.text) + " cannot stand inside a group; expected '}' to close the group that begins at " + to_string(opened));
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
