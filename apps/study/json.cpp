// SPDX-License-Identifier: MIT
#include "apps/json.hpp"

#include <algorithm>
#include <utility>

#include <radiosity/support/left_out.hpp>

#include "apps/study/outcome.hpp"
#include "apps/study/pareto.hpp"

namespace study {
namespace {

using apps::JsonWriter;

void write(JsonWriter& json, const char* key, const Norms& norms, double noise) {
  const std::pair<const char*, double> values[] = {{"l1", norms.l1}, {"l2", norms.l2}, {"worst", norms.worst}};
  json.key(key).open_object();
  for (const auto& [norm, value] : values) { json.key(norm).number(known_error(value, noise).value); }
  json.key("below_noise").open_array();
  for (const auto& [norm, value] : values) {
    if (known_error(value, noise).limited) { json.string(norm); }
  }
  json.close().close();
}

void write(JsonWriter& json, const char* key, const Errors& errors, const Reference& reference) {
  json.key(key).open_object();
  write(json, "cells", errors.cells, reference.noise);
  write(json, "points", errors.points, reference.point_noise);
  json.close();
}

void write(JsonWriter& json, const Run& run, const Reference& reference, bool pareto) {
  json.open_object();
  json.key("setting").string(run.setting);
  if (!run.refused.empty()) {
    json.key("refused").string(run.refused);
    json.close();
    return;
  }
  json.key("refused").null();
  json.key("cpu_seconds").number(run.cpu_seconds);
  json.key("seconds_saved").number(run.seconds_saved);
  json.key("peak_bytes").count(run.peak_bytes).key("bytes").count(run.bytes);
  json.key("links").count(run.links);
  json.key("leaves").count(run.leaves);
  json.key("rays").count(run.rays);
  json.key("pareto").boolean(pareto);
  json.key("errors").open_object();
  write(json, "leaves", run.leaves_error, reference);
  write(json, "simple", run.simple_error, reference);
  write(json, "weighted", run.weighted_error, reference);
  json.close();
  json.key("picture");
  if (run.picture_error) {
    json.open_object();
    json.key("relative_l2").number(run.picture_error->relative_l2);
    json.key("low").number(run.picture_error->low).key("high").number(run.picture_error->high);
    json.close();
  } else {
    json.null();
  }
  json.key("parts");
  if (run.parts) {
    json.open_object();
    json.key("discretisation").number(run.parts->discretisation);
    json.key("links").number(run.parts->links);
    json.key("solver").number(run.parts->solver);
    json.key("reconstruction").number(run.parts->reconstruction);
    json.close();
  } else {
    json.null();
  }
  json.close();
}

void write(JsonWriter& json, const Reference& reference) {
  json.key("reference").open_object();
  json.key("kind").string(reference.kind);
  json.key("noise").number(reference.noise);
  json.key("point_noise").number(reference.point_noise);
  json.key("cells").count(reference.cells);
  json.key("points").count(reference.points);
  json.key("paths").count(reference.paths);
  json.key("cached").boolean(reference.cached);
  json.close();
}

void write(JsonWriter& json, const SceneStudy& scene) {
  std::vector<CostPoint> points;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) { points.push_back(point_of(run, scene.reference, Cost::cpu_time)); }
  }
  const std::vector<std::size_t> front = pareto_front(points);
  std::size_t number = 0;

  json.open_object();
  json.key("scene").string(scene.scene);
  json.key("title").string(scene.title);
  write(json, scene.reference);
  json.key("methods").open_array();
  for (const Method& method : scene.methods) {
    json.open_object();
    json.key("name").string(method.name);
    json.key("summary").string(method.summary);
    json.key("slopes").open_object();
    for (const auto& [key, cost] : {std::pair{"cpu_time", Cost::cpu_time}, {"memory", Cost::memory}, {"links", Cost::links}}) {
      std::vector<CostPoint> own;
      for (const Run& run : method.runs) { own.push_back(point_of(run, scene.reference, cost)); }
      const auto law = fit_power_law(own);
      json.key(key);
      law ? json.number(law->exponent) : json.null();
    }
    json.close();
    json.key("runs").open_array();
    for (const Run& run : method.runs) {
      write(json, run, scene.reference, std::find(front.begin(), front.end(), number++) != front.end());
    }
    json.close().close();
  }
  json.close();
  json.key("left_out").open_array();
  for (const radiosity::LeftOut& item : scene.left_out) {
    json.open_object();
    json.key("what").string(item.what).key("why").string(item.why).key("saved").string(item.saved);
    json.close();
  }
  json.close().close();
}

}  // namespace

std::string to_json(const Study& study) {
  JsonWriter json;
  json.open_object();
  json.key("program").string("halflight");
  json.key("version").string(study.version);
  json.key("machine").string(study.machine);
  json.key("compiler").string(study.compiler);
  json.key("seed").count(study.seed);
  json.key("scenes").open_array();
  for (const SceneStudy& scene : study.scenes) { write(json, scene); }
  json.close().close();
  return json.text();
}

}  // namespace study
