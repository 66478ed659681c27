// SPDX-License-Identifier: MIT
#include "apps/vrml/parser.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps::vrml {

ParsedFile Parser::run() {
  auto root = std::make_shared<Node>();
  root->type = "Group";
  while (!in_.at_end() && ok()) {  // standard VRML 1.0 has one node, its extensions and VRML 97 several
    if (auto node = read()) { root->children.push_back(std::move(node)); }
  }
  if (ok() && root->children.empty() && prototypes_.first() == nullptr) {
    fail("expected a node such as " + example() + ", found the end of the file");
  }
  if (ok() && file_ == nullptr && prototypes_.first() != nullptr && !any_instance_) {
    notes_.add("the prototypes of this file have no instances in it");
  }
  return {ok() ? std::move(root) : nullptr, std::move(prototypes_)};
}

std::shared_ptr<const Node> Parser::read() {
  if (depth_ > graph_limits.deepest) {
    fail_too_deep(in_.place());
    return nullptr;
  }
  if (is_statement()) {
    statement();
    return nullptr;
  }
  if (in_.take("USE")) { return used_node(); }
  std::vector<std::string> names;
  while (ok() && in_.take("DEF")) {  // more than one is against the grammar, but clear
    if (!in_.is_word()) { fail("expected a name after DEF, " + found()); }
    names.emplace_back(in_.token());
    in_.next();
  }
  if (!ok()) { return nullptr; }
  if (!in_.is_word()) {
    fail("expected a node such as " + example() + ", " + found());
    return nullptr;
  }
  auto node = std::make_shared<Node>();
  node->type = in_.token();
  if (!names.empty()) { node->name = names.back(); }
  node->place = in_.place();
  node->file = file_;
  node->version = version_;
  in_.next();
  if (!in_.is("{")) {
    std::vector<std::string_view> known;
    for (const NodeType& type : node_types(version_)) { known.push_back(type.name); }
    fail("expected '{' after the node " + mesh_file::shown(node->type) + ", " + found() + suggestion(node->type, known));
    return nullptr;
  }
  in_.next();
  const auto prototype = prototypes_.find(node->type);
  ++depth_;
  body(*node, prototype.get());
  --depth_;
  if (!ok()) { return nullptr; }
  settle(*node);
  if (prototype != nullptr && prototype->root != nullptr) { node = instance_of(*prototype, *node); }
  if (node != nullptr && node->height > graph_limits.deepest) { fail_too_deep(node->place); }  // nested uses may exceed the depth
  if (!ok()) { return nullptr; }
  for (const std::string& name : names) { defined_[name] = node; }
  return node;
}

std::shared_ptr<const Node> Parser::used_node() {
  const auto known = defined_.find(in_.token());
  if (known == defined_.end()) {
    fail(in_.is_word() ? "USE names " + mesh_file::shown(in_.token()) + ", but no node before it is called that by DEF"
                       : "expected a name after USE, " + found());
    return nullptr;
  }
  in_.next();
  return known->second;
}

void Parser::body(Node& node, const Prototype* prototype) {
  const NodeType* type = prototype == nullptr ? node_type(version_, node.type) : nullptr;
  FieldTypes own;  // declared by the node itself
  if (version_ == Version::v97 && type == nullptr && (prototype == nullptr || prototype->root == nullptr)) {
    return skip_body(node, prototype);
  }
  while (ok() && !in_.is("}")) {
    if (in_.at_end()) { return fail("expected '}' to close the node " + node.type + " that begins at " + at(node.place) + ", " + found()); }
    if (!in_.is_word()) { return fail("expected a field or a node in " + node.type + ", " + found()); }
    const std::string_view word = in_.token();
    const FieldTypes& declared = prototype != nullptr ? prototype->types : own;
    // Declared fields must not change the type of built-in fields of a node.
    const FieldType* const known = type != nullptr ? field_type(*type, word) : nullptr;
    const auto among = declared.find(word);
    const FieldType* const field = known == nullptr && among != declared.end() ? &among->second : known;
    if (version_ == Version::v1 && word == "fields") {
      in_.next();
      declare(own);
    } else if (version_ == Version::v1 && word == "isA") {
      in_.next();
      Field names;
      value({FieldType::Kind::strings, 1, true}, "isA", names);
      for (const std::string& name : names.words) {
        if (type != nullptr || node_type(version_, name) == nullptr) { continue; }
        type = node_type(version_, name);
        node.type = name;
      }
    } else if (field != nullptr) {
      in_.next();
      if (auto read_value = value_or_is(*field, word)) { node.fields[std::string(word)] = std::move(read_value); }
    } else if (is_statement()) {
      statement();
    } else if (type == nullptr && own.empty() && prototype == nullptr) {
      note_unknown(node);
      return skip_to("}", node.place);
    } else if (may_be_child(type, word)) {
      if (auto child = read()) { node.children.push_back(std::move(child)); }
    } else {
      unknown_field(node.type, word, type, declared);
    }
  }
  in_.next();
}

