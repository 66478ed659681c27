// SPDX-License-Identifier: MIT
#include "apps/exercise/exercises.hpp"

#include <array>

#include "embedded/examples.hpp"

namespace apps::exercise {
namespace {

constexpr std::array<Exercise, 12> exercises{{
    {"01_tetrahedron.euler", "a tetrahedron from nothing", tetrahedron},
    {"02_torus.euler", "the torus of least edges", torus},
    {"03_holes.euler", "a pothole, then a hole through the cube", holes},
    {"04_dual.euler", "the dual of a prism", dual_of_prism},
    {"05_inverse.euler", "undo by inverse operators", inverse},
    {"06_break.euler", "break records and mend them", break_and_mend},
    {"07_split_edge.hpp", "split_edge written with split_vertex", nullptr},
    {"08_oracle.hpp", "an oracle of your own", nullptr},
    {"09_split_object.hpp", "a split object of your own", nullptr},
    {"10_form_factors.txt", "form factors of two plates by hand", form_factors},
    {"11_push_pull.txt", "push and pull by hand on three patches", push_pull},
    {"12_t_vertex.txt", "why a T-vertex shows", t_vertex},
}};

}  // namespace

std::span<const Exercise> all() { return exercises; }

std::string beginning(const Exercise& exercise) { return embedded::example(std::string("exercises/") + exercise.file); }

}  // namespace apps::exercise
