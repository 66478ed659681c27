// SPDX-License-Identifier: MIT
#pragma once

// The lamps of a scene, for direct light at points (LitRegion, lit_region.hpp), and how each object is taken out of their light.
//
// A lamp is one sheet of one object that emits, or, where such sheets are many and that is asked for, all that shine alike of one object
// or of objects near each other: a bulb of a thousand triangles, a row of candles. Without anything in between, the form factor from a
// point to a lamp is the contour integral over the lamp's outline (facets.hpp): exact for flat lamps; a curved one is a polyhedron of the
// same area, its outline off by at most 0.2 % of its diameter.

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

// Heights below this count as none, in a scene of size 1 to 2: a thousandth of what a picture or a leaf could tell, far above rounding.
inline constexpr double least_slack = 1e-9;

}  // namespace detail

struct LampLimits {
  // The strongest sheets are taken, up to this number; those that surround their middle (a bright dome) up to this share of the scene's
  // area: what shines all around a point is not met better one by one.
  std::uint32_t most = 64;
  double most_surrounding = 0.1;
  // Where there are more sheets than that: are those that shine alike taken together?
  bool bodies = false;
};

class DirectLight {
 public:
  DirectLight() = default;
  // `surfaces`: the unrefined boundaries of the objects of the scene, one each, needed no more after this; `emission`: exitance of each
  // input surface.
  DirectLight(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
              const LampLimits& limits = {});

  struct Lamp {
    std::uint32_t surface = 0, object = 0;  // of the input; of several surfaces the first; no_object for several objects
    Color exitance{0.0};
    Facets facets;
    std::vector<std::uint32_t> object_of;  // of each facet
    bool flat = false;                     // all facets lie in one plane
    double area = 0.0;                     // of the true surface
    double correction = 1.0;               // that over the area of the facets
    glm::dvec3 centre{0.0};                // of a sphere around it
    double radius = 0.0;
    double width = 0.0;                 // of a cylinder around it, along its longest edge
    std::array<glm::dvec3, 4> corners;  // of a rectangle around it, in its plane; of a curved one, around a point of it
    double bulge = 0.0;                 // how far it leaves the rectangle
    std::vector<SampleEnd> ends;        // of each facet
    std::vector<LampSample> samples;    // even over its area, the first ones too
    FineSamples fine;                   // about these; of large lamps, others have none
    std::vector<bool> behind;           // by object: some of it lies behind the plane of the flat lamp
    [[nodiscard]] raycast::PatchShape shape() const { return {corners, object, bulge}; }
  };
  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }
  // Is this input surface among the lamps? What else emits is left to whoever asks.
  [[nodiscard]] bool is_lamp(std::uint32_t surface) const { return lamp_of(surface) != nullptr; }
  // The lamp that an input surface belongs to; null: none.
  [[nodiscard]] const Lamp* lamp_of(std::uint32_t surface) const {
    return surface < lamp_of_.size() && lamp_of_[surface] < lamps_.size() ? &lamps_[lamp_of_[surface]] : nullptr;
  }

  // What segments meet: the scene, in which open meshes stand in for curved objects that are slow to meet; two for each, the second ones
  // behind all objects. The object that such a mesh belongs to, and how far points on it are lifted to be above its meshes; 0: none stand
  // in.
  [[nodiscard]] const raycast::Scene& objects() const { return *objects_; }
  [[nodiscard]] std::uint32_t whole(std::uint32_t o) const { return o < bodies_.size() ? o : whole_[o - bodies_.size()]; }
  [[nodiscard]] double lift(std::uint32_t o) const { return bodies_[o].lift; }
  // A point of object o, lifted above these meshes where such stand in: along its normal, and at a concave edge along that of the sheet
  // beyond it, too, for beside an edge that is round the point may lie between that sheet and the mesh before it.
  [[nodiscard]] glm::dvec3 lifted(std::uint32_t o, const glm::dvec3& x, const glm::dvec3& n) const;
  // How far segments stay off flat surfaces on which they begin and end, so that these need no owners and single precision decides about
  // nearly all: by more than its error, in a scene of size 1 to 2. Where lamps are far, beside the size of all else, by less: then double
  // precision decides about more of them, and what stands on a floor has its shadow there.
  [[nodiscard]] double off_surface() const { return off_surface_; }
  // The sheet of that object which a segment has met.
  [[nodiscard]] std::uint32_t sheet(const raycast::Hit& hit) const {
    const Body& body = bodies_[whole(hit.object)];
    return body.lift > 0.0 ? body.sheets[hit.object < bodies_.size() ? 0 : 1][hit.sheet] : hit.sheet;
  }

 private:
  friend class LitRegion;
  // How an object is taken out of a lamp.
  struct Body {
    Facets facets;
    bool convex = false;  // by its outline; an exact one may be off that by as much as meshes that stand in are off their objects
    bool closed = false;  // by those faces alone that show their front
    bool exact = false;   // its facets are it
    raycast::Box bounds;
    double lift = 0.0;  // above 0: meshes stand in for it where segments are asked, and points on it are lifted above them by so much
    std::array<std::vector<std::uint32_t>, 2> sheets;  // then: of the faces of both
  };
  // Sheets that shine alike.
  struct Candidate {
    struct OfObject {
      std::uint32_t object = 0;
      std::vector<std::uint32_t> sheets;  // ascending
    };
    std::vector<OfObject> parts;
    Color exitance{0.0};
    double strength = 0.0, area = 0.0;
  };
  void take_bodies(const std::vector<Surface>& surfaces);
  // Takes candidates together until they are `most` at most, if that is possible.
  [[nodiscard]] static std::vector<Candidate> join_alike(const std::vector<Candidate>& singles, const raycast::Scene& objects,
                                                         std::uint32_t most);
  // A lamp without samples, and these once it is known in place of which objects meshes stand.
  [[nodiscard]] static Lamp make_lamp(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const Candidate& candidate);
  void take_samples(Lamp& lamp, bool fine, std::uint64_t seed) const;

  const raycast::Scene* objects_ = nullptr;
  const raycast::Scene* true_objects_ = nullptr;  // without meshes that stand in
  double off_surface_ = 1e-5;
  double slack_ = detail::least_slack;  // heights below count as none: twice what faces that are not quite plane are off, if that is more
  // Where meshes stand in, objects_ points to this.
  std::shared_ptr<const raycast::Scene> with_stand_ins_;
  std::vector<std::uint32_t> whole_;  // of those the objects that they are halves of
  std::vector<Lamp> lamps_;
  std::vector<std::uint32_t> lamp_of_;  // by input surface; beyond the lamps: none
  std::vector<Body> bodies_;            // by object; without facets: asked by segments
  std::vector<std::uint32_t> rooms_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/direct_light.cpp>
#endif
