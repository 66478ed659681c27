// SPDX-License-Identifier: MIT
#pragma once

// A study as files in a folder:
//
//   index.html                       everything: one page that contains all its pictures, without script or network, suitable for print
//   results.csv results.json         all numbers; errors below the noise of their reference are given as that noise (verdicts.hpp)
//   SCENE_cpu.svg, SCENE_memory.svg, SCENE_links.svg, SCENE_reconstruction.svg
//   SCENE_error_METHOD.svg           false-colour error pictures

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

// The files that write_pages() writes, without the folder; all names are different.
[[nodiscard]] std::vector<std::string> page_files(const Study& study);

// Writes all files, and creates the folder if necessary. Returns a sentence if something could not be written; files written before remain.
[[nodiscard]] std::optional<std::string> write_pages(const Study& study, const std::string& folder);

[[nodiscard]] std::string page(const Study& study);

// --- the tables of a scene as rows of text, shown on the page (tables.cpp)

struct TableRow {
  std::vector<std::string> cells;  // the first text_columns columns of the table are names, the others numbers
  bool strong = false;             // is the run on the Pareto front?
  bool begins = false;             // does a new method begin?
  std::string remark;              // replaces all but the first columns: why there is no result
};

struct Table {
  std::vector<std::string> head;
  std::size_t text_columns = 1;
  std::vector<TableRow> rows;
};

// One row per method: its cheapest run within each of the targets (verdicts.hpp), its smallest error, its slope.
[[nodiscard]] Table summary_table(const SceneStudy& scene);

// One row per run: cost, and errors before and after reconstruction.
[[nodiscard]] Table run_table(const SceneStudy& scene);

// One row per run: the other norms, for cells and points.
[[nodiscard]] Table norm_table(const SceneStudy& scene);

// One row per run that has them: the four parts of its error.
[[nodiscard]] Table part_table(const SceneStudy& scene);

// Sentences about the runs: which method is cheapest within each target, by how much, and which has the smallest error.
[[nodiscard]] std::vector<std::string> findings(const SceneStudy& scene);

// "path traced: 1 200 cell means with a noise of 0.4 %, ..."
[[nodiscard]] std::string reference_text(const Reference& reference);

// --- CSV and JSON

// A field of CSV (RFC 4180): quoted if it contains a comma, a quote or a line end.
[[nodiscard]] std::string csv_field(std::string_view text);

// One line per run and reconstruction (none, simple, weighted), after a line of names. Fields that were not measured are empty; a run
// without a result has its reason in `refused`. `below_noise` names, separated by spaces, the columns whose value is only an upper bound.
[[nodiscard]] std::string to_csv(const Study& study);

// The same, nested, with derived values: Pareto fronts and slopes. Its keys are described in examples/scenes/README.md.
[[nodiscard]] std::string to_json(const Study& study);

}  // namespace study
