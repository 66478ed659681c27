// SPDX-License-Identifier: MIT
// Union, intersection and difference of solids against an oracle that knows nothing of lines: the implicit functions of the leaves.
#include "primitives.hpp"

#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/objects/csg.hpp>

using namespace raycast;
using test::dvec3;
using test::placed;

namespace {

// A random tree of primitives about the origin, with its oracle: the least |implicit| of all leaves, and whether the point is inside.
struct Oracle {
  const test::Primitive* primitive = nullptr;  // of a leaf
  CsgOperation operation = CsgOperation::unite;
  glm::dmat3 back{1.0};
  dvec3 centre{0.0};
  std::vector<Oracle> parts;

  [[nodiscard]] bool inside(const dvec3& p, double& nearest) const {
    if (primitive) {
      const auto f = static_cast<double>(primitive->implicit(test::real(back * (p - centre))));
      nearest = std::min(nearest, std::abs(f));
      return f < 0.0;
    }
    bool all = true, any = false, first = false, others = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool in = parts[i].inside(p, nearest);
      all = all && in;
      any = any || in;
      (i == 0 ? first : others) |= in;
    }
    return operation == CsgOperation::unite ? any : operation == CsgOperation::intersect ? all : first && !others;
  }
};

struct RandomTree {
  CsgNode node;
  Oracle oracle;
};

RandomTree random_tree(test::Random& random, const std::vector<test::Primitive>& primitives, int depth) {
  RandomTree tree;
  if (depth == 0) {
    const test::Primitive& primitive = primitives[random.below(static_cast<std::uint32_t>(primitives.size()))];
    const double size = random.uniform(0.5, 1.5);
    const glm::dmat3 rotation = random.rotation();
    tree.node.solid = primitive.make(dvec3(0.0), 1.0).object;
    tree.node.placement = {rotation * size, 0.5 * random.in_cube(), false};
    tree.oracle.primitive = &primitive;
    tree.oracle.back = glm::transpose(rotation) / size;
    tree.oracle.centre = tree.node.placement.translation;
    return tree;
  }
  tree.node.operation = tree.oracle.operation = static_cast<CsgOperation>(random.below(3));
  const std::uint32_t count = 1 + random.below(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    RandomTree part = random_tree(random, primitives, depth - 1);
    tree.node.parts.push_back(std::move(part.node));
    tree.oracle.parts.push_back(std::move(part.oracle));
  }
  return tree;
}

