// SPDX-License-Identifier: MIT
// Random trees of curved solids: none is refused, and the mesh holds the volume of the true solid. Contacts that general position never
// has.
#include "random_solids.hpp"

#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

using namespace raycast;
using test::dvec3;
using test::RandomSolid;
using test::RandomSolids;

namespace {

struct Estimate {
  double volume = 0.0, deviation = 0.0;
  long inside = 0;
};

// Of the solid within a box, by two random points in each of n^3 cells. How many pairs differ tells the variance; four more are counted, so
// that it is not taken for zero where a small solid was missed.
Estimate measure(const std::function<bool(const dvec3&)>& inside, const Box& box, test::Random& random, int n) {
  Estimate result;
  const dvec3 step = box.size() / static_cast<double>(n);
  const double cell = step.x * step.y * step.z;
  long differ = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const dvec3 at = box.lo + dvec3(i % n, i / n % n, i / n / n) * step;
    const bool a = inside(at + dvec3(random.uniform(), random.uniform(), random.uniform()) * step);
    const bool b = inside(at + dvec3(random.uniform(), random.uniform(), random.uniform()) * step);
    result.inside += a + b;
    differ += a != b;
  }
  result.volume = 0.5 * cell * static_cast<double>(result.inside);
  result.deviation = 0.5 * cell * std::sqrt(static_cast<double>(differ + 4));
  return result;
}

struct Measures {
  double volume = 0.0, area = 0.0;
  std::uint32_t faces = 0;
  Box box;
};

// Of an approximation, the first one by default, which must be closed, and of convex faces that have an area.
Measures measure(const Csg& csg, double tolerance = 1e60) {
  brep::Builder builder;
  csg.approximate(tolerance, builder);
  const auto closed = brep::close<CsgBRep>(builder);
  INFO((closed.defects.empty() ? std::string() : closed.defects.front().sentence));
  Measures result;
  CHECK(closed.brep);
  if (!closed.brep) { return result; }
  for (const brep::FaceId f : brep::faces(*closed.brep)) {
    const dvec3 area = brep::vector_area(*closed.brep, f);
    CHECK(brep::is_convex(*closed.brep, f));
    result.area += glm::length(area);
    result.volume += glm::dot(area, brep::centroid(*closed.brep, f)) / 3.0;
    ++result.faces;
  }
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { result.box.extend(builder.position(v)); }
  return result;
}

// A surface that is off the true one by d at most holds a volume that is off by d times its area, and four deviations are never exceeded.
// What is thinner than d may be missing from it, so the area is that of a finer one.
void check_volume(const RandomSolid& solid, test::Random& random, int n) {
  INFO(solid.text);
  const Made<Csg> csg = Csg::make(solid.node);
  const Made<CsgTree> tree = CsgTree::make(solid.node);
  REQUIRE(tree);
  const Box box = tree->bounds();
  if (box.empty()) {
    CHECK(csg.refusal == "nothing is left: the parts of an intersection do not meet");
    return;
  }
  const Estimate truth = measure(solid.inside, box, random, n);
  if (!csg) {
    INFO(csg.refusal);
    CHECK(csg.refusal.find("nothing is left") == 0);
    CHECK(truth.inside == 0);
    return;
  }
  const Measures mesh = measure(*csg);
  const double off = std::abs(mesh.volume - truth.volume), d = csg->chord_tolerance(), sampling = 4 * truth.deviation + 1e-6 * truth.volume;
  if (off <= d * mesh.area + sampling) { return; }
  CHECK(off <= d * measure(*csg, d / 8).area + sampling);
}

RandomSolid room_solid() {
  RandomSolid result;
  result.node.solid = BoxObject::make({0, 0, 0}, {2, 2, 2}).object;
  result.inside = [](const dvec3& p) { return p.x > 0 && p.y > 0 && p.z > 0 && p.x < 2 && p.y < 2 && p.z < 2; };
  result.text = "box b from 0 0 0 to 2 2 2";
  return result;
}

