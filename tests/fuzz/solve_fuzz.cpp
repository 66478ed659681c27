// SPDX-License-Identifier: MIT
// libFuzzer target: the input is read as a small scene of every kind of object, booleans of curved solids and open meshes among them, with
// sizes from 1e-12 to 1e6, and solved under a small budget. Laws of any outcome:
//
//   a refusal says why
//   areas and radiosities are finite, areas and what CG, Gauss-Seidel or Southwell find are not negative beyond the residual
//   B <= E_max / (1 - rho_max s) with s the largest row sum: no solution has more energy than its lamps give it
//   two threads give the bits of one; what the shortcuts leave out changes no bit, or, without reflected light, B = E
//
// A run may end for want of time or memory: that is an outcome, too.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <brep/finite.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/box.hpp>
#include <raycast/objects/cone.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace {

using Shape = std::shared_ptr<const raycast::Object>;

void require(bool holds, const char* law) {
  if (holds) { return; }
  std::fprintf(stderr, "broken: %s\n", law);
  std::abort();
}

// The input, byte by byte; zeros at its end.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_{data}, left_{size} {}

  std::uint32_t below(std::uint32_t count) {
    if (left_ == 0) { return 0; }
    --left_;
    return *data_++ % count;
  }
  bool one_in(std::uint32_t count) { return below(count) == count - 1; }
  // A coordinate or a length: mostly a small multiple of 1/4, sometimes what is hard.
  double number() {
    constexpr double hard[] = {1e-12, 1e-7, 1e-3, 1e3, 1e6, 1.0 / 3.0, 1.0 + 1e-9, 1.0 - 0x1p-53, 0.1 + 0.2};
    const std::uint32_t choice = below(40);
    if (choice < std::size(hard)) { return hard[choice]; }
    return choice < 14 ? -0.25 * below(9) : 0.25 * below(9);
  }
  glm::dvec3 point() {
    const double x = number(), y = number();
    return {x, y, number()};
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

Shape solid(Choices& choices, int depth) {
  const std::uint32_t kind = choices.below(depth < 2 ? 9 : 6);
  const glm::dvec3 at = choices.point(), size = choices.point();
  switch (kind) {
    case 0:
      return raycast::BoxObject::make(at, at + glm::abs(size)).object;
    case 1:
      return raycast::Sphere::make(at, size.x).object;
    case 2:
      return raycast::Cylinder::make(at, size, choices.number()).object;
    case 3: {
      const double base = choices.number();
      return raycast::Cone::make(at, size, base, choices.number()).object;
    }
    case 4: {
      const double ring = choices.number();
      return raycast::Torus::make(at, size, ring, choices.number()).object;
    }
    case 5: {
      const double first = choices.number(), second = choices.number();
      return raycast::Superquadric::make(at, size, first, second, choices.one_in(3) ? choices.number() : 0.0).object;
    }
    default: {
      raycast::CsgNode node;
      node.operation = static_cast<raycast::CsgOperation>(kind - 6);
      for (std::uint32_t parts = 1 + choices.below(3); parts > 0; --parts) {
        raycast::CsgNode leaf;
        leaf.solid = solid(choices, depth + 1);
        if (!leaf.solid) { return nullptr; }
        leaf.name = "part " + std::to_string(parts);
        node.parts.push_back(std::move(leaf));
      }
      return raycast::Csg::make(node).object;
    }
  }
}

Shape shape(Choices& choices) {
  switch (choices.below(8)) {
    case 0: {
      std::vector<glm::dvec3> corners;
      const std::uint32_t axis = choices.below(4);
      const double height = choices.number();
      for (std::uint32_t count = 3 + choices.below(5); count > 0; --count) {
        corners.push_back(choices.point());
        if (axis < 3) { corners.back()[static_cast<int>(axis)] = height; }
      }
      return raycast::Polygon::make(std::move(corners)).object;
    }
    case 1: {
      const glm::dvec3 centre = choices.point(), normal = choices.point();
      return raycast::Disk::make(centre, normal, choices.number()).object;
    }
    case 2: {
      std::vector<glm::dvec3> vertices;
      for (std::uint32_t count = 4 + choices.below(4); count > 0; --count) { vertices.push_back(choices.point()); }
      std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
      if (choices.one_in(2)) {
        for (std::vector<std::uint32_t>& face : faces) {
          for (std::uint32_t& corner : face) { corner = choices.below(static_cast<std::uint32_t>(vertices.size())); }
        }
      }
      return raycast::Mesh::make(vertices, faces).object;
    }
    default:
      return solid(choices, 0);
  }
}

radiosity::Scene scene_of(Choices& choices) {
  constexpr double reflectances[] = {0.0, 0.5, 0.9, 0.99, 1.0, 0.3}, emissions[] = {0.0, 1.0, 17.0, 0.0};
  radiosity::Scene scene;
  for (int m = 0; m < 3; ++m) {
    radiosity::Material material;
    material.name = "material";
    for (int c = 0; c < 3; ++c) {
      material.reflectance[c] = reflectances[choices.below(6)];
      material.emission[c] = emissions[choices.below(4)];
    }
    scene.materials.push_back(material);
  }
  const auto add = [&](Shape of, bool inside) {
    radiosity::SceneObject object;
    object.name = "object " + std::to_string(scene.objects.size());
    object.material = {choices.below(3)};
    object.placement.inside = inside;
    object.shape = std::move(of);
    scene.objects.push_back(std::move(object));
  };
  if (choices.one_in(2)) { add(raycast::BoxObject::make(glm::dvec3{-1.0}, glm::dvec3{3.0}).object, true); }
  for (std::uint32_t count = 1 + choices.below(4); count > 0; --count) {
    if (const Shape of = shape(choices)) { add(of, of->solid() && choices.one_in(8)); }
    if (choices.one_in(12) && !scene.objects.empty()) { scene.objects.push_back(radiosity::SceneObject{scene.objects.back()}); }
  }
  return scene;
}

radiosity::Options options_of(Choices& choices) {
  radiosity::Options options{.epsilon = 0.1 + 0.1 * choices.below(6),
                             .min_area = 0.01 * (1 + choices.below(8)),
                             .cluster_from = choices.one_in(2) ? 2U : 300U,
                             .solver = static_cast<radiosity::Solver>(choices.below(4)),
                             .reconstruction = static_cast<radiosity::Reconstruction>(choices.below(4)),
                             .topology = choices.one_in(4) ? radiosity::Topology::separate : radiosity::Topology::shared,
                             .audit_points = choices.one_in(4) ? 8U : 0U,
                             .threads = 1};
  if (choices.one_in(3)) {
    options.refinement = radiosity::Refinement::a_posteriori;
    options.target = 0.1 + 0.1 * choices.below(4);
  }
  options.indirect = static_cast<radiosity::Indirect>(choices.below(3));  // rays are refused where links are gone through one by one
  options.max_iterations = 200;
  options.memory = 100'000'000;
  return options;
}

double largest(const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); }
double least(const glm::dvec3& c) { return std::min({c.x, c.y, c.z}); }

