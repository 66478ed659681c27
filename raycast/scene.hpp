// SPDX-License-Identifier: MIT
#pragma once

// All objects of a scene, compiled for rays (compiled.hpp), and the law of occlusion in double precision.
//
// The ends of a visibility segment lie on surfaces, up to rounding, or on chord patches inside convex ones (paper 4.3). Spans, not an
// epsilon along the ray, decide what blocks:
//   - Of an end's owner, the span that contains the end is ignored: a ray that leaves a solid is never stopped by its own surface, while a
//     concave solid can still shadow itself further on. A polygon that is an owner is ignored, and so is a convex object that owns both
//     ends.
//   - Of every other object, a span is ignored if the end merely touches it: the span begins at the end, up to a skin, and the end is no
//     deeper than a skin behind the surface where the span ends. It is also ignored if it begins and ends within the owner's own ignored
//     span (up to the skin): a chord point inside its owner represents the owner's surface, and what is sunk into the owner, or fills the
//     same place, is not in front of that surface.
// Depths are measured perpendicular to the surface, |t_crossing - t_end| |n.d|, so they do not depend on the angle of the ray. For a
// convex solid this is an upper bound of the depth of every point in the ignored part.
//
// Skins. `rounding` = eps_surface M, with M the largest coordinate of the scene (tolerances.hpp). Added to it are the non-planarity of
// the two surfaces and, between two objects, tol_contact of the smaller one's diameter: a lamp that close to the ceiling counts as lying
// on it. covered() uses the same skin, so both agree on what is coincident.
//
// This law, object by object, is blocks(). The fast searches answer in single precision where its error bound allows, and call blocks()
// otherwise. Their answers are those of blocks() for every object, bit for bit, with any instruction set. Far objects (far_objects.hpp)
// are not compiled: blocks() alone decides for them, and only if a segment leaves the surroundings of all others.
//
// All queries are const, thread-safe, and use no heap memory (except for a line that crosses a mesh more than eight times, and covered()
// where surfaces coincide).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/bvh.hpp>
#include <raycast/compiled.hpp>
#include <raycast/isa.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/shaft.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

namespace raycast {

struct Corners16;
struct Rays16;
struct Entries;

class Scene {
 public:
  // Every instruction set gives the same answers; `isa` must be available on this machine.
  explicit Scene(std::vector<PlacedObject> objects, Isa isa = best_isa());

  // From now on this caster answers all rays. Occluder lists and covered() are still computed by the scene, and so are hits where
  // surfaces coincide or a back is met.
  void ask(OtherCaster caster) { other_ = std::move(caster); }

  // From now on rays ignore these objects. Each must be the same surface at the same place as a later object that is not left out. Their
  // points count as covered.
  void leave_out(std::span<const std::uint32_t> copies);
  [[nodiscard]] bool left_out(std::uint32_t i) const { return left_out_[i]; }

  [[nodiscard]] const PlacedObject& object(std::uint32_t i) const { return objects_[i]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(objects_.size()); }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  [[nodiscard]] double diameter() const { return bounds_.diameter(); }
  // Approximate cost of the first hit of a ray, in rays through a scene of few polygons. The probability that a ray meets the bounds of
  // an object is the ratio of their surface to that of the scene (Cauchy 1832).
  [[nodiscard]] double ray_work() const;
  // Additional cost of finding the objects that a ray may meet, beyond that among few polygons; in the same unit.
  [[nodiscard]] double walk_work() const;
  // Approximate cost of finding the first hit of this ray, which lies at t = 1, in microseconds of a core of 2024. Computed from the
  // nodes that the search opens and the tests that it makes, so it is the same on any machine.
  [[nodiscard]] double ray_work(const Segment& ray) const;
  [[nodiscard]] std::size_t bytes() const {  // of the compiled scene, without the objects themselves
    return objects_.capacity() * sizeof(PlacedObject) + records_.capacity() * sizeof(Record) + corners_.capacity() * sizeof(glm::dvec3) +
           walls_.capacity() * sizeof(Walls) + compiled_.bytes() + places_.bytes() + placed_.capacity() * sizeof(std::uint32_t);
  }