RandomSolid sphere(const dvec3& centre, double radius) {
  RandomSolid result;
  result.node.solid = Sphere::make(centre, radius).object;
  result.inside = [=](const dvec3& p) { return glm::length(p - centre) < radius; };
  result.text = "sphere of radius " + std::to_string(radius);
  return result;
}

CsgNode combine(CsgOperation operation, std::vector<std::shared_ptr<const Object>> solids) {
  CsgNode result;
  result.operation = operation;
  for (std::shared_ptr<const Object>& solid : solids) { result.parts.push_back({std::move(solid), {}, {}, {}, {}}); }
  return result;
}

}  // namespace

TEST_CASE("csg: no tree of two to five curved solids is refused, and its mesh holds the volume of the true solid within the chord bound") {
  SEEDED(random);
  const char* given = std::getenv("HALFLIGHT_CSG_TREES");
  const int trees = given ? std::atoi(given) : 400;  // about three seconds
  for (int i = 0; i < trees; ++i) {
    // Any numbers, or multiples of 1/8, so that surfaces touch, coincide and share axes.
    RandomSolids solids(random, i % 2 == 0 ? 0.0 : 0.125);
    RandomSolid solid;
    if (i % 6 < 4) {
      std::vector<RandomSolid> parts{room_solid()};
      const std::uint32_t more = i % 6 < 2 ? 1 : 2 + random.below(3);
      for (std::uint32_t k = 0; k < more; ++k) {
        parts.push_back(k == 0 ? solids.leaf(static_cast<RandomSolids::Kind>(1 + random.below(4)), 0.05, 0.5) : solids.any_leaf(0.1, 0.5));
      }
      auto operation = static_cast<CsgOperation>(random.below(3));
      if (more > 1 && operation == CsgOperation::intersect) operation = CsgOperation::subtract;  // little would be left
      solid = RandomSolids::combine(operation, std::move(parts));
    } else {
      solid = solids.tree(2 + random.below(4), 0.05, 1.0);
    }
    INFO("tree " << i);
    check_volume(solid, random, 24);
  }
}

TEST_CASE("csg: a small solid cut from a huge one has as many faces as one cut from its like, and its own chords") {
  SEEDED(random);
  for (int i = 0; i < 12; ++i) {
    const double radius = random.magnitude(1) * std::pow(10.0, -i % 6);
    const dvec3 at = random.direction();  // on the surface of the huge one
    std::vector<RandomSolid> parts{sphere(dvec3(0.0), 1.0), sphere(at, std::min(radius, 1.0))};
    if (i % 2) { std::swap(parts[0], parts[1]); }
    const RandomSolid solid = RandomSolids::combine(i < 6 ? CsgOperation::intersect : CsgOperation::subtract, std::move(parts));
    const Made<Csg> csg = Csg::make(solid.node);
    INFO(solid.text << ": " << csg.refusal);
    if (i < 6 && radius < 1e-5) { continue; }  // refused from some 130 000 times what is left on (csg_plan.cpp)
    REQUIRE(csg);
    CHECK(measure(*csg).faces < 4000);
    check_volume(solid, random, 24);
  }
}

TEST_CASE("csg: a dimple in a large sphere is where it belongs, however small") {
  SEEDED(random);
  for (const double radius : {0.1, 0.01, 1e-3, 1e-4}) {
    const dvec3 at = random.direction();
    const std::shared_ptr<const Object> large = Sphere::make(dvec3(0.0), 1.0).object, small = Sphere::make(at, radius).object;
    const Made<Csg> csg = Csg::make(combine(CsgOperation::subtract, {large, small}));
    REQUIRE(csg);
    brep::Builder builder;
    csg->approximate(1e60, builder);
    const auto closed = brep::close<CsgBRep>(builder);
    REQUIRE(closed.brep);
    double area = 0.0;
    for (const brep::FaceId f : brep::faces(*closed.brep)) {
      if (closed.brep->data(f).sheet == 1) { area += brep::area(*closed.brep, f); }
    }
    // Of a sphere of radius r about a point of the unit sphere the part 1/2 - r/4 lies inside (Archimedes); chords within 4 % of r.
    INFO("radius " << radius << ", faces " << closed.brep->face_count());
    const double truth = 4 * std::numbers::pi * radius * radius * (0.5 - 0.25 * radius);
    CHECK(area == test::Approx(truth).epsilon(0.12));
    CHECK(closed.brep->face_count() < 4000);
  }
}

