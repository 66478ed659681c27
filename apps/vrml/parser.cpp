// SPDX-License-Identifier: MIT
// Text to nodes. The grammar is that of a node: [DEF name] Type { fields and children }, or USE name. Blanks and commas separate.
#include <charconv>

#include "apps/mesh_file/reading.hpp"
#include "apps/vrml/scene_graph.hpp"
#include "apps/words.hpp"

namespace apps::vrml {
namespace {

constexpr std::string_view marks = "{}[]()|";

class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) { next(); }

  // The present one: a word, a mark, or a string with its quotes; empty at the end.
  [[nodiscard]] std::string_view token() const { return token_; }
  [[nodiscard]] Place place() const { return at_; }
  [[nodiscard]] bool is(std::string_view text) const { return token_ == text; }
  [[nodiscard]] bool at_end() const { return token_.empty(); }
  [[nodiscard]] bool is_string() const { return !token_.empty() && token_[0] == '"'; }
  [[nodiscard]] bool is_word() const { return !at_end() && !is_string() && marks.find(token_[0]) == marks.npos; }

  void next() {
    skip();
    at_ = {line_, static_cast<std::uint32_t>(i_ - line_begin_ + 1)};
    const std::size_t begin = i_;
    if (i_ >= text_.size()) {
      token_ = {};
    } else if (text_[i_] == '"') {
      for (++i_; i_ < text_.size() && text_[i_] != '"'; ++i_) {
        if (text_[i_] == '\\' && i_ + 1 < text_.size()) { ++i_; }
        line_end();
      }
      i_ = std::min(i_ + 1, text_.size());
      token_ = text_.substr(begin, i_ - begin);
    } else if (marks.find(text_[i_]) != marks.npos) {
      token_ = text_.substr(i_++, 1);
    } else {
      while (i_ < text_.size() && !is_blank(text_[i_]) && text_[i_] != '"' && text_[i_] != '#' && marks.find(text_[i_]) == marks.npos) {
        ++i_;
      }
      token_ = text_.substr(begin, i_ - begin);
    }
  }

 private:
  static bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == ','; }
  // Lines end with LF, CR LF or CR.
  void line_end() {
    if (text_[i_] != '\n' && (text_[i_] != '\r' || text_.substr(i_ + 1, 1) == "\n")) { return; }
    ++line_;
    line_begin_ = i_ + 1;
  }
  void skip() {
    for (bool comment = false; i_ < text_.size() && (comment || is_blank(text_[i_]) || text_[i_] == '#'); ++i_) {
      comment = text_[i_] == '#' || (comment && text_[i_] != '\n' && text_[i_] != '\r');
      line_end();
    }
  }

  std::string_view text_, token_;
  std::size_t i_ = 0, line_begin_ = 0;
  std::uint32_t line_ = 1;
  Place at_;
};

// Hexadecimal, too.
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with("0x") || word.starts_with("0X")) {
    std::uint32_t value = 0;
    const auto [end, code] = std::from_chars(word.data() + 2, word.data() + word.size(), value, 16);
    return code == std::errc() && end == word.data() + word.size() ? std::optional<double>(value) : std::nullopt;
  }
  return mesh_file::to_number(word);
}

class Parser {
 public:
  Parser(std::string_view text, Errors& errors, Notes& notes) : tokens_(text), errors_(errors), notes_(notes) {}

  std::shared_ptr<const Node> run() {
    auto root = std::make_shared<Node>();
    root->type = "Group";
    while (!tokens_.at_end() && ok()) {  // one node; extensions of others have several
      if (auto node = read(0)) { root->children.push_back(std::move(node)); }
    }
    if (ok() && root->children.empty()) { fail("expected a node such as Separator, found the end of the file"); }
    return ok() ? root : nullptr;
  }

 private:
  using FieldTypes = std::map<std::string, FieldType, std::less<>>;

  // What is behind the first error is not understood, so nothing is said about it.
  [[nodiscard]] bool ok() const { return errors_.count() == 0; }
  void fail(Place place, std::string sentence) {
    if (ok()) { errors_.add(place, std::move(sentence)); }
  }
  void fail(std::string sentence) { fail(tokens_.place(), std::move(sentence)); }
  [[nodiscard]] std::string found() const {
    return tokens_.at_end() ? "found the end of the file" : "found " + mesh_file::shown(tokens_.token());
  }
  static std::string at(Place place) { return std::to_string(place.line) + ":" + std::to_string(place.column); }

