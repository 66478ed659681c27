// SPDX-License-Identifier: MIT
#include "apps/json.hpp"

#include <optional>
#include <set>
#include <utility>

#include <radiosity/support/left_out.hpp>

#include "apps/study/folder.hpp"
#include "apps/study/verdicts.hpp"

namespace study {
namespace {

using apps::JsonWriter;

// A norm below the noise of the reference is given as that noise, and named.
auto written(const Norms& norms, double noise) {
  return [norms, noise](JsonWriter& json) {
    const std::pair<const char*, double> values[] = {{"l1", norms.l1}, {"l2", norms.l2}, {"worst", norms.worst}};
    std::vector<std::string> below;
    json.open_object();
    for (const auto& [norm, value] : values) {
      const KnownError error = known_error(value, noise);
      json.fields(norm, error.value);
      if (error.limited) { below.emplace_back(norm); }
    }
    json.fields("below_noise", below).close();
  };
}

auto written(const Errors& errors, const Reference& reference) {
  return [&](JsonWriter& json) {
    json.object("cells", written(errors.cells, reference.noise), "points", written(errors.points, reference.point_noise));
  };
}

void write(JsonWriter& json, const Run& run, const Reference& reference, bool pareto) {
  if (!run.refused.empty()) {
    json.object("setting", run.setting, "refused", run.refused);
    return;
  }
  const auto errors = [&](JsonWriter& inner) {
    inner.object("leaves", written(run.leaves_error, reference), "simple", written(run.simple_error, reference), "weighted",
                 written(run.weighted_error, reference));
  };
  const auto picture = [&](JsonWriter& inner) {
    const auto& error = run.picture_error;
    error ? inner.object("relative_l2", error->relative_l2, "low", error->low, "high", error->high) : inner.null();
  };
  const auto parts = [&](JsonWriter& inner) {
    const auto& part = run.parts;
    part ? inner.object("discretisation", part->discretisation, "links", part->links, "solver", part->solver, "reconstruction",
                        part->reconstruction)
         : inner.null();
  };
  json.object("setting", run.setting, "refused", std::optional<std::string>(), "cut_off",
              run.cut_off.empty() ? std::optional<std::string>() : run.cut_off, "cpu_seconds", run.cpu_seconds, "seconds_saved",
              run.seconds_saved, "peak_bytes", run.peak_bytes, "bytes", run.bytes, "links", run.links, "leaves", run.leaves, "rays",
              run.rays, "pareto", pareto, "errors", errors, "picture", picture, "parts", parts);
}

void write(JsonWriter& json, const SceneStudy& scene) {
  const std::set<const Run*> front = on_front(scene);
  const auto slope = [&](const Method& method, Cost cost) {
    const auto law = fit_power_law(points_of(method, scene.reference, cost));
    return law ? std::optional(law->exponent) : std::nullopt;
  };
  const auto reference = [&](JsonWriter& inner) {
    const Reference& r = scene.reference;
    inner.object("kind", r.kind, "noise", r.noise, "point_noise", r.point_noise, "cells", r.cells, "points", r.points, "paths", r.paths,
                 "cached", r.cached);
  };
  json.open_object().fields("scene", scene.scene, "title", scene.title, "reference", reference);
  json.key("methods").list(scene.methods, [&](const Method& method) {
    const auto slopes = [&](JsonWriter& inner) {
      inner.object("cpu_time", slope(method, Cost::cpu_time), "memory", slope(method, Cost::memory), "links", slope(method, Cost::links));
    };
    json.open_object().fields("name", method.name, "summary", method.summary, "slopes", slopes);
    json.key("runs").list(method.runs, [&](const Run& run) { write(json, run, scene.reference, front.contains(&run)); });
    json.close();
  });
  json.key("left_out").list(scene.left_out, [&](const radiosity::LeftOut& item) {
    json.object("what", item.what, "why", item.why, "saved", item.saved);
  });
  json.close();
}

}  // namespace

std::string to_json(const Study& study) {
  JsonWriter json;
  json.open_object();
  json.fields("program", "halflight", "version", study.version, "machine", study.machine, "compiler", study.compiler, "seed", study.seed);
  json.key("scenes").list(study.scenes, [&](const SceneStudy& scene) { write(json, scene); }).close();
  return json.text();
}

}  // namespace study
