// SPDX-License-Identifier: MIT
#pragma once

// Scripts of Euler operators: a text that is a lesson, a bug report and a fuzz seed at once.
//
//   # a comment; the lines before a statement and the one behind it are its caption
//   h0 = make_segment              a handle on the left is checked against the result
//   top = split_edge h0            any other word on the left names the result from here on
//   split_face next(top) h0        arguments: handles h7 v3 f1, names, and functions of them, nested as you like:
//                                    next prev twin (half-edge -> half-edge), face vertex (of a half-edge),
//                                    anchor (the half-edge from which the walk around a face or vertex begins)
//   set_anchor h3                  the walk around the face of h3 begins at h3 from here on
//   refused split_face h0 h7       the operator must be refused; without the word a refusal is an error of the script
//   undo                           takes the last operator or raw edit back; `redo` does the last undone operator again
//   expect v 8 e 12 f 6 s 1 h 0    counts, any of them; the records must be valid too
//   raw next h3 h5                 overwrites one field of one record: next prev vertex face (of a half-edge), anchor
//   expect R2 R3                   validate reports faults of these rules and of no other (`expect valid`: none)
//
// The operators are the rows of euler_table.hpp under their own names or those of the textbooks: `mef h5 h0` is `split_face h5 h0`.
// While a raw edit stands no operator runs, since operators trust the records; further raw edits, `expect R...` and `undo` may follow.
//
// A comment at the head of the text with an empty line behind it is about the whole: its first line is the title. Lines end with LF,
// CR LF or CR; the text is UTF-8. Parsing: euler_script_parse.hpp; running: euler_script_run.hpp; writing a log as a script:
// euler_script_text.hpp. Any bytes give a script or a list of errors, in time linear in their number.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <brep/euler_table.hpp>
#include <brep/handles.hpp>

namespace brep {

struct Place {
  std::uint32_t line = 1, column = 1;  // the column counts bytes
};

enum class Command : std::uint8_t { apply, undo, redo, raw, expect };  // apply: an operator of the table, or set_anchor

// In the order of Command; apply has the names of the operators. `raw` and `expect` have a form of their own.
inline constexpr std::array<std::string_view, 5> command_names{"", "undo", "redo", "raw", "expect"};

enum class Function : std::uint8_t { next, prev, twin, face, vertex, anchor };
inline constexpr std::array<std::string_view, 6> function_names{"next", "prev", "twin", "face", "vertex", "anchor"};

// A handle or a name, and the functions that are applied to it, innermost first.
struct Expression {
  Place place;
  Element handle;  // when name is empty
  std::string name;
  std::vector<Function> functions;
};

// Fields of records that `raw` overwrites; a vertex and a face have the anchor alone.
enum class Field : std::uint8_t { next, prev, vertex, face, anchor };
inline constexpr std::array<std::string_view, 5> field_names{"next", "prev", "vertex", "face", "anchor"};

inline constexpr std::string_view counted = "vefsh";  // the letters of `expect`, in the order of Statement::counts

struct Statement {
  Place place;
  Command command = Command::undo;
  Operator op{};        // apply
  std::string written;  // apply: the name of the operator as it was written, a textbook name perhaps
  bool refused = false;
  Expression result;                            // the left side: a handle, a name, or nothing; no functions
  std::vector<Expression> arguments;            // raw: the record's element and the new value
  Field field = Field::next;                    // raw
  std::array<std::optional<long>, 5> counts{};  // expect
  std::optional<std::vector<int>> rules;        // expect: rules of the validator, ascending; empty for `valid`
  std::string text;                             // as written, without comment
  std::string caption;                          // its comments, one line each; paragraphs are parted by an empty line
};

struct Script {
  std::string title, introduction;  // the comment at the head
  std::vector<Statement> statements;
  std::string closing;  // comments behind the last statement
};

struct ScriptError {
  Place place;
  std::string sentence;
};

// A script, or every error that was found, in the order of the text.
struct ScriptResult {
  std::optional<Script> script;
  std::vector<ScriptError> errors;
};

}  // namespace brep
