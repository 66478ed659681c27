// SPDX-License-Identifier: MIT
#pragma once

// The lamps of a scene for direct light at points (LitRegion, lit_region.hpp), and the way in which each object is treated as a blocker.
//
// A lamp is one emitting sheet of one object. If there are many such sheets and LampLimits::bodies is set, all sheets of equal exitance
// of one object, or of neighbouring objects, are joined to one lamp: a bulb of a thousand triangles, a row of candles. Without blockers,
// the form factor from a point to a lamp is the contour integral over the lamp's outline (facets.hpp). This is exact for flat lamps; a
// curved lamp is replaced by a polyhedron of the same area whose outline is off by at most 0.2 % of its diameter.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// Heights below this count as zero, relative to the diameter of what does not emit: a thousandth of what is visible in a picture or on a
// leaf. Beside a sun a million times as far away as the rest is large, rounding sets the limit, `rounding_slack`, in a scene of size 1 to
// 2.
inline constexpr double least_slack = 1e-9, rounding_slack = 1e-15;

}  // namespace detail

struct LampLimits {
  // The strongest sheets become lamps, up to this number. Lamps that surround their own centre (a bright dome) are taken only up to this
  // share of the scene's area, because light from all sides is not computed better lamp by lamp.
  std::uint32_t most = 64;
  double most_surrounding = 0.1;
  // If there are more emitting sheets than `most`: are sheets of equal exitance joined to one lamp?
  bool bodies = false;
};

class DirectLight {
 public:
  DirectLight() = default;
  // `surfaces`: the unrefined boundaries of the objects, one each, which may be freed after this call; `emission`: exitance of each input
  // surface.
  DirectLight(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
              const LampLimits& limits = {});

