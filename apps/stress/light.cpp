// SPDX-License-Identifier: MIT
// Reflectance and emission at their limits, and the linear system.
#include <limits>

#include <raycast/objects/csg.hpp>
#include <raycast/objects/csg_tree.hpp>

#include "apps/stress/case.hpp"

namespace apps::stress {
namespace {

Scene lit_room(double reflectance) {
  Scene scene = room_with_box();
  for (radiosity::Material& material : scene.materials) { material.reflectance = Color{reflectance}; }
  return scene;
}

// In a nearly lossless room the light is nearly uniform: B = emitted power / (absorbed fraction * area), apart from the first bounces.
double filled(const Solution& solution, double loss) {
  double emitted = 0.0;
  double area = 0.0;
  for (const radiosity::SurfaceMean& s : solution.audit.surfaces) {
    emitted += s.name == "lamp" ? 5.0 * s.area : 0.0;
    area += s.area;
  }
  return emitted / (loss * area);
}

// Two rooms of 1 x 1 x 1 joined by a duct of the given side and length .1: the light through the duct is the stiffest part of the system.
Scene keyhole(double side, double reflectance) {
  Scene scene;
  scene.materials = {{"white", Color{reflectance}, Color{0.0}}, {"lamp", Color{reflectance}, Color{1.0}}};
  const double a = 0.5 - 0.5 * side;
  const double b = 0.5 + 0.5 * side;
  raycast::CsgNode rooms;
  rooms.parts = {{box({0, 0, 0}, {1, 1, 1}), "near", {}, {}, {}},
                 {box({0.5, a, a}, {1.6, b, b}), "duct", {}, {}, {}},
                 {box({1.1, 0, 0}, {2.1, 1, 1}), "far", {}, {}, {}}};
  scene.objects = {object("rooms", raycast::Csg::make(rooms).object, 0, true)};
  const std::uint32_t sheets = scene.objects[0].shape == nullptr ? 0 : scene.objects[0].shape->sheet_count();
  scene.objects[0].material.assign(sheets, 0);
  for (std::uint32_t s = 0; s < sheets; ++s) {
    if (scene.objects[0].shape->sheet_name(s) == "near.x0") { scene.objects[0].material[s] = 1; }
  }
  return scene;
}

constexpr Case cases_of_light[] = {
    {"stiff", "reflectance up to 1 - 1e-9 in closed rooms",
     "a closed room has one stiff mode, its evenly spread light; it is deflated, and row sums that are exactly 1 keep errors from growing "
     "by 1 / (1 - rho)",
     [](Findings& findings) {
       double off = 0.0;
       double energy = 0.0;
       std::uint32_t iterations = 0;
       double excess = 0.0;  // deviation from a uniformly lit room, relative to what the first bounces explain
       for (const double loss : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
         const Solution furnace = findings.solve(furnace_with_things(1.0 - loss), coarse());
         const Solution room = findings.solve(lit_room(1.0 - loss), coarse());
         off = std::max(off, worst(furnace, 1.0));
         iterations = std::max({iterations, furnace.audit.iterations, room.audit.iterations});
         energy = std::max(energy, room.audit.energy_balance);
         excess = std::max(excess, relative(mean(room, "room.z0"), filled(room, loss)) / (2.0 * loss + 1e-3));
       }
       findings.at_most("furnace with things in it: |B - 1|", off, 1e-3);
       findings.at_most("iterations", iterations, 20);
       findings.at_most("lit room: energy amiss", energy, 1e-5);
       findings.at_most("lit room: |B / filled - 1| / (2 loss + 1e-3)", excess, 1.0);
     }},
    {"lossless", "reflectance 1", "light that is never absorbed has no steady state in a closed room; in an open one it leaves",
     [](Findings& findings) {
       findings.refuse("closed room with a lamp", lit_room(1.0), coarse(), "grow without end");
       Scene one_channel = lit_room(0.5);
       for (radiosity::Material& material : one_channel.materials) { material.reflectance.y = 1.0; }
       findings.refuse("lossless in one channel", one_channel, coarse(), "grow without end");
       const Solution open = findings.solve(two_plates(1.0), coarse());
       findings.at_most("open plates: |escaped - 1|", std::abs(open.audit.escaped - 1.0), 1e-6);
       Scene dark = lit_room(1.0);
       for (radiosity::Material& material : dark.materials) { material.emission = Color{0.0}; }
       findings.exactly("closed, without lamp: B", worst(findings.solve(dark, coarse()), 0.0), 0.0);
     }},
    {"materials", "reflectances and emissions that cannot be", "no such surface exists; the sentence names the material",
     [](Findings& findings) {
       const double nan = std::numeric_limits<double>::quiet_NaN();
       const double infinity = std::numeric_limits<double>::infinity();
       const auto refuse = [&](const char* what, double reflectance, double emission) {
         Scene scene = two_plates(0.5);
         scene.materials[1].reflectance.y = reflectance;
         scene.materials[1].emission.z = emission;
         findings.refuse(what, scene, coarse(), "'wall'");
       };
       refuse("reflectance 1.0001", 1.0001, 0.0);
       refuse("reflectance -1e-9", -1e-9, 0.0);
       refuse("reflectance NaN", nan, 0.0);
       refuse("emission -1", 0.5, -1.0);
       refuse("emission NaN", 0.5, nan);
       refuse("emission infinite", 0.5, infinity);
     }},
    {"range", "emissions over 60 decades",
     "thresholds are relative, so a factor of two changes no bit; of two rooms that do not see each other each has its own light",
     [](Findings& findings) {
       const Solution one = findings.solve(room_with_box(), coarse());
       double other = 0.0;
       for (const double factor : {0x1p-100, 0x1p100}) {
         Scene scene = room_with_box();
         scene.materials[1].emission *= factor;
         other += other_bits(findings.solve(scene, coarse()), one, factor);
       }
       findings.exactly("emission times 2^-100, 2^100: other bits", other, 0.0);
       // A lamp of 1e30 in one room and one of 1e-30 in another that the first cannot reach.
       Scene pair = two_plates(0.5);
       const Solution alone = findings.solve(pair, coarse());
       pair.materials.push_back({"faint", Color{0.5}, Color{1e-30}});
       pair.materials[0].emission = Color{1e30};
       Scene far = moved(two_plates(0.5), 1.0, {0.0, 0.0, 3.0});
       far.objects[0].material = {2};
       for (radiosity::SceneObject& o : far.objects) {
         o.name = "far " + o.name;
         pair.objects.push_back(o);
       }
       const Solution both = findings.solve(pair, coarse());
       findings.at_most("1e30 beside 1e-30: bright plate, relative", relative(mean(both, "upper"), 1e30 * mean(alone, "upper")), 1e-6);
       findings.at_most("1e30 beside 1e-30: faint plate, relative", relative(mean(both, "far upper"), 1e-30 * mean(alone, "upper")), 0.05);
     }},
    {"channel", "one channel black, one without light", "channels do not know of each other",
     [](Findings& findings) {
       // Red has reflectance and emission, green only emission, blue only reflectance.
       Scene scene = room_with_box();
       scene.materials[0].reflectance = {0.7, 0.0, 0.7};
       scene.materials[1].emission = {5.0, 5.0, 0.0};
       const Solution color = findings.solve(scene, coarse());
       const Solution grey = findings.solve(room_with_box(), coarse());
       double red = 0.0;
       double green = 0.0;
       double blue = 0.0;
       for (std::size_t i = 0; i < color.radiosity.size() && i < grey.radiosity.size(); ++i) {
         red += color.radiosity[i].x == grey.radiosity[i].x ? 0.0 : 1.0;
         const bool lamp = color.hierarchy[i].surface + 1 == color.audit.surfaces.size();
         green = std::max(green, color.area[i] > 0.0 ? std::abs(color.radiosity[i].y - (lamp ? 5.0 : 0.0)) : 0.0);
         blue = std::max(blue, color.radiosity[i].z);
       }
       findings.exactly("red: bits other than in a grey room", red, 0.0);
       findings.exactly("green, which nothing reflects: |B - E|", green, 0.0);
       findings.exactly("blue, which nothing emits: B", blue, 0.0);
     }},
    {"dark", "no light", "B = 0 is known before any work",
     [](Findings& findings) {
       Scene scene = room_with_box();
       scene.materials[1].emission = Color{0.0};
       const Solution solution = findings.solve(scene, coarse());
       findings.exactly("B", worst(solution, 0.0), 0.0);
       findings.exactly("links", static_cast<double>(solution.audit.links), 0.0);
       findings.exactly("rays", static_cast<double>(solution.audit.rays), 0.0);
     }},
    {"black", "nothing reflects", "B = E is known before any work",
     [](Findings& findings) {
       const Solution solution = findings.solve(lit_room(0.0), coarse());
       findings.exactly("lamp: |B - E|", std::abs(mean(solution, "lamp") - 5.0), 0.0);
       findings.exactly("floor: B", mean(solution, "room.z0"), 0.0);
       findings.exactly("links", static_cast<double>(solution.audit.links), 0.0);
     }},
    {"conditioned", "conjugate gradients at condition 1e9",
     "what is left after deflation is well conditioned; of two rooms with a small opening one slow mode remains, which costs a few "
     "iterations",
     [](Findings& findings) {
       // The condition number of the system is 2 / (1 - rho); Jacobi would need 18 / (1 - rho) iterations for the same residual.
       const Solution room = findings.solve(lit_room(1.0 - 1e-9), coarse());
       findings.at_most("rho = 1 - 1e-9: iterations", room.audit.iterations, 20);
       // B is 1e9 times the emission and has 16 digits of its own, while the residual is relative to the emission.
       findings.at_most("rho = 1 - 1e-9: residual relative to B", room.audit.residual * 1e-9, 1e-14);
       findings.exactly("rho = 1 - 1e-9: converged", room.audit.converged ? 1.0 : 0.0, 1.0);
       const Solution rooms = findings.solve(keyhole(0.05, 1.0 - 1e-6), coarse());
       findings.at_most("two rooms through a duct of .05: iterations", rooms.audit.iterations, 40);
       findings.at_most("two rooms through a duct of .05: residual", rooms.audit.residual, 1e-8);
       // Nearly nothing is absorbed, so both rooms are nearly equally bright.
       findings.at_most("two rooms: |far / near - 1|", relative(mean(rooms, "rooms.far.x1"), mean(rooms, "rooms.near.z0")), 0.05);
     }},
};

}  // namespace

std::span<const Case> light_cases() { return cases_of_light; }

}  // namespace apps::stress
