// SPDX-License-Identifier: MIT
#pragma once

// Runs the statements of euler_script.hpp over a BRep with an EulerLog.
//
// Each statement gives an Outcome and the next one may follow, whatever it was: a refusal changes nothing. run_script() is the strict form:
// it stops at the first statement that was not done as written. Handles of any value may come in; the operators refuse dead
// ones, and functions such as next(x) are not evaluated for them. While a raw edit stands the records may be anything, so no
// operator runs and nothing walks over them but the validator.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <brep/euler_log.hpp>
#include <brep/euler_script.hpp>
#include <brep/validate.hpp>

namespace brep {

struct Outcome {
  enum class Kind { done, refused, failed };
  Kind kind = Kind::done;
  bool as_written = true;     // strict replay goes on: done, or refused where the script says `refused`
  Element result;             // of an operator that was done
  Refusal refusal;            // Kind::refused
  std::string sentence;       // why it was refused or failed
  std::vector<Fault> faults;  // raw and expect: what the validator says
};

template <class B>
class ScriptRunner {
 public:
  explicit ScriptRunner(B& brep) : brep_(&brep) {}

  Outcome run(const Statement& s) {
    Outcome outcome = dispatch(s);
    // An older value must not stand in for a result that did not come.
    if (outcome.kind != Outcome::Kind::done) { names_.erase(s.result.name); }
    if (s.refused && outcome.kind == Outcome::Kind::done) {
      outcome.kind = Outcome::Kind::failed;
      outcome.sentence = std::string(name(s.op)) + " was done, but the script says that it is refused";
    }
    outcome.as_written = outcome.kind == Outcome::Kind::done || (s.refused && outcome.kind == Outcome::Kind::refused);
    return outcome;
  }

  // A raw edit stands.
  [[nodiscard]] bool damaged() const { return !edits_.empty(); }

  // The elements that an expression names at present, for pictures; nothing where it has no value.
  [[nodiscard]] Element value(const Expression& e) const {
    Outcome ignored;
    return evaluate(e, ignored);
  }

 private:
  struct Edit {
    Field field;
    Element owner;
    std::uint32_t before;
  };

  static Outcome failed(std::string sentence) {
    Outcome outcome;
    outcome.kind = Outcome::Kind::failed;
    outcome.sentence = std::move(sentence);
    return outcome;
  }
  static Outcome refused(const Refusal& refusal) {
    Outcome outcome;
    outcome.kind = Outcome::Kind::refused;
    outcome.refusal = refusal;
    outcome.sentence = refusal.sentence();
    return outcome;
  }
  static Outcome outcome_of(const Result<Element>& result) {
    if (!result) { return refused(result.refusal()); }
    Outcome outcome;
    outcome.result = *result;
    return outcome;
  }

  [[nodiscard]] bool alive(Element e) const {
    return e.letter == 'h'   ? brep_->alive(HalfedgeId{e.index})
           : e.letter == 'v' ? brep_->alive(VertexId{e.index})
                             : brep_->alive(FaceId{e.index});
  }
  [[nodiscard]] Element value_of(Function function, Element x) const {
    const HalfedgeId h{x.index};
    switch (function) {
      case Function::next:
        return brep_->next(h);
      case Function::prev:
        return brep_->prev(h);
      case Function::twin:
        return twin(h);
      case Function::face:
        return brep_->face(h);
      case Function::vertex:
        return brep_->vertex(h);
      case Function::anchor:
        return x.letter == 'v' ? brep_->halfedge(VertexId{x.index}) : brep_->halfedge(FaceId{x.index});
    }
    return {};
  }
  // Nothing, and the reason in `why`, when a function meets an element that is not alive or a name has no value.
  [[nodiscard]] Element evaluate(const Expression& e, Outcome& why) const {
    Element x = e.handle;
    if (!e.name.empty()) {
      const auto named = names_.find(e.name);
      if (named == names_.end()) {
        why = failed("'" + e.name + "' has no value: the statement that defines it was not done");
        return {};
      }
      x = named->second;
    }
    for (Function function : e.functions) {
      if (!alive(x)) {
        why = refused(Refusal{Code::dead, {x}});
        return {};
      }
      x = value_of(function, x);
    }
    return x;
  }

