// SPDX-License-Identifier: MIT
#include "apps/euler/story.hpp"

#include <utility>

#include <brep/circulators.hpp>

#include "apps/euler/wording.hpp"

namespace apps::euler {

Teller::Teller(Solid& solid, bool drawn) : solid_(solid), drawn_(drawn), runner_(solid) { remember(story_.frames.emplace_back()); }

void Teller::remember(Frame& frame) {
  story_.edges += solid_.edge_count();
  if (!drawn_ && story_.frames.size() > 2) {
    Frame& old = story_.frames[story_.frames.size() - 3];
    old.drawn = Records();  // by moves, which free the memory
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

}  // namespace apps::euler
