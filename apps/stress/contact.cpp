// SPDX-License-Identifier: MIT
// Objects that touch, coincide, overlap, or nearly do.
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>

#include "apps/stress/case.hpp"

namespace apps::stress {
namespace {

// A room of 2 x 1 x 1 divided by a wall, made of three boxes that touch and stand on the floor; a lamp in one half.
Scene two_halves(double thickness) {
  Scene scene;
  scene.materials = {{"white", Color{0.7}, Color{0.0}}, {"lamp", Color{0.0}, Color{5.0}}};
  const double a = 1.03;
  const double b = a + thickness;
  scene.objects = {object("room", box({0, 0, 0}, {2, 1, 1}), 0, true), object("wall", box({a, 0, 0}, {b, 0.37, 1})),
                   object("wall 2", box({a, 0.37, 0}, {b, 0.71, 1})), object("wall 3", box({a, 0.71, 0}, {b, 1, 1})),
                   square("lamp", {0.5, 0.5, 1.0}, 0.15, false, 1)};
  return scene;
}

constexpr Case cases_of_contact[] = {
    {"touching", "patches with a common edge", "contour integrals have no singular kernel; refinement ends at the smallest area",
     [](Findings& findings) {
       double mean_sum = 0.0;
       double corrected = 0.0;
       for (const double finest : {1e-2, 1e-4}) {
         Options options = coarse();
         options.min_area = finest;
         const Solution cube = findings.solve(furnace_cube(0.9), options);
         mean_sum = std::max(mean_sum, std::abs(cube.audit.computed_row_sum.mean - 1.0));
         corrected = std::max({corrected, std::abs(cube.audit.row_sum.min - 1.0), std::abs(cube.audit.row_sum.max - 1.0)});
       }
       findings.at_most("walls of a cube: |mean row sum - 1|", mean_sum, 1e-3);
       findings.at_most("walls of a cube: |row sum - 1| after closing", corrected, 1e-9);
       // A black lamp: the wall receives direct light only, by the form factor of two squares with a common edge (Howell C-14).
       Scene scene;
       scene.materials = {{"wall", Color{0.5}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}};
       scene.objects = {plate("floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1),
                        plate("wall", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}})};
       Options options = coarse();
       options.min_area = 1e-6;
       const Solution corner = findings.solve(scene, options);
       findings.at_most("common edge: form factor, relative", relative(mean(corner, "wall"), 0.5 * 0.20004377607540315), 1e-3);
       findings.at_most("common edge, patches to 1e-6: links", static_cast<double>(corner.audit.links), 2e6);
     }},
    {"coincident", "coplanar and coincident patches",
     "what lies in one plane exchanges nothing; where two coincide and face the same way the later one is seen",
     [](Findings& findings) {
       Scene beside;
       beside.materials = {{"lamp", Color{0.5}, Color{1.0}}, {"wall", Color{0.5}, Color{0.0}}};
       beside.objects = {square("lamp", {0, 0, 0}, 0.5, true, 0), square("beside", {1, 0, 0}, 0.5, true, 1)};
       findings.exactly("coplanar plates side by side: B", mean(findings.solve(beside, coarse()), "beside"), 0.0);
       // A lamp on a floor: the floor below it is buried, and lamp and floor see what is above them.
       Scene on_floor = two_plates(0.5);
       const Solution alone = findings.solve(on_floor, coarse());
       Scene under = on_floor;
       under.objects.insert(under.objects.begin(), square("floor", {0.5, 0.5, 0.0}, 0.5, true, 1));
       const Solution covered = findings.solve(under, coarse());
       findings.at_most("lamp over all of a floor: upper plate, relative", relative(mean(covered, "upper"), mean(alone, "upper")), 1e-12);
       findings.warned("lamp over all of a floor", covered, "duplicates");
       // Two sheets back to back do not bury each other.
       Scene sheet = on_floor;
       sheet.objects.push_back(square("back", {0.5, 0.5, 1.0}, 0.5, true, 1));
       const Solution back = findings.solve(sheet, coarse());
       findings.at_most("two sheets back to back: the lit one, relative", relative(mean(back, "upper"), mean(alone, "upper")), 1e-12);
       findings.exactly("two sheets back to back: the other, B", mean(back, "back"), 0.0);
     }},
    {"duplicates", "an object twice at one place", "the later object is seen, the earlier is covered, and the run says so",
     [](Findings& findings) {
       const auto twice = [&](const std::string& what, Scene scene, std::size_t which) {
         const Solution once = findings.solve(scene, coarse());
         const std::string name = scene.objects[which].name;
         scene.objects.push_back(scene.objects[which]);
         scene.objects.back().name = "again";
         const Solution solution = findings.solve(scene, coarse());
         double off = 0.0;
         for (const radiosity::SurfaceMean& s : once.audit.surfaces) {
           const std::string seen = s.name.substr(0, name.size()) == name ? "again" + s.name.substr(name.size()) : s.name;
           if (s.radiosity.x > 0.0) { off = std::max(off, relative(mean(solution, seen), s.radiosity.x)); }
         }
         findings.at_most(what + " twice: B against once, relative", off, 0.02);
         findings.warned(what + " twice", solution, "duplicates");
       };
       twice("plate", two_plates(0.5), 1);
       Scene room = room_with_box();
       twice("box", room, 1);
       room.objects[1] = object("box", raycast::Sphere::make({0.5, 0.5, 0.4}, 0.2).object);
       twice("sphere", room, 1);
       Scene furnace = furnace_with_things(0.9);
       furnace.objects.push_back(furnace.objects[2]);
       findings.at_most("furnace with a sphere twice: |B - 1|", worst(findings.solve(furnace, coarse()), 1.0), 1e-3);
     }},
    {"interpenetrating", "solids that overlap", "what lies in another solid is buried: its area takes no part",
     [](Findings& findings) {
       Scene scene = furnace_cube(0.9);
       scene.objects.push_back(object("box", box({0.2, 0.2, 0.1}, {0.6, 0.6, 0.5})));
       scene.objects.push_back(object("other box", box({0.4, 0.3, 0.3}, {0.8, 0.7, 0.9})));
       scene.objects.push_back(object("sphere in the wall", raycast::Sphere::make({0.95, 0.8, 0.2}, 0.15).object));
       scene.objects.push_back(object("cylinder through the floor", raycast::Cylinder::make({0.2, 0.8, -0.3}, {0, 0, 0.6}, 0.1).object));
       const Solution solution = findings.solve(scene, coarse());
       findings.at_most("furnace: |B - 1| of all that shows", worst(solution, 1.0), 1e-3);
       // The part y .3 to .6, z .3 to .5 of the .4 x .4 face x = .6 of the first box lies inside the other box.
       findings.at_most("exposed area of a face partly inside, relative", relative(area(solution, "box.x1"), 0.16 - 0.3 * 0.2), 0.02);
     }},
    {"gap", "solids 1e-12 apart", "closer than coordinates can tell is touching: no light goes through, nothing is counted twice",
     [](Findings& findings) {
       const auto scene_of = [](double gap) {
         Scene scene = room_with_box();
         scene.objects[1] = object("box", box({0.3, 0.2, gap}, {0.6, 0.5, 0.5 + gap}));
         scene.objects.push_back(object("on it", box({0.35, 0.25, 0.5 + 2.0 * gap}, {0.5, 0.4, 0.7})));
         scene.objects.push_back(object("beside it", box({0.6 + gap, 0.2, 0.0}, {0.8, 0.5, 0.3})));
         return scene;
       };
       const Solution none = findings.solve(scene_of(0.0), coarse());
       const Solution narrow = findings.solve(scene_of(1e-12), coarse());
       findings.at_most("gap of 1e-12 against none, relative", largest_relative_difference(narrow, none), 1e-3);
       findings.at_most("face over the gap: B", mean(narrow, "box.z0"), 0.0);
       // A gap wide enough to count as one. The floor is not divided along a box that does not stand on it, so the meshes differ; finer
       // meshes reduce the difference.
       const Solution open = findings.solve(scene_of(1e-6), finer());
       const Solution closed = findings.solve(scene_of(0.0), finer());
       findings.at_most(
           "gap of 1e-6 against none, relative",
           std::max(relative(mean(open, "room.x0"), mean(closed, "room.x0")), relative(mean(open, "box.y0"), mean(closed, "box.y0"))),
           2e-2);
     }},
    {"leak", "a wall of boxes that stands on the floor",
     "faces are cut where a wall divides them, so no patch takes light on one side and gives it on the other",
     [](Findings& findings) {
       for (const double thickness : {0.05, 1e-3}) {
         const Solution solution = findings.solve(two_halves(thickness), coarse());
         const std::string what = thickness > 1e-2 ? "wall of .05" : "wall of .001";
         findings.at_most(what + ": light behind it / before it", mean(solution, "room.x1") / mean(solution, "room.x0"), 0.0);
       }
     }},
    {"grazing", "rays along a wall", "a ray that only touches a solid is not stopped: spans decide, not epsilons along the ray",
     [](Findings& findings) {
       // Two black-backed plates stand on a long box; all rays between them near its surface run along it.
       Scene scene;
       scene.materials = {{"black", Color{0.0}, Color{0.0}}, {"lamp", Color{0.0}, Color{1.0}}, {"white", Color{0.5}, Color{0.0}}};
       const auto end = [](std::string name, double x, double height, bool forward, std::uint32_t material) {
         std::vector<glm::dvec3> corners{{x, 0, 0}, {x, 1, 0}, {x, 1, height}, {x, 0, height}};
         if (!forward) { std::reverse(corners.begin(), corners.end()); }
         return plate(std::move(name), std::move(corners), material);
       };
       for (const double height : {1.0, 1e-4}) {
         scene.objects = {end("lamp", 0.0, height, true, 1), end("target", 2.0, height, false, 2)};
         const auto boxes_at = [&](double distance) {  // the same boxes at both distances, so that patches are divided alike
           scene.objects.resize(2);
           scene.objects.push_back(object("ground", box({-1, -1, -1 - distance}, {3, 2, -distance})));
           scene.objects.push_back(object("side", box({-1, 1 + distance, -1}, {3, 2 + distance, 1})));
         };
         boxes_at(0.5);
         const double free = mean(findings.solve(scene, coarse()), "target");
         boxes_at(0.0);
         const Solution solution = findings.solve(scene, coarse());
         findings.at_most(height == 1.0 ? "squares: light along the ground against free, relative" : "strips of 1e-4: the same",
                          relative(mean(solution, "target"), free), 1e-6);
       }
     }},
};

}  // namespace

std::span<const Case> contact_cases() { return cases_of_contact; }

}  // namespace apps::stress
