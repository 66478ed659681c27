// SPDX-License-Identifier: MIT
#pragma once

// A script that was run, step by step: the content of the pictures and the page.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/euler_script.hpp>
#include <brep/euler_script_run.hpp>

#include "apps/euler/records.hpp"

namespace apps::euler {

using Solid = brep::BRep<brep::NoData, brep::NoData, brep::NoData, brep::EulerLog>;

struct Check {  // an `expect` after a step
  std::string text;
  bool met = true;
  std::string sentence;
};

struct Frame {
  std::string statement;  // empty for the start
  std::string caption;
  std::string told;  // describes the step in words; only in drawn stories
  std::uint32_t line = 0;
  brep::Outcome outcome;
  Records records;               // the present ones, damaged ones included
  Records drawn;                 // the last valid ones
  long shells = 0, handles = 0;  // of `drawn`
  bool damaged = false;
  std::vector<brep::Element> arguments;  // handles as they were before the step
  brep::Element edited;                  // the element whose record a raw edit overwrote
  std::vector<Check> checks;
};

using Coordinates = std::map<std::uint32_t, glm::dvec3>;  // by vertex

struct Story {
  std::string title, introduction;
  std::vector<Frame> frames;              // the first is the start
  std::vector<brep::ScriptError> errors;  // statements that were not executed as written
  Coordinates coordinates;                // only if the script has some (outputs.hpp)
  std::size_t edges = 0;                  // the sum over all frames: the cost of drawing them
};

// Executes one statement after another, even after one that failed. A story that is not drawn keeps the records of its last two frames
// only, because those of all steps of a long script take much memory.
class Teller {
 public:
  explicit Teller(Solid& solid, bool drawn = true);
  void tell(const brep::Statement& statement);
  [[nodiscard]] const Story& story() const { return story_; }
  [[nodiscard]] Story& story() { return story_; }

 private:
  void remember(Frame& frame);

  Solid& solid_;
  bool drawn_;
  brep::ScriptRunner<Solid> runner_;
  Story story_;
};

[[nodiscard]] Story tell(const brep::Script& script, const std::string& name, bool drawn = true);

// The statement, with its result added unless it names it already: "h2 = split_edge h0", "split_edge h0   -> h2",
// "new = split_edge h0   (h2)".
[[nodiscard]] std::string headline(const Frame& frame);
// "v 8   e 12   f 6   s 1   h 0"
[[nodiscard]] std::string counts(const Frame& frame);
// "8 - 12 + 6 = 2 = 2(1 - 0)"
[[nodiscard]] std::string equation(const Frame& frame);

// --- words

// Describes a step for which the script has no caption: the operator with its textbook name, its effect on the counts, and the elements
// that were added or removed.
[[nodiscard]] std::string told(const brep::Statement& statement, const brep::Outcome& outcome, const Records& before, const Records& after);

// The walk around a face (its half-edges, each with its origin) or around a vertex (the half-edges that leave it, each with its face) as
// one line; a sentence if the element does not exist.
[[nodiscard]] std::string walk(const Records& records, brep::Element of);

// Words with which a statement of a script may begin: operators by our names and by those of textbooks, and other statements.
[[nodiscard]] std::vector<std::string> statement_words();

// "; did you mean 'split_face'?" for a line whose first word (after "name =") is unknown but close to a known one; else empty.
[[nodiscard]] std::string meant(std::string_view line, const std::vector<std::string>& known);

// The same for a line of a script, counted from 1.
[[nodiscard]] std::string meant_in(std::string_view script, std::uint32_t line);

}  // namespace apps::euler
