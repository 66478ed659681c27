// SPDX-License-Identifier: MIT
#pragma once

// What a run may be told. Every number is dimensionless: a scene that is scaled or moved gives the same result.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace raycast {
class Scene;
struct OtherCaster;
}  // namespace raycast

namespace radiosity {

struct Surface;
struct Mesh;
struct Frame;
struct AuditGoal;
struct PictureError;
struct Question;
struct LeafFace;
struct ChildFaces;
enum class Decision : unsigned char;

// How the faces of an object hang together: neighbours share their vertices, or each is a polygon of its own, the root of a classical
// quad-tree (polygons.hpp).
enum class Topology { shared, separate };
enum class Solver { conjugate_gradients, jacobi, gauss_seidel, southwell };
inline constexpr const char* name(Solver solver) {
  constexpr const char* names[] = {"cg", "jacobi", "gauss-seidel", "southwell"};
  return names[static_cast<int>(solver)];
}
// How the light between surfaces that do not shine travels after F-refinement: over links that are chosen by form factor, or over links
// made of stored rays (rays/ray_links.hpp). Lamps have links in either case.
enum class Indirect { automatic, links, rays };
inline constexpr const char* name(Indirect indirect) {
  constexpr const char* names[] = {"auto", "links", "rays"};
  return names[static_cast<int>(indirect)];
}
enum class Refinement { a_posteriori, a_priori };  // BF- and F-refinement (paper 4.4)
// Paper fig. 5; simple ignores the normals (figs. 6-8); constant shows the solution itself, one colour a leaf; none: nobody asks for a
// picture, the mesh is as with constant and errors are those of the leaves.
enum class Reconstruction { weighted, simple, constant, none };
inline constexpr const char* name(Reconstruction reconstruction) {
  constexpr const char* names[] = {"weighted", "simple", "constant", "none"};
  return names[static_cast<int>(reconstruction)];
}

struct Options {
  Refinement refinement = Refinement::a_priori;
  // BF-refinement goes on until the estimated relative L2 error is at most this.
  double target = 0.02;
  // In place of `target`: BF-refinement ends after this many seconds (wall). Links that promise most come first; the result is the best so
  // far. It is the only option by which a result depends on the machine. The audit comes on top.
  std::optional<double> time;
  // F-refinement (paper 4.4): a pair is linked when its estimated form factor is at most epsilon.
  double epsilon = 0.005;
  // The smallest patch, as a share of the area of the scene (without lamps and what is black: oracle/lit_faces.hpp), that a pair may ask
  // for by its form factor: a pair is also linked when neither is larger than four times this, for its quarters would be smaller. Where
  // lamps light but a spot of a large scene, whose other light goes by stored rays, it is a share of about what they light
  // (detail::lit_part).
  double min_area = 6e-5;
  // Where a light shines a patch is split, too, while the light varies across it by more than this share of the relative L2 error (which is
  // relative to the reflected light, where that is less than a quarter as bright as the mean emission: audit/reflected_light.hpp); down
  // to a quarter of min_area, for shadows have sharper edges than all other light, or below by the square of what this is finer than a
  // quarter of epsilon. Default: a quarter of epsilon. Leaves above min_area are split once more, to a quarter of this
  // (refinement/leaf_splits.hpp).
  std::optional<double> light_epsilon;
  // Accuracy target: target, or epsilon and min_area, fall round by round until the audited relative L2 error is at most this: that of the
  // picture when Control::picture_error is given, else that over all surfaces. Ends, too, when it has taken its budget of links, work or
  // memory, or gains no more (audit/accuracy_target.hpp).
  std::optional<double> error;

  // The mesh is made once more in gathered light (picture/mesh_refiner.hpp), with faces split until its colours are off by at most this
  // relative L2 error: Solution::refined. Needs faces that share their vertices, and colours at these.
  std::optional<double> mesh_error;

  // Automatic: rays from some 100 input faces on, and where most light is reflected close beside a lamp (ray_choice.hpp).
  Indirect indirect = Indirect::automatic;

  // Refinement asks this oracle (oracle.hpp: what it is asked, and what it must promise) in place of its own. Of F-refinement that is the
  // one of epsilon; the light oracle is asked after it. Of BF-refinement it is the one that chooses which end of a link with a large error
  // is split; the first, coarse links are made as ever.
  std::function<Decision(const Question&)> oracle;
  // This splits the faces of leaves, in place of regular refinement (meshing.hpp).
  std::function<ChildFaces(const LeafFace&)> meshing;
  // Above 0: the faces of flat objects are cut along the edges of shadows and across their direct light (discontinuity/) in place of
  // regular refinement, and at most so many such edges are imprinted on each. Needs shared topology and no strategy of the user.
  std::uint32_t discontinuities = 0;

