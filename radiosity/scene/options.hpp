// SPDX-License-Identifier: MIT
#pragma once

// The options of a run. Every number is dimensionless, so scaling or moving a scene does not change the result.

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

// How the faces of an object are connected: neighbours share vertices, or each face is a separate polygon, the root of a classical
// quad-tree (polygons.hpp).
enum class Topology { shared, separate };
enum class Solver { conjugate_gradients, jacobi, gauss_seidel, southwell };
inline constexpr const char* name(Solver solver) {
  constexpr const char* names[] = {"cg", "jacobi", "gauss-seidel", "southwell"};
  return names[static_cast<int>(solver)];
}
// How the light between surfaces that are not lamps is carried in F-refinement: by links chosen by form factor, or by links made of
// stored rays (rays/ray_links.hpp). The light of lamps is carried by links in either case.
enum class Indirect { automatic, links, rays };
inline constexpr const char* name(Indirect indirect) {
  constexpr const char* names[] = {"auto", "links", "rays"};
  return names[static_cast<int>(indirect)];
}
enum class Refinement { a_posteriori, a_priori };  // BF- and F-refinement (paper 4.4)
// Paper fig. 5; simple ignores the normals (figs. 6-8); constant shows the solution itself, one colour per leaf; none: no picture is
// wanted, the mesh is as with constant, and errors are those of the leaves.
enum class Reconstruction { weighted, simple, constant, none };
inline constexpr const char* name(Reconstruction reconstruction) {
  constexpr const char* names[] = {"weighted", "simple", "constant", "none"};
  return names[static_cast<int>(reconstruction)];
}

struct Options {
  Refinement refinement = Refinement::a_priori;
  // BF-refinement continues until the estimated relative L2 error is at most this.
  double target = 0.02;
  // Instead of `target`: BF-refinement ends after this many seconds (wall time). The most promising links come first; the result is the
  // best so far. This is the only option that makes a result depend on the machine. The audit takes additional time.
  std::optional<double> time = {};
  // F-refinement (paper 4.4): a pair is linked when its estimated form factor is at most epsilon.
  double epsilon = 0.005;
  // The smallest patch that the form factor of a pair may require, as a share of the scene's area (without lamps and black surfaces:
  // oracle/lit_faces.hpp). A pair is linked if neither patch is larger than four times this, because its quarters would be smaller. If
  // lamps light only a spot of a large scene whose other light goes by stored rays, it is a share of about the lit area
  // (detail::lit_part).
  double min_area = 6e-5;
  // A patch lit by a lamp is also split while the lamp's light varies across it by more than this share of the relative L2 error. (The
  // error is relative to the reflected light, if that is less than a quarter as bright as the mean emission: audit/reflected_light.hpp.)
  // Patches are split down to a quarter of min_area, because shadows have sharper edges than all other light; less, by the square of the
  // ratio, if this is below a quarter of epsilon. Default: a quarter of epsilon. Leaves above min_area are split once more, to a quarter
  // of this (refinement/leaf_splits.hpp).
  std::optional<double> light_epsilon = {};
  // Accuracy target: `target`, or epsilon and min_area, are reduced round by round until the audited relative L2 error is at most this:
  // that of the picture if Control::picture_error is given, otherwise that over all surfaces. Also ends when the budget of links, work or
  // memory is used up, or when there is no more gain (audit/accuracy_target.hpp).
  std::optional<double> error = {};
  // Of one round towards `error`: rays that its audit may take from the reserve that all rounds share (audit/audit_effort.hpp). Set by the
  // run itself.
  std::uint64_t audit_reserve = 0;

  // Makes a second mesh, with gathered light (picture/mesh_refiner.hpp), whose faces are split until the relative L2 error of its colours
  // is at most this: Solution::refined. Requires shared topology and a reconstruction with colours at the corners.
  std::optional<double> mesh_error = {};

  // Automatic: by rays from some 100 input faces on, if most light is reflected close beside a lamp, and if Control::viewpoint is in a room
  // that is dim beside the rest of the scene (ray_choice.hpp).
  Indirect indirect = Indirect::automatic;

  // An oracle that refinement asks instead of its own (oracle.hpp states the contract). In F-refinement it replaces the rule with
  // epsilon; the light oracle is asked after it. In BF-refinement it chooses which end of a link with a large error is split; the first,
  // coarse links do not depend on it.
  std::function<Decision(const Question&)> oracle = {};
  // Splits the faces of leaves, instead of regular refinement (meshing.hpp).
  std::function<ChildFaces(const LeafFace&)> meshing = {};
  // If above 0: the faces of flat objects are cut along shadow edges and across their direct light (discontinuity/) instead of by regular
  // refinement, with at most this many shadow edges per face. Requires shared topology and no user-defined `meshing`.
  std::uint32_t discontinuities = 0;

  // Makes the ray caster that is used instead of the library's own (raycast::Scene::ask), for objects compiled in this frame.
  std::function<raycast::OtherCaster(const raycast::Scene&, const Frame&)> caster = {};

