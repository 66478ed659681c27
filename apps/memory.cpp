// SPDX-License-Identifier: MIT
#include "apps/memory.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <radiosity/support/memory.hpp>

namespace apps {
namespace {

// The value, in bytes, of a line of /proc/self/status in kilobytes: "VmHWM:     12345 kB".
std::optional<std::uint64_t> status(std::string_view name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(name) || line.size() <= name.size() || line[name.size()] != ':') { continue; }
    const std::size_t digit = line.find_first_of("0123456789");
    std::uint64_t kilobytes = 0;
    if (digit == std::string::npos) { return std::nullopt; }
    std::from_chars(line.data() + digit, line.data() + line.size(), kilobytes);
    return 1024 * kilobytes;
  }
  return std::nullopt;
}

void return_free_memory() {
#if defined(__GLIBC__)
  ::malloc_trim(0);
#endif
}

bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

std::optional<std::uint64_t> parse_memory(std::string_view text) {
  double number = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc()) { return std::nullopt; }
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (unit.starts_with(' ')) { unit.remove_prefix(1); }
  double factor = 1.0;
  constexpr std::string_view prefixes = "kMGT";
  if (!unit.empty() && unit != "B") {
    const std::size_t power = unit.front() == 'K' ? 0 : prefixes.find(unit.front());
    if (power == std::string_view::npos) { return std::nullopt; }
    unit.remove_prefix(1);
    const bool binary = unit.starts_with('i');
    if (binary) { unit.remove_prefix(1); }
    factor = std::pow(binary ? 1024.0 : 1000.0, static_cast<double>(power + 1));
  }
  if (!unit.empty() && unit != "B") { return std::nullopt; }
  const double bytes = number * factor;
  return bytes >= 1.0 && bytes < 0x1p63 ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

std::uint64_t memory_left(std::optional<std::uint64_t> allowed) {
  if (!allowed) { return std::numeric_limits<std::uint64_t>::max(); }
  return_free_memory();
  const std::optional<std::uint64_t> held = resident_memory();
  return held ? *allowed - std::min(*allowed, *held) : std::numeric_limits<std::uint64_t>::max();
}

std::optional<std::uint64_t> resident_memory() { return status("VmRSS"); }

void leave_out_others(std::vector<radiosity::StageTime>& stages) {
  const std::optional<std::uint64_t> own = status("VmHWM");
  for (radiosity::StageTime& stage : stages) {
    if (own && stage.peak_bytes) { stage.peak_bytes = std::min(*own, *stage.peak_bytes); }
  }
}

PeakMeter::PeakMeter() {
  return_free_memory();
  if (!reset_peak()) { return; }
  before_ = resident_memory();
  // The peak of getrusage(2) may still include the program that started this one; then it has not been reset.
  constexpr std::uint64_t margin = 1 << 22;
  const auto peak = radiosity::peak_memory();
  stages_follow_ = before_ && peak && *peak <= *before_ + margin;
}

std::optional<std::uint64_t> PeakMeter::taken(const radiosity::Audit& audit, std::string_view last_stage) const {
  if (!before_) { return std::nullopt; }
  std::optional<std::uint64_t> peak;
  for (const radiosity::StageTime& stage : audit.stages) {
    if (stages_follow_ && stage.name == last_stage) { peak = stage.peak_bytes; }
  }
  if (!peak) { peak = status("VmHWM"); }
  return peak ? std::optional(*peak - std::min(*peak, *before_)) : std::nullopt;
}

}  // namespace apps
