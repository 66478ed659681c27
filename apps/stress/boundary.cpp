// SPDX-License-Identifier: MIT
// Faulty shells and normals, and occlusion.
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include "apps/stress/case.hpp"

namespace apps::stress {
namespace {

const std::vector<glm::dvec3> cube_corners{{0.3, 0.3, 0.3}, {0.6, 0.3, 0.3}, {0.6, 0.6, 0.3}, {0.3, 0.6, 0.3},
                                           {0.3, 0.3, 0.6}, {0.6, 0.3, 0.6}, {0.6, 0.6, 0.6}, {0.3, 0.6, 0.6}};
const std::vector<std::vector<std::uint32_t>> cube_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::vector<std::vector<std::uint32_t>> reversed(std::vector<std::vector<std::uint32_t>> faces) {
  for (auto& face : faces) { std::reverse(face.begin(), face.end()); }
  return faces;
}

constexpr Case cases_of_boundary[] = {
    {"inverted", "normals the wrong way",
     "a solid inside out cannot be meant and is refused; an open shell may be seen from either side, so it is solved with a warning",
     [](Findings& findings) {
       findings.refuse("closed mesh inside out", raycast::Mesh::make(cube_corners, reversed(cube_faces)).refusal, "inside out");
       auto one = cube_faces;
       std::reverse(one[1].begin(), one[1].end());
       findings.refuse("one face of a mesh the other way round", raycast::Mesh::make(cube_corners, one).refusal, "f");
       // An open mesh inside out is legal: a pot seen from within.
       auto pot = cube_faces;
       pot.erase(pot.begin() + 1);
       Scene scene = room_with_box();
       scene.objects[1] = object("pot", raycast::Mesh::make(cube_corners, reversed(pot)).object);
       const Solution solution = findings.solve(scene, coarse());
       findings.warned("open mesh inside out", solution, "open shell with 4 open edges");
       findings.at_least("rays to its black back, fraction", solution.audit.stray ? solution.audit.stray->to_backs : 0.0, 0.01);
     }},
    {"open", "open shells and plates", "surfaces are one-sided: backs are black, and how much light meets them or leaves is reported",
     [](Findings& findings) {
       auto faces = cube_faces;
       faces.erase(faces.begin());
       faces.erase(faces.begin());
       Scene scene = two_plates(0.5);
       scene.objects.push_back(object("tube", raycast::Mesh::make(cube_corners, faces).object, 1));
       const Solution solution = findings.solve(scene, coarse());
       findings.warned("tube without lids", solution, "open shell with 8 open edges");
       findings.at_least("rays from surfaces to nothing, fraction", solution.audit.stray ? solution.audit.stray->escaping : 0.0, 0.5);
       findings.at_least("emitted light that escapes, fraction", solution.audit.escaped, 0.5);
       // Plates are lit on one side only.
       Scene away = two_plates(0.5);
       away.objects.push_back(square("above", {0.5, 0.5, 1.5}, 0.5, true, 1));
       away.objects.push_back(square("below", {0.5, 0.5, -0.5}, 0.5, true, 1));
       const Solution dark = findings.solve(away, coarse());
       findings.exactly("plate behind a plate: B", mean(dark, "above"), 0.0);
       findings.exactly("plate behind the lamp: B", mean(dark, "below"), 0.0);
       findings.at_least("rays to black backs, fraction", dark.audit.stray ? dark.audit.stray->to_backs : 0.0, 0.01);
     }},
    {"inside", "an object inside another", "nothing shows of it, so it is dark and changes nothing; the run says so",
     [](Findings& findings) {
       Scene scene = room_with_box();
       const Solution without = findings.solve(scene, coarse());
       scene.objects.push_back(object("hidden", box({0.35, 0.25, 0.1}, {0.5, 0.4, 0.3})));
       const Solution solution = findings.solve(scene, coarse());
       findings.warned("box in a box", solution, "'hidden' is buried");
       findings.exactly("box in a box: B", mean(solution, "hidden.x0"), 0.0);
       findings.at_most("box in a box: the room against without, relative", relative(mean(solution, "room.z0"), mean(without, "room.z0")),
                        1e-2);
       Scene lamp = room_with_box();
       lamp.objects.push_back(object("hidden lamp", raycast::Sphere::make({0.45, 0.35, 0.25}, 0.1).object, 1));
       const Solution lit = findings.solve(lamp, coarse());
       findings.at_most("a lamp in the box: the room against without, relative", relative(mean(lit, "room.z0"), mean(without, "room.z0")),
                        1e-2);
     }},
    {"hidden", "a lamp wholly covered, a lamp just below the ceiling", "what one convex object hides is proven dark, without a ray",
     [](Findings& findings) {
       Scene capped = two_plates(0.5);
       capped.objects.push_back(object("cap", box({-1.0, -1.0, 0.5}, {2.0, 2.0, 0.6}), 1));
       const Solution solution = findings.solve(capped, coarse());
       findings.exactly("plate behind a slab: B", mean(solution, "upper"), 0.0);
       // With the lamp a thousandth below the ceiling, the room is not proven closed, and its row sums are not corrected.
       const Scene flush = room_with_box();
       Scene hung = flush;
       hung.objects[2] = square("lamp", {0.5, 0.5, 0.999}, 0.15, false, 1);
       const Solution a = findings.solve(flush, finer());
       const Solution b = findings.solve(hung, finer());
       double off = 0.0;
       for (const char* name : {"room.z0", "room.x0", "box.z1"}) { off = std::max(off, relative(mean(b, name), mean(a, name))); }
       findings.at_most("lamp 1e-3 below the ceiling against in it, relative", off, 0.02);
     }},
    {"concave", "solids that shadow themselves", "spans tell a ray that leaves its own solid from one that meets it again",
     [](Findings& findings) {
       Scene scene = furnace_cube(0.9);
       scene.objects.push_back(object("ring", raycast::Torus::make({0.5, 0.5, 0.3}, {0, 0, 1}, 0.25, 0.1).object));
       scene.objects.push_back(object("pinched", raycast::Superquadric::make({0.5, 0.5, 0.7}, {0.2, 0.2, 0.2}, 2.5, 2.5).object));
       findings.at_most("furnace: |B - 1|", worst(findings.solve(scene, coarse()), 1.0), 1e-3);
     }},
};

}  // namespace

std::span<const Case> boundary_cases() { return cases_of_boundary; }

}  // namespace apps::stress
