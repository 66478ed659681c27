// SPDX-License-Identifier: MIT
// A study in parts is the study of one machine; runs that were cut off are told and credited nowhere.
#include "catch.hpp"

#include <cstdlib>
#include <random>
#include <string>

#include "apps/study/folder.hpp"
#include "apps/study/parts.hpp"
#include "apps/study/verdicts.hpp"
#include "browser.hpp"
#include "json.hpp"
#include "made_up_study.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

using namespace study;

Study study_of_three() {
  Study whole = made_up::study_of_one();
  for (const char* name : {"second", "third"}) { whole.scenes.push_back(made_up::scene(name, 0.0)); }
  whole.scenes[1].methods[2].runs[3].cut_off = "stopped after 1 s of CPU time";
  return whole;
}

// What part `number` of the study would have measured.
Part part_of(const Study& whole, const PartNumber& number) {
  const std::size_t methods = whole.scenes[0].methods.size();
  Part part{number, "asked", whole.scenes.size(), methods, {}, {}, whole};
  part.study.scenes.clear();
  for (std::size_t s = 0; s < whole.scenes.size(); ++s) {
    SceneStudy scene = whole.scenes[s];
    scene.methods.clear();
    scene.pictures.clear();
    std::vector<std::size_t> which;
    for (std::size_t m = 0; m < methods; ++m) {
      if (!number.has(s * methods + m)) { continue; }
      scene.methods.push_back(whole.scenes[s].methods[m]);
      scene.pictures.push_back(whole.scenes[s].pictures[m]);
      which.push_back(m);
    }
    if (which.empty()) { continue; }
    part.study.scenes.push_back(scene);
    part.scenes.push_back(s);
    part.methods.push_back(which);
  }
  return part;
}

std::vector<Part> parts_of(const Study& whole, std::size_t count) {
  std::vector<Part> parts;
  for (std::size_t i = count; i >= 1; --i) {
    std::optional<Part> part = read_part(to_bytes(part_of(whole, {i, count})));
    REQUIRE(part);
    parts.push_back(std::move(*part));
  }
  return parts;
}

}  // namespace

TEST_CASE("study: parts that were written, read and merged are the whole, to the last bit of every table and picture") {
  Study whole = study_of_three();
  for (std::size_t i = 1; i < 3; ++i) {
    for (ErrorPicture& picture : whole.scenes[i].pictures) { picture.cells.resize(3); }
  }
  const auto pictures = [](const Study& study) {
    std::string text;
    for (const SceneStudy& scene : study.scenes) {
      for (const ErrorPicture& picture : scene.pictures) {
        text += picture.method + picture.setting;
        for (const ErrorCell& cell : picture.cells) { text += " " + std::to_string(cell.error) + "@" + std::to_string(cell.corners[2].y); }
      }
    }
    return text;
  };
  for (const std::size_t count : {40u, 5u, 4u, 2u, 1u}) {  // 40: more parts than pairs
    INFO(count << " parts");
    const Merged merged = merge(parts_of(whole, count));
    INFO(merged.fault);
    REQUIRE(merged.study);
    CHECK(to_csv(*merged.study) == to_csv(whole));
    CHECK(to_json(*merged.study) == to_json(whole));
    CHECK(pictures(*merged.study) == pictures(whole));
    if (count > 1) { continue; }
    Study again = *merged.study;
    for (Study* study : {&again, &whole}) {  // drawing is what takes its time
      for (SceneStudy& scene : study->scenes) { scene.pictures.resize(1); }
    }
    CHECK(page(again) == page(whole));
  }
}