  std::shared_ptr<const Node> read(std::size_t depth) {
    if (depth > graph_limits.deepest) {
      fail("nodes are nested deeper than " + std::to_string(graph_limits.deepest));
      return nullptr;
    }
    std::string name;
    if (tokens_.is("USE")) {
      tokens_.next();
      const auto known = defined_.find(tokens_.token());
      if (known == defined_.end()) {
        fail(tokens_.is_word() ? "USE names " + mesh_file::shown(tokens_.token()) + ", but no node before it is called that by DEF"
                               : "expected a name after USE, " + found());
        return nullptr;
      }
      tokens_.next();
      return known->second;
    }
    if (tokens_.is("DEF")) {
      tokens_.next();
      if (!tokens_.is_word()) { fail("expected a name after DEF, " + found()); }
      name = tokens_.token();
      tokens_.next();
    }
    if (!tokens_.is_word()) {
      fail("expected a node such as Separator, " + found());
      return nullptr;
    }
    auto node = std::make_shared<Node>();
    node->type = tokens_.token();
    node->name = name;
    node->place = tokens_.place();
    tokens_.next();
    if (!tokens_.is("{")) {
      std::vector<std::string_view> known;
      for (const NodeType& type : node_types()) { known.push_back(type.name); }
      fail("expected '{' after the node " + mesh_file::shown(node->type) + ", " + found() + suggestion(node->type, known));
      return nullptr;
    }
    tokens_.next();
    body(*node, depth);
    if (!name.empty()) { defined_[name] = node; }
    return node;
  }

  // To behind the closing brace.
  void body(Node& node, std::size_t depth) {
    const NodeType* type = node_type(node.type);
    FieldTypes own;  // that the node itself declares
    while (ok() && !tokens_.is("}")) {
      if (tokens_.at_end()) {
        return fail("expected '}' to close the node " + node.type + " that begins at " + at(node.place) + ", " + found());
      }
      if (!tokens_.is_word()) { return fail("expected a field or a node in " + node.type + ", " + found()); }
      const std::string_view word = tokens_.token();
      const auto declared = own.find(word);
      const FieldType* const field = declared != own.end() ? &declared->second : type != nullptr ? field_type(*type, word) : nullptr;
      if (word == "fields") {
        tokens_.next();
        declare(own);
      } else if (word == "isA") {
        tokens_.next();
        Field names{tokens_.place(), {}, {}, {}};
        value({FieldType::Kind::strings, 1, true}, "isA", names);
        for (const std::string& name : names.words) {
          if (type != nullptr || node_type(name) == nullptr) { continue; }
          type = node_type(name);
          node.type = name;
        }
      } else if (field != nullptr) {
        Field& out = node.fields[std::string(word)];
        tokens_.next();
        out = {tokens_.place(), {}, {}, {}};
        value(*field, word, out);
      } else if (type == nullptr && own.empty()) {
        notes_.add("nodes of the type " + mesh_file::shown(node.type) + " are not known: passed over",
                   "at line " + std::to_string(node.place.line));
        return skip_body(node.place);
      } else if ((type != nullptr && type->group) || type == nullptr || node_type(word) != nullptr || word == "DEF" || word == "USE") {
        if (auto child = read(depth + 1)) { node.children.push_back(std::move(child)); }
      } else {
        std::vector<std::string_view> known;
        for (const FieldEntry& entry : type->fields) { known.push_back(entry.name); }
        notes_.add("a " + node.type + " has no field " + mesh_file::shown(word) + suggestion(word, known) + ": passed over",
                   "at line " + std::to_string(tokens_.place().line));
        skip_value();
      }
    }
    tokens_.next();
  }

  // Of a field that is not known: what is in brackets, or numbers and strings, or one word.
  void skip_value() {
    tokens_.next();
    const bool brackets = tokens_.is("["), parentheses = tokens_.is("(");
    if (brackets || parentheses) {
      while (!tokens_.at_end() && !tokens_.is(brackets ? "]" : ")")) { tokens_.next(); }
      return tokens_.next();
    }
    const auto is_value = [&] { return tokens_.is_string() || (tokens_.is_word() && number_of(tokens_.token())); };
    if (tokens_.is_word() && !is_value()) { return tokens_.next(); }
    while (is_value()) { tokens_.next(); }
  }

  void skip_body(Place opened) {
    for (std::size_t depth = 1; depth > 0; tokens_.next()) {
      if (tokens_.at_end()) { return fail("expected '}' to close the node that begins at " + at(opened) + ", " + found()); }
      depth += tokens_.is("{") ? 1 : 0;
      depth -= tokens_.is("}") ? 1 : 0;
    }
  }

