// SPDX-License-Identifier: MIT
#pragma once

// What a command has found out, as one list that both of its outputs read: the JSON writes every fact under its path, the text names facts
// in its sentences. A new figure is one row.
//
//     Facts facts;
//     facts.add("rays", std::uint64_t{12});
//     facts.add("settings.epsilon", 0.005, "%.3g");
//     facts.json()                                      { "rays": 12, "settings": { "epsilon": 0.005 } }
//     facts.text("{rays} rays, {settings.epsilon}")     12 rays, 0.005

#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "apps/json.hpp"

namespace apps {

// 12 345 678 as "12.3 MB".
[[nodiscard]] std::string bytes_text(std::uint64_t count);

// 1234567 as "1 234 567".
[[nodiscard]] std::string grouped(std::uint64_t count);

class Facts {
 public:
  // Writes a list; no sentence names one.
  using Writer = std::function<void(JsonWriter&)>;
  using Value = std::variant<std::monostate, double, std::uint64_t, bool, std::string, Writer>;  // monostate: null

  // `path`: the keys from the outermost object to the value; the facts of one object follow each other. `unit`: how text shows a number:
  // "%" in per cent, "B" as bytes, "1" a count without gaps between its digits, or a printf conversion; by itself a count is grouped.
  void add(std::string path, Value value, std::string unit = {}) { rows_.push_back({std::move(path), std::move(value), std::move(unit)}); }
  void add(std::string path, std::unsigned_integral auto count, std::string unit = {}) requires(!std::same_as<decltype(count), bool>) {
    add(std::move(path), Value(std::uint64_t{count}), std::move(unit));
  }
  template <class T>
  void add(std::string path, const std::optional<T>& value, std::string unit = {}) {
    add(std::move(path), value ? Value(*value) : Value(), std::move(unit));
  }

  [[nodiscard]] std::string json() const;

  // The sentence with every {path} replaced by the fact. Nothing when one of them is null or not there.
  [[nodiscard]] std::optional<std::string> text(std::string_view sentence) const;

 private:
  struct Row {
    std::string path;
    Value value;
    std::string unit;
  };
  std::vector<Row> rows_;
};

}  // namespace apps
