// SPDX-License-Identifier: MIT
#include <radiosity/bake/bake.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/bake/own_rays.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/number_text.hpp>

namespace radiosity {

namespace baking::detail {

inline BakeOutcome refused(std::vector<std::string> sentences, Failure::Kind kind = Failure::Kind::invalid_scene) {
  return {std::nullopt, {kind, std::move(sentences)}};
}

// As bake(), except that std::bad_alloc may be thrown.
inline BakeOutcome bake_within_memory(const PolygonView& mesh, std::span<const Material> materials, const BakeOptions& options,
                                      const Control& control) {
  std::vector<std::string> sentences;
  for (const Material& material : materials) {
    if (auto sentence = fault(material)) { sentences.push_back(std::move(*sentence)); }
  }
  if (materials.empty()) { sentences.emplace_back("there are no materials"); }
  if (!sentences.empty()) { return refused(std::move(sentences)); }
  if (!(options.intake.weld >= 0.0 && options.intake.weld <= largest_weld)) {
    return refused({"weld is " + number_text(options.intake.weld) + "; it lies in [0, 0.01]"}, Failure::Kind::invalid_options);
  }
  Scene scene{{materials.begin(), materials.end()}, {}};
  Intake intake = take_in(mesh, materials, options.intake);
  if (intake.objects.empty()) {
    sentences.emplace_back("there is no polygon with an area");
    for (const Change& change : intake.changes) {
      sentences.push_back(sentence(change) + ", first number " + std::to_string(change.first));
    }
    return refused(std::move(sentences));
  }
  scene.objects = std::move(intake.objects);
  Options settings = options.solve;
  if (settings.reconstruction == Reconstruction::none) { settings.reconstruction = Reconstruction::weighted; }
  if (options.rays) {
    settings.caster = [&, skin = skin_of(options.rays, mesh, options.intake.weld)](const raycast::Scene& objects, const Frame& frame) {
      return caster_of(options.rays, intake.parts, skin, objects, frame);
    };
  }
  Outcome outcome = solve(scene, settings, control);
  if (!outcome.solution) { return {std::nullopt, std::move(outcome.failure)}; }
  BakeOutcome result;
  Baked& baked = result.baked.emplace();
  baked.light = BakedLight(scene, *outcome.solution, std::move(intake.parts));
  baked.colors = baked_colors(baked.light, mesh);
  baked.audit = std::move(outcome.solution->audit);
  baked.changes = std::move(intake.changes);
  baked.faces = intake.faces;
  return result;
}

}  // namespace baking::detail

HALFLIGHT_INLINE BakeOutcome bake(const PolygonView& mesh, std::span<const Material> materials, const BakeOptions& options,
                                  const Control& control) {
  return radiosity::detail::unless_out_of_memory([&] { return baking::detail::bake_within_memory(mesh, materials, options, control); });
}

HALFLIGHT_INLINE BakeOutcome bake(const MeshView& mesh, const BakeOptions& options, const Control& control) {
  return radiosity::detail::unless_out_of_memory([&]() -> BakeOutcome {
    const std::size_t triangles = mesh.indices.size() / 3;
    if (mesh.stride < 3 || mesh.indices.size() % 3 != 0) {
      return baking::detail::refused({mesh.stride < 3
                                          ? "the stride of the positions is " + std::to_string(mesh.stride) + "; a vertex has three numbers"
                                          : "there are " + std::to_string(mesh.indices.size()) + " indices; a triangle has three"});
    }
    if (const std::size_t rest = mesh.positions.size() % mesh.stride; rest == 1 || rest == 2) {
      return baking::detail::refused({"there are " + std::to_string(mesh.positions.size()) + " numbers of positions, " +
                                      std::to_string(mesh.stride) + " a vertex; the last vertex lacks some of its three"});
    }
    if (!mesh.material.empty() && mesh.material.size() != triangles) {
      return baking::detail::refused(
          {"there are " + std::to_string(triangles) + " triangles, and materials of " + std::to_string(mesh.material.size())});
    }
    std::vector<glm::dvec3> positions;
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += mesh.stride) {
      positions.emplace_back(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    }
    std::vector<std::uint32_t> first(triangles + 1), material(mesh.material.begin(), mesh.material.end());
    for (std::size_t t = 0; t <= triangles; ++t) { first[t] = static_cast<std::uint32_t>(3 * t); }
    material.resize(triangles, 0);
    return bake({positions, mesh.indices, first, material}, mesh.materials, options, control);
  });
}

}  // namespace radiosity
