// SPDX-License-Identifier: MIT
// The table of the kinds of objects: what it says of a kind, the reader does, whatever kinds there are.
#include <algorithm>
#include <string>

#include "apps/scene_file.hpp"
#include "apps/scene_file/grammar.hpp"
#include "catch.hpp"

namespace {

using apps::scene_file::Clause;
using apps::scene_file::object_kinds;
using apps::scene_file::ObjectKind;

bool says(const apps::SceneResult& result, const std::string& part) {
  return std::any_of(result.errors.begin(), result.errors.end(),
                     [&](const apps::InputError& error) { return error.sentence.find(part) != std::string::npos; });
}

// Values that suit every kind.
std::string clause_text(const Clause& clause) {
  using enum apps::scene_file::Form;
  const std::string word = "  " + std::string(clause.word);
  switch (clause.form) {
    case vector:
      return word + (clause.word == "from" || clause.word == "center" || clause.word == "base" ? " 0 0 0\n" : " 1 1 1\n");
    case length:
      return word + (clause.word == "radius" ? " 1\n" : clause.word == "ring" ? " 2\n" : " 0.5\n");
    case pair:
      return word + " 1 1\n";
    case vertex:
      return word + " 0 0 0\n" + word + " 1 0 0\n" + word + " 0 1 0\n";
    case face:
      return word + " 0 1 2\n";
  }
  return {};
}

std::string object(const ObjectKind& kind, const Clause* without) {
  std::string text = "material m reflectance 0.5\n" + std::string(kind.word) + " x {\n  material m\n";
  for (const Clause& clause : kind.clauses) {
    if (&clause != without) { text += clause_text(clause); }
  }
  return text + "}\n";
}

}  // namespace

TEST_CASE("a kind of object is read with its clauses, and each that it requires is missed by name") {
  for (const ObjectKind& kind : object_kinds()) {
    if (is_csg(kind)) { continue; }
    const auto whole = apps::parse_scene(object(kind, nullptr));
    INFO(object(kind, nullptr) << apps::to_text(whole, "scene"));
    REQUIRE(whole.file);
    CHECK(whole.file->origins[0].kind == kind.word);
    CHECK(whole.file->scene.objects[0].shape->solid() == (kind.solid && kind.word != "mesh"));  // the mesh here is one triangle, open
    for (const Clause& clause : kind.clauses) {
      const auto result = apps::parse_scene(object(kind, &clause));
      CAPTURE(clause.word);
      CHECK(result.file.has_value() == !clause.required);
      CHECK(says(result, "has no '" + std::string(clause.word) + "'") == clause.required);
    }
  }
}

TEST_CASE("an unknown word in an object is told with the clauses of its kind, 'inside' belongs to what encloses something") {
  for (const ObjectKind& kind : object_kinds()) {
    if (is_csg(kind)) { continue; }
    const auto result = apps::parse_scene("material m reflectance 0.5\n" + std::string(kind.word) + " x blaah 1 material m\n");
    CAPTURE(kind.word, apps::to_text(result, "scene"));
    for (const Clause& clause : kind.clauses) { CHECK(says(result, std::string(clause.word))); }
    CHECK(says(result, "inside") == kind.solid);
    CHECK(says(result, "unknown word 'blaah' in this " + std::string(kind.word)));
  }
}