TEST_CASE("csg: equal, tangent and coaxial solids give the solid that is meant, or it is said that nothing is left") {
  const double pi = std::numbers::pi;
  const auto unit = BoxObject::make({0, 0, 0}, {1, 1, 1}).object;
  const auto ball = [](const dvec3& c, double r) { return Sphere::make(c, r).object; };
  const auto rod = [](const dvec3& base, const dvec3& axis, double r) { return Cylinder::make(base, axis, r).object; };
  const auto spike = [](const dvec3& base, const dvec3& axis, double r) { return Cone::make(base, axis, r, 0.0).object; };
  const auto ring = [](const dvec3& c, double R, double r) { return Torus::make(c, {0, 0, 1}, R, r).object; };
  constexpr auto unite = CsgOperation::unite, intersect = CsgOperation::intersect, subtract = CsgOperation::subtract;
  struct Case {
    const char* name;
    CsgOperation operation;
    std::vector<std::shared_ptr<const Object>> solids;
    double volume;  // 0: nothing is left
  };
  const double half_ball = 4.0 / 3 * pi / 8;
  const Case cases[] = {
      {"equal spheres", unite, {ball({0, 0, 0}, 0.5), ball({0, 0, 0}, 0.5)}, half_ball},
      {"equal spheres", intersect, {ball({0, 0, 0}, 0.5), ball({0, 0, 0}, 0.5)}, half_ball},
      {"equal spheres", subtract, {ball({0, 0, 0}, 0.5), ball({0, 0, 0}, 0.5)}, 0},
      {"concentric spheres", subtract, {ball({0, 0, 0}, 0.5), ball({0, 0, 0}, 0.25)}, half_ball * 7 / 8},
      {"spheres that touch", unite, {ball({0, 0, 0}, 0.5), ball({1, 0, 0}, 0.5)}, 2 * half_ball},
      {"spheres that touch", intersect, {ball({0, 0, 0}, 0.5), ball({1, 0, 0}, 0.5)}, 0},
      {"spheres that touch", subtract, {ball({0, 0, 0}, 0.5), ball({1, 0, 0}, 0.5)}, half_ball},
      {"a sphere that touches another from inside", subtract, {ball({0, 0, 0}, 0.5), ball({0.25, 0, 0}, 0.25)}, half_ball * 7 / 8},
      {"a ball on a table", unite, {unit, ball({0.5, 0.5, 1.25}, 0.25)}, 1 + half_ball / 8},
      {"a ball under a lid", subtract, {unit, ball({0.5, 0.5, 0.75}, 0.25)}, 1 - half_ball / 8},
      {"an inscribed ball", subtract, {unit, ball({0.5, 0.5, 0.5}, 0.5)}, 1 - half_ball},
      {"an inscribed ball", intersect, {unit, ball({0.5, 0.5, 0.5}, 0.5)}, half_ball},
      {"an inscribed ball", unite, {unit, ball({0.5, 0.5, 0.5}, 0.5)}, 1},
      {"a ball without its box", subtract, {ball({0.5, 0.5, 0.5}, 0.5), unit}, 0},
      {"an inscribed rod", subtract, {unit, rod({0.5, 0.5, 0}, {0, 0, 1}, 0.5)}, 1 - pi / 4},
      {"an inscribed rod", intersect, {unit, rod({0.5, 0.5, 0}, {0, 0, 1}, 0.5)}, pi / 4},
      {"a rod that lies on a table", unite, {unit, rod({0.25, 0.5, 1.25}, {0.5, 0, 0}, 0.25)}, 1 + pi / 32},
      {"a drill that touches a wall", subtract, {unit, rod({0.25, 0.75, 0.5}, {0.5, 0, 0}, 0.25)}, 1 - pi / 32},
      {"rods in a row", unite, {rod({0, 0, 0}, {0, 0, 1}, 0.5), rod({0, 0, 1}, {0, 0, 1}, 0.5)}, pi / 2},
      {"rods in one another", unite, {rod({0, 0, 0}, {0, 0, 1}, 0.5), rod({0, 0, 0.5}, {0, 0, 1}, 0.5)}, 1.5 * pi / 4},
      {"rods in one another", subtract, {rod({0, 0, 0}, {0, 0, 1}, 0.5), rod({0, 0, 0.5}, {0, 0, 1}, 0.5)}, pi / 8},
      {"a short rod in a long one", subtract, {rod({0, 0, 0}, {0, 0, 8}, 0.5), rod({0, 0, 1}, {0, 0, 0.25}, 0.5)}, 7.75 * pi / 4},
      {"rods that touch along a line", unite, {rod({0, 0, 0}, {0, 0, 1}, 0.5), rod({1, 0, 0}, {0, 0, 1}, 0.5)}, pi / 2},
      {"rods that touch along a line", intersect, {rod({0, 0, 0}, {0, 0, 1}, 0.5), rod({1, 0, 0}, {0, 0, 1}, 0.5)}, 0},
      {"rods of one radius across", intersect, {rod({-1, 0, 0}, {2, 0, 0}, 0.5), rod({0, -1, 0}, {0, 2, 0}, 0.5)}, 16.0 / 3 / 8},
      {"a cone that stands on its tip", unite, {unit, spike({0.5, 0.5, 2}, {0, 0, -1}, 0.5)}, 1 + pi / 12},
      {"a cone to the opposite face", subtract, {unit, spike({0.5, 0.5, 0}, {0, 0, 1}, 0.5)}, 1 - pi / 12},
      {"cones on one base", unite, {spike({0, 0, 0}, {0, 0, 1}, 0.5), spike({0, 0, 0}, {0, 0, -1}, 0.5)}, pi / 6},
      {"a cone in its cylinder", subtract, {rod({0, 0, 0}, {0, 0, 1}, 0.5), spike({0, 0, 0}, {0, 0, 1}, 0.5)}, pi / 4 - pi / 12},
      {"a ring on a table", unite, {unit, ring({0.5, 0.5, 1.125}, 0.25, 0.125)}, 1 + 2 * pi * pi * 0.25 / 64},
      {"a ring under a lid", subtract, {unit, ring({0.5, 0.5, 0.875}, 0.25, 0.125)}, 1 - 2 * pi * pi * 0.25 / 64},
      {"a ball in its ring", unite, {ball({0, 0, 0}, 0.25), ring({0, 0, 0}, 0.5, 0.25)}, half_ball / 8 + 2 * pi * pi * 0.5 / 16},
      {"a ball in its ring", intersect, {ball({0, 0, 0}, 0.25), ring({0, 0, 0}, 0.5, 0.25)}, 0},
      {"a rod in its ring", unite, {rod({0, 0, -0.5}, {0, 0, 1}, 0.25), ring({0, 0, 0}, 0.5, 0.25)}, pi / 16 + 2 * pi * pi * 0.5 / 16},
      {"equal rings", subtract, {ring({0, 0, 0}, 0.5, 0.25), ring({0, 0, 0}, 0.5, 0.25)}, 0},
  };
  test::Random random;
  for (const Case& c : cases) {
    for (int turned = 0; turned < (c.volume == 0 ? 1 : 2); ++turned) {
      CsgNode node = combine(c.operation, c.solids);
      if (turned) { node.placement = {random.rotation(), random.in_cube(), false}; }
      const Made<Csg> csg = Csg::make(node);
      INFO(c.name << ", operation " << static_cast<int>(c.operation) << (turned ? ", turned: " : ": ") << csg.refusal);
      if (c.volume == 0) {
        CHECK((!csg && csg.refusal.find("nothing is left") == 0));
        continue;
      }
      CHECK(csg);
      if (!csg) { continue; }
      const Measures mesh = measure(*csg);
      CHECK(std::abs(mesh.volume - c.volume) <= csg->chord_tolerance() * mesh.area);
    }
  }
}
