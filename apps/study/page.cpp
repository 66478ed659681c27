// SPDX-License-Identifier: MIT
#include "apps/study/folder.hpp"

#include <algorithm>

#include <radiosity/support/left_out.hpp>

#include "apps/bytes.hpp"
#include "apps/html_document.hpp"
#include "apps/picture_file.hpp"
#include "apps/study/error_picture.hpp"
#include "apps/study/plot.hpp"
#include "apps/study/verdicts.hpp"
#include "apps/text.hpp"
#include "embedded/study.hpp"

namespace study {
namespace {

using apps::escaped;

class Page {
 public:
  explicit Page(const Study& study) : study_(study) {}

  std::string write() {
    const bool several = study_.scenes.size() > 1;
    const std::string title = several || study_.scenes.empty() ? "Work-precision study" : "Work-precision study: " + study_.scenes[0].scene;
    text_ = "\n<h1>" + escaped(title) + "</h1>\n";
    introduction();
    if (several) { overview(); }
    for (std::size_t i = 0; i < study_.scenes.size(); ++i) { scene(study_.scenes[i], i); }
    reading();
    return apps::html_document(title, apps::embedded::study_page_css, text_);
  }

 private:
  void paragraph(const std::string& text) { text_ += "<p>" + escaped(text) + "</p>\n"; }

  void introduction() {
    paragraph(
        "How wrong is each method, and what does it cost? Every method solves the same scene at several settings, its error is measured "
        "against the same reference, and its time by the same clock. In the plots, lower and further left is better.");
    text_ += "<dl>";
    const auto fact = [&](const char* name, const std::string& value) {
      text_ += std::string("<dt>") + name + "</dt><dd>" + escaped(value) + "</dd>";
    };
    fact("Program", "halflight " + study_.version);
    fact("Compiler", study_.compiler);
    fact("Machine", study_.machine);
    fact("Seed", std::to_string(study_.seed));
    text_ += "</dl>\n";
  }

  // A table of all scenes: the time that each method needs for the error that most of them reach.
  void overview() {
    const std::vector<std::string> names = method_names(study_);
    text_ += "<div class=\"scroll wide\"><h2 class=\"first\">Overview</h2>\n<table><caption><b>Table " + std::to_string(++tables_) +
             ".</b> CPU seconds of each method's cheapest run within the error named, which is the smallest that most methods reach; the "
             "least of each scene is bold.</caption>\n<thead><tr><th class=\"name\">scene</th><th "
             "class=\"name\">reference</th><th>noise</th><th>error</th>";
    for (const std::string& name : names) { text_ += "<th>" + escaped(name) + "</th>"; }
    text_ += "</tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < study_.scenes.size(); ++i) {
      const SceneStudy& s = study_.scenes[i];
      text_ += "<tr><td class=\"name\"><a href=\"#scene" + std::to_string(i) + "\">" + escaped(s.scene) + "</a></td><td class=\"name\">" +
               escaped(s.reference.kind) + "</td><td>" + (s.reference.noise > 0.0 ? escaped(percent(s.reference.noise)) : "0") + "</td>";
      overview_row(s, names);
    }
    text_ += "</tbody></table></div>\n<nav><ul>\n";
    for (std::size_t i = 0; i < study_.scenes.size(); ++i) {
      text_ += "<li><a href=\"#scene" + std::to_string(i) + "\">" + escaped(study_.scenes[i].scene) +
               "</a>: " + escaped(study_.scenes[i].title) + "</li>\n";
    }
    text_ += "</ul></nav>\n";
  }