TEST_CASE("study: parts that are missing, twice there, of another study or damaged are refused with the reason") {
  const Study whole = study_of_three();
  const auto without = [&](std::size_t i) {
    std::vector<Part> parts = parts_of(whole, 4);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
    return merge(parts).fault;
  };
  CHECK(without(1) == "of 4 parts these are missing: 3");
  std::vector<Part> twice = parts_of(whole, 4);
  twice.push_back(twice[0]);
  CHECK(merge(twice).fault == "part 4 is there twice");
  std::vector<Part> other = parts_of(whole, 4);
  other[2].asked = "something else";
  CHECK(merge(other).fault.find("of another study") != std::string::npos);
  CHECK(merge({}).fault == "there is no part");

  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::string bytes = to_bytes(part_of(whole, {2, 4}));
  for (int k = 0; k < 300; ++k) {
    std::string damaged = bytes;
    if (k % 2 == 0) {
      damaged.resize(random() % bytes.size());
    } else {
      char& byte = damaged[random() % bytes.size()];
      byte = static_cast<char>(byte + 1 + static_cast<char>(random() % 200));
    }
    CHECK((damaged == bytes || !read_part(damaged)));
  }
}

TEST_CASE("study: I/N is read, and nothing else") {
  const auto part = parse_part("3/8");
  REQUIRE(part);
  CHECK(part->index == 3);
  CHECK(part->count == 8);
  for (const char* wrong : {"0/3", "4/3", "3", "/3", "3/", "-1/3", "1/3x", " 1/3", ""}) { CHECK_FALSE(parse_part(wrong)); }
  std::size_t pairs = 0;
  for (std::size_t pair = 0; pair < 100; ++pair) {
    for (std::size_t i = 1; i <= 7; ++i) { pairs += PartNumber{i, 7}.has(pair) ? 1 : 0; }
  }
  CHECK(pairs == 100);  // each in one part
}

TEST_CASE("study: a run that was cut off stands in the table, marked, and is credited nowhere") {
  Study whole = made_up::study_of_one();
  SceneStudy& scene = whole.scenes[0];
  Run& best = scene.methods[2].runs[5];
  best.leaves_error = made_up::errors(0.0045);  // the best of all, and nearly free
  best.cpu_seconds = 1e-6;
  CHECK(on_front(scene).contains(&best));
  CHECK(most_accurate(scene.methods[2], scene.reference) != nullptr);
  best.cut_off = "stopped after 1 s of CPU time";
  CHECK_FALSE(on_front(scene).contains(&best));
  for (const double target : targets(scene)) { CHECK(cheapest_within(scene.methods[2], scene.reference, target) != &best); }
  CHECK(most_accurate(scene.methods[2], scene.reference) != &best);
  for (const CostPoint& point : points_of(scene.methods[2], scene.reference, Cost::cpu_time)) { CHECK(point.cost != 1e-6); }
  bool marked = false;
  for (const TableRow& row : run_table(scene).rows) { marked = marked || row.cells[1].find("\u2020") != std::string::npos; }
  CHECK(marked);
  CHECK(to_csv(whole).find("stopped after 1 s of CPU time") != std::string::npos);
  CHECK(json::parse(to_json(whole))["scenes"][0]["methods"][2]["runs"][5]["cut_off"].string() == best.cut_off);
}