// Tame solids: their implicit function is a distance up to a small factor.
std::vector<test::Primitive> tame() {
  std::vector<test::Primitive> all;
  for (const char* name : {"sphere", "box", "cylinder", "cone", "frustum", "torus", "ellipsoid"}) {
    for (const test::Primitive& p : test::primitives()) {
      if (p.name == name) { all.push_back(p); }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("csg: a point of a line is in the spans exactly when it is in the boolean of the leaves, and spans alternate") {
  SEEDED(random);
  const std::vector<test::Primitive> primitives = tame();
  int inside = 0;
  for (int round = 0; round < 300; ++round) {
    const RandomTree random_solid = random_tree(random, primitives, 1 + static_cast<int>(random.below(3)));
    const Made<CsgTree> tree = CsgTree::make(random_solid.node);
    REQUIRE(tree);
    for (int ray = 0; ray < 40; ++ray) {
      const dvec3 d = random.direction();
      const Segment line{0.7 * random.in_cube() - random.uniform(-3, 3) * d, random.magnitude(2) * d};
      Spans spans;
      tree->spans(line, spans);
      double last = -infinity;
      for (const Span& span : spans) {
        CHECK(last < span.in.t);
        CHECK(span.in.t < span.out.t);
        last = span.out.t;
        for (const Crossing& at : {span.in, span.out}) {
          const SurfacePoint on = tree->project(at.sheet, line.at(at.t));
          CHECK(glm::length(on.position - line.at(at.t)) < 1e-7);  // the film is 2^-26 of a size of at most 5
          CHECK(glm::dot(on.normal, line.direction) * (at.t == span.in.t ? 1 : -1) < 1e-6 * glm::length(line.direction));
        }
      }
      const double t = nearest_parameter(line, dvec3(0.0)) + random.uniform(-1, 1) / glm::length(line.direction);
      double nearest = 1.0;
      const bool oracle = random_solid.oracle.inside(line.at(t), nearest);
      if (nearest < 1e-6) { continue; }
      inside += oracle;
      CHECK(oracle == std::any_of(spans.begin(), spans.end(), [&](const Span& s) { return s.in.t < t && t < s.out.t; }));
    }
  }
  CHECK(inside > 1000);
}

TEST_CASE("csg: solids cut flush leave no film, and solids that touch leave no gap, however rounding falls") {
  SEEDED(random);
  for (int round = 0; round < 200; ++round) {
    // A wall of thickness w with a round window that ends where the wall ends, and the same wall in two halves that touch, turned at
    // random.
    const double w = random.uniform(0.1, 0.3);
    const Placement turn{random.rotation(), random.in_cube(), false};
    const auto wall = BoxObject::make({-1, -1, 0}, {1, 1, w}).object;
    const auto window = Cylinder::make({0, 0, 0}, {0, 0, w}, 0.5).object;
    CsgNode cut{{}, {}, CsgOperation::subtract, {{wall, "wall", {}, {}, {}}, {window, "window", {}, {}, {}}}, turn};
    CsgNode halves{
        {}, {}, CsgOperation::unite, {{wall, "low", {}, {}, {}}, {window, "high", {}, {}, {glm::dmat3(1.0), dvec3(0, 0, w), false}}}, turn};
    const Made<CsgTree> hole = CsgTree::make(cut), tower = CsgTree::make(halves);
    REQUIRE(hole);
    REQUIRE(tower);
    for (int ray = 0; ray < 50; ++ray) {
      // Through the window from one side to the other, the rim left out.
      const double angle = random.uniform(0, 6.28), a = random.uniform(0, 0.45), b = random.uniform(0, 0.45);
      const dvec3 low(a * std::cos(angle), a * std::sin(angle), 0), high(b, 0, w);
      const Segment line = between(turn.linear * (low + 3.0 * (low - high)) + turn.translation,
                                   turn.linear * (high + 3.0 * (high - low)) + turn.translation);
      Spans through;
      hole->spans(line, through);
      for (const Span& span : through) { CHECK_FALSE((span.in.t < 3.5 / 7 && span.out.t > 3.5 / 7)); }
      for (const Span& span : through) { CHECK((span.out.t - span.in.t) * glm::length(line.direction) > 1e-3); }
      Spans up;
      tower->spans(line, up);
      REQUIRE(up.size() >= 1);
      for (const Span& span : up) { CHECK((span.out.t - span.in.t) * glm::length(line.direction) > 1e-3); }
      CHECK(std::any_of(up.begin(), up.end(), [](const Span& s) { return s.in.t < 3.5 / 7 && s.out.t > 4.02 / 7; }));
    }
  }
}

namespace {

// A house of one block: a room, two windows, a pillar that stands free in one of them; all sizes have few binary digits but the pillar's.
CsgNode house(const Placement& placement) {
  const auto box = [](const char* name, const dvec3& lo, const dvec3& hi) {
    return CsgNode{BoxObject::make(lo, hi).object, name, {}, {}, {}};
  };
  CsgNode cut{{},
              {},
              CsgOperation::subtract,
              {box("block", {-1, -1, -1}, {1, 1, 1}), box("room", {-0.75, -0.75, -0.75}, {0.75, 0.75, 0.75}),
               box("front", {-0.5, -1, -0.25}, {0.5, -0.75, 0.5}), box("side", {0.5, -0.25, -0.5}, {1.5, 0.25, 0.5})},
              {}};
  return {{}, {}, CsgOperation::unite, {cut, box("pillar", {-0.1, -1, -0.5}, {0.1, -0.7, 0.6})}, placement};
}

}  // namespace

TEST_CASE("csg: rays meet the evaluated faces of polyhedral leaves where the merged spans of the leaves say, turned or not") {
  SEEDED(random);
  for (int round = 0; round < 40; ++round) {
    const Placement placement{round == 0 ? glm::dmat3(1.0) : random.rotation() * random.magnitude(3), random.in_cube(), false};
    const double size = glm::length(placement.linear[0]);
    const Made<Csg> csg = Csg::make(house(placement));
    REQUIRE(csg);
    CHECK(csg->flat());
    CHECK_FALSE(csg->convex());
    CHECK(csg->slack() < 1e-7 * size);
    for (int ray = 0; ray < 100; ++ray) {
      const dvec3 from = placement.linear * (2.0 * random.in_cube()) + placement.translation;
      const Segment line = between(from, placement.linear * random.in_cube() + placement.translation);
      Spans faces, leaves;
      csg->spans(line, faces);
      csg->tree().spans(line, leaves);
      // They may differ where a line passes an edge within the grid, 2^-24 of half the size: one ray in 10^5.
      REQUIRE(faces.size() == leaves.size());
      for (std::size_t i = 0; i < faces.size(); ++i) {
        for (const auto& [a, b] : {std::pair(faces[i].in, leaves[i].in), std::pair(faces[i].out, leaves[i].out)}) {
          CHECK(a.sheet == b.sheet);
          CHECK(std::abs(a.t - b.t) * std::abs(glm::dot(csg->project(a.sheet, line.at(a.t)).normal, line.direction)) < 1e-6 * size);
        }
      }
    }
  }
}

TEST_CASE("csg: its mesh is closed, its vertices lie on their sheets, and it holds the volume that its spans hold") {
  SEEDED(random);
  const std::vector<test::Primitive> primitives = tame();
  long corners = 0, on_chords = 0;
  for (int round = 0; round < 20; ++round) {
    const RandomTree random_solid = random_tree(random, primitives, 2);
    const Made<Csg> csg = Csg::make(random_solid.node);
    if (!csg) {
      INFO(csg.refusal);
      CHECK(csg.refusal.find("nothing is left") == 0);
      continue;
    }
    for (const double tolerance : {1e9, 0.004 * csg->bounds().diameter()}) {
      brep::Builder builder;
      csg->approximate(tolerance, builder);
      const auto closed = brep::close<CsgBRep>(builder);
      REQUIRE(closed.brep);
      double volume = 0.0, area = 0.0;
      for (const brep::FaceId f : brep::faces(*closed.brep)) {
        const dvec3 vector_area = brep::vector_area(*closed.brep, f);
        area += glm::length(vector_area);
        for (const brep::HalfedgeId h : brep::halfedges_of(*closed.brep, f)) {
          const dvec3& p = closed.brep->data(closed.brep->vertex(h)).position;
          const double off = glm::length(csg->project(closed.brep->data(f).sheet, p).position - p);
          CHECK(off <= 0.03 * csg->bounds().diameter());
          ++corners;
          on_chords += off > 1e-7 ? 1 : 0;  // a cell of the grid
        }
        volume += glm::dot(vector_area, brep::centroid(*closed.brep, f)) / 3.0;
      }
      // By lines on a grid: n^2 columns of width w, each right but for those that cross an outline.
      const Box box = csg->bounds();
      const int n = 40;
      const dvec3 step = box.size() / static_cast<double>(n);
      double measured = 0.0;
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
          Spans spans;
          csg->spans({{box.lo.x + (i + random.uniform()) * step.x, box.lo.y + (k + random.uniform()) * step.y, box.lo.z}, {0, 0, 1}},
                     spans);
          for (const Span& span : spans) { measured += (span.out.t - span.in.t) * step.x * step.y; }
        }
      }
      // Chords are off by at most the tolerance (1 % of the size for the first one) over the area; the sum over columns by less than a
      // third.
      const double chord = std::min(tolerance, 0.01 * box.diameter());
      CHECK(std::abs(volume - measured) < chord * area + 0.3 * step.x * area);
    }
  }
  INFO(on_chords << " of " << corners);
  CHECK(on_chords * 50 < corners);  // where surfaces graze each other
}

TEST_CASE("csg: in a scene, occluded = the law = closest < 1 from the air, for faces and for merged spans") {
  SEEDED(random);
  const CsgNode ball{Sphere::make({0, 0, 0}, 1).object, "ball", {}, {}, {}};
  const CsgNode drill{Cylinder::make({0, 0, -2}, {0, 0, 4}, 0.5).object, "drill", {}, {}, {}};
  const Made<Csg> bead = Csg::make({{}, {}, CsgOperation::subtract, {ball, drill}, {}});
  REQUIRE(bead);
  std::vector<PlacedObject> objects{placed(BoxObject::make({-4, -4, -4}, {4, 4, 4}), test::room())};
  for (int i = 0; i < 6; ++i) {
    const Made<Csg> solid = i % 2 == 0 ? Csg::make(house({random.rotation(), dvec3(0.0), false})) : bead;
    objects.push_back(placed(solid, {random.rotation(), 3.0 * random.in_cube(), false}));
  }
  const Scene scene(objects);
  int blocked = 0;
  for (int i = 0; i < 4000; ++i) {
    const Segment segment = between(3.9 * random.in_cube(), 3.9 * random.in_cube());
    const bool in_air = std::none_of(objects.begin() + 1, objects.end(), [&](const PlacedObject& object) {
      Spans spans;
      object.spans(segment, spans);
      return std::any_of(spans.begin(), spans.end(), [](const Span& s) { return s.in.t < 1e-6 && s.out.t > -1e-6; });
    });
    bool law = false;
    for (std::uint32_t o = 0; o < scene.size(); ++o) { law = law || scene.occluded_by(o, segment); }
    CHECK(scene.occluded(segment) == law);
    Segments16 lanes;
    lanes.set(0, segment, no_object, no_object);
    CHECK((scene.occluded16(lanes) != 0) == law);
    const auto hit = scene.closest(segment);
    if (hit) {  // the sheet, not the face, of the object
      const SurfacePoint on = scene.object(hit->object).project(hit->sheet, segment.at(hit->t));
      CHECK(glm::length(on.position - segment.at(hit->t)) < 1e-7);
      CHECK(glm::dot(on.normal, segment.direction) < 1e-6);
    }
    if (!in_air || (hit && std::abs(hit->t - 1.0) < 1e-9)) { continue; }
    CHECK(law == (hit && hit->t < 1.0));
    blocked += law;
  }
  CHECK(blocked > 500);
}

TEST_CASE("csg: what is no solid, turned inside out, empty or nested too deep is refused with a sentence") {
  const CsgNode box{BoxObject::make({0, 0, 0}, {1, 1, 1}).object, "box", {}, {}, {}};
  const CsgNode far{BoxObject::make({2, 0, 0}, {3, 1, 1}).object, "far", {}, {}, {}};
  const CsgNode polygon{Polygon::make(test::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})).object, "wall", {}, {}, {}};
  CsgNode room = box, deep = box;
  room.placement.inside = true;
  for (int i = 0; i < 65; ++i) { deep = {{}, {}, CsgOperation::unite, {deep}, {}}; }
  const auto refusal = [](CsgOperation operation, std::vector<CsgNode> parts) {
    return Csg::make({{}, "whole", operation, std::move(parts), {}}).refusal;
  };
  CHECK(refusal(CsgOperation::unite, {}) == "'whole' has no parts");
  CHECK(refusal(CsgOperation::unite, {box, polygon}) == "'wall' has no inside: only solids can be united, intersected or taken away");
  CHECK(refusal(CsgOperation::subtract, {box, room}).find("'box' is turned inside out") == 0);
  CHECK(refusal(CsgOperation::intersect, {box, far}) == "nothing is left: the parts of an intersection do not meet");
  CHECK(refusal(CsgOperation::subtract, {box, box}) == "nothing is left of the solid");
  CHECK(refusal(CsgOperation::unite, {deep}).find("nested deeper than 64") != std::string::npos);
  CHECK(refusal(CsgOperation::unite, {box, far}).empty());
}
