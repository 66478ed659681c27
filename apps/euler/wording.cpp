// SPDX-License-Identifier: MIT
#include "apps/euler/wording.hpp"

#include <algorithm>
#include <cstdlib>

#include <brep/euler_script_words.hpp>
#include <brep/euler_table.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/words.hpp"

namespace apps::euler {
namespace {

std::string name(char letter, std::size_t i) { return letter + std::to_string(i); }

// The elements that live in `now` and not in `then`: edges by both their halves.
std::vector<std::string> added(const Records& then, const Records& now) {
  std::vector<std::string> out;
  for (std::uint32_t h = 0; h < now.halfedges.size(); h += 2) {
    if (now.halfedges[h].alive && !then.alive(brep::HalfedgeId{h})) { out.push_back("the edge " + name('h', h) + "/" + name('h', h + 1)); }
  }
  const auto anchors = [&](char letter, const std::vector<std::uint32_t>& old, const std::vector<std::uint32_t>& here) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      const bool before = i < old.size() && old[i] != brep::invalid_index;
      if (here[i] != brep::invalid_index && !before) { out.push_back(name(letter, i)); }
    }
  };
  anchors('v', then.vertices, now.vertices);
  anchors('f', then.faces, now.faces);
  return out;
}

std::string listed(const std::vector<std::string>& items) {
  std::string out;
  for (std::size_t i = 0; i < items.size(); ++i) { out += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i]; }
  return out;
}

std::string change(const char* letter, int by) {
  return by == 0 ? "" : std::string(letter) + (by > 0 ? " + " : " \xe2\x88\x92 ") + std::to_string(std::abs(by));
}

}  // namespace

std::string told(const brep::Statement& statement, const brep::Outcome& outcome, const Records& before, const Records& after) {
  if (outcome.kind != brep::Outcome::Kind::done) { return {}; }  // the sentence says it
  if (statement.command == brep::Command::undo) { return "The last step is taken back, by its inverse."; }
  if (statement.command == brep::Command::redo) { return "The step that was taken back is done again."; }
  if (statement.command == brep::Command::raw) { return "One field of one record is overwritten, which no operator would do."; }
  const brep::OperatorForm& form = brep::form(statement.op);
  std::vector<std::string> counts;
  for (const std::string& text : {change("v", form.v), change("e", form.e), change("f", form.f)}) {
    if (!text.empty()) { counts.push_back(text); }
  }
  std::string textbook;
  for (const std::string_view word : form.textbook) {
    if (!word.empty()) { textbook += (textbook.empty() ? ", in textbooks " : " or ") + std::string(word); }
  }
  std::string out = std::string(form.name) + textbook + (counts.empty() ? "" : ": " + listed(counts)) + ".";
  const std::vector<std::string> fresh = added(before, after), gone = added(after, before);
  if (!fresh.empty()) { out += " New: " + listed(fresh) + "."; }
  if (!gone.empty()) { out += " Gone: " + listed(gone) + "."; }
  return out;
}

std::string walk(const Records& r, brep::Element of) {
  const bool face = of.letter == 'f';
  const std::vector<std::uint32_t>& anchors = face ? r.faces : r.vertices;
  if (of.index >= anchors.size() || anchors[of.index] == brep::invalid_index) { return to_string(of) + " does not exist"; }
  std::string out = to_string(of) + ":";
  std::uint32_t h = anchors[of.index];
  std::size_t steps = 0;
  do {
    if (h >= r.halfedges.size() || !r.halfedges[h].alive || ++steps > r.halfedges.size()) {
      return out + " ... the walk does not come back";
    }
    out += " " + name('h', h) + (face ? " (from " + name('v', r.halfedges[h].vertex) : " (in " + name('f', r.halfedges[h].face)) + ")";
    h = face ? r.halfedges[h].next : r.halfedges[h ^ 1U].next;
  } while (h != anchors[of.index]);
  return out + "; " + std::to_string(steps) + (face ? (steps == 1 ? " edge" : " edges") : (steps == 1 ? " edge leaves" : " edges leave"));
}

std::vector<std::string> statement_words() {
  std::vector<std::string> words = {"undo", "redo", "raw", "expect", "refused", "set_anchor"};
  for (const brep::OperatorForm& row : brep::operator_forms) {
    words.emplace_back(row.name);
    for (const std::string_view word : row.textbook) {
      if (!word.empty()) { words.emplace_back(word); }
    }
  }
  return words;
}

std::string meant(std::string_view line, const std::vector<std::string>& known) {
  const std::size_t equals = line.find('=');
  const std::size_t begin = line.find_first_not_of(" \t", equals == line.npos ? 0 : equals + 1);
  if (begin == line.npos) { return {}; }
  const std::string_view word = line.substr(begin, line.find_first_of(" \t\r(", begin) - begin);
  if (std::find(known.begin(), known.end(), word) != known.end()) { return {}; }
  return suggestion(word, known);
}

std::string meant_in(std::string_view script, std::uint32_t line) {
  for (; line > 1; --line) {
    const std::size_t end = script.find('\n');
    if (end == script.npos) { return {}; }
    script.remove_prefix(end + 1);
  }
  return meant(script.substr(0, script.find('\n')), statement_words());
}

}  // namespace apps::euler
