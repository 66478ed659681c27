// SPDX-License-Identifier: MIT
#pragma once

// The tables of a scene as rows of text, which the page shows.

#include <string>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

struct TableRow {
  std::vector<std::string> cells;  // the first text_columns of the table are names, then come numbers
  bool strong = false;             // on the Pareto front
  bool begins = false;             // a new method
  std::string remark;              // in place of all but the first columns: why there is no result
};

struct Table {
  std::vector<std::string> head;
  std::size_t text_columns = 1;
  std::vector<TableRow> rows;
};

// One row a method: its cheapest run within each of the targets (verdicts.hpp), its least error, its slope.
[[nodiscard]] Table summary_table(const SceneStudy& scene);

// One row a run: cost, and errors before and after reconstruction.
[[nodiscard]] Table run_table(const SceneStudy& scene);

// One row a run: the other norms, cells and points.
[[nodiscard]] Table norm_table(const SceneStudy& scene);

// One row a run that has them: the four parts of its error.
[[nodiscard]] Table part_table(const SceneStudy& scene);

// What the runs say in words: who is cheapest within each target, by how much, and who errs least. One sentence each.
[[nodiscard]] std::vector<std::string> findings(const SceneStudy& scene);

// "path traced: 1 200 cell means with a noise of 0.4 %, ..."
[[nodiscard]] std::string reference_text(const Reference& reference);

}  // namespace study
