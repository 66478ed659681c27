// SPDX-License-Identifier: MIT
#include "apps/facts.hpp"

#include <algorithm>
#include <type_traits>

#include "apps/text.hpp"

namespace apps {
namespace {

std::vector<std::string_view> keys_of(std::string_view path) {
  std::vector<std::string_view> keys;
  while (true) {
    const std::size_t dot = path.find('.');
    keys.push_back(path.substr(0, dot));
    if (dot == path.npos) { return keys; }
    path.remove_prefix(dot + 1);
  }
}

void write(JsonWriter& json, const Facts::Value& value) {
  std::visit(
      [&](const auto& held) {
        if constexpr (std::is_same_v<decltype(held), const std::monostate&>) {
          json.null();
        } else {
          json.value(held);
        }
      },
      value);
}

std::string value_text(const Facts::Value& value, const std::string& unit) {
  if (const auto* words = std::get_if<std::string>(&value)) { return *words; }
  if (const auto* x = std::get_if<double>(&value)) {
    return unit == "%" ? percent(*x) : formatted(unit.empty() ? "%.6g" : unit.c_str(), *x);
  }
  if (const auto* n = std::get_if<std::uint64_t>(&value)) {
    return unit == "B" ? bytes_text(*n) : unit == "1" ? std::to_string(*n) : grouped(*n);
  }
  return {};
}

}  // namespace

std::string bytes_text(std::uint64_t count) {
  auto value = static_cast<double>(count);
  const std::string prefix = take_prefix(value, 1000.0);
  return formatted(prefix.empty() ? "%.0f" : "%.1f", value) + " " + prefix + "B";
}

std::string Facts::json() const {
  JsonWriter json;
  json.open_object();
  std::vector<std::string_view> open;  // the keys of the objects around the last fact
  for (const Row& row : rows_) {
    std::vector<std::string_view> keys = keys_of(row.path);
    const std::string_view own = keys.back();
    keys.pop_back();
    const auto common = static_cast<std::size_t>(std::mismatch(open.begin(), open.end(), keys.begin(), keys.end()).first - open.begin());
    for (std::size_t i = open.size(); i > common; --i) { json.close(); }
    for (std::size_t i = common; i < keys.size(); ++i) { json.key(keys[i]).open_object(); }
    open = std::move(keys);
    write(json.key(own), row.value);
  }
  for (std::size_t i = 0; i <= open.size(); ++i) { json.close(); }
  return json.text();
}

std::optional<std::string> Facts::text(std::string_view sentence) const {
  std::string result;
  while (true) {
    const std::size_t brace = sentence.find('{');
    result += sentence.substr(0, brace);
    if (brace == sentence.npos) { return result; }
    const std::size_t end = sentence.find('}', brace);
    const std::string_view path = sentence.substr(brace + 1, end - brace - 1);
    const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.path == path; });
    if (row == rows_.end() || std::holds_alternative<std::monostate>(row->value)) { return std::nullopt; }
    result += value_text(row->value, row->unit);
    sentence.remove_prefix(end + 1);
  }
}

}  // namespace apps