  // Number of input faces from which on clusters are built above them; below, all pairs of input faces are examined.
  std::uint32_t cluster_from = 300;

  Solver solver = Solver::conjugate_gradients;
  double residual = 1e-8;  // wanted residual, relative to that of B = E, the light that is reflected first
  std::uint32_t max_iterations = 1000;
  Reconstruction reconstruction = Reconstruction::weighted;
  bool shortcuts = true;  // false: what the plan proves to be unnecessary (plan.hpp) is done all the same, with the same result
  Topology topology = Topology::shared;
  // For studies: adds a Comparison (comparison.hpp) to the solution, with a dense solution if there are at most this many leaves.
  std::optional<std::uint32_t> compare = {};

  std::uint32_t audit_points = 2000;  // approximate number of points of the audit (audit_effort.hpp); 0: no audit
  unsigned threads = 0;               // 0: as many as the machine has; results do not depend on it
  // Limit of the bytes that the run may take, in addition to what the process holds at its beginning; predicted from the numbers of
  // nodes, links and pairs before they are made (memory.hpp). A run that would need more ends with the best solution that fits and
  // reports it in audit.shortage: that of the last generation of BF-refinement, of the last round towards an error target, or of
  // F-refinement with larger epsilon and min_area (audit.coarsened). If not even the coarsest solution fits, there is none
  // (Failure::Kind::out_of_memory). If none is set, allowed_memory() is taken.
  std::optional<std::uint64_t> memory = {};
  // Memory for the arrays that grow with nodes, links, pairs and rays, including those of the Solution (big_array.hpp); null: the heap.
  // It must outlive the Solution and is used by several threads at once. BReps, contours and the mesh stay on the heap.
  std::pmr::memory_resource* arrays = nullptr;
  std::uint64_t seed = 1;

  // The limit on memory that holds: `memory`, or else 2 GB for a run towards an accuracy, which may be out of reach: the light of a lamp a
  // millimetre from a wall would be refined endlessly. Nothing: no limit.
  [[nodiscard]] std::optional<std::uint64_t> allowed_memory() const {
    const bool towards_accuracy = error || (refinement == Refinement::a_posteriori && !time);
    return memory || !towards_accuracy ? memory : std::optional(memory_towards_accuracy);
  }
  static constexpr std::uint64_t memory_towards_accuracy = 2'000'000'000;
};

// One sentence for every invalid option; empty if a run can begin.
[[nodiscard]] std::vector<std::string> faults(const Options& options);

// A camera, for errors weighted by its picture.
struct Viewpoint {
  glm::dvec3 eye{0.0};  // in scene coordinates, like all vectors here
  // The share of the picture that a unit of area takes at a position with this normal if nothing hides it; 0 outside the picture.
  std::function<double(const glm::dvec3& position, const glm::dvec3& normal)> share;
  // The share of the picture of one pixel, in the same unit; 0: pixels are points.
  double pixel = 0.0;
};

// Lets the caller watch and stop a run. `progress` is called from the thread that called solve().
struct Control {
  // Once true, the run ends soon: with the best solution so far, marked by audit.interrupted, or, before the first generation of
  // refinement, with Failure::Kind::cancelled. BF-refinement has a solution after each generation, an error target after each round.
  // F-refinement has one once all links are evaluated; before that it makes coarse links between the existing patches (audit.coarsened),
  // which takes up to a second with a thousand input faces, some seconds with 70 000. The rest is then solved by conjugate gradients,
  // whatever solver was requested, and there is no audit.
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(std::string_view stage, double fraction)> progress;
  // Called with the valid BReps of all objects after each generation of refinement.
  std::function<void(const std::vector<Surface>&)> after_generation;
  // Measures the error of the picture that will be made of a mesh (in scene coordinates and W/m2) of a solution with this frame
  // (picture_error.hpp). If set, an error target refers to the picture. Returns nothing if the error cannot be measured.
  std::function<std::optional<PictureError>(const Mesh&, const Frame&, const AuditGoal&)> picture_error;

  // Called in each generation of F-refinement, before anything is split, with the pairs that were examined and the decision about each,
  // in order. Also called after the evaluation of links, with the links that are split by their light (refinement/link_splits.hpp) and
  // the pairs that replace them. Costs nothing if not set.
  std::function<void(const Question&, Decision)> decided = {};

  // If set, only pictures from here are wanted: with stored rays, what matters for them is resolved more finely
  // (rays/view_importance.hpp), and with Options::mesh_error the error of the mesh is that of its picture.
  std::optional<Viewpoint> viewpoint = {};

  [[nodiscard]] bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  // A copy that nothing can cancel.
  [[nodiscard]] Control unstoppable() const { return {nullptr, progress, after_generation, picture_error, decided, viewpoint}; }
  void report(std::string_view stage, double fraction) const {
    if (progress) { progress(stage, fraction); }
  }
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/scene/options.cpp>
#endif
