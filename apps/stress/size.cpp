// SPDX-License-Identifier: MIT
// Very large and small scenes, scenes far from the origin, thin objects, many objects, deep refinement.
#include <atomic>
#include <cmath>
#include <numbers>

#include <raycast/objects/mesh.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

#include "apps/stress/case.hpp"

namespace apps::stress {
namespace {

// The room with every coordinate multiplied by `scale`, moved by `offset` and rounded, as in a file.
Scene written(double scale, double offset) {
  Scene scene = room_with_box();
  const auto at = [&](double x, double y, double z) { return glm::dvec3{x, y, z} * scale + glm::dvec3{offset}; };
  scene.objects = {object("room", box(at(0, 0, 0), at(1, 1, 1)), 0, true), object("box", box(at(0.3, 0.2, 0.0), at(0.6, 0.5, 0.5))),
                   plate("lamp", {at(0.35, 0.35, 1.0), at(0.35, 0.65, 1.0), at(0.65, 0.65, 1.0), at(0.65, 0.35, 1.0)}, 1)};
  return scene;
}

// k small squares at pseudo-random places in a cube, every eighth a lamp, facing up or down alternately.
Scene cloud(std::uint32_t k) {
  Scene scene;
  scene.materials = {{"white", Color{0.5}, Color{0.0}}, {"lamp", Color{0.5}, Color{1.0}}};
  const double r = 0.3 / std::cbrt(static_cast<double>(k));
  for (std::uint32_t i = 0; i < k; ++i) {
    // Halton's sequence in bases 2, 3, 5
    glm::dvec3 at{0.0};
    const std::uint32_t bases[] = {2, 3, 5};
    for (int c = 0; c < 3; ++c) {
      double digit = 1.0;
      for (std::uint32_t n = i + 1; n > 0; n /= bases[c]) { at[c] += (digit /= bases[c]) * (n % bases[c]); }
    }
    scene.objects.push_back(square("p" + std::to_string(i), at, r, i % 2 == 0, i % 8 == 0 ? 1 : 0));
  }
  return scene;
}
constexpr std::uint32_t many = 100'000;

constexpr Case cases_of_size[] = {
    {"scale", "scenes of 1e-9 to 1e9",
     "all is computed in a frame of the scene's own size, a power of two away; other factors round the slopes of links, kept in 8 bits, "
     "otherwise",
     [](Findings& findings) {
       const Solution one = findings.solve(written(1.0, 0.0), coarse());
       double off = 0.0;
       for (const double factor : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9}) {
         off = std::max(off, largest_relative_difference(findings.solve(written(factor, 0.0), coarse()), one));
       }
       findings.at_most("1e-9 ... 1e9: B against 1, relative", off, 1e-4);
       double bits = 0.0;
       for (const double factor : {0x1p-30, 0x1p30}) { bits += other_bits(findings.solve(written(factor, 0.0), coarse()), one); }
       findings.exactly("2^-30, 2^30: other bits", bits, 0.0);
     }},
    {"offset", "scenes far from the origin", "the frame is centred on the scene; what coordinates have lost there is said",
     [](Findings& findings) {
       const Solution one = findings.solve(written(1.0, 0.0), coarse());
       const auto off = [&](double by) { return largest_relative_difference(findings.solve(written(1.0, by), coarse()), one); };
       findings.at_most("1e3 sizes: B, relative", off(1e3), 1e-6);
       findings.at_most("1e5 sizes: B, relative", off(1e5), 1e-6);
       // Here coordinates are known to 1e-9 of the room's size, and so is the light.
       const Solution far = findings.solve(written(1.0, 1e7), coarse());
       findings.at_most("1e7 sizes: B, relative", largest_relative_difference(far, one), 1e-6);
       findings.warned("1e7 sizes", far, "from the origin");
     }},
    {"lamp", "a lamp of 1e-5", "against a patch a thousand times larger a small one is integrated as a point; thresholds are relative",
     [](Findings& findings) {
       double off = 0.0;
       for (const double distance : {0.1, 1.0}) {
         Scene scene;
         scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1e10}}};
         scene.objects = {square("lamp", {0, 0, distance}, 5e-6, false, 1), square("target", {0, 0, 0}, 1e-2, true, 0)};
         const double irradiance = 1e10 * 1e-10 / (std::numbers::pi * distance * distance);
         // Over the target, r^2 is larger by (2e-4 / 3) / distance^2 on average, and the cosines decrease by as much again.
         const double known = 3e-4 / (distance * distance);
         off = std::max(off, relative(mean(findings.solve(scene, coarse()), "target"), 0.5 * irradiance) / known);
       }
       findings.at_most("lamp of 1e-5: |B / inverse square - 1| / extent^2", off, 1.0);
       // A lamp of 1e-5 in a room: its light must arrive.
       Scene room = room_with_box();
       room.objects[2] = square("lamp", {0.5, 0.5, 1.0}, 5e-6, false, 1);
       room.materials[1].emission = Color{5.0 * 9e8};
       const Solution solution = findings.solve(room, coarse());
       findings.at_most("in a room: energy amiss", solution.audit.energy_balance, 1e-5);
       const Solution wide = findings.solve(room_with_box(), coarse());
       findings.at_most("in a room: floor against a lamp of .3, relative", relative(mean(solution, "room.z0"), mean(wide, "room.z0")),
                        0.05);
     }},
    {"sliver", "needles, splinters and blades of aspect 1e-6", "the longest edges are split first, and no normal is made of nothing",
     [](Findings& findings) {
       Scene scene = two_plates(0.5);
       scene.objects.push_back(plate("needle", {{0, 0.5, 0.5}, {1, 0.5, 0.5}, {1, 0.500001, 0.5}, {0, 0.500001, 0.5}}, 1));
       scene.objects.push_back(plate("splinter", {{0, 0.3, 0.5}, {1, 0.3, 0.5}, {0.5, 0.300001, 0.5}}, 1));
       const Solution solution = findings.solve(scene, coarse());
       findings.at_most("quadrilateral and triangle: energy amiss", solution.audit.energy_balance, 1e-6);
       // The radiosity must be that of plates ten thousand times wider at the same place.
       Scene wide = two_plates(0.5);
       wide.objects.push_back(plate("needle", {{0, 0.495, 0.5}, {1, 0.495, 0.5}, {1, 0.505, 0.5}, {0, 0.505, 0.5}}, 1));
       wide.objects.push_back(plate("splinter", {{0, 0.3, 0.5}, {1, 0.3, 0.5}, {0.5, 0.31, 0.5}}, 1));
       const Solution reference = findings.solve(wide, coarse());
       for (const char* name : {"needle", "splinter"}) {
         findings.at_most(std::string{name} + ": B against one of width 1e-2, relative",
                          relative(mean(solution, name), mean(reference, name)), 0.05);
       }
       // A blade in a furnace, and a very flat tetrahedron.
       Scene furnace = furnace_cube(0.9);
       furnace.objects.push_back(object("blade", box({0.2, 0.5, 0.2}, {0.8, 0.5 + 1e-6, 0.7})));
       const std::vector<glm::dvec3> fan{{0.1, 0.1, 0.1}, {0.9, 0.1, 0.1}, {0.5, 0.1 + 1e-6, 0.1}, {0.5, 0.1 + 5e-7, 0.2}};
       furnace.objects.push_back(object("tetrahedron", raycast::Mesh::make(fan, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}).object));
       const Solution glow = findings.solve(furnace, coarse());
       findings.at_most("blade of 1e-6 and flat tetrahedron in a furnace: |B - 1|", worst(glow, 1.0), 1e-3);
     }},
    {"torus", "a ring of minor radius 1e-6",
     "rays are centred on the point nearest to the ring before the quartic is solved; below a ten thousandth of the ring its roots could "
     "not be told apart, and it is refused",
     [](Findings& findings) {
       Scene scene = furnace_cube(0.9);
       findings.refuse("minor radius 1e-6, major .3", raycast::Torus::make({0.5, 0.5, 0.5}, {0, 0.6, 0.8}, 0.3, 1e-6).refusal, "1e-4");
       scene.objects.push_back(object("ring", raycast::Torus::make({0.5, 0.5, 0.5}, {0, 0.6, 0.8}, 1e-4, 1e-6).object));
       const Solution solution = findings.solve(scene, coarse());
       findings.at_most("minor radius 1e-6, major 1e-4, in a furnace: |B - 1|", worst(solution, 1.0), 1e-3);
       findings.at_most("area of the ring, relative",
                        relative(area(solution, "ring"), 4.0 * std::numbers::pi * std::numbers::pi * 1e-4 * 1e-6), 0.1);
     }},
    {"superquadric", "superquadrics of exponents .05 and 10", "crossings are bracketed between the coordinate planes, not searched",
     [](Findings& findings) {
       Scene scene = furnace_cube(0.9);
       scene.objects.push_back(object("square", raycast::Superquadric::make({0.3, 0.3, 0.3}, {0.15, 0.15, 0.15}, 0.05, 0.05).object));
       const Solution boxy = findings.solve(scene, coarse());
       findings.at_most("exponents .05 in a furnace: |B - 1|", worst(boxy, 1.0), 1e-3);
       findings.at_most("exponents .05: area against the cube's, relative", relative(area(boxy, "square"), 6.0 * 0.09), 0.1);
       scene.objects.back() = object("needles", raycast::Superquadric::make({0.5, 0.5, 0.5}, {0.3, 0.3, 0.3}, 10.0, 10.0).object);
       findings.at_most("exponents 10 in a furnace: |B - 1|", worst(findings.solve(scene, coarse()), 1.0), 1e-3);
     }},
    {"deep", "20 levels of refinement", "generations, not recursion; areas are compared, not counted",
     [](Findings& findings) {
       // Two squares that touch at one corner: at every level a few patches near it are split again.
       Scene scene;
       scene.materials = {{"lamp", Color{0.0}, Color{1.0}}, {"wall", Color{0.5}, Color{0.0}}};
       scene.objects = {plate("lamp", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0),
                        plate("wall", {{0, -1, 0}, {0, 0, 0}, {0, 0, 1}, {0, -1, 1}}, 1)};
       Options options = coarse();
       options.epsilon = 1.0;
       const double whole = mean(findings.solve(scene, options), "wall");
       options.epsilon = 0.02;
       options.min_area = std::ldexp(0.5, -40);
       const Solution solution = findings.solve(scene, options);
       std::vector<std::uint32_t> level(solution.hierarchy.size(), 0);
       std::uint32_t deepest = 0;
       for (std::size_t i = 0; i < level.size(); ++i) {
         if (solution.hierarchy[i].parent != radiosity::no_node) { level[i] = level[solution.hierarchy[i].parent] + 1; }
         deepest = std::max(deepest, level[i]);
       }
       findings.at_least("levels", deepest, 20);
       findings.at_most("links", static_cast<double>(solution.audit.links), 1e5);
       findings.at_most("form factor against the exact one, relative", relative(mean(solution, "wall"), whole), 1e-4);
     }},
    {"polygons", "many input polygons", "time and links stay in proportion",
     [](Findings& findings) {
       Options options = coarse();
       const Solution solution = findings.solve(cloud(many), options);
       findings.exactly("polygons", static_cast<double>(solution.audit.surfaces.size()), many);
       findings.at_most("links per polygon", static_cast<double>(solution.audit.links) / many, 20.0);
       findings.at_most("energy amiss", solution.audit.energy_balance, 1e-5);
     }},
    {"interrupt", "a run that is stopped early", "the best so far is a valid solution of its own mesh, and says that it was stopped",
     [](Findings& findings) {
       // A run that is stopped after its fourth generation.
       std::atomic<bool> cancel{false};
       bool begun = false;  // has the first coarse mesh been linked?
       int generations = 0;
       radiosity::Control control;
       control.cancel = &cancel;
       control.progress = [&](std::string_view stage, double part) { begun = begun || (stage == "refine" && part == 1.0); };
       control.after_generation = [&](const auto&) { cancel = cancel || (begun && ++generations == 4); };
       Options options = coarse();
       options.refinement = radiosity::Refinement::a_posteriori;
       options.target = 1e-3;
       const Solution partial = findings.solve(room_with_box(), options, control);
       findings.at_most("residual of what was reached", partial.audit.residual, 1e-8);
       findings.at_most("energy amiss", partial.audit.energy_balance, 1e-5);
       findings.exactly("says that it was interrupted", partial.audit.interrupted ? 1.0 : 0.0, 1.0);
       const Solution whole = findings.solve(room_with_box(), coarse());
       findings.at_most("floor against an uninterrupted run, relative", relative(mean(partial, "room.z0"), mean(whole, "room.z0")), 0.1);
     }},
};

}  // namespace

std::span<const Case> size_cases() { return cases_of_size; }

}  // namespace apps::stress