  // Does anything stand between the two ends, t in (0, 1)? The owners are the objects on which the ends lie. Symmetric: exchanging ends
  // and owners gives the same answer (up to the rounding of grazing rays). A segment of length zero is never occluded.
  [[nodiscard]] bool occluded(const Segment& segment, std::uint32_t source_owner = no_object, std::uint32_t target_owner = no_object) const;

  // The lanes whose segment is occluded: bit for bit the answers of occluded() for each. `hint`: the last blocker, a shape that is tested
  // first; keep one per pair of patches, or per patch.
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, std::uint32_t& hint) const;
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments) const {
    std::uint32_t hint = no_shape;
    return occluded16(segments, hint);
  }

  // The possible blockers of segments between two patches (shaft.hpp), from the whole scene or from the list of a pair of their ancestors.
  [[nodiscard]] OccluderList occluders(const PatchShape& a, const PatchShape& b) const;
  [[nodiscard]] OccluderList filter(const OccluderList& parent, const PatchShape& a, const PatchShape& b) const;
  [[nodiscard]] std::uint32_t object_of(std::uint32_t shape) const { return compiled_.object_of(shape); }  // of a shape in a list
  // As above, for segments between the patches of the list; the answers are the same.
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, const OccluderList& list, std::uint32_t& hint) const;

  // The law for one object, which defines occluded(). In double precision, without any search.
  [[nodiscard]] bool occluded_by(std::uint32_t object, const Segment& segment, std::uint32_t source_owner = no_object,
                                 std::uint32_t target_owner = no_object) const {
    return has_line(segment) && blocks(Line(segment), end_at(source_owner), end_at(target_owner), object);
  }

  // The first surface at t > 0, without upper limit: where a span of any object begins. Of coincident surfaces the covering one is hit:
  // the later object if they face the same way, the front if they stand back to back. `source_sheet`: as in Segments16.
  [[nodiscard]] std::optional<Hit> closest(const Segment& ray, std::uint32_t source_owner = no_object,
                                           std::uint32_t source_sheet = unknown_sheet) const;
  // The same for a ray that begins at a point of a surface.
  [[nodiscard]] std::optional<Hit> closest(const ScenePoint& from, const glm::dvec3& direction) const {
    return closest({from.position, direction}, from.object, from.sheet);
  }
  // The point of the surface at which `ray` has this hit.
  [[nodiscard]] ScenePoint point(const Hit& hit, const Segment& ray) const {
    return {objects_[hit.object].project(hit.sheet, ray.at(hit.t)), hit.object, hit.sheet};
  }

  // As above for sixteen rays, bit for bit; the targets' owners are ignored. Faster if the rays are close to each other.
  [[nodiscard]] Hits16 closest16(const Segments16& rays) const;

  // Is the point p of an object's surface, with unit normal n into the air, covered? It is if another object fills the air just in front
  // of p (p is inside that object, or the object stands on p), or if a later object's surface that is not covered itself coincides and
  // faces the same way. Surfaces without thickness that stand back to back (a two-sided sheet) do not cover each other. So at every place
  // exactly one surface is visible: the foremost of those that coincide there, or a later one within its skin.
  [[nodiscard]] bool covered(const glm::dvec3& p, const glm::dvec3& n, std::uint32_t owner) const;
  [[nodiscard]] bool covered(const ScenePoint& point) const { return covered(point.position, point.normal, point.object); }

 private:
  struct Record {                                      // data of an object for queries
    glm::dvec3 normal{0.0}, point{0.0};                // of a polygon
    std::uint32_t first_corner = 0, corner_count = 0;  // 0 corners: not a polygon
    double touch = 0.0;                                // tol_contact of its diameter
    double slack = 0.0;
  };
  struct End {  // of a segment
    std::uint32_t owner;
    double touch = 0.0, base;
  };
  struct Line {
    const Segment& segment;
    RayFrame frame;
    SlabTest slabs;
    explicit Line(const Segment& s) : segment(s), frame(s), slabs(s) {}
  };
  struct Nearest {
    Hit hit{infinity, no_object, 0, true};
    double limit = infinity;
    std::uint32_t count = 0;
    std::array<Hit, 4> tied{};  // the nearest hit, then those equally near within rounding; if there are more than four, the last object
  };
  struct Search {  // search for the first hit of a ray
    Segment ray;
    End source;
    std::uint32_t source_sheet = unknown_sheet;
    Nearest nearest{};
    double t0 = 0.0, t1 = infinity;  // range of the ray within the compiled scene
    // The last objects for which the law was evaluated: once is enough, for what is nearer was found with the rest.
    std::array<std::uint32_t, 4> asked{no_object, no_object, no_object, no_object};

    [[nodiscard]] bool is_asked(std::uint32_t object) const { return std::find(asked.begin(), asked.end(), object) != asked.end(); }
    // `farther`: the limit rose, so that objects that were asked before may be met between the old limit and the new one.
    void set_asked(std::uint32_t object, bool farther) {
      if (farther) { asked.fill(no_object); }
      std::rotate(asked.begin(), asked.end() - 1, asked.end());
      asked.front() = object;
    }

    // Sets the range within a cube around the whole scene; returns false if there is none.
    [[nodiscard]] bool clip(const Compiled& scene);
  };

  void compile();
  [[nodiscard]] bool is_far(std::uint32_t object) const { return std::binary_search(far_.begin(), far_.end(), object); }

  struct Exact;
  struct ExactOne;
  struct Asker;
  [[nodiscard]] std::uint32_t occluded16(const Segments16& segments, const std::uint32_t* list, std::uint32_t count, bool rooms_clear,
                                         std::uint32_t& hint) const;
  [[nodiscard]] OccluderList list_of(const OccluderList* parent, const PatchShape& a, const PatchShape& b) const;
  [[nodiscard]] bool far_between(const std::array<glm::dvec3, 4>& p, const std::array<glm::dvec3, 4>& q, const PatchShape& a,
                                 const PatchShape& b) const;
  void drop_guards(OccluderList& list, const Corners16& corners) const;
  [[nodiscard]] bool within(std::uint32_t object, std::span<const glm::dvec3> points) const;
  [[nodiscard]] bool rooms_clear(const PatchShape& a, const PatchShape& b, const OccluderList& list, const Corners16& corners) const;
  // Is the point in the convex room number r, at least `depth` from its walls or, within rounding, on one of them? False for rooms
  // without Walls.
  [[nodiscard]] bool in_room(std::size_t r, const glm::dvec3& p, double depth = 0.0) const {
    const Walls& walls = walls_[r];
    const auto within = [&](const glm::dvec3& point, const glm::dvec3& normal) {
      return glm::dot(normal, p - point) >= depth - 0.5 * rounding_;
    };
    for (std::uint32_t sheet = 0; sheet < walls.curved_sheets; ++sheet) {
      const SurfacePoint nearest = objects_[compiled_.rooms[r]].project(sheet, p);
      if (!within(nearest.position, nearest.normal)) { return false; }
    }
    return walls.curved_sheets > 0 ||
           (!walls.planes.empty() &&
            std::all_of(walls.planes.begin(), walls.planes.end(), [&](const Plane& wall) { return within(wall.point, wall.normal); }));
  }
  // Adds hits with far objects, which only rays from elsewhere or without another hit can meet.
  void approach_far(Search& search) const;
  // Adds hits with rooms, after all other objects: a point in a convex room, farther from its walls than ties extend, is hit before these.
  void approach_rooms(Search& search) const;
  [[nodiscard]] std::uint32_t may_be_around(const Guard& room, const Rays16& rays, std::uint32_t lanes) const;
  [[nodiscard]] std::uint32_t blocked_by_rooms(const Segments16& segments, const Rays16& rays, std::uint32_t near,
                                               std::uint32_t lanes) const;

  [[nodiscard]] End end_at(std::uint32_t owner) const {
    if (owner == no_object) { return {owner, 0.0, rounding_}; }
    return {owner, records_[owner].touch, rounding_ + records_[owner].slack};
  }
  [[nodiscard]] double skin(const End& end, std::uint32_t i) const {
    return end.base + records_[i].slack + (end.owner == i ? 0.0 : std::min(end.touch, records_[i].touch));
  }
  // Distance of the point `dt` beyond the crossing from the surface's plane there.
  [[nodiscard]] double depth(std::uint32_t i, const Segment& s, const Crossing& at, double dt) const {
    return dt < infinity ? dt * std::abs(along(i, s, at)) : infinity;
  }
  [[nodiscard]] double along(std::uint32_t i, const Segment& s, const Crossing& at) const {
    const Record& r = records_[i];
    return glm::dot(r.corner_count ? r.normal : objects_[i].normal(at.sheet, s.at(at.t)), s.direction);
  }
  [[nodiscard]] bool passes(const Line& line, const Record& polygon) const {
    return line.frame.winding(std::span(corners_).subspan(polygon.first_corner, polygon.corner_count)) != 0;
  }
  [[nodiscard]] bool blocks(const Line& line, const End& a, const End& b, std::uint32_t i) const;
  [[nodiscard]] bool blocks_by_spans(const Segment& s, const End& a, const End& b, std::uint32_t i) const;
  // On an open surface every crossing counts by itself: the surface blocks if one of its faces does.
  [[nodiscard]] bool blocks_by_face(const Segment& s, const End& a, const End& b, std::uint32_t i, std::uint32_t face) const;
  struct Stops;
  // Does the ray hit this face of an open surface, other than within the skin at its source?
  [[nodiscard]] bool meets_face(const Segment& ray, const End& source, std::uint32_t i, std::uint32_t face, const Crossing& at) const;
  // Does the point at an end of a segment lie on the plane of this sheet, well within the skin?
  [[nodiscard]] bool touches(const glm::dvec3& p, const End& end, std::uint32_t object, std::uint32_t sheet) const;
  [[nodiscard]] bool within_owner(const Segment& s, const End& end, bool source, const Span& span, std::uint32_t i) const;
  [[nodiscard]] std::uint32_t met_by_other(const Segments16& rays, Hits16& hits) const;
  void approach(const Line& line, const End& a, std::uint32_t i, Nearest& nearest) const;
  void approach_bounded(Search& search) const;
  [[nodiscard]] std::optional<Crossing> first_crossing(const Search& search, const Entries& entries, unsigned i, float limit) const;
  void decide(Search& search, const Entries& entries, float limit) const;
  [[nodiscard]] bool ties(const Segment& ray, const Hit& first, const Hit& hit) const;
  void offer(const Segment& ray, const Hit& hit, Nearest& nearest) const;

  std::vector<PlacedObject> objects_;
  std::vector<bool> left_out_;      // by object
  std::vector<std::uint32_t> far_;  // objects that are not compiled (far_objects.hpp)
  Box near_;                        // the bounds of all others
  std::vector<Record> records_;
  std::vector<glm::dvec3> corners_;
  // How a convex room decides whether a point is inside: a polyhedral one by its planes (normals inwards), a curved one by the nearest
  // points of its sheets. A room of many walls has neither, nor has one whose project() does not find the nearest point.
  struct Walls {
    std::vector<Plane> planes;
    std::uint32_t curved_sheets = 0;
  };
  std::vector<Walls> walls_;  // by room
  Compiled compiled_;
  std::vector<std::uint32_t> guard_of_;  // by object: its index in compiled_.guards, or no_shape
  std::vector<std::uint32_t> placed_;    // the objects that are no rooms and are not left out
  Bvh places_;                           // of their bounds: a search around a point need not visit the faces of meshes
  OtherCaster other_;
  Isa isa_;
  Box bounds_;
  double rounding_ = 0.0, slack_ = 0.0;  // slack_: largest of all objects
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/first_hit.cpp>
#include <raycast/occluder_lists.cpp>
#include <raycast/occlusion.cpp>
#include <raycast/ray_cost.cpp>
#include <raycast/scene.cpp>
#endif
