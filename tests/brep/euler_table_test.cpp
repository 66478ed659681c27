// SPDX-License-Identifier: MIT
// The table of the Euler operators: its words, its counts, and that every row's inverse takes back what its apply has done.

#include <brep/euler_log.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>

#include <array>
#include <set>
#include <string>

#include "calls.hpp"

using namespace brep;

namespace {

using Logged = BRep<NoData, NoData, NoData, EulerLog>;

std::array<long, 3> counts(const Logged& m) {
  return {static_cast<long>(m.vertex_count()), static_cast<long>(m.edge_count()), static_cast<long>(m.face_count())};
}

// Every name of a row: its own first.
std::vector<std::string> words(const OperatorForm& row) {
  std::vector<std::string> all{std::string(row.name)};
  for (std::string_view word : row.textbook) {
    if (!word.empty()) { all.emplace_back(word); }
  }
  return all;
}

Statement statement_of(const std::string& line) {
  INFO(line);
  const ScriptResult result = parse_script(line);
  REQUIRE(result.script.has_value());
  return result.script->statements.at(0);
}

}  // namespace

TEST_CASE("every row's apply followed by its inverse restores every record, wherever it is possible") {
  std::array<int, operator_forms.size()> done{}, refused{};
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Logged m;
    const std::size_t limit = 3 + random.below(40);
    for (int i = 0; i < 150; ++i) {
      (void)calls::apply(m, calls::random_call(m, random, limit));
      const auto before = shapes::picture(m);
      for (const OperatorForm& row : operator_forms) {
        INFO(row.name);
        const auto any = [&] { return HalfedgeId{random.below(std::max(m.halfedge_end(), 1u))}; };
        const HalfedgeId a = any();
        HalfedgeId b = any();
        if (m.alive(a) && random.below(2) == 0) b = random.below(2) == 0 ? m.next(a) : m.next(twin(a));  // more often possible
        const std::size_t step = mark(m);
        const auto old = counts(m);
        const Result<Element> answer = apply(m, row.op, a, b);
        const auto now = counts(m);
        if (!answer) {
          ++refused[static_cast<std::size_t>(row.op)];
          REQUIRE(mark(m) == step);
          REQUIRE(shapes::picture(m) == before);
          continue;
        }
        ++done[static_cast<std::size_t>(row.op)];
        REQUIRE(mark(m) == step + 1);
        REQUIRE(steps(m).back().op == row.op);
        REQUIRE(answer->letter == row.result);
        REQUIRE(now == std::array<long, 3>{old[0] + row.v, old[1] + row.e, old[2] + row.f});
        REQUIRE(shapes::faults(m) == "");
        REQUIRE(undo(m));
        REQUIRE(shapes::picture(m) == before);
      }
    }
  }
  for (const OperatorForm& row : operator_forms) {  // the law was asked of every row, where it is possible and where it is not
    INFO(row.name);
    CHECK(done[static_cast<std::size_t>(row.op)] > 100);
    CHECK((refused[static_cast<std::size_t>(row.op)] > 10 || row.arguments.empty()));
  }
}

TEST_CASE("each row keeps v - e + f = 2(s - h), its counts are those of euler.hpp, and no word stands in two rows") {
  std::set<std::string> seen;
  for (const OperatorForm& row : operator_forms) {
    INFO(row.name);
    CHECK((row.v - row.e + row.f) % 2 == 0);
    const calls::Change change = calls::change(row.op);
    CHECK((row.v == change.v && row.e == change.e && row.f == change.f));
    for (const std::string& word : words(row)) {
      CHECK(seen.insert(word).second);
      CHECK(find_operator(word) == &form(row.op));
    }
  }
  for (const char* word : {"mvfs", "kvfs", "mev", "kev", "mef", "kef", "kemr", "mekr", "kfmrh", "mfkrh"}) { CHECK(seen.count(word) == 1); }
  CHECK(find_operator("") == nullptr);
  CHECK(find_operator("undo") == nullptr);
}

TEST_CASE("every name of an operator parses to the same step, and the log prints the operator's own name") {
  const std::string start = "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\nh6 = make_segment\n";
  for (const OperatorForm& row : operator_forms) {
    std::string own_log;
    for (const std::string& word : words(row)) {
      std::string line = word;
      for (std::size_t i = 0; i < row.arguments.size(); ++i) { line += i == 0 ? " h0" : " h6"; }
      INFO(line);
      const Statement s = statement_of(line);
      CHECK(s.command == Command::apply);
      CHECK(s.op == row.op);
      CHECK(s.written == word);
      CHECK(s.arguments.size() == row.arguments.size());
      Logged m;
      const ScriptResult setting = parse_script(start);
      REQUIRE_FALSE(run_script(*setting.script, m).has_value());
      ScriptRunner<Logged> runner(m);
      const Outcome outcome = runner.run(s);
      const std::string log = to_text(steps(m));
      if (word == row.name) { own_log = log; }
      CHECK(log == own_log);
      CHECK(
          (outcome.kind == Outcome::Kind::done || (outcome.sentence.find("(" + word + " is ") != std::string::npos) == (word != row.name)));
      CHECK_FALSE(parse_script(word + " = make_segment").script.has_value());  // no result may have the name of an operator
    }
  }
}

TEST_CASE("a cube by the textbook's words has the records of the cube by the operators' own") {
  const std::string own =
      "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_vertex h3 h3\nh6 = split_face h5 h0\nh8 = split_vertex h1 h1\n"
      "h10 = split_vertex h3 h3\nh12 = split_vertex h5 h5\nh14 = split_vertex h7 h7\nh16 = split_face h9 h15\n"
      "h18 = split_face h15 h13\nh20 = split_face h13 h11\nh22 = split_face h11 h16\nbridge h6 h22\ncut h24\njoin_faces h22\n";
  std::string text = own;
  for (const OperatorForm& row : operator_forms) {
    if (row.textbook[0].empty()) { continue; }
    for (std::size_t at = 0; (at = text.find(row.name, at)) != text.npos;) { text.replace(at, row.name.size(), row.textbook[0]); }
  }
  CHECK(text.find("split_face") == text.npos);
  CHECK(text.find("\nmekr h6") != text.npos);
  Logged a, b;
  const auto run = [](const std::string& script, Logged& m) {
    const ScriptResult parsed = parse_script(script);
    REQUIRE(parsed.script.has_value());
    const auto error = run_script(*parsed.script, m);
    INFO((error ? error->sentence : ""));
    REQUIRE_FALSE(error.has_value());
  };
  run(own, a);
  run(text, b);
  CHECK(shapes::records(a) == shapes::records(b));
  CHECK(to_text(steps(a)) == to_text(steps(b)));
}
