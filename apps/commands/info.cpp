// SPDX-License-Identifier: MIT
// halflight info SCENE: says what a scene contains, without solving it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/lamp_choice.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

struct InfoOptions {
  std::string scene;
  ModelOptions model;
};

std::string color(const radiosity::Color& c) { return radiosity::is_grey(c) ? formatted("%.6g", c.x) : triple(c); }

std::string materials(const radiosity::Scene& scene) {
  std::string out = "materials: " + std::to_string(scene.materials.size()) + "\n";
  for (std::size_t i = 0; i < scene.materials.size() && i < longest_list; ++i) {
    const radiosity::Material& m = scene.materials[i];
    out += "  " + left(m.name, 18) + "reflectance " + color(m.reflectance);
    out += (radiosity::is_black(m.emission) ? "" : "   emission " + color(m.emission) + " W/m2") + "\n";
  }
  return out + and_more(scene.materials.size(), longest_list);
}

// The number of sheets of which at least one face is left.
std::size_t surfaces(const radiosity::Prepared& prepared) {
  std::size_t count = 0;
  for (const radiosity::Surface& surface : prepared.surfaces) {
    std::vector<bool> exists(surface.object->sheet_count(), false);
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet != brep::no_sheet) { exists[sheet] = true; }
    }
    count += static_cast<std::size_t>(std::count(exists.begin(), exists.end(), true));
  }
  return count;
}

std::string objects(const SceneFile& file, const radiosity::Prepared& prepared) {
  const radiosity::Scene& scene = file.scene;
  std::string out = "objects: " + std::to_string(scene.objects.size()) + " with " + std::to_string(surfaces(prepared)) + " surfaces\n";
  for (std::size_t i = 0; i < scene.objects.size() && i < longest_list; ++i) {
    const radiosity::SceneObject& o = scene.objects[i];
    const auto first = o.material.front();
    const bool one = std::all_of(o.material.begin(), o.material.end(), [&](auto m) { return m == first; });
    out += "  " + left(o.name, 18) + left(std::string(file.origins[i].kind), 10);
    out += one ? scene.materials[first].name : "materials by sheet";
    out += std::string(o.placement.inside ? ", seen from inside" : o.shape->solid() ? "" : ", one-sided") + "\n";
  }
  return out + and_more(scene.objects.size(), longest_list);
}

std::string cameras(const SceneFile& file) {
  std::string out =
      "cameras: " + std::to_string(file.cameras.size()) + (file.cameras.empty() ? " (render uses an automatic view)\n" : "\n");
  for (std::size_t i = 0; i < file.cameras.size() && i < longest_list; ++i) {
    const radiosity::Camera& camera = file.cameras[i];
    out += "  " + left(camera.name, 18) + camera_text(camera) + "\n";
  }
  return out + and_more(file.cameras.size(), longest_list);
}

// The input faces of a run, as they are before it cuts long ones.
radiosity::FaceCounts face_counts(const radiosity::Scene& scene, const radiosity::Prepared& prepared) {
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(scene);
  std::vector<radiosity::Color> emission;
  for (const radiosity::InputSurface& input : inputs) { emission.push_back(scene.materials[input.material].emission); }
  std::vector<double> areas(inputs.size(), 0.0);
  std::vector<std::uint64_t> counts(inputs.size(), 0);  // of input faces
  for (const radiosity::Surface& surface : prepared.surfaces) {
    for (const std::vector<brep::FaceId>& parts : radiosity::input_faces(surface)) {
      const std::uint32_t input = surface.first_surface + surface.brep.data(parts.front()).sheet;
      for (const brep::FaceId part : parts) { areas[input] += brep::area(surface.brep, part); }
      ++counts[input];
    }
  }
  const std::vector<bool> lamps = radiosity::choose_lamps(areas, emission, prepared.objects.bounds());
  radiosity::FaceCounts faces;
  for (std::size_t s = 0; s < inputs.size(); ++s) {
    faces.all += counts[s];
    faces.shining += radiosity::is_black(emission[s]) ? 0 : counts[s];
    faces.lamps += lamps[s] ? counts[s] : 0;
  }
  faces.uncut_shining = faces.shining;
  return faces;
}

// The plan of a run, before any light is computed.
std::string plan(const radiosity::Scene& scene, const radiosity::Prepared& prepared) {
  const radiosity::Plan& plan = prepared.plan;
  const radiosity::FaceCounts faces = face_counts(scene, prepared);
  std::string out = "input faces: " + std::to_string(faces.all) + "\n";
  out += std::string("closed: ") + (plan.closed ? "proven, no light leaves the scene\n" : "not proven\n");
  out +=
      "can stand between two others: " + std::to_string(plan.occluders) + " of " + std::to_string(prepared.surfaces.size()) + " objects\n";
  out += "left out when rendered, as far as known without solving:\n";
  for (const radiosity::LeftOut& item : plan.left_out) { out += "  " + item.what + ": " + item.why + "\n"; }
  const radiosity::RayChoice rays = radiosity::choose_rays(faces, {});
  const radiosity::ClusterChoice clusters = radiosity::choose_clusters(faces.all, {});
  if (!rays.cast) {
    out += "  stored rays for the light between surfaces that do not shine: " + rays.reason +
           (rays.few ? "; unless a run finds that lamps hide what they light most from the rest" : "") + "\n";
  }
  const std::string without_clusters = rays.cast         ? "light goes by stored rays"
                                       : rays.many_lamps ? "lamps of many faces have clusters of their own"
                                                         : clusters.reason;
  if (!without_clusters.empty()) { out += "  clusters above the input faces: " + without_clusters + "\n"; }
  return out;
}

std::string notes(const SceneFile& file) {
  std::string out = file.notes.empty() ? "" : "taken in:\n";
  for (const std::string& note : file.notes) { out += "  " + note + "\n"; }
  out += file.warnings.empty() ? "" : "warnings:\n";
  for (const std::string& sentence : file.warnings) { out += "  " + sentence + "\n"; }
  return out;
}

std::string summary(const SceneFile& file, const radiosity::Prepared& prepared, const std::string& name) {
  const raycast::Box bounds = radiosity::scene_bounds(file.scene);
  return name + "\n" + "bounds: " + triple(bounds.lo) + "  to  " + triple(bounds.hi) + "\n" + notes(file) + materials(file.scene) +
         objects(file, prepared) + cameras(file) + plan(file.scene, prepared);
}

ExitCode run(const InfoOptions& options) {
  ExitCode code = ExitCode::ok;
  const auto file = load_scene(options.scene, {}, code, options.model);
  if (!file) { return code; }
  const radiosity::PrepareResult preparation = radiosity::prepare(file->scene);
  if (!preparation.prepared) {
    complain_of(options.scene, preparation.faults);
    return ExitCode::invalid_input;
  }
  return print(summary(*file, *preparation.prepared, options.scene)) ? ExitCode::ok : ExitCode::failure;
}

}  // namespace

Command info_command() {
  const auto options = std::make_shared<InfoOptions>();
  return {"info", "say what is in a scene without solving it", with_model_arguments({scene_argument(options->scene)}, options->model),
          [options] { return run(*options); }};
}

}  // namespace apps
