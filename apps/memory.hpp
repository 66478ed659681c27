// SPDX-License-Identifier: MIT
#pragma once

// Memory of the whole process, which is what the program's user means. The library's prediction (radiosity/support/memory.hpp) is added
// to what the program and the scene already hold.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <radiosity/result/audit.hpp>

namespace apps {

// "2G", "512 MB", "1.5GiB", "300000000" as bytes; k M G T are powers of 1000, or of 1024 with an i.
[[nodiscard]] std::optional<std::uint64_t> parse_memory(std::string_view text);
inline constexpr const char* memory_form = "a number of bytes such as 500M or 2G";

// What the process holds now; nothing if the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> resident_memory();

// What the process may still take if it may hold so many bytes, after free memory is returned to the system; the largest number if there
// is no limit or the system does not tell.
[[nodiscard]] std::uint64_t memory_left(std::optional<std::uint64_t> allowed);

// The peak of getrusage(2) includes the memory of the program that started this one (its parent before exec). If the system also reports
// this process's own peak (VmHWM), the peaks of the stages are limited to it.
void leave_out_others(std::vector<radiosity::StageTime>& stages);

// Measures the memory of one run of a study, in which several runs follow each other in one process. Before the run, free memory is
// returned to the system and the system's peak is reset (Linux: clear_refs, proc(5)). The memory of the run is its peak minus what was
// held when it began.
class PeakMeter {
 public:
  PeakMeter();
  // The memory of a run that began and ended after the construction of the meter, up to the stage of this name; nothing if the system
  // does not tell.
  [[nodiscard]] std::optional<std::uint64_t> taken(const radiosity::Audit& audit, std::string_view last_stage) const;

 private:
  std::optional<std::uint64_t> before_;  // nothing: the peak could not be reset
  bool stages_follow_ = false;           // were the peaks of the stages reset as well?
};

}  // namespace apps