void check_solution(const radiosity::Scene& scene, const radiosity::Options& options, const radiosity::Solution& solution) {
  const radiosity::Audit& audit = solution.audit;
  double emission = 0.0, reflectance = 0.0, brightest = 0.0, darkest = 0.0;
  for (const radiosity::InputSurface& input : radiosity::surfaces(scene)) {
    emission = std::max(emission, largest(scene.materials[input.material].emission));
    reflectance = std::max(reflectance, largest(scene.materials[input.material].reflectance));
  }
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    require(std::isfinite(solution.area[i]) && solution.area[i] >= 0.0, "areas are finite and not negative");
    require(brep::is_finite(solution.radiosity[i]), "radiosities are finite");
    if (!solution.hierarchy[i].leaf() || !(solution.area[i] > 0.0)) { continue; }
    brightest = std::max(brightest, largest(solution.radiosity[i]));
    darkest = std::min(darkest, least(solution.radiosity[i]));
  }
  require(std::isfinite(audit.energy_balance) && std::isfinite(audit.escaped) && std::isfinite(audit.residual), "the audit is finite");
  if (audit.leaf_error) { require(std::isfinite(audit.leaf_error->relative_l2), "the error is finite"); }
  for (const glm::dvec3& p : solution.mesh.positions) { require(brep::is_finite(p), "positions are finite"); }
  for (const radiosity::MeshCorner& corner : solution.mesh.corners) { require(brep::is_finite(corner.radiosity), "colours are finite"); }
  if (!audit.converged) { return; }
  // The links' slopes may send a little less than nothing into a corner that hardly sees the lamp.
  if (options.solver != radiosity::Solver::jacobi) { require(darkest >= -1e-2 * brightest, "radiosities are not negative"); }
  const double left = 1.0 - reflectance * audit.row_sum.max;
  if (left > 1e-3) { require(brightest <= emission / left * (1.0 + 1e-6), "B <= E / (1 - rho s)"); }
}

