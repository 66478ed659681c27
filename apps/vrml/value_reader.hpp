// SPDX-License-Identifier: MIT
#pragma once

// Parses values of fields, except nodes: converts tokens to numbers, strings and words, and records the first error of the file.

#include <string>
#include <string_view>
#include <utility>

#include "apps/vrml/scene_graph.hpp"
#include "apps/vrml/tokens.hpp"

namespace apps::vrml {

class ValueReader {
 public:
  ValueReader(std::string_view text, Version version, Errors& errors) : tokens_(text, version), errors_(errors) {}

  // --- the present token
  [[nodiscard]] std::string_view token() const { return tokens_.token(); }
  [[nodiscard]] Place place() const { return tokens_.place(); }
  [[nodiscard]] bool is(std::string_view text) const { return tokens_.is(text); }
  [[nodiscard]] bool is_word() const { return tokens_.is_word(); }
  [[nodiscard]] bool is_number_or_string() const { return tokens_.is_string() || (is_word() && number_of(token())); }
  [[nodiscard]] bool at_end() const { return tokens_.at_end(); }
  void next() { tokens_.next(); }
  bool take(std::string_view text) {
    const bool taken = is(text);
    if (taken) { next(); }
    return taken;
  }

  // Skips from an opening bracket to the closing one, inclusive; calls on_name with the names defined by DEF in between.
  template <class OnName>
  void skip_to(std::string_view close, Place opened, const OnName& on_name) {
    const std::string_view open = close == "}" ? "{" : close == "]" ? "[" : "(";
    for (std::size_t depth = 1; depth > 0; next()) {
      if (at_end()) {
        return fail("expected '" + std::string(close) + "' to close what begins at " + std::to_string(opened.line) + ":" +
                    std::to_string(opened.column) + ", " + found());
      }
      depth += is(open) ? 1 : 0;
      depth -= is(close) ? 1 : 0;
      if (!is("DEF")) { continue; }
      next();
      on_name(token());
    }
  }

  // --- errors: only the first one is reported, because what follows it cannot be interpreted
  [[nodiscard]] bool ok() const { return errors_.count() == 0; }
  void fail(Place place, std::string sentence) {
    if (ok()) { errors_.add(place, std::move(sentence)); }
  }
  void fail(std::string sentence) { fail(tokens_.place(), std::move(sentence)); }
  [[nodiscard]] std::string found() const {
    return tokens_.at_end() ? "found the end of the file" : "found " + mesh_file::shown(tokens_.token());
  }

  void value(const FieldType& type, std::string_view field, Field& out) {
    if (tokens_.is("~")) { tokens_.next(); }
    if (type.kind == FieldType::Kind::image) {  // width, height, components, then a number per pixel
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

 private:
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

  Tokens tokens_;
  Errors& errors_;
};

}  // namespace apps::vrml
