// SPDX-License-Identifier: MIT
#pragma once

// Reads tokens into statements. The grammar (examples/scenes/README.md) needs one token of look-ahead. Braces of groups and clauses are
// handled by loops, so a million of them use no stack; operands of unions, intersections and differences by recursion, at most 64 deep.
//
// Recovery: after an error the rest of the line is skipped; inside a block reading continues with the next line. An unexpected
// block is skipped up to its closing brace. If a line inside a block begins with a word that can only begin a statement, a
// closing brace is missing.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

class Parser {
 public:
  Parser(std::string_view text, Errors& errors);
  [[nodiscard]] SceneSyntax scene();

 private:
  // Statements: each begins after its keyword and ends after its line or block (parser.cpp).
  void statement(SceneSyntax& out);
  void material(SceneSyntax& out);
  void camera(SceneSyntax& out);
  void group(SceneSyntax& out);
  [[nodiscard]] std::optional<ObjectSyntax> object(const ObjectKind& kind, std::size_t depth = 0);
  [[nodiscard]] std::optional<UseSyntax> use();
  void unknown_statement();

  // Clauses of a statement, on its line and in its block; `clause` reads what follows the word `keyword`.
  template <class Clause>
  void clauses(std::string_view statement, std::span<const std::string_view> known, Clause&& clause);
  void material_clause(const Token& keyword, MaterialSyntax& out);
  void camera_clause(const Token& keyword, CameraSyntax& out);
  void object_clause(const Token& keyword, ObjectSyntax& out);
  void operand(const ObjectKind& kind, ObjectSyntax& out, std::size_t depth);
  void require_clauses(const ObjectSyntax& object, bool operand);
  void sheet_clause(ObjectSyntax& out);
  void file_clause(ObjectSyntax& out);
  void face_clause(const Token& keyword, ObjectSyntax& out);
  void own_clause(const Token& keyword, Form form, ObjectSyntax& out);
  bool placement_clause(const Token& keyword, raycast::Placement& out);
  void rotate_clause(const Token& keyword, raycast::Placement& out);
  void scale_clause(const Token& keyword, raycast::Placement& out);
  template <class Read>
  bool one_or_three(const Token& keyword, const char* names, glm::dvec3& out, const Read& read);
  void color_clause(const Token& keyword, radiosity::Color& out, double most, std::string_view law);

  // Values (values.cpp). Each returns false after reporting an error.
  bool number(std::string_view clause, double& out, double most = max_number);
  bool numbers(const Token& keyword, std::span<double> out);
  bool vector(const Token& keyword, glm::dvec3& out);
  bool whole_number(std::string_view what, std::uint32_t most, std::uint32_t& out);
  bool name(std::string_view of_what, Name& out);
  bool no_more_numbers(std::string_view clause, std::string_view takes);

  // Tokens.
  void next();
  void skip_rest();       // up to a brace or the end of the line
  void skip_statement();  // the rest of the line and the block that it opens
  void skip_block();      // from '{' to its '}', inclusive
  void skip_to_next();    // the rest of the statement and the end of the line
  void expect_end_of_line();
  void unclosed(Place opened);
  void error(Place place, std::string sentence) { errors_.add(place, std::move(sentence)); }
  [[nodiscard]] bool at(Token::Kind kind) const { return token_.kind == kind; }
  [[nodiscard]] bool at_word(std::string_view word) const { return at(Token::Kind::word) && token_.text == word; }

  Errors& errors_;
  Lexer lexer_;
  Token token_;
  std::size_t digits_ = 0;  // largest number of significant digits of a number read since it was set to 0
};

}  // namespace apps::scene_file
