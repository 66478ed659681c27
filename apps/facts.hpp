// SPDX-License-Identifier: MIT
#pragma once

// The results of a command as one list that both outputs use: the JSON writes every fact under its path, the text names facts in its
// sentences. A new figure is one row.
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

class Facts {
 public:
  // Writes a list, which only the JSON contains; no sentence can name it.
  using Writer = std::function<void(JsonWriter&)>;
  using Value = std::variant<std::monostate, double, std::uint64_t, bool, std::string, Writer>;  // monostate: null

  // `path`: the keys from the outermost object to the value; the facts of one object must be adjacent. `unit`: how the text shows a
  // number: "%" as a percentage, "B" as bytes, "1" as a count without digit grouping, or a printf conversion. Without a unit, the digits
  // of a count are grouped.
  void add(std::string path, Value value, std::string unit = {}) { rows_.push_back({std::move(path), std::move(value), std::move(unit)}); }
  void add(std::string path, std::unsigned_integral auto count, std::string unit = {}) requires(!std::same_as<decltype(count), bool>) {
    add(std::move(path), Value(std::uint64_t{count}), std::move(unit));
  }
  template <class T>
  void add(std::string path, const std::optional<T>& value, std::string unit = {}) {
    add(std::move(path), value ? Value(*value) : Value(), std::move(unit));
  }
  // Facts of one unit whose paths begin alike: add_all("%", "error.", "low", low, "high", high).
  void add_all(const std::string&, const std::string&) {}
  template <class T, class... Rest>
  void add_all(const std::string& unit, const std::string& object, const char* key, const T& value, const Rest&... rest) {
    add(object + key, value, unit);
    add_all(unit, object, rest...);
  }

  [[nodiscard]] std::string json() const;

  // The sentence with every {path} replaced by its fact; nothing if one of them is null or missing.
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