  void overview_row(const SceneStudy& scene, const std::vector<std::string>& names) {
    double goal = 0.0;
    std::size_t most = 0;
    for (const double target : targets(scene)) {  // in decreasing order
      const auto reaches = [&](const Method& m) { return cheapest_within(m, scene.reference, target) != nullptr; };
      const auto count = static_cast<std::size_t>(std::count_if(scene.methods.begin(), scene.methods.end(), reaches));
      if (count >= most) { goal = target, most = count; }
    }
    double least = 0.0;
    std::vector<const Run*> runs;
    for (const std::string& name : names) {
      const auto method = std::find_if(scene.methods.begin(), scene.methods.end(), [&](const Method& m) { return m.name == name; });
      const Run* run = method == scene.methods.end() || most == 0 ? nullptr : cheapest_within(*method, scene.reference, goal);
      runs.push_back(run);
      if (run != nullptr && (least == 0.0 || run->cpu_seconds < least)) { least = run->cpu_seconds; }
    }
    text_ += "<td>" + (most > 0 ? escaped(percent(goal)) : "–") + "</td>";
    for (const Run* run : runs) {
      const bool best = run != nullptr && run->cpu_seconds <= least;
      text_ += (best ? "<td class=\"best\">" : "<td>") + (run != nullptr ? escaped(figure(run->cpu_seconds)) : "–") + "</td>";
    }
    text_ += "</tr>\n";
  }

  void scene(const SceneStudy& s, std::size_t index) {
    text_ += "<h2 id=\"scene" + std::to_string(index) + "\"" + (study_.scenes.size() == 1 ? " class=\"first\"" : "") + ">" +
             escaped(s.scene) + "</h2>\n<p class=\"difficulty\">" + escaped(s.title) + "</p>\n";
    paragraph("Reference: " + reference_text(s.reference));
    text_ += "<ul class=\"findings\">";
    for (const std::string& sentence : findings(s)) { text_ += "<li>" + escaped(sentence) + "</li>"; }
    text_ += "</ul>\n";
    const std::vector<Figure> plots = figures(study_, s);
    add_plot(plots[0]);
    table(summary_table(s), "summary",
          "What each method needs to come within an error, by its cheapest run in time, and the run of its least error.");
    add_plot(plots[1]);
    add_plot(plots[2]);
    add_plot(plots[3]);
    maps(s);
    text_ += "<h3>Methods</h3>\n<dl>";
    for (const Method& m : s.methods) { text_ += "<dt>" + escaped(m.name) + "</dt><dd>" + escaped(m.summary) + "</dd>"; }
    text_ += "</dl>\n";
    table(
        run_table(s), "wide",
        "All runs: cost, and the relative L2 error of cell means and at points, in per cent, before and after reconstruction. “s saved” is "
        "about what the run would take longer if nothing were left out. † was stopped by a limit: the best it had by then, which stands in "
        "no plot and counts for no method. ★ and shade: on the Pareto front of error and CPU time.");
    const Table parts = part_table(s);
    if (!parts.rows.empty()) {
      table(parts, "",
            "Where the error comes from, each a relative L2 error of its own at the reference's points, in per cent: a dense solution on "
            "the run's leaves against the reference; the run's links and visibility against that solution; the solver's residual; the "
            "picture against the leaves.");
    }
    table(norm_table(s), "wide",
          "The other norms, in per cent: relative L1, and the worst cell or point relative to the brightest of the reference.");
    if (s.left_out.empty()) { return; }
    text_ += "<h3>What this scene does not need</h3>\n<ul class=\"omitted\">\n";
    for (const radiosity::LeftOut& item : s.left_out) {
      text_ += "<li>" + escaped(item.what + ": " + item.why + (item.saved.empty() ? "" : ". Saved: " + item.saved)) + ".</li>\n";
    }
    text_ += "</ul>\n";
  }

  void add_plot(const Figure& figure) {
    text_ += "<figure>" + to_svg(figure.drawing, figure.caption) + "<figcaption><b>Fig. " + std::to_string(++figures_) + ".</b> " +
             escaped(figure.caption) + "</figcaption></figure>\n";
  }

