// SPDX-License-Identifier: MIT
#include "apps/study/outcome.hpp"
#include "apps/study/table.hpp"
#include "apps/study/tables.hpp"

namespace study {
namespace {

// A '|' would end the cell, a line end the table, and '<' begin a tag.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') { result += '\\'; }
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string markdown(const Table& table) {
  std::string text = "|";
  for (const std::string& name : table.head) { text += " " + cell(name) + " |"; }
  text += "\n|";
  for (std::size_t i = 0; i < table.head.size(); ++i) { text += i < table.text_columns ? " --- |" : " ---: |"; }
  text += "\n";
  for (const TableRow& row : table.rows) {
    text += "|";
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      text += " " + cell(row.cells[i]) + (row.strong && i + 1 == table.text_columns ? " \\* |" : " |");
    }
    for (std::size_t i = row.cells.size(); i < table.head.size(); ++i) {
      text += (i == row.cells.size() ? " " + cell(row.remark) : std::string()) + " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string to_markdown(const Study& study) {
  std::string text =
      "# Work-precision study\n\nhalflight " + study.version + ", " + study.compiler + ", " + study.machine + ", seed " +
      std::to_string(study.seed) +
      ".\nErrors are relative L2 errors of the cell means, before reconstruction unless a column says otherwise; \"<\" marks what "
      "lies below the noise of\nthe reference, \"–\" what was not reached or not measured, \"\\*\" the Pareto front of error "
      "and CPU time. A method's cost to an error is that of its cheapest\nmeasured run within it.\n";
  for (const SceneStudy& scene : study.scenes) {
    std::string words;
    for (const std::string& sentence : findings(scene)) { words += (words.empty() ? "" : " ") + sentence; }
    text += "\n## " + cell(scene.scene) + "\n\n" + cell(scene.title) + "\n\nReference: " + reference_text(scene.reference) + "\n\n" +
            words + "\n\n" + markdown(summary_table(scene)) + "\n### All runs (errors in %)\n\n" + markdown(run_table(scene));
    const Table parts = part_table(scene);
    if (!parts.rows.empty()) { text += "\n### Where the error comes from (%)\n\n" + markdown(parts); }
    text += "\n### Other norms (%)\n\n" + markdown(norm_table(scene));
    if (!scene.left_out.empty()) { text += "\n### Left out\n\n"; }
    for (const radiosity::LeftOut& item : scene.left_out) {
      text += "- " + item.what + ": " + item.why + (item.saved.empty() ? "" : " (saved: " + item.saved + ")") + "\n";
    }
  }
  return text;
}

}  // namespace study
