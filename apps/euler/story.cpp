// SPDX-License-Identifier: MIT
#include "apps/euler/story.hpp"

#include <cstdlib>
#include <utility>

#include <brep/circulators.hpp>
#include <brep/euler_table.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps::euler {

Teller::Teller(Solid& solid, bool drawn) : solid_(solid), drawn_(drawn), runner_(solid) { remember(story_.frames.emplace_back()); }

void Teller::remember(Frame& frame) {
  story_.edges += solid_.edge_count();
  if (!drawn_ && story_.frames.size() > 2) {
    Frame& old = story_.frames[story_.frames.size() - 3];
    old.drawn = Records();  // assignments that free the memory
    old.records = Records();
  }
  frame.records = records_of(solid_);
  frame.damaged = runner_.damaged();
  if (frame.damaged) {
    const Frame& before = story_.frames[story_.frames.size() - 2];
    frame.drawn = before.drawn;
    frame.shells = before.shells;
    frame.handles = before.handles;
    return;
  }
  frame.drawn = frame.records;
  frame.shells = static_cast<long>(brep::shell_count(solid_));
  frame.handles = brep::genus(solid_);
}

void Teller::tell(const brep::Statement& s) {
  const auto append = [](std::string& text, const std::string& more) {
    if (!text.empty() && !more.empty()) { text += "\n\n"; }
    text += more;
  };
  if (s.command == brep::Command::expect) {
    const brep::Outcome outcome = runner_.run(s);
    Frame& frame = story_.frames.back();
    append(frame.caption, s.caption);
    frame.checks.push_back({s.text, outcome.as_written, outcome.sentence});
    if (!outcome.as_written) { story_.errors.push_back({s.place, outcome.sentence}); }
    return;
  }
  Frame frame;
  frame.statement = s.text;
  frame.caption = s.caption;
  frame.line = s.place.line;
  for (const brep::Expression& e : s.arguments) { frame.arguments.push_back(runner_.value(e)); }
  frame.outcome = runner_.run(s);
  if (s.command == brep::Command::raw && frame.outcome.as_written) { frame.edited = frame.arguments.front(); }
  if (!frame.outcome.as_written) { story_.errors.push_back({s.place, frame.outcome.sentence}); }
  const Records before = story_.frames.back().records;
  story_.frames.push_back(std::move(frame));
  remember(story_.frames.back());
  Frame& now = story_.frames.back();
  if (drawn_) { now.told = told(s, now.outcome, before, now.records); }
}

Story tell(const brep::Script& script, const std::string& name, bool drawn) {
  Solid solid;
  Teller teller(solid, drawn);
  Story& story = teller.story();
  story.title = script.title.empty() ? name : script.title;
  story.introduction = script.introduction;
  for (const brep::Statement& s : script.statements) { teller.tell(s); }
  if (!script.closing.empty()) {
    std::string& caption = story.frames.back().caption;
    caption += (caption.empty() ? "" : "\n\n") + script.closing;
  }
  return std::move(story);
}

std::string headline(const Frame& frame) {
  const bool named = frame.statement.find('=') != std::string::npos;
  const bool silent = frame.outcome.kind != brep::Outcome::Kind::done || frame.outcome.result.letter == 0;
  const std::string result = silent ? "" : to_string(frame.outcome.result);
  if (silent || frame.statement.rfind(result + " ", 0) == 0) { return frame.statement; }
  return frame.statement + (named ? "   (" + result + ")" : "   -> " + result);
}

std::string counts(const Frame& frame) {
  const auto n = [](long count) { return std::to_string(count); };
  return "v " + n(frame.drawn.v) + "   e " + n(frame.drawn.e) + "   f " + n(frame.drawn.f) + "   s " + n(frame.shells) + "   h " +
         n(frame.handles);
}

std::string equation(const Frame& frame) {
  const auto n = [](long count) { return std::to_string(count); };
  const Records& r = frame.drawn;
  const std::string minus = " \xe2\x88\x92 ";
  return n(r.v) + minus + n(r.e) + " + " + n(r.f) + " = " + (r.v - r.e + r.f < 0 ? "\xe2\x88\x92" : "") + n(std::abs(r.v - r.e + r.f)) +
         " = 2(" + n(frame.shells) + minus + n(frame.handles) + ")";
}

namespace {

std::string name(char letter, std::size_t i) { return letter + std::to_string(i); }

// The elements that exist in `now` but not in `then`; edges by both half-edges.
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
  if (outcome.kind != brep::Outcome::Kind::done) { return {}; }  // the sentence of the outcome says why
  if (statement.command == brep::Command::undo) { return "The last step is taken back."; }
  if (statement.command == brep::Command::redo) { return "The step that was taken back is done again."; }
  if (statement.command == brep::Command::raw) { return "One field of one record is overwritten, which no operator would do."; }
  const brep::OperatorForm& form = brep::form(statement.op);
  std::vector<std::string> counts;
  for (const std::string& text : {change("v", form.v), change("e", form.e), change("f", form.f)}) {
    if (!text.empty()) { counts.push_back(text); }
  }
  const std::string textbook(form.steps.empty() ? form.textbook[0] : form.steps);
  std::string out =
      std::string(form.name) + (textbook.empty() ? "" : ", in textbooks " + textbook) + (counts.empty() ? "" : ": " + listed(counts)) + ".";
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
  return out + "; " + (face ? counted(steps, "edge") : counted(steps, "edge leaves", "edges leave"));
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
  if (contains(known, word)) { return {}; }
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
