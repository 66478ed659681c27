// SPDX-License-Identifier: MIT
#pragma once

// What a step did, in words, for steps about which their script says nothing: the operator with its textbook name, what it adds to the
// counts, and what is new or gone.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <brep/euler_script.hpp>
#include <brep/euler_script_run.hpp>

#include "apps/euler/records.hpp"

namespace apps::euler {

[[nodiscard]] std::string told(const brep::Statement& statement, const brep::Outcome& outcome, const Records& before, const Records& after);

// The walk around a face (its half-edges, each with the vertex where it starts) or around a vertex (the half-edges that leave it, each
// with its face), in a line; a sentence when there is none.
[[nodiscard]] std::string walk(const Records& records, brep::Element of);

// What a statement of a script may begin with: operators by our names and by those of textbooks, and the other statements.
[[nodiscard]] std::vector<std::string> statement_words();

// "; did you mean 'split_face'?" of a line whose first word, after a name and =, is not known but near to one that is; else nothing.
[[nodiscard]] std::string meant(std::string_view line, const std::vector<std::string>& known);

// The same of a line of a script, counted from 1.
[[nodiscard]] std::string meant_in(std::string_view script, std::uint32_t line);

}  // namespace apps::euler
