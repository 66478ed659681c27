// SPDX-License-Identifier: MIT
// What a study becomes: tables, pictures and the page, from made-up figures.
#include "catch.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "apps/bytes.hpp"
#include "apps/study/error_picture.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/verdicts.hpp"
#include "browser.hpp"
#include "json.hpp"
#include "made_up_study.hpp"
#include "markup.hpp"
#include "program.hpp"

namespace {

using namespace study;

// RFC 4180.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = rows.back().back();
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[++i];
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && text[i] == ',') {
      rows.back().emplace_back();
    } else if (!quoted && text[i] == '\n') {
      rows.push_back({""});
    } else {
      field += text[i];
    }
  }
  rows.pop_back();
  return rows;
}

double to_double(const std::string& text) {
  double x = std::nan("");
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

std::size_t count_parts(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) { ++n; }
  return n;
}

radiosity::Rgb8 rgb(Srgb color) {
  return {static_cast<std::uint8_t>(color >> 16U), static_cast<std::uint8_t>(color >> 8U), static_cast<std::uint8_t>(color)};
}

int difference(const radiosity::Rgb8& a, const radiosity::Rgb8& b) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c) { most = std::max(most, std::abs(int{a[c]} - int{b[c]})); }
  return most;
}

}  // namespace

TEST_CASE("CSV: fields with commas, quotes and line ends come back as they were") {
  for (const char* text : {"plain", "", "a,b", "say \"it\"", "\"", "two\nlines", ",", "é – ε"}) {
    CHECK(parse_csv("x," + csv_field(text) + ",y\n") == std::vector<std::vector<std::string>>{{"x", text, "y"}});
  }
}

TEST_CASE("CSV: every run and reconstruction has a line of the same columns, numbers come back to the last bit unless noise limits them") {
  const Study study = made_up::study_of_one();
  const auto rows = parse_csv(to_csv(study));
  REQUIRE(rows.size() == 1 + 9 * 6 * 3);
  std::map<std::string, std::size_t> column;
  for (std::size_t i = 0; i < rows[0].size(); ++i) { column[rows[0][i]] = i; }
  std::size_t line = 1;
  std::size_t limited = 0;
  for (const Method& method : study.scenes[0].methods) {
    for (const Run& run : method.runs) {
      for (const Stage stage : stages) {
        const auto& row = rows[line++];
        REQUIRE(row.size() == rows[0].size());
        const auto field = [&](const char* name) { return row[column.at(name)]; };
        CHECK(field("method") == method.name);
        CHECK(field("setting") == run.setting);
        CHECK(field("refused") == run.refused);
        if (!run.refused.empty()) {
          CHECK(field("cpu_seconds").empty());
          CHECK(field("cells_l2").empty());
          continue;
        }
        CHECK(to_double(field("cpu_seconds")) == run.cpu_seconds);
        CHECK(field("links") == std::to_string(run.links));
        CHECK(field("part_discretisation").empty() == !run.parts.has_value());
        const double error = errors(run, stage).cells.l2;
        const bool below = (' ' + field("below_noise") + ' ').find(" cells_l2 ") != std::string::npos;
        CHECK(below == (error < made_up::noise));
        CHECK(to_double(field("cells_l2")) == std::max(error, made_up::noise));
        limited += below ? 1 : 0;
        CHECK(field("points_l2").empty() == std::isnan(errors(run, stage).points.l2));
      }
    }
  }
  CHECK(limited > 10);
}