  void maps(const SceneStudy& s) {
    if (s.pictures.empty()) { return; }
    const double limit = error_limit(s);
    text_ += "<h3>Where each method errs</h3>\n<div class=\"maps\">\n";
    for (const ErrorPicture& picture : s.pictures) {
      const std::string name = picture.method + ", " + picture.setting;
      text_ += "<figure><img alt=\"error picture: " + escaped(name) + "\" src=\"data:image/png;base64," +
               apps::base64(apps::to_png(error_picture(picture, s.camera, limit, 480))) + "\"><figcaption>" + escaped(name) +
               "</figcaption></figure>\n";
    }
    text_ += "</div>\n<figure class=\"scale\">" + to_svg(error_scale(limit), "scale of the error pictures") + "<figcaption><b>Fig. " +
             std::to_string(++figures_) +
             ".</b> Error of each cell's mean in the picture, after weighted reconstruction, relative to the brightest cell of the "
             "reference; one scale for all. What is grey emits light or is no part of the scene.</figcaption></figure>\n";
  }

  void table(const Table& table, const std::string& kind, const std::string& caption) {
    const auto kind_of = [&](std::size_t column) { return column < table.text_columns ? std::string(" class=\"name\"") : std::string(); };
    text_ += "<div class=\"scroll " + kind + "\"><table><caption><b>Table " + std::to_string(++tables_) + ".</b> " + escaped(caption) +
             "</caption>\n<thead><tr>";
    for (std::size_t i = 0; i < table.head.size(); ++i) { text_ += "<th" + kind_of(i) + ">" + escaped(table.head[i]) + "</th>"; }
    text_ += "</tr></thead>\n<tbody>\n";
    for (const TableRow& row : table.rows) {
      const std::string classes =
          std::string(row.begins ? "begins" : "") + (row.begins && row.strong ? " " : "") + (row.strong ? "front" : "");
      text_ += classes.empty() ? "<tr>" : "<tr class=\"" + classes + "\">";
      for (std::size_t i = 0; i < row.cells.size(); ++i) { text_ += "<td" + kind_of(i) + ">" + escaped(row.cells[i]) + "</td>"; }
      if (!row.remark.empty()) {
        text_ += "<td class=\"remark\" colspan=\"" + std::to_string(table.head.size() - row.cells.size()) + "\">" + escaped(row.remark) +
                 "</td>";
      }
      text_ += "</tr>\n";
    }
    text_ += "</tbody></table></div>\n";
  }

  void reading() {
    text_ += "<h2>How this is measured</h2>\n";
    paragraph(
        "Methods are compared, in plots, in the first table and on the Pareto front, by one error: the relative L2 error of the cell "
        "means, before reconstruction. Errors are those of the radiosity of all surfaces that do not emit, weighted by area. L1 and L2 are "
        "relative to the same norm of the reference, the worst is relative to the greatest value of the reference. “Cells” compares means "
        "over the cells of the reference, “points” the radiosity at single points. “Before” is the constant radiosity of the solution's "
        "leaves, “simple” and “weighted” are what a picture shows.");
    paragraph(
        "A reference that was traced has noise of its own, which is also in the errors: the relative L2 norm of its standard errors. No "
        "error is reported below it: a hollow mark, and “<” in a table, say that the error is at most the noise. A slope is the exponent p "
        "of error = c · costᵖ by least squares in log-log, with its standard error, and needs three runs that are not limited by noise. A "
        "run is on the Pareto front when no other run of any method is cheaper and no less accurate.");
    paragraph(
        "After A. Willmott and P. Heckbert, An Empirical Comparison of Radiosity Algorithms, Carnegie Mellon University, CMU-CS-97-115, "
        "1997. “Paper” is H. Bendels, D. W. Fellner, S. Schäfer, Hierarchical Radiosity on Topological Data Structures, 1996.");
  }

  const Study& study_;
  std::string text_;
  int figures_ = 0;
  int tables_ = 0;
};

}  // namespace

std::string page(const Study& study) { return Page(study).write(); }

}  // namespace study
