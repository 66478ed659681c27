// SPDX-License-Identifier: MIT
#pragma once

// Memory as the program's user means it: of the whole process. What the library predicts (radiosity/support/memory.hpp) comes on top of
// what the program and the scene hold already.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <radiosity/result/audit.hpp>

namespace apps {

// "2G", "512 MB", "1.5GiB", "300000000": bytes; k M G T are powers of 1000, with an i of 1024.
[[nodiscard]] std::optional<std::uint64_t> parse_memory(std::string_view text);
inline constexpr const char* memory_form = "a number of bytes such as 500M or 2G";

// What the process holds now; nothing where the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> resident_memory();

// The peak of getrusage(2) includes the memory of the program that started this one (its parent before exec). Where the system also tells
// this process's own peak (VmHWM), the peaks of the stages are cut to it.
void leave_out_others(std::vector<radiosity::StageTime>& stages);

// Measures the memory of one run of a study, where several runs follow each other in one process. Before the run, free memory is given back
// to the system and the system's peak is reset (Linux: clear_refs, proc(5)). The run took its peak less what was held when it began.
class PeakMeter {
 public:
  PeakMeter();
  // The peak of a run that began and ended after the meter, up to the stage of this name; nothing where the system does not tell.
  [[nodiscard]] std::optional<std::uint64_t> taken(const radiosity::Audit& audit, std::string_view last_stage) const;

 private:
  std::optional<std::uint64_t> before_;  // nothing: the peak could not be reset
  bool stages_follow_ = false;           // the peaks of the stages begin anew as well
};

}  // namespace apps
