// SPDX-License-Identifier: MIT
// Unions, intersections and differences. A separate file, because no other one needs brep/csg.
#include <string>
#include <unordered_map>
#include <utility>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/transform.hpp>

#include "apps/scene_file/build.hpp"
#include "apps/scene_file/lexer.hpp"

namespace apps::scene_file {
namespace {

class Operands {
 public:
  Operands(CsgShape& out, Errors& errors) : out_(out), errors_(errors) {}

  // The tree of the statement, at most max_use_depth deep; without solid or parts after an error. The name of a leaf is its path;
  // `prefix` is the path to the statement.
  raycast::CsgNode node(const ObjectSyntax& syntax, const std::string& prefix, bool root) {
    raycast::CsgNode result;
    result.name = prefix + syntax.name.text;
    if (!root) {
      result.placement = syntax.placement;
      if (syntax.inside) {
        errors_.add(*syntax.inside, "'inside' cannot stand at an operand: " + in_quotes(syntax.name.text) +
                                        " takes part as a solid; turn the outermost union, intersection or difference");
      }
      if (const auto sentence = raycast::check(result.placement)) {
        errors_.add(syntax.name.place, in_quotes(syntax.name.text) + ": " + *sentence);
      }
    }
    if (!is_csg(*syntax.kind)) {
      result.solid = syntax.kind->make(syntax, errors_);
      out_.leaves.push_back(result.solid);
      if (result.solid && !result.solid->solid()) {
        errors_.add(syntax.name.place, in_quotes(syntax.name.text) + " has no inside; operands are closed solids");
      }
      return result;
    }
    result.operation = syntax.kind->word == "union"          ? raycast::CsgOperation::unite
                       : syntax.kind->word == "intersection" ? raycast::CsgOperation::intersect
                                                             : raycast::CsgOperation::subtract;
    std::unordered_map<std::string_view, Place> names;
    for (const ObjectSyntax& operand : syntax.operands) {
      const auto [earlier, is_new] = names.emplace(operand.name.text, operand.name.place);
      if (!is_new) {
        errors_.add(operand.name.place,
                    "the name " + in_quotes(operand.name.text) + " is taken; the first one stands at " + to_string(earlier->second));
      }
      result.parts.push_back(node(operand, root ? std::string() : result.name + ".", false));
    }
    return result;
  }

 private:
  CsgShape& out_;
  Errors& errors_;
};

}  // namespace

CsgShape make_csg(const ObjectSyntax& syntax, Errors& errors) {
  CsgShape result;
  const std::size_t before = errors.count();
  const raycast::CsgNode tree = Operands(result, errors).node(syntax, {}, true);
  if (errors.count() > before) { return result; }
  auto made = raycast::Csg::make(tree);
  if (!made) { errors.add(syntax.name.place, std::string(syntax.kind->word) + " " + in_quotes(syntax.name.text) + ": " + made.refusal); }
  result.whole = std::move(made.object);
  return result;
}

}  // namespace apps::scene_file