TEST_CASE("JSON: what a program reads is what was found, with fronts and slopes, and nothing below the noise") {
  const Study study = made_up::study_of_one();
  const json::Value root = json::parse(to_json(study));
  CHECK(root["seed"].number() == 7.0);
  CHECK(root["machine"].string() == study.machine);
  CHECK(root["compiler"].string() == study.compiler);
  const json::Value& scene = root["scenes"][0];
  CHECK(scene["title"].string() == study.scenes[0].title);
  REQUIRE(scene["methods"].size() == 9);
  for (std::size_t m = 0; m < 9; ++m) {
    const json::Value& method = scene["methods"][m];
    CHECK(method["slopes"]["cpu_time"].number() == test::Approx(made_up::laws[m].exponent).margin(1e-9));
    for (std::size_t r = 0; r < 6; ++r) {
      const json::Value& run = method["runs"][r];
      const Run& given = study.scenes[0].methods[m].runs[r];
      CHECK(run["setting"].string() == given.setting);
      if (!given.refused.empty()) {
        CHECK(run["refused"].string() == given.refused);
        CHECK_FALSE(run.contains("errors"));
        continue;
      }
      const json::Value& cells = run["errors"]["leaves"]["cells"];
      CHECK(cells["l2"].number() == std::max(given.leaves_error.cells.l2, made_up::noise));
      CHECK(run["errors"]["weighted"]["points"]["l2"].is_null() == std::isnan(given.weighted_error.points.l2));
      // On the front exactly when no run of any method is as cheap and as accurate. Nothing here is equal but what noise limits.
      bool beaten = false;
      for (const Method& other : study.scenes[0].methods) {
        for (const Run& rival : other.runs) {
          const double error = std::max(rival.leaves_error.cells.l2, made_up::noise);
          const double own = std::max(given.leaves_error.cells.l2, made_up::noise);
          const bool sound = rival.refused.empty() && &rival != &given;
          beaten = beaten || (sound && rival.cpu_seconds <= given.cpu_seconds && error <= own &&
                              (rival.cpu_seconds < given.cpu_seconds || error < own));
        }
      }
      CHECK(run["pareto"].boolean() == !beaten);
    }
  }
}

TEST_CASE("an error below the noise is given as the noise and marked, everywhere") {
  CHECK(to_text(known_error(0.003, 0.004)) == "< 0.400 %");
  CHECK(to_text(known_error(0.004, 0.004)) == "0.400 %");
  CHECK(to_text(known_error(0.0, 0.0)) == "0 %");
  CHECK(to_text(known_error(std::nan(""), 0.004)) == "–");
  Study study = made_up::study_of_one();
  // With the noise above all errors no table says a number below it.
  study.scenes[0].pictures.clear();
  study.scenes[0].reference.noise = study.scenes[0].reference.point_noise = 5.0;
  const Table runs = run_table(study.scenes[0]);
  for (const TableRow& row : runs.rows) {
    for (std::size_t i = 8; i < row.cells.size(); ++i) { CHECK((row.cells[i] == "< 500" || row.cells[i] == "–")); }
  }
  const auto rows = parse_csv(to_csv(study));
  for (std::size_t i = 1; i < rows.size(); ++i) { CHECK((rows[i][14] == "5" || rows[i][14].empty())); }
  CHECK(page(study).find("no slope: too few points") != std::string::npos);
}

TEST_CASE("targets are reached by some run, and the findings name the cheapest method within each") {
  const SceneStudy scene = made_up::scene("s", 0.0);
  const std::vector<double> goals = targets(scene);
  REQUIRE(goals.size() == 3);
  CHECK(std::is_sorted(goals.rbegin(), goals.rend()));
  for (const double goal : goals) {
    const Run* best = nullptr;
    const Method* by = nullptr;
    for (const Method& method : scene.methods) {
      for (const Run& run : method.runs) {
        const bool reached = run.refused.empty() && run.leaves_error.cells.l2 <= goal;
        if (reached && (best == nullptr || run.cpu_seconds < best->cpu_seconds)) { best = &run, by = &method; }
      }
    }
    REQUIRE(best != nullptr);
    const std::string expected = "Within " + percent(goal) + ": " + by->name + " needs least time, " + figure(best->cpu_seconds) + " s";
    const auto sentences = findings(scene);
    CHECK(std::any_of(sentences.begin(), sentences.end(), [&](const std::string& s) { return s.substr(0, expected.size()) == expected; }));
  }
  CHECK(targets({}).empty());
  CHECK(findings({}).empty());
}