TEST_CASE("halflight study --part and --merge: what was measured in parts is what one run measures") {
  program::Place place;
  // A furnace so white that paths would never end: its reference is exact and its pictures are not traced, which saves most of the time.
  place.write("furnace.scene", "material wall reflectance 0.9995 emission 0.0005\nbox room from 0 0 0 to 1 1 1 inside material wall\n");
  const std::string options = " --time-per-run 0.01 --paths 16 --dense 0 -q";
  CHECK(place.run("study furnace.scene -o parts --part 2/2" + options).code == 0);
  CHECK(place.has("parts/part-2-of-2.study"));
  const program::Run early = place.run("study --merge parts -o whole");
  CHECK(early.code == 3);
  CHECK(early.err.find("of 2 parts these are missing: 1") != std::string::npos);
  CHECK(place.run("study furnace.scene -o parts --part 1/2" + options).code == 0);
  CHECK(place.run("study --merge parts -o whole").code == 0);
  CHECK(place.run("study furnace.scene -o one" + options).code == 0);
  const json::Value whole = json::parse(place.read("whole/results.json")), one = json::parse(place.read("one/results.json"));
  const auto& methods = whole["scenes"][0]["methods"].array();
  REQUIRE(methods.size() == one["scenes"][0]["methods"].size());
  int compared = 0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    CHECK(methods[m]["name"].string() == one["scenes"][0]["methods"][m]["name"].string());
    for (std::size_t r = 0; r < methods[m]["runs"].size(); ++r) {
      const json::Value &a = methods[m]["runs"][r], &b = one["scenes"][0]["methods"][m]["runs"][r];
      if (!a["refused"].is_null() || !b["refused"].is_null() || !a["cut_off"].is_null() || !b["cut_off"].is_null()) { continue; }
      ++compared;
      CHECK(a["links"].number() == b["links"].number());
      CHECK(a["errors"]["leaves"]["cells"]["l2"].number() == b["errors"]["leaves"]["cells"]["l2"].number());
      CHECK(a["errors"]["weighted"]["points"]["l2"].number() == b["errors"]["weighted"]["points"]["l2"].number());
    }
  }
  CHECK(compared > 3);
  CHECK(place.run("study -o x").code == 2);
  CHECK(place.run("study furnace.scene -o x --part 3/2").code == 2);
}

TEST_CASE("study page: legends are whole, tick labels do not collide, tables stay within the page at 1200 px and on paper") {
  if (!browser::found()) { SKIP_TEST("there is no chromium"); }
  program::Place place;
  Study whole = study_of_three();
  for (Method& method : whole.scenes[0].methods) {
    if (method.name == "BF to a target, clusters") { method.name = "BF, accuracy target, clusters and a long name"; }
  }
  const std::string text = page(whole);
  const auto faults = [&](const std::string& probe, const char* window) {
    const std::string dom = browser::elements(place, probe, R"(
      const wide = document.documentElement.clientWidth, faults = [], paper = wide < 700;
      for (const t of document.querySelectorAll('table')) {
        const limit = !paper ? wide : t.closest('.wide') ? 1032 : 688, right = t.getBoundingClientRect().right;
        if (wide != 1000 && right > limit + 0.5) { faults.push('table ' + t.caption.textContent.slice(0, 9) + ' ' + right); }
      }
      if (!paper && document.documentElement.scrollWidth > wide) { faults.push('the page is wider than its window'); }
      for (const s of document.querySelectorAll('figure svg')) {
        const box = s.getBoundingClientRect(), labels = [...s.querySelectorAll('text')].map(t => [t, t.getBoundingClientRect()]);
        for (const [t, r] of labels) {
          if (Math.min(r.left - box.left, box.right - r.right, r.top - box.top, box.bottom - r.bottom) < -0.5) { faults.push('clipped: ' + t.textContent); }
        }
        labels.forEach(([t, a], i) => labels.slice(i + 1).forEach(([u, b]) => {
          const dx = Math.min(a.right, b.right) - Math.max(a.left, b.left), dy = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
          if (dx > 0.5 && dy > 0.35 * Math.min(a.height, b.height)) { faults.push('collide: ' + t.textContent + ' | ' + u.textContent); }
        }));
      }
      document.documentElement.dataset.faults = [...new Set(faults)].slice(0, 12).join('; ');
    )",
                                              window);
    const std::size_t at = dom.find("data-faults=\"");
    REQUIRE(at != dom.npos);
    return dom.substr(at + 13, dom.find('"', at + 13) - at - 13);
  };
  CHECK(faults(text, "1200,900").empty());
  CHECK(faults(text, "1000,900").empty());  // where a wide table is scrolled, and the page is not
  std::string printed = text;               // A4 less its margins is 182 mm wide, 688 px, or across 273 mm, 1032 px
  for (std::size_t at; (at = printed.find("@media print")) != printed.npos;) { printed.replace(at, 12, "@media all"); }
  CHECK(faults(printed, "688,900").empty());
}
