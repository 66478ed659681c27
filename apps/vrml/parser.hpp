// SPDX-License-Identifier: MIT
#pragma once

// Parses text to nodes. A node is: [DEF name] Type { fields and children }, or USE name (parser.cpp). VRML 97 also has prototypes: node
// types that a file defines by other nodes (prototype_statements.cpp).

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "apps/vrml/scene_graph.hpp"
#include "apps/vrml/value_reader.hpp"

namespace apps::vrml {

class Parser {
 public:
  Parser(std::string_view text, Version version, Errors& errors, Notes& notes, OtherFiles& others, std::shared_ptr<const std::string> file)
      : in_(text, version, errors), version_(version), notes_(notes), others_(others), file_(std::move(file)) {}

  ParsedFile run();

 private:
  [[nodiscard]] bool ok() const { return in_.ok(); }
  void fail(Place place, std::string sentence) { in_.fail(place, std::move(sentence)); }
  void fail(std::string sentence) { in_.fail(std::move(sentence)); }
  void fail_too_deep(Place place) { fail(place, "nodes are nested deeper than " + std::to_string(graph_limits.deepest)); }
  [[nodiscard]] std::string found() const { return in_.found(); }
  [[nodiscard]] std::string example() const { return version_ == Version::v97 ? "Shape" : "Separator"; }
  static std::string at(Place place) { return std::to_string(place.line) + ":" + std::to_string(place.column); }

  // --- nodes and their fields

  // Null for text that makes no node, and after an error.
  std::shared_ptr<const Node> read();
  // The node named after USE.
  std::shared_ptr<const Node> used_node();
  // Parses to the closing brace, inclusive. `prototype`: the one of which the node is an instance; null if it is not an instance.
  void body(Node& node, const Prototype* prototype);
  // Skips the body of a node of VRML 97 whose type is not known, or whose prototype is in a file that cannot be read.
  void skip_body(const Node& node, const Prototype* prototype);
  [[nodiscard]] bool may_be_child(const NodeType* type, std::string_view word) const;
  void note_unknown(const Node& node);
  void unknown_field(const std::string& node, std::string_view word, const NodeType* type, const FieldTypes& declared);
  // Skips the value of an unknown field: a bracketed list, numbers and strings, or one word or node.
  void skip_value();
  // Skips from an opening bracket to the closing one, inclusive. Names defined in between may be used, but denote empty nodes.
  void skip_to(std::string_view close, Place opened);
  // Parses a list of declarations such as [ SFFloat radius, MFString isA ].
  void declare(FieldTypes& own);
  // Parses one declaration such as SFFloat radius. Null after an error.
  const FieldType* declare_one(FieldTypes& own);
  void value(const FieldType& type, std::string_view field, Field& out);

  // --- statements and prototypes of VRML 97

  // Is this a statement that may stand where a node may, but makes none?
  [[nodiscard]] bool is_statement() const {
    return version_ == Version::v97 && (in_.is("NULL") || in_.is("ROUTE") || in_.is("PROTO") || in_.is("EXTERNPROTO"));
  }
  void statement();
  // Parses PROTO name [ fields ] { nodes }, whose first node replaces an instance, or EXTERNPROTO name [ fields ] "file".
  void declare_prototype(bool external);
  // Parses one declaration: field SFColor color 1 0 0, exposedField likewise, eventIn SFBool on, eventOut likewise.
  void declare_field(Prototype& made, bool external);
  void body_of_prototype(Prototype& made, Place place);
  // The first prototype that one of the URLs after EXTERNPROTO names; null if none can be read.
  std::shared_ptr<const Prototype> prototype_elsewhere(std::string_view name, Place place);
  std::shared_ptr<Node> instance_of(const Prototype& prototype, const Node& call);
  // Null if the value is that (by IS) of a field that the prototype does not have or that has another type.
  std::shared_ptr<const Field> value_or_is(const FieldType& type, std::string_view field);

  ValueReader in_;
  Version version_;
  Notes& notes_;
  OtherFiles& others_;
  std::shared_ptr<const std::string> file_;
  std::size_t depth_ = 0;
  std::map<std::string, std::shared_ptr<const Node>, std::less<>> defined_;
  Prototypes prototypes_;
  const FieldTypes* fields_of_prototype_ = nullptr;  // of the prototype whose body is being read; null: none
  std::size_t copies_left_ = graph_limits.most_visits;
  bool any_instance_ = false;
};

}  // namespace apps::vrml