  struct Lamp {
    std::uint32_t surface = 0, object = 0;  // surface: the first input surface; object: no_object if there are several objects
    Color exitance{0.0};
    Facets facets;
    std::vector<std::uint32_t> object_of;  // object of each facet
    bool flat = false;                     // do all facets lie in one plane?
    double area = 0.0;                     // area of the true surface
    double correction = 1.0;               // true area divided by the area of the facets
    glm::dvec3 centre{0.0};                // of the bounding sphere
    double radius = 0.0;
    double width = 0.0;                 // diameter of a bounding cylinder along its longest edge
    std::array<glm::dvec3, 4> corners;  // rectangle around it, in its plane; of a curved lamp, in a plane through one of its points
    double bulge = 0.0;                 // largest distance from the plane of the rectangle
    std::vector<SampleEnd> ends;        // by facet
    bool ball = false;                  // nearly a sphere: then the samples are those of a disk
    std::vector<LampSample> samples;    // stratified over its area, any first multiple of 16 of them, too
    std::vector<LampSample> rim;        // of a ball: sixteen samples on the rim of the disk, in addition
    FineSamples fine;                   // finer samples around these; only large lamps have them
    std::vector<bool> behind;           // by object: does a part of it lie behind the plane of the flat lamp?
    [[nodiscard]] raycast::PatchShape shape() const { return {corners, object, bulge}; }
  };
  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }
  // Is this input surface a lamp? Light of other emitters is left to the caller.
  [[nodiscard]] bool is_lamp(std::uint32_t surface) const { return lamp_of(surface) != nullptr; }
  // The lamp that an input surface belongs to, or null.
  [[nodiscard]] const Lamp* lamp_of(std::uint32_t surface) const {
    return surface < lamp_of_.size() && lamp_of_[surface] < lamps_.size() ? &lamps_[lamp_of_[surface]] : nullptr;
  }

  // The objects that shadow segments are tested against. Curved objects that are slow to intersect are replaced by two open meshes each,
  // the second ones numbered after all objects; whole(o) is the object that a mesh belongs to. lift(o) is the distance by which points on
  // object o are lifted above its meshes; 0 if it has none.
  [[nodiscard]] const raycast::Scene& objects() const { return *objects_; }
  [[nodiscard]] std::uint32_t whole(std::uint32_t o) const { return o < bodies_.size() ? o : whole_[o - bodies_.size()]; }
  [[nodiscard]] double lift(std::uint32_t o) const { return bodies_[o].lift; }
  // A point of object o, lifted above its meshes if it has any: along its normal and, at a concave edge, also along the normal of the
  // adjacent sheet, because beside a rounded edge the point may lie between that sheet and its mesh.
  [[nodiscard]] glm::dvec3 lifted(std::uint32_t o, const glm::dvec3& x, const glm::dvec3& n) const;
  // The distance from flat surfaces at which segments begin and end, so that they need no owners and single precision decides nearly all
  // tests. It exceeds the single-precision error in a scene of size 1 to 2. If lamps are far away compared with the rest of the scene, or
  // objects far smaller than it, it is smaller: then double precision decides more tests, and small objects still cast shadows where they
  // touch the floor, and a lamp in a hut on a wide plain lights what is before the door.
  [[nodiscard]] double off_surface() const { return off_surface_; }
  // The sheet of the true object that a segment has met.
  [[nodiscard]] std::uint32_t sheet(const raycast::Hit& hit) const {
    const Body& body = bodies_[whole(hit.object)];
    return body.lift > 0.0 ? body.sheets[hit.object < bodies_.size() ? 0 : 1][hit.sheet] : hit.sheet;
  }

 private:
  friend class LitRegion;
  // How an object is treated as a blocker of a lamp.
  struct Body {
    Facets facets;
    bool convex = false;  // by its outline; an exact body may deviate by as much as stand-in meshes deviate from their objects
    bool closed = false;  // is it bounded by the visible faces alone?
    bool exact = false;   // are the facets the exact surface?
    raycast::Box bounds;
    static constexpr std::size_t of_run = 16;
    std::vector<raycast::Box> runs;  // bounds of facets 0 to 15, 16 to 31, and so on
    double lift = 0.0;  // if > 0, meshes stand in for it in segment tests, and points on it are lifted above them by this length
    std::array<std::vector<std::uint32_t>, 2> sheets;  // then: the sheet of each face of both meshes
  };
  // Sheets of equal exitance.
  struct Candidate {
    struct OfObject {
      std::uint32_t object = 0;
      std::vector<std::uint32_t> sheets;  // ascending
    };
    std::vector<OfObject> parts;
    Color exitance{0.0};
    double strength = 0.0, area = 0.0;
  };
  // What the constructor needs to know of all sheets: those that emit, the area of all, and the bounds of those that do not emit.
  struct Sheets {
    std::vector<Candidate> candidates;
    double area = 0.0;
    raycast::Box dark;
  };
  [[nodiscard]] static Sheets sheets_of(const std::vector<Surface>& surfaces, const std::vector<Color>& emission);
  void set_tolerances(const raycast::Box& dark);
  void take_bodies(const std::vector<Surface>& surfaces);
  // Joins candidates until there are at most `most`, if that is possible.
  [[nodiscard]] static std::vector<Candidate> join_alike(const std::vector<Candidate>& singles, const raycast::Scene& objects,
                                                         std::uint32_t most);
  // make_lamp leaves out the samples, which need to know which objects have stand-in meshes; take_samples adds them.
  [[nodiscard]] static Lamp make_lamp(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const Candidate& candidate);
  void take_samples(Lamp& lamp, bool fine, std::uint64_t seed) const;
  void mark_behind(Lamp& lamp) const;  // sets Lamp::behind

  const raycast::Scene* objects_ = nullptr;
  const raycast::Scene* true_objects_ = nullptr;  // the scene without stand-in meshes
  double off_surface_ = 1e-5;
  // Heights below this count as zero: least_slack, or twice the deviation of the least planar faces if that is more.
  double slack_ = detail::least_slack;
  // The scene that objects_ points to if there are stand-in meshes.
  std::shared_ptr<const raycast::Scene> with_stand_ins_;
  std::vector<std::uint32_t> whole_;  // by mesh: the object that it belongs to
  std::vector<Lamp> lamps_;
  std::vector<std::uint32_t> lamp_of_;  // by input surface; values beyond the lamps: none
  std::vector<Body> bodies_;            // by object; a body without facets is tested by segments
  std::vector<std::uint32_t> rooms_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/alike_lamps.cpp>
#include <radiosity/direct/direct_light.cpp>
#endif