  Outcome dispatch(const Statement& s) {
    if (s.command == Command::expect) { return expect(s); }
    if (s.command == Command::undo) { return undo_last(); }
    if (s.command != Command::raw && damaged()) {
      return failed("a raw edit stands, and operators trust the records; `undo` takes it back");
    }
    if (s.command == Command::redo) { return redo(*brep_) ? Outcome{} : failed("there is nothing to redo"); }
    std::vector<Element> arguments;
    for (const Expression& e : s.arguments) {
      Outcome why;
      arguments.push_back(evaluate(e, why));
      if (arguments.back().letter == 0) { return why; }
    }
    if (s.command == Command::raw) { return raw(s.field, arguments[0], arguments[1].index); }
    const HalfedgeId a{arguments.empty() ? invalid_index : arguments[0].index};
    const HalfedgeId b{arguments.size() < 2 ? invalid_index : arguments[1].index};
    Outcome outcome = outcome_of(apply(*brep_, s.op, a, b));
    if (outcome.kind == Outcome::Kind::refused && !s.written.empty() && s.written != name(s.op)) {
      outcome.sentence += " (" + s.written + " is " + std::string(name(s.op)) + " here)";
    }
    if (outcome.kind != Outcome::Kind::done) { return outcome; }
    if (!s.result.name.empty()) { names_[s.result.name] = outcome.result; }
    if (s.result.handle.letter != 0 && s.result.handle != outcome.result) {
      Outcome other = failed("the result is " + to_string(outcome.result) + ", but the script says " + to_string(s.result.handle));
      other.result = outcome.result;
      return other;
    }
    return outcome;
  }

  // The word that a raw edit overwrites; `owner` is alive.
  [[nodiscard]] std::uint32_t& word(Field field, Element owner) {
    using detail::Raw;
    if (owner.letter == 'v') { return Raw::at(*brep_, VertexId{owner.index}).halfedge.index; }
    if (owner.letter == 'f') { return Raw::at(*brep_, FaceId{owner.index}).halfedge.index; }
    auto& record = Raw::at(*brep_, HalfedgeId{owner.index});
    return field == Field::next     ? record.next.index
           : field == Field::prev   ? record.prev.index
           : field == Field::vertex ? record.vertex.index
                                    : record.face.index;
  }
  Outcome raw(Field field, Element owner, std::uint32_t value) {
    if (!alive(owner)) { return refused(Refusal{Code::dead, {owner}}); }
    edits_.push_back({field, owner, word(field, owner)});
    word(field, owner) = value;
    Outcome outcome;
    outcome.faults = validate(*brep_);
    return outcome;
  }
  Outcome undo_last() {
    if (damaged()) {
      word(edits_.back().field, edits_.back().owner) = edits_.back().before;
      edits_.pop_back();
      return {};
    }
    return undo(*brep_) ? Outcome{} : failed("there is nothing to undo");
  }

  Outcome expect(const Statement& s) {
    Outcome outcome;
    outcome.faults = validate(*brep_);
    const auto fail = [&](std::string sentence) {
      outcome.kind = Outcome::Kind::failed;
      outcome.sentence = std::move(sentence);
    };
    if (s.rules) {
      std::string found;
      std::vector<int> rules;
      for (const Fault& fault : outcome.faults) { rules.push_back(fault.rule); }
      std::sort(rules.begin(), rules.end());
      rules.erase(std::unique(rules.begin(), rules.end()), rules.end());
      for (int rule : rules) { found += " R" + std::to_string(rule); }
      if (rules != *s.rules) { fail(rules.empty() ? "no rule is broken" : "the rules that are broken are" + found); }
      return outcome;
    }
    if (!outcome.faults.empty()) {
      fail("the records are not valid: " + outcome.faults.front().sentence);
      return outcome;
    }
    const std::array<long, 5> found{static_cast<long>(brep_->vertex_count()), static_cast<long>(brep_->edge_count()),
                                    static_cast<long>(brep_->face_count()), static_cast<long>(shell_count(*brep_)), genus(*brep_)};
    std::string differences;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!s.counts[i] || *s.counts[i] == found[i]) { continue; }
      if (!differences.empty()) { differences += ", "; }
      (differences += counted[i]) += " is " + std::to_string(found[i]) + ", not " + std::to_string(*s.counts[i]);
    }
    if (!differences.empty()) { fail(std::move(differences)); }
    return outcome;
  }

  B* brep_;
  std::map<std::string, Element> names_;
  std::vector<Edit> edits_;  // raw edits that stand
};

// Runs a whole script. Returns where and why the first statement was not done as written; nothing when all were.
template <class B>
[[nodiscard]] std::optional<ScriptError> run_script(const Script& script, B& brep) {
  ScriptRunner<B> runner(brep);
  for (const Statement& s : script.statements) {
    const Outcome outcome = runner.run(s);
    if (!outcome.as_written) { return ScriptError{s.place, outcome.sentence}; }
  }
  return std::nullopt;
}

}  // namespace brep