  // fields [ SFFloat radius, MFString isA ]
  void declare(FieldTypes& own) {
    if (!tokens_.is("[")) { return fail("expected '[' after 'fields', " + found()); }
    for (tokens_.next(); ok() && !tokens_.is("]");) {
      const FieldType* const type = named_type(tokens_.token());
      if (type == nullptr) { return fail("expected the type of a field such as SFFloat, " + found()); }
      tokens_.next();
      if (!tokens_.is_word()) { return fail("expected the name of a field, " + found()); }
      own.emplace(tokens_.token(), *type);
      tokens_.next();
    }
    tokens_.next();
  }

  void value(const FieldType& type, std::string_view field, Field& out) {
    if (tokens_.is("~")) { tokens_.next(); }
    if (type.kind == FieldType::Kind::image) {  // width, height, components, then a number for each pixel
      for (int i = 0; i < 3 && ok(); ++i) { number(field, out); }
      const double pixels = ok() ? out.numbers[0] * out.numbers[1] : 0.0;
      for (double i = 0.0; i < pixels && ok(); i += 1.0) { number(field, out); }
      return;
    }
    if (!type.many || !tokens_.is("[")) { return single(type, field, out); }
    for (tokens_.next(); ok() && !tokens_.is("]");) {
      if (tokens_.at_end()) { return fail("expected ']' to close the values of '" + std::string(field) + "', " + found()); }
      single(type, field, out);
    }
    tokens_.next();
  }

  void single(const FieldType& type, std::string_view field, Field& out) {
    switch (type.kind) {
      case FieldType::Kind::strings:
        if (!tokens_.is_string() && !tokens_.is_word()) {
          return fail("expected a string in quotes for '" + std::string(field) + "', " + found());
        }
        out.words.push_back(unquoted(tokens_.token()));
        return tokens_.next();
      case FieldType::Kind::words:
        if (!tokens_.is("(")) {
          if (!tokens_.is_word()) { return fail("expected a word for '" + std::string(field) + "', " + found()); }
          out.words.emplace_back(tokens_.token());
          return tokens_.next();
        }
        for (tokens_.next(); ok() && !tokens_.is(")"); tokens_.next()) {
          if (tokens_.is("|")) { continue; }
          if (!tokens_.is_word()) { return fail("expected a word or ')' for '" + std::string(field) + "', " + found()); }
          out.words.emplace_back(tokens_.token());
        }
        return tokens_.next();
      case FieldType::Kind::indices:
        out.places.push_back(tokens_.place());
        return number(field, out);
      default:
        for (unsigned i = 0; i < type.count && ok(); ++i) { number(field, out); }
    }
  }

  void number(std::string_view field, Field& out) {
    const auto value = number_of(tokens_.token());
    if (!value) { return fail("expected a number for '" + std::string(field) + "', " + found()); }
    out.numbers.push_back(*value);
    tokens_.next();
  }

  static std::string unquoted(std::string_view token) {
    if (token.empty() || token[0] != '"') { return std::string(token); }
    token.remove_prefix(1);
    if (!token.empty() && token.back() == '"') { token.remove_suffix(1); }
    std::string text;
    for (std::size_t i = 0; i < token.size(); ++i) {
      if (token[i] == '\\' && i + 1 < token.size()) { ++i; }
      text += token[i];
    }
    return text;
  }

  Tokens tokens_;
  Errors& errors_;
  Notes& notes_;
  std::map<std::string, std::shared_ptr<const Node>, std::less<>> defined_;
};

}  // namespace

double Node::number(std::string_view field, double otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && !found->numbers.empty() ? found->numbers[0] : otherwise;
}

glm::dvec3 Node::vector(std::string_view field, const glm::dvec3& otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && found->numbers.size() >= 3 ? glm::dvec3(found->numbers[0], found->numbers[1], found->numbers[2]) : otherwise;
}

glm::dvec4 Node::rotation(std::string_view field) const {
  const Field* const found = find(field);
  if (found == nullptr || found->numbers.size() < 4) { return {0.0, 0.0, 1.0, 0.0}; }
  return {found->numbers[0], found->numbers[1], found->numbers[2], found->numbers[3]};
}

std::string_view Node::word(std::string_view field, std::string_view otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && !found->words.empty() ? std::string_view(found->words[0]) : otherwise;
}

std::shared_ptr<const Node> parse(std::string_view text, Errors& errors, Notes& notes) {
  constexpr std::string_view header = "#VRML V1.0 ascii";
  if (!text.starts_with(header)) {
    errors.add({1, 1}, text.starts_with("#VRML V2.0")
                           ? "this is VRML 2.0 (VRML97), which is not read; expected the first line '#VRML V1.0 ascii'"
                           : "expected '#VRML V1.0 ascii' as the first line");
    return nullptr;
  }
  return Parser(text, errors, notes).run();
}

}  // namespace apps::vrml