  // Makes the ray caster that answers in place of the library's own (raycast::Scene::ask), for objects that are compiled in this frame.
  std::function<raycast::OtherCaster(const raycast::Scene&, const Frame&)> caster;

  // Input faces from which on clusters are built above them; below, all pairs of input faces are looked at.
  std::uint32_t cluster_from = 300;

  Solver solver = Solver::conjugate_gradients;
  double residual = 1e-8;  // wanted, relative to that of B = E: the light that is reflected first
  std::uint32_t max_iterations = 1000;
  Reconstruction reconstruction = Reconstruction::weighted;
  bool shortcuts = true;  // false: what the plan proves needless (plan.hpp) is done all the same, for the same result
  Topology topology = Topology::shared;
  // For studies: the solution brings a Comparison (comparison.hpp), with a dense solution when it has no more leaves than this.
  std::optional<std::uint32_t> compare;

  std::uint32_t audit_points = 2000;  // about, at which the error is measured (audit_effort.hpp: and its cost); 0: no error estimate
  unsigned threads = 0;               // 0: as many as the machine has; results do not depend on it
  // Bytes that the run may take on top of what the process holds when it begins, predicted from the numbers of nodes, links and pairs
  // before they are made (memory.hpp). A run that would need more ends with the best solution that fits, which says so by audit.shortage:
  // that of the last generation of BF-refinement, of the last round to an error target, or of F-refinement with epsilon and min_area as
  // large as they must be (audit.coarsened). Where not even the coarsest fits there is none (Failure::Kind::out_of_memory).
  std::optional<std::uint64_t> memory;
  // Where the arrays lie that grow with nodes, links, pairs and rays, those of the Solution among them (big_array.hpp); null: on the heap.
  // It must outlive the Solution, and is used by several threads at once. What is left on the heap: BReps, contours, the mesh.
  std::pmr::memory_resource* arrays = nullptr;
  std::uint64_t seed = 1;
};

// A sentence for every option that makes no sense; empty when a run can begin.
[[nodiscard]] std::vector<std::string> faults(const Options& options);

// A camera, for errors that count by its picture.
struct Viewpoint {
  glm::dvec3 eye{0.0};  // in the scene's coordinates, as all here
  // How much of the picture a unit of area takes at a position with this normal, if nothing stands between; 0 for what is not in the
  // picture.
  std::function<double(const glm::dvec3& position, const glm::dvec3& normal)> share;
  // How much of the picture a pixel takes, in the same unit; 0: its pixels are points.
  double pixel = 0.0;
};

// How the caller watches and stops a run. `progress` is called from the thread that called solve().
struct Control {
  // Once true the run ends soon: with the best solution that it has, which says so by audit.interrupted, or without
  // (Failure::Kind::cancelled) before the first generation of refinement. BF-refinement has one after each generation, an error target
  // after each round. F-refinement has it once all links are evaluated, and before makes coarse links over the patches that there are
  // (audit.coarsened): up to a second with a thousand input faces, some seconds with 70 000. What is left to solve then is solved by
  // conjugate gradients, whatever solver was asked for, and there is no audit.
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(std::string_view stage, double fraction)> progress;
  // Called with the valid BReps of all objects after each generation of refinement.
  std::function<void(const std::vector<Surface>&)> after_generation;
  // Measures the error of the picture that will be made of a mesh, in the scene's coordinates and in W/m2, of a solution with this frame
  // (picture_error.hpp): an error target is then that of the picture. Nothing when it cannot.
  std::function<std::optional<PictureError>(const Mesh&, const Frame&, const AuditGoal&)> picture_error;

  // Called in each generation of F-refinement with the pairs that were looked at and what became of each, in their order, before anything
  // is split; and once links are evaluated, with those that are split for the light that they carry (refinement/link_splits.hpp) and the
  // pairs that replace them. Nothing is kept for it: a run that nobody watches pays nothing.
  std::function<void(const Question&, Decision)> decided = {};

  // Nothing but pictures from here is wanted: with stored rays, what matters for them is resolved more finely (rays/view_importance.hpp),
  // and with Options::mesh_error the error of the mesh is that of its picture.
  std::optional<Viewpoint> viewpoint = {};

  [[nodiscard]] bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  // The same, but nothing stops the run.
  [[nodiscard]] Control unstoppable() const { return {nullptr, progress, after_generation, picture_error, decided, viewpoint}; }
  void report(std::string_view stage, double fraction) const {
    if (progress) { progress(stage, fraction); }
  }
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/scene/options.cpp>
#endif