void Parser::skip_body(const Node& node, const Prototype* prototype) {
  if (prototype != nullptr) {
    notes_.add("the prototype " + mesh_file::shown(node.type) + " is in another file: its instances are passed over", at_line_of(node));
  } else if (depth_ == 1 && node_type(Version::v1, node.type) != nullptr) {
    return fail(node.place, node.type + " is a node of VRML 1.0: let the first line of the file be '#VRML V1.0 ascii'");
  } else if (node.type == "Script") {
    notes_.add("scripts are not run: what they change or make is not seen", at_line_of(node));
  } else {
    note_unknown(node);
  }
  return skip_to("}", node.place);
}

bool Parser::may_be_child(const NodeType* type, std::string_view word) const {
  if (word == "DEF" || word == "USE" || node_type(version_, word) != nullptr) { return true; }
  return version_ == Version::v1 ? type == nullptr || type->group : prototypes_.find(word) != nullptr;
}

void Parser::note_unknown(const Node& node) {
  notes_.add("nodes of the type " + mesh_file::shown(node.type) + " are not known: passed over", at_line_of(node));
}

void Parser::unknown_field(const std::string& node, std::string_view word, const NodeType* type, const FieldTypes& declared) {
  const Place place = in_.place();
  in_.next();
  if (version_ == Version::v97 && in_.take("IS")) { return in_.next(); }  // an event of the node is connected with one of the prototype
  std::vector<std::string_view> known;
  for (const auto& [name, unused] : declared) { known.push_back(name); }
  for (std::size_t i = 0; type != nullptr && i < type->fields.size(); ++i) { known.push_back(type->fields[i].name); }
  notes_.add("a " + node + " has no field " + mesh_file::shown(word) + suggestion(word, known) + ": passed over", at_line(place, file_));
  skip_value();
}

void Parser::skip_value() {
  const Place place = in_.place();
  if (in_.take("[")) {
    skip_to("]", place);
  } else if (in_.take("(")) {
    skip_to(")", place);
  } else if (in_.is_number_or_string()) {
    while (in_.is_number_or_string()) { in_.next(); }
  } else if (is_statement()) {
    statement();
  } else if (in_.is("DEF") || in_.is("USE")) {
    read();
  } else if (in_.is_word()) {
    in_.next();
    if (in_.take("{")) { skip_to("}", place); }
  }
}

void Parser::skip_to(std::string_view close, Place opened) {
  in_.skip_to(close, opened, [this](std::string_view name) { defined_[std::string(name)] = std::make_shared<Node>(); });
}

void Parser::declare(FieldTypes& own) {
  if (!in_.is("[")) { return fail("expected '[' after 'fields', " + found()); }
  for (in_.next(); ok() && !in_.is("]");) { declare_one(own); }
  in_.next();
}

const FieldType* Parser::declare_one(FieldTypes& own) {
  const FieldType* const type = named_type(in_.token());
  if (type == nullptr) {
    fail("expected the type of a field such as SFFloat, " + found());
    return nullptr;
  }
  in_.next();
  if (!in_.is_word()) {
    fail("expected the name of a field, " + found());
    return nullptr;
  }
  own.emplace(in_.token(), *type);
  in_.next();
  return type;
}

void Parser::value(const FieldType& type, std::string_view field, Field& out) {
  if (type.kind != FieldType::Kind::nodes) { return in_.value(type, field, out); }
  const bool brackets = type.many && in_.take("[");
  while (ok() && !(brackets && in_.is("]"))) {
    if (auto node = read()) { out.nodes.push_back(std::move(node)); }
    if (!brackets) { return; }
  }
  in_.next();
}

ParsedFile parse(std::string_view text, Errors& errors, Notes& notes, OtherFiles& others, const std::shared_ptr<const std::string>& file) {
  text = without_mark(text);
  const bool v97 = text.starts_with("#VRML V2.0");
  if (!v97 && !text.starts_with("#VRML V1.0 ascii")) {
    errors.add({1, 1}, "expected '#VRML V2.0 utf8' or '#VRML V1.0 ascii' as the first line");
    return {};
  }
  return Parser(text, v97 ? Version::v97 : Version::v1, errors, notes, others, file).run();
}

}  // namespace apps::vrml
