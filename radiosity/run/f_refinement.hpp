// SPDX-License-Identifier: MIT
#pragma once

// F-refinement as a part of a run: as fine as requested or, once the run has been told to stop, coarse links that are made quickly. Those
// connect the patches that exist by then, so leaves keep their size, and they are the links of a run with larger thresholds: each pair of
// leaves that see each other is covered, row sums are closed, energy is conserved.

#include <cstdint>
#include <optional>
#include <string>

#include <radiosity/oracle/importance.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/run.hpp>

namespace radiosity {

namespace detail {

void refine_by_forms(Run& run);

// The share of the area to which Options::min_area refers. A lamp in the ceiling of a hall a kilometre wide lights a spot of some square
// metres, where all of the error is. Light with the mean m and the RMS r fits on a share (m / r)^2 of the area, and m is at most the mean
// emission; so the result decreases with the square of Audit::reflected_share, beginning at that of a room with a lamp close to a wall.
// The spots of n lamps are as many times smaller. Patches of an n-th of the area would take n times as long as with one lamp, so the result
// decreases with the square root of n: a picture with 49 lamps 2 mm below the ceiling, once 23 % too bright, is off by 6 %.
// It is 1 if links chosen by form factor carry all light, because these ask for the smallest patches everywhere.
[[nodiscard]] double lit_part(const Run& run);

// Is the picture of the camera so much darker than the scene that its light must enter at a few places?
[[nodiscard]] bool lit_through_openings(const Importance& importance);

// From here on the run cannot be stopped, is marked as interrupted, and refines the rest with at least these thresholds.
inline constexpr double soon_made = 0.04;  // epsilon
void hurry(Run& run, double epsilon = soon_made);

// hurry(), and new links to evaluate instead of all previous ones. If much work had been done they are made finer, in less than a tenth
// of its time.
void refine_coarsely(Run& run);

// The reason why refinement has ended without links; nothing if it has made some.
[[nodiscard]] std::optional<Failure> refusal(const Run& run);

// "the run would need at least 3 GB of memory ..."
[[nodiscard]] std::string too_large(const Run& run, std::uint64_t needed);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/run/f_refinement.cpp>
#endif
