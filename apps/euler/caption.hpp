// SPDX-License-Identifier: MIT
#pragma once

// What a step did, in words, for steps about which their script says nothing: the operator with its textbook name, what it adds to the
// counts, and what is new or gone.

#include <string>

#include <brep/euler_script.hpp>
#include <brep/euler_script_run.hpp>

#include "apps/euler/records.hpp"

namespace apps::euler {

[[nodiscard]] std::string told(const brep::Statement& statement, const brep::Outcome& outcome, const Records& before, const Records& after);

// The walk around a face (its half-edges, each with the vertex where it starts) or around a vertex (the half-edges that leave it, each
// with its face), in a line; a sentence when there is none.
[[nodiscard]] std::string walk(const Records& records, brep::Element of);

}  // namespace apps::euler