TEST_CASE("error pictures: white is right, blue too dark, orange too bright, both ends differ in grey, too") {
  CHECK(error_color(0.0) == 0xf7f7f7);
  CHECK(error_color(-5.0) == error_color(-1.0));
  const auto grey = [](Srgb color) { return 0.2126 * rgb(color)[0] + 0.7152 * rgb(color)[1] + 0.0722 * rgb(color)[2]; };
  for (int i = 0; i < 50; ++i) {  // lighter towards the middle, on both sides
    CHECK(grey(error_color((i + 1) / 50.0)) < grey(error_color(i / 50.0)));
    CHECK(grey(error_color(-(i + 1) / 50.0)) < grey(error_color(-i / 50.0)));
  }
  CHECK(grey(error_color(-1.0)) < grey(error_color(1.0)) - 20.0);

  // One cell fills the middle of the view; around it is background, and where its back shows, too.
  ErrorPicture errors{"m", "s", {{{{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, 0.0}}};
  radiosity::Camera camera;  // looks along y from the origin
  camera.field_of_view = 90.0;
  camera.size = radiosity::PictureSize{100, 80};
  for (const double error : {-0.02, -0.01, 0.0, 0.007, 0.02}) {
    errors.cells[0].error = error;
    const radiosity::Picture picture = error_picture(errors, camera, 0.02, 200);
    CHECK(picture.width == 200);
    CHECK(picture.height == 160);
    CHECK(difference(picture.pixel(100, 80), rgb(error_color(error / 0.02))) <= 1);
    CHECK(difference(picture.pixel(54, 80), rgb(error_color(error / 0.02))) <= 1);  // the cell ends at 50 and 150
    CHECK(difference(picture.pixel(45, 80), rgb(0xb4b4b4)) <= 1);
  }
  std::reverse(errors.cells[0].corners.begin(), errors.cells[0].corners.end());
  CHECK(difference(error_picture(errors, camera, 0.02, 200).pixel(100, 80), rgb(0xb4b4b4)) <= 1);
  CHECK(error_picture({"m", "s", {}}, camera, 0.02, 50).shown.size() == 50 * 40);
}

TEST_CASE("the scale of error pictures holds 98 % of the cells and is 1, 2 or 5 times a power of ten") {
  const SceneStudy scene = made_up::scene("s", 0.0);
  const double limit = error_limit(scene);
  std::size_t within = 0;
  std::size_t all = 0;
  for (const ErrorPicture& picture : scene.pictures) {
    for (const ErrorCell& cell : picture.cells) { ++all, within += std::abs(cell.error) <= limit ? 1 : 0; }
  }
  CHECK(static_cast<double>(within) >= 0.98 * static_cast<double>(all));
  const double mantissa = limit / std::pow(10.0, std::floor(std::log10(limit * (1 + 1e-9))));
  CHECK((mantissa == test::Approx(1.0) || mantissa == test::Approx(2.0) || mantissa == test::Approx(5.0)));
}

TEST_CASE("base64 as in RFC 4648") {
  using apps::base64;
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("the page is well-formed, holds everything itself and states machine, compiler, seed and version") {
  Study study = made_up::study_of_one();
  study.scenes[0].pictures.resize(2);
  study.scenes.push_back(made_up::scene("another <scene>", 0.0));
  study.scenes[1].methods.erase(study.scenes[1].methods.begin() + 2);
  study.scenes[1].pictures.clear();
  const std::string html = page(study);
  CHECK(markup::fault(html) == "");
  CHECK(html.find("http") == html.find("http://www.w3.org/2000/svg"));  // the namespace of SVG is a name, no address
  CHECK(count_parts(html, "http") == count_parts(html, "xmlns=\"http://www.w3.org/2000/svg\""));
  CHECK(count_parts(html, "src=") == count_parts(html, "src=\"data:image/png;base64,"));
  for (const char* outside : {"<link", "<script", "@import", "url("}) { CHECK(html.find(outside) == std::string::npos); }
  CHECK(count_parts(html, "href=\"") == count_parts(html, "href=\"#scene"));
  for (const std::string& stated : {study.machine, study.compiler, "halflight " + study.version, std::string("<dt>Seed</dt><dd>7</dd>")}) {
    CHECK(html.find(stated) != std::string::npos);
  }
  CHECK(count_parts(html, "<img ") == 2);
  CHECK(count_parts(html, "<svg ") == 4 + 4 + 1);  // plots of both scenes, and one scale
  CHECK(html.find("no result: the matrix needs 4 GB") != std::string::npos);
  CHECK(html.find("two thirds of the solver&#39;s arithmetic") != std::string::npos);
  CHECK(count_parts(html, "Overview") == 1);
  CHECK(markup::fault(page({})) == "");
}

TEST_CASE("on paper the runs of a method stay together, and a heading is on the page of its table") {
  if (!browser::found() || std::system("command -v pdftotext >/dev/null 2>&1") != 0) { SKIP_TEST("there is no chromium, or no pdftotext"); }
  Study study = made_up::study_of_one();
  study.scenes.resize(2, study.scenes[0]);
  std::vector<std::string> names;
  for (SceneStudy& scene : study.scenes) {
    scene.pictures.clear();
    for (Method& method : scene.methods) {
      method.name = method.name.substr(0, method.name.find(','));  // on one line
      const std::vector<Run> runs = method.runs;
      method.runs.insert(method.runs.end(), runs.begin(), runs.end());
      names.push_back(method.name);
    }
  }
  const program::Place place;
  place.write("page.html", page(study));
  REQUIRE(std::system(("cd '" + place.path().string() + "' && timeout 60 chromium --headless --no-sandbox --disable-gpu" +
                       " --user-data-dir=profile --print-to-pdf=page.pdf page.html >/dev/null 2>&1 && pdftotext -layout page.pdf")
                          .c_str()) == 0);
  std::istringstream pages(place.read("page.txt"));
  int checked = 0;
  for (std::string text; std::getline(pages, text, '\f');) {
    INFO(text);
    if (text.find("Overview") != std::string::npos) { CHECK(text.find("Table 1") != std::string::npos); }
    const std::size_t run = text.find(" epsilon .");  // the first of the page
    if (run == std::string::npos) { continue; }
    const std::string row = text.substr(text.rfind('\n', run) + 1, run - text.rfind('\n', run));
    CHECK(std::any_of(names.begin(), names.end(), [&](const std::string& name) { return row.find(name) != std::string::npos; }));
    ++checked;
  }
  CHECK(checked >= 6);  // three tables of each scene
}

TEST_CASE("a method has the same colour in every scene") {
  Study study = made_up::study_of_one();
  study.scenes.push_back(made_up::scene("second", 0.0));
  for (SceneStudy& scene : study.scenes) { scene.pictures.clear(); }
  study.scenes[1].methods.erase(study.scenes[1].methods.begin(), study.scenes[1].methods.begin() + 8);  // "progressive" alone
  const std::string html = page(study);
  const std::string second = html.substr(html.find("id=\"scene1\""));
  const std::string plot = second.substr(0, second.find("</svg>"));
  CHECK(plot.find("fill=\"#d55e00\"") != std::string::npos);  // the ninth style has the second colour
  CHECK(plot.find("fill=\"#0072b2\"") == std::string::npos);
}

TEST_CASE("write_pages writes what page_files lists, each under a name of its own, or says what failed") {
  const program::Place place;
  Study study = made_up::study_of_one();
  study.scenes[0].pictures.resize(2);
  study.scenes[0].pictures[1].method = "hierarchical:F";  // the same file name as "hierarchical F"
  const std::string folder = (place.path() / "new" / "study").string();
  const auto fault = write_pages(study, folder);
  CHECK_FALSE(fault);
  const std::vector<std::string> files = page_files(study);
  CHECK(files.size() == 3 + 4 + 2);
  std::size_t found = 0;
  for (const auto& entry : program::fs::directory_iterator(folder)) {
    ++found;
    CHECK(std::find(files.begin(), files.end(), entry.path().filename().string()) != files.end());
    const std::string bytes = program::content(entry.path());
    CHECK(entry.path().extension() != ".png");
    if (entry.path().extension() == ".svg") { CHECK(markup::fault(bytes) == ""); }
    CHECK((bytes.find("data:image/png;base64,iVBOR") != std::string::npos) ==
          (entry.path().filename() == "index.html" || entry.path().filename().string().find("_error_") != std::string::npos));
  }
  CHECK(found == files.size());
  CHECK(program::content(program::fs::path(folder) / "results.csv") == to_csv(study));

  place.write("file", "x");
  CHECK(write_pages(study, (place.path() / "file").string()));
  CHECK(write_pages(study, (place.path() / "file" / "below").string()));
}
