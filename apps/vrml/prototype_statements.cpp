// SPDX-License-Identifier: MIT
// What VRML 97 has beside nodes: NULL, ROUTE, prototypes and values that refer to a prototype's fields.
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "apps/vrml/parser.hpp"

namespace apps::vrml {

void Parser::statement() {
  const int words = in_.is("ROUTE") ? 4 : in_.is("NULL") ? 1 : 0;  // ROUTE node.event TO node.event
  if (words == 0) { declare_prototype(in_.is("EXTERNPROTO")); }
  for (int i = 0; i < words; ++i) { in_.next(); }
}

void Parser::declare_prototype(bool external) {
  const Place place = in_.place();
  in_.next();
  if (depth_ > graph_limits.deepest) { return fail_too_deep(place); }
  if (!in_.is_word()) { return fail("expected the name of a prototype, " + found()); }
  const std::string name(in_.token());
  in_.next();
  if (!in_.is("[")) { return fail("expected '[' after the prototype " + mesh_file::shown(name) + ", " + found()); }
  const auto* const outer_fields = std::exchange(fields_of_prototype_, nullptr);
  prototypes_.enter();
  ++depth_;
  auto made = std::make_shared<Prototype>();
  for (in_.next(); ok() && !in_.is("]");) { declare_field(*made, external); }
  in_.next();
  std::shared_ptr<const Prototype> elsewhere;
  if (ok() && external) {
    elsewhere = prototype_elsewhere(name, place);
  } else if (ok()) {
    fields_of_prototype_ = &made->types;
    auto outer_names = std::exchange(defined_, {});  // the body of a prototype has its own name space
    body_of_prototype(*made, place);
    defined_ = std::move(outer_names);
  }
  --depth_;
  prototypes_.leave();
  fields_of_prototype_ = outer_fields;
  prototypes_.declare(name, elsewhere != nullptr ? std::move(elsewhere) : std::move(made));
}

std::shared_ptr<const Prototype> Parser::prototype_elsewhere(std::string_view name, Place place) {
  Field urls;
  value({FieldType::Kind::strings, 1, true}, name, urls);
  std::shared_ptr<const Prototype> first;
  for (std::size_t i = 0; ok() && first == nullptr && i < urls.words.size(); ++i) {
    first = others_.prototype(urls.words[i], file_, at_line(place, file_));
  }
  return first;
}

void Parser::declare_field(Prototype& made, bool external) {
  const bool field = in_.is("field") || in_.is("exposedField");
  if (!field && !in_.is("eventIn") && !in_.is("eventOut")) {
    return fail("expected field, exposedField, eventIn, eventOut or ']', " + found());
  }
  in_.next();
  FieldTypes one;
  if (declare_one(one) == nullptr) { return; }
  const auto& [name, type] = *made.types.insert_or_assign(one.begin()->first, one.begin()->second).first;
  if (!field || external) { return; }
  if (auto otherwise = value_or_is(type, name)) { made.defaults[name] = std::move(otherwise); }
}

void Parser::body_of_prototype(Prototype& made, Place place) {
  if (!in_.is("{")) { return fail("expected '{' and the nodes of the prototype, " + found()); }
  for (in_.next(); ok() && !in_.is("}");) {
    if (in_.at_end()) { return fail("expected '}' to close the prototype that begins at " + at(place) + ", " + found()); }
    auto node = read();
    if (made.root == nullptr) { made.root = std::move(node); }
  }
  in_.next();
  if (made.root == nullptr) { made.root = std::make_shared<Node>(); }  // an empty node
}

std::shared_ptr<Node> Parser::instance_of(const Prototype& prototype, const Node& call) {
  any_instance_ = any_instance_ || fields_of_prototype_ == nullptr;  // those within other prototypes are none of the file
  const auto made = instance(prototype, call.fields, copies_left_);
  if (made == nullptr || made->children.size() >= copies_left_) {
    fail(call.place, "instances of prototypes make more than " + std::to_string(graph_limits.most_visits) + " nodes");
    return nullptr;
  }
  copies_left_ -= made->children.size();
  auto node = std::make_shared<Node>(*made);
  if (!call.name.empty()) { node->name = call.name; }
  return node;
}

std::shared_ptr<const Field> Parser::value_or_is(const FieldType& type, std::string_view field) {
  auto out = std::make_shared<Field>();
  out->place = in_.place();
  if (version_ == Version::v1 || !in_.is("IS")) {
    value(type, field, *out);
    return out;
  }
  in_.next();
  out->is = in_.token();
  bool fits = false;
  if (fields_of_prototype_ != nullptr) {
    const auto named = fields_of_prototype_->find(out->is);
    fits = named != fields_of_prototype_->end() && named->second.kind == type.kind && named->second.count == type.count;
  }
  if (!fits) {
    notes_.add("no prototype around has a field " + mesh_file::shown(out->is) + " of the type of '" + std::string(field) + "': passed over",
               at_line(out->place, file_));
  }
  in_.next();
  return fits ? out : nullptr;
}

}  // namespace apps::vrml
