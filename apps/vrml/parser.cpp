// SPDX-License-Identifier: MIT
// Parses text to nodes. A node is: [DEF name] Type { fields and children }, or USE name. VRML 97 also has prototypes: node types that a
// file defines by other nodes.
#include <algorithm>
#include <utility>

#include "apps/text.hpp"
#include "apps/vrml/scene_graph.hpp"
#include "apps/vrml/value_reader.hpp"
#include "apps/words.hpp"

namespace apps::vrml {
namespace {

class Parser {
 public:
  Parser(std::string_view text, Version version, Errors& errors, Notes& notes, OtherFiles& others, std::shared_ptr<const std::string> file)
      : in_(text, version, errors), version_(version), notes_(notes), others_(others), file_(std::move(file)) {}

  ParsedFile run() {
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

 private:
  [[nodiscard]] bool ok() const { return in_.ok(); }
  void fail(Place place, std::string sentence) { in_.fail(place, std::move(sentence)); }
  void fail(std::string sentence) { in_.fail(std::move(sentence)); }
  void fail_too_deep(Place place) { fail(place, "nodes are nested deeper than " + std::to_string(graph_limits.deepest)); }
  [[nodiscard]] std::string found() const { return in_.found(); }
  [[nodiscard]] std::string example() const { return version_ == Version::v97 ? "Shape" : "Separator"; }
  static std::string at(Place place) { return std::to_string(place.line) + ":" + std::to_string(place.column); }

  // Null for text that makes no node, and after an error.
  std::shared_ptr<const Node> read() {
    if (depth_ > graph_limits.deepest) {
      fail_too_deep(in_.place());
      return nullptr;
    }
    if (is_statement()) { return statement(); }
    std::string name;
    if (in_.take("USE")) {
      const auto known = defined_.find(in_.token());
      if (known == defined_.end()) {
        fail(in_.is_word() ? "USE names " + mesh_file::shown(in_.token()) + ", but no node before it is called that by DEF"
                           : "expected a name after USE, " + found());
        return nullptr;
      }
      in_.next();
      return known->second;
    }
    if (in_.take("DEF")) {
      if (!in_.is_word()) { fail("expected a name after DEF, " + found()); }
      name = in_.token();
      in_.next();
    }
    if (!in_.is_word()) {
      fail("expected a node such as " + example() + ", " + found());
      return nullptr;
    }
    auto node = std::make_shared<Node>();
    node->type = in_.token();
    node->name = name;
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
    if (!name.empty() && ok()) { defined_[name] = node; }
    return ok() ? node : nullptr;
  }

  // Parses to the closing brace, inclusive. `prototype`: the one of which the node is an instance; null if it is not an instance.
  void body(Node& node, const Prototype* prototype) {
    const NodeType* type = prototype == nullptr ? node_type(version_, node.type) : nullptr;
    FieldTypes own;  // declared by the node itself
    if (version_ == Version::v97 && type == nullptr && (prototype == nullptr || prototype->root == nullptr)) {
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
    while (ok() && !in_.is("}")) {
      if (in_.at_end()) {
        return fail("expected '}' to close the node " + node.type + " that begins at " + at(node.place) + ", " + found());
      }
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

  [[nodiscard]] bool may_be_child(const NodeType* type, std::string_view word) const {
    if (word == "DEF" || word == "USE" || node_type(version_, word) != nullptr) { return true; }
    return version_ == Version::v1 ? type == nullptr || type->group : prototypes_.find(word) != nullptr;
  }

  void note_unknown(const Node& node) {
    notes_.add("nodes of the type " + mesh_file::shown(node.type) + " are not known: passed over", at_line_of(node));
  }

  void unknown_field(const std::string& node, std::string_view word, const NodeType* type, const FieldTypes& declared) {
    const Place place = in_.place();
    in_.next();
    if (version_ == Version::v97 && in_.take("IS")) { return in_.next(); }  // an event of the node is connected with one of the prototype
    std::vector<std::string_view> known;
    for (const auto& [name, unused] : declared) { known.push_back(name); }
    for (std::size_t i = 0; type != nullptr && i < type->fields.size(); ++i) { known.push_back(type->fields[i].name); }
    notes_.add("a " + node + " has no field " + mesh_file::shown(word) + suggestion(word, known) + ": passed over", at_line(place, file_));
    skip_value();
  }

  // Skips the value of an unknown field: a bracketed list, numbers and strings, or one word or node.
  void skip_value() {
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

  // Skips from an opening bracket to the closing one, inclusive. Names defined in between may be used, but denote empty nodes.
  void skip_to(std::string_view close, Place opened) {
    in_.skip_to(close, opened, [this](std::string_view name) { defined_[std::string(name)] = std::make_shared<Node>(); });
  }

  // Parses a list of declarations such as [ SFFloat radius, MFString isA ].
  void declare(FieldTypes& own) {
    if (!in_.is("[")) { return fail("expected '[' after 'fields', " + found()); }
    for (in_.next(); ok() && !in_.is("]");) { declare_one(own); }
    in_.next();
  }
  // Parses one declaration such as SFFloat radius. Null after an error.
  const FieldType* declare_one(FieldTypes& own) {
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

  // --- prototypes

  // Is this a statement of VRML 97 that may stand where a node may, but makes none?
  [[nodiscard]] bool is_statement() const {
    return version_ == Version::v97 && (in_.is("NULL") || in_.is("ROUTE") || in_.is("PROTO") || in_.is("EXTERNPROTO"));
  }
  std::nullptr_t statement() {
    const int words = in_.is("ROUTE") ? 4 : in_.is("NULL") ? 1 : 0;  // ROUTE node.event TO node.event
    if (words == 0) { declare_prototype(in_.is("EXTERNPROTO")); }
    for (int i = 0; i < words; ++i) { in_.next(); }
    return nullptr;
  }

  // Parses PROTO name [ fields ] { nodes }, whose first node replaces an instance, or EXTERNPROTO name [ fields ] "file".
  void declare_prototype(bool external) {
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
      Field urls;
      value({FieldType::Kind::strings, 1, true}, name, urls);
      for (std::size_t i = 0; ok() && elsewhere == nullptr && i < urls.words.size(); ++i) {
        elsewhere = others_.prototype(urls.words[i], file_, at_line(place, file_));
      }
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

  // Parses one declaration: field SFColor color 1 0 0, exposedField likewise, eventIn SFBool on, eventOut likewise.
  void declare_field(Prototype& made, bool external) {
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

  void body_of_prototype(Prototype& made, Place place) {
    if (!in_.is("{")) { return fail("expected '{' and the nodes of the prototype, " + found()); }
    for (in_.next(); ok() && !in_.is("}");) {
      if (in_.at_end()) { return fail("expected '}' to close the prototype that begins at " + at(place) + ", " + found()); }
      auto node = read();
      if (made.root == nullptr) { made.root = std::move(node); }
    }
    in_.next();
    if (made.root == nullptr) { made.root = std::make_shared<Node>(); }  // an empty node
  }

  std::shared_ptr<Node> instance_of(const Prototype& prototype, const Node& call) {
    any_instance_ = true;
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

  // --- values

  // Null if the value is that (by IS) of a field that the prototype does not have or that has another type.
  std::shared_ptr<const Field> value_or_is(const FieldType& type, std::string_view field) {
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
      notes_.add(
          "no prototype around has a field " + mesh_file::shown(out->is) + " of the type of '" + std::string(field) + "': passed over",
          at_line(out->place, file_));
    }
    in_.next();
    return fits ? out : nullptr;
  }

  void value(const FieldType& type, std::string_view field, Field& out) {
    if (type.kind != FieldType::Kind::nodes) { return in_.value(type, field, out); }
    const bool brackets = type.many && in_.take("[");
    while (ok() && !(brackets && in_.is("]"))) {
      if (auto node = read()) { out.nodes.push_back(std::move(node)); }
      if (!brackets) { return; }
    }
    in_.next();
  }

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

}  // namespace

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
