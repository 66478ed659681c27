// SPDX-License-Identifier: MIT
#pragma once

// A study as files in a folder:
//
//   index.html                       everything: one page that holds all of its pictures, without script or network, and can be printed
//   results.csv results.json         all numbers; errors below the noise of their reference are given as that noise (verdicts.hpp)
//   SCENE_cpu.svg, SCENE_memory.svg, SCENE_links.svg, SCENE_reconstruction.svg
//   SCENE_error_METHOD.svg           false-colour error pictures

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

// What write_pages() writes, without the folder. No two are the same.
[[nodiscard]] std::vector<std::string> page_files(const Study& study);

// Writes them all, the folder too where there is none. A sentence when something could not be written; what was written before stays.
[[nodiscard]] std::optional<std::string> write_pages(const Study& study, const std::string& folder);

[[nodiscard]] std::string page(const Study& study);

// --- the tables of a scene as rows of text, which the page shows (tables.cpp)

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

// --- CSV and JSON

// A field of CSV (RFC 4180): quoted where it holds a comma, a quote or a line end.
[[nodiscard]] std::string csv_field(std::string_view text);

// One line a run and reconstruction (none, simple, weighted), after one line of names. What was not measured is empty; a run without
// result has its reason in `refused`. `below_noise` names the columns whose value is only an upper bound, apart by spaces.
[[nodiscard]] std::string to_csv(const Study& study);

// The same, nested, and what was derived from it: Pareto fronts and slopes. Its keys are described in examples/scenes/README.md.
[[nodiscard]] std::string to_json(const Study& study);

}  // namespace study