// Where no light is reflected nothing is refined, unless nothing is left out: then B = E on other leaves.
void check_own_light(const radiosity::Scene& scene, const radiosity::Solution& solution) {
  const std::vector<radiosity::InputSurface> inputs = radiosity::surfaces(scene);
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    const radiosity::Node& node = solution.hierarchy[i];
    if (!node.leaf() || !(solution.area[i] > 0.0)) { continue; }
    const glm::dvec3& emission = scene.materials[inputs[node.surface].material].emission;
    const double error = largest(glm::abs(solution.radiosity[i] - emission));
    require(error <= 1e-6 * largest(emission), "without reflected light B = E");  // a solver ends at a residual of 1e-8
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, std::min<std::size_t>(size, 400));
  radiosity::Options options = options_of(choices);
  const std::uint32_t comparison = choices.below(6);
  const radiosity::Scene scene = scene_of(choices);
  std::atomic<bool> cancel{false};
  radiosity::Control control;
  control.cancel = &cancel;
  control.progress = [](std::string_view, double part) { require(part >= 0.0 && part <= 1.0 + 1e-9, "progress lies between 0 and 1"); };
  const std::jthread watcher{[&](const std::stop_token& done) {
    std::mutex mutex;
    std::unique_lock lock{mutex};
    std::condition_variable_any ended;
    if (!ended.wait_for(lock, done, std::chrono::seconds(2), [&] { return done.stop_requested(); })) { cancel = true; }
  }};
  const radiosity::Outcome outcome = radiosity::solve(scene, options, control);
  if (!outcome.solution) {
    require(!outcome.failure.sentences.empty(), "a refusal says why");
    require((outcome.failure.kind == radiosity::Failure::Kind::cancelled) <= cancel, "nobody cancelled");
    return 0;
  }
  check_solution(scene, options, *outcome.solution);
  if (cancel || !outcome.solution->audit.shortage.empty()) { return 0; }
  if (comparison == 0) {
    options.threads = 2;
    const radiosity::Outcome again = radiosity::solve(scene, options, control);
    if (cancel) { return 0; }
    require(again.solution && again.solution->radiosity == outcome.solution->radiosity, "two threads give the bits of one");
  }
  if (comparison == 1) {
    options.shortcuts = false;
    const radiosity::Outcome again = radiosity::solve(scene, options, control);
    const bool short_of_memory =
        again.solution ? !again.solution->audit.shortage.empty() : again.failure.kind == radiosity::Failure::Kind::out_of_memory;
    if (cancel || short_of_memory) { return 0; }  // what is left out takes none
    require(again.solution.has_value(), "what is left out was not needed");
    if (outcome.solution->links.empty() && again.solution->radiosity.size() != outcome.solution->radiosity.size()) {
      check_own_light(scene, *again.solution);
    } else {
      require(again.solution->radiosity == outcome.solution->radiosity, "what is left out changes no bit");
    }
  }
  return 0;
}
