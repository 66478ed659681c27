// SPDX-License-Identifier: MIT
#pragma once

// F-refinement as a part of a run: as fine as was asked for or, once the run was told to stop, coarse links that are soon made. Those go
// over the patches that there are by then, so leaves keep their size, and are the links of a run with larger thresholds: each pair of
// leaves that see each other is covered, row sums close, energy is kept.

#include <cstdint>
#include <optional>
#include <string>

#include <radiosity/result/outcome.hpp>
#include <radiosity/run/run.hpp>

namespace radiosity {

namespace detail {

void refine_by_forms(Run& run);

// To which part of the area Options::min_area refers. A lamp in the ceiling of a hall a kilometre wide lights a spot of some square metres,
// and all error lies there. All of a light with the mean m and the RMS r fits on (m / r)^2 of the area, and m is at most the mean emission:
// so this falls with the square of Audit::reflected_share, from that of a room with a lamp close to a wall on. It is 1 where links that are
// chosen by form factor carry all light, for these ask for the smallest patches everywhere.
[[nodiscard]] double lit_part(const Run& run);

// From here on nothing stops the run, it says that it was interrupted, and what is left to refine has at least these thresholds.
inline constexpr double soon_made = 0.04;  // epsilon
void hurry(Run& run, double epsilon = soon_made);

// hurry(), and new links to evaluate in place of all others. Where much had been done they are finer, for less than a tenth of that.
void refine_coarsely(Run& run);

// Why refinement has ended without links; nothing when it has made some.
[[nodiscard]] std::optional<Failure> refusal(const Run& run);

// "the run would need at least 3 GB of memory ..."
[[nodiscard]] std::string too_large(const Run& run, std::uint64_t needed);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/f_refinement.cpp>
#endif
