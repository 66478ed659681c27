// SPDX-License-Identifier: MIT
#include <radiosity/picture/reconstruct.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/refine.hpp>
#include <brep/t_vertices.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/corner_normal.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::uint64_t eliminate_t_vertices(std::vector<Surface>& surfaces) {
  std::uint64_t added = 0;
  for (Surface& surface : surfaces) {
    if (surface.topology == Topology::separate) { continue; }
    std::vector<brep::FaceId> faces;
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      if (surface.brep.data(f).sheet != brep::no_sheet) { faces.push_back(f); }
    }
    for (const brep::FaceId f : faces) { added += brep::eliminate_t_vertices(surface.brep, f); }
  }
  return added;
}

namespace detail {

// The angle of the face of h at the origin of h.
[[nodiscard]] HALFLIGHT_INLINE double corner_angle(const SurfaceBRep& brep, brep::HalfedgeId h) {
  const glm::dvec3& p = brep.data(brep.vertex(h)).position;
  const glm::dvec3 a = brep.data(brep.target(h)).position - p;
  const glm::dvec3 b = brep.data(brep.vertex(brep.prev(h))).position - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

HALFLIGHT_INLINE void set_normals(const raycast::PlacedObject& object, SurfaceBRep& brep) {
  for (const brep::FaceId f : brep::faces(brep)) {
    const std::uint32_t sheet = brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    glm::dvec3 middle{0.0};
    double corners = 0.0;
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      middle += brep.data(brep.vertex(h)).position;
      corners += 1.0;
    }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      brep.data(h).normal = corner_normal(object, sheet, brep.data(brep.vertex(h)).position, middle / corners);
    }
  }
}

// The weight of one face's light in a corner of another, by their normals (reconstruct.hpp): the 64th power of the cosine.
[[nodiscard]] inline double alike(const glm::dvec3& a, const glm::dvec3& b) {
  double weight = std::max(0.0, glm::dot(a, b));
  for (int power = 1; power < 64; power *= 2) { weight *= weight; }
  return weight;
}

// The weight of a leaf's light in a corner of a much larger leaf (reconstruct.hpp). `own`: area; `other`: exposed area, because a sliver
// counts as small however long it is, and so does the visible part beside an object that stands on the leaf.
[[nodiscard]] inline double beside(double own, double other) {
  constexpr double much_larger = 64.0;
  return std::min(1.0, much_larger * other / own);
}

// For faces that were cut: does a wall stand between these two leaves near their common corner v, or does something hang close in front
// of only one of them? Tested just above the leaves.
[[nodiscard]] HALFLIGHT_INLINE bool parted(const LeafLight& light, std::uint32_t a, std::uint32_t b, const glm::dvec3& v) {
  constexpr double along = 0.01, above = 1e-3;
  const Node &from = light.hierarchy[a], &to = light.hierarchy[b];
  const glm::dvec3 lift = v + above * std::min(from.radius, to.radius) * from.normal;
  const glm::dvec3 p = lift + along * (from.centre - v), q = lift + along * (to.centre - v);
  const glm::dvec3 up = std::max(from.radius, to.radius) * from.normal;
  return light.objects->occluded({p, q - p}) || light.objects->occluded({p, up}) != light.objects->occluded({q, up});
}

// Colours the half-edges of a face whose leaf is `own`.
HALFLIGHT_INLINE void colour_face(SurfaceBRep& brep, brep::FaceId f, std::uint32_t own, const LeafLight& light, Reconstruction kind) {
  const bool constant = kind == Reconstruction::constant || kind == Reconstruction::none;
  const auto material = [&](std::uint32_t node) { return light.materials[light.hierarchy[node].surface]; };
  if (constant && light.exposure.area[own] > 0.0) {
    for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) { brep.data(e).radiosity = light.radiosity[own]; }
    return;
  }
  const std::uint32_t root = input_face(light.hierarchy, own), part = brep.data(f).part;
  // False for buried faces, which show the light around them.
  const bool walls = light.objects != nullptr && light.exposure.area[own] > 0.0;
  Color face_sum{0.0};  // sum over the corners that have a colour
  int coloured = 0;
  std::vector<brep::HalfedgeId> bare;
  for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) {
    Color sum{0.0};
    double weights = 0.0;
    for (const brep::HalfedgeId l : brep::halfedges_from(brep, brep.vertex(e))) {
      const std::uint32_t node = brep.data(brep.face(l)).node;
      if (node == no_node || !(light.exposure.area[node] > 0.0) || material(node) != material(own)) { continue; }
      double weight = corner_angle(brep, l) * beside(light.hierarchy[own].area, light.exposure.area[node]);
      if (kind != Reconstruction::simple) { weight *= alike(brep.data(e).normal, brep.data(l).normal); }
      const bool cut = walls && brep.data(brep.face(l)).part == part && input_face(light.hierarchy, node) != root;
      if (cut && parted(light, own, node, brep.data(brep.vertex(e)).position)) { continue; }
      sum += weight * light.radiosity[node];
      weights += weight;
    }
    if (!(weights > 0.0)) {
      bare.push_back(e);
      continue;
    }
    brep.data(e).radiosity = sum / weights;
    face_sum += sum / weights;
    ++coloured;
  }
  const Color mean = coloured > 0 ? face_sum / static_cast<double>(coloured) : light.radiosity[own];
  for (const brep::HalfedgeId e : bare) { brep.data(e).radiosity = mean; }
  if (constant) {
    for (const brep::HalfedgeId e : brep::halfedges_of(brep, f)) { brep.data(e).radiosity = mean; }
  }
}

// Does a face of the same sheet with exposed area share a vertex with this one?
template <class Exposed>
[[nodiscard]] bool touches_exposed(const SurfaceBRep& brep, brep::FaceId f, const Exposed& exposed) {
  const std::uint32_t sheet = brep.data(f).sheet;
  for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
    for (const brep::HalfedgeId l : brep::halfedges_from(brep, brep.vertex(h))) {
      if (brep.data(brep.face(l)).sheet == sheet && exposed(brep.face(l))) { return true; }
    }
  }
  return false;
}

// Does the object end at this point of one of its planes? Planes extend beyond the outlines of objects.
[[nodiscard]] HALFLIGHT_INLINE bool ends_at(const raycast::PlacedObject& object, const raycast::SurfacePoint& at, double touch) {
  const raycast::Segment line{at.position, at.normal};
  raycast::Spans spans;
  object.spans_near(line, -touch, touch, spans);
  return std::any_of(spans.begin(), spans.end(), [&](const raycast::Span& span) { return std::abs(span.out.t) <= touch; });
}

// Does a corner of the border of a sheet lie within a convex polygon, more than `touch` inside its edges?
[[nodiscard]] HALFLIGHT_INLINE bool border_within(const SurfaceBRep& brep, std::uint32_t sheet, Polygon polygon, double touch) {
  const glm::dvec3 up = brep::normal(polygon);
  const auto is_within = [&](const glm::dvec3& p) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const glm::dvec3 &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
      const glm::dvec3 inwards = glm::cross(up, b - a);
      if (glm::dot(inwards, p - a) <= touch * glm::length(inwards)) { return false; }
    }
    return true;
  };
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).sheet != sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      if (brep.data(brep.face(brep::twin(h))).sheet != sheet && is_within(brep.data(brep.vertex(h)).position)) { return true; }
    }
  }
  return false;
}

// Does a face of a flat object lie completely on another flat object that covers it: one that faces the same way, or a solid that stands
// on it? Then nothing of it may be visible, not even slivers as at the foot of a curved object or at the rim of a disk, whose mesh lies
// within the disk. The corners, drawn in slightly, and points between them must lie on the other object, and no corner of that object's
// border may lie within the face. `from`: first object that is considered among those that face the same way.
[[nodiscard]] HALFLIGHT_INLINE bool lies_under(const Surface& own, brep::FaceId f, const std::vector<Surface>& surfaces,
                                               std::size_t from = 0) {
  if (!own.object->flat()) { return false; }
  Polygon corners;
  raycast::Box box;
  glm::dvec3 middle{0.0};
  for (const brep::HalfedgeId h : brep::corners(own.brep, f)) {
    corners.push_back(own.brep.data(own.brep.vertex(h)).position);
    box.extend(corners.back());
    middle += corners.back();
  }
  middle /= static_cast<double>(corners.size());
  const glm::dvec3 normal = glm::normalize(vector_area(corners));
  Polygon within{middle};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    for (const double t : {0.0, 0.25, 0.5, 0.75}) {
      const glm::dvec3 p = a + t * (b - a);
      within.push_back(p + 1e-6 * (middle - p));
      if (t != 0.25 && t != 0.75) { within.push_back(0.5 * (p + middle)); }
    }
  }
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& other) {
    const bool alike = static_cast<std::size_t>(&other - surfaces.data()) >= from, opposite = other.object->solid();
    if (other.object == own.object || !other.object->exact() || !(alike || opposite)) { return false; }
    const raycast::Box bounds = other.object->bounds();
    const double touch = 256.0 * raycast::unit_roundoff * bounds.magnitude() +
                         raycast::tol_contact * std::min(bounds.diameter(), own.object->bounds().diameter());
    const raycast::Box grown = bounds.grown(touch);
    if (!grown.contains(box.lo) || !grown.contains(box.hi)) { return false; }
    raycast::Spans through;  // the sheets at the middle of the face; its foot on each is at most `touch` away, aslant by the cosine below
    other.object->spans_near({middle, normal}, -2.0 * touch, 2.0 * touch, through);
    std::vector<std::uint32_t> sheets;
    for (const raycast::Span& span : through) {
      if (std::abs(span.in.t) <= 2.0 * touch) { sheets.push_back(span.in.sheet); }
      if (std::abs(span.out.t) <= 2.0 * touch) { sheets.push_back(span.out.sheet); }
    }
    for (const std::uint32_t s : sheets) {
      const bool on = std::all_of(within.begin(), within.end(), [&](const glm::dvec3& p) {
        const raycast::SurfacePoint foot = other.object->project(s, p);
        const double cosine = glm::dot(foot.normal, normal);
        if (!((alike && cosine > 0.999) || (opposite && cosine < -0.999))) { return false; }
        return glm::length(foot.position - p) <= touch && ends_at(*other.object, foot, touch);
      });
      if (on && !border_within(other.brep, s, corners, touch)) { return true; }
    }
    return false;
  });
}

// Is the face seen, at least in part?
template <class Exposed>
[[nodiscard]] bool is_seen(const std::vector<Surface>& surfaces, const Surface& surface, brep::FaceId f, const LeafLight& light,
                           const Exposed& exposed) {
  if (!exposed(f) && (!touches_exposed(surface.brep, f, exposed) || lies_under(surface, f, surfaces))) { return false; }
  // T-vertex elimination may cut off a part of a leaf that lies under a later object, which covers it.
  const std::uint32_t node = surface.brep.data(f).node;
  return !light.exposure.partly_buried[node] || !lies_under(surface, f, surfaces, light.hierarchy[node].object + 1);
}

// Adds a face whose half-edges have colours. `position`: by vertex index, the index of its position in the mesh.
HALFLIGHT_INLINE void add_face(const Surface& surface, brep::FaceId f, const std::vector<std::uint32_t>& position, const LeafLight& light,
                               bool buried, Mesh& mesh) {
  const SurfaceBRep& brep = surface.brep;
  const std::uint32_t node = brep.data(f).node;
  // At most four corners: T-vertex elimination leaves no others, and the rest would be cut as a fan. Separate polygons keep their
  // T-vertices, and a leaf is shaded from its own corners.
  std::vector<brep::HalfedgeId> loop;
  if (surface.topology == Topology::separate) {
    for (const brep::HalfedgeId h : brep::corners(brep, f)) { loop.push_back(h); }
  } else {
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { loop.push_back(h); }
  }
  // At the edge of a blade T-vertex elimination may leave a sliver between the edge and its chord, which is perpendicular to the surface
  // or shows its back.
  const auto turned_away = [&](std::initializer_list<std::size_t> corners) {
    Polygon contour;
    for (const std::size_t k : corners) { contour.push_back(brep.data(brep.vertex(loop[k])).position); }
    const glm::dvec3 flat = vector_area(contour);
    const double least = 0.1 * glm::length(flat);
    return std::all_of(corners.begin(), corners.end(), [&](std::size_t k) { return glm::dot(flat, brep.data(loop[k]).normal) < least; });
  };
  const auto add = [&](std::initializer_list<std::size_t> corners) {
    if (!surface.object->flat() && turned_away(corners)) { return; }
    const auto first = static_cast<std::uint32_t>(mesh.corners.size());
    Color mean{0.0};
    for (const std::size_t k : corners) {
      const SurfaceHalfedge& corner = brep.data(loop[k]);
      mesh.corners.push_back({position[brep.vertex(loop[k]).index], corner.radiosity, glm::vec3(corner.normal)});
      mean += brep.data(loop[k]).radiosity / static_cast<double>(corners.size());
    }
    mesh.faces.push_back(
        {first, static_cast<std::uint32_t>(corners.size()), light.hierarchy[node].surface, node, buried ? mean : light.radiosity[node]});
  };
  if (loop.size() == 4) {
    add({0, 1, 2, 3});
  } else {
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) { add({0, k, k + 1}); }
  }
}

}  // namespace detail

HALFLIGHT_INLINE Mesh read_mesh(std::vector<Surface>& surfaces, const LeafLight& light,
                                const std::function<bool(std::size_t, brep::FaceId)>& exposed,
                                const std::function<void(std::size_t)>& colour) {
  Mesh mesh;
  for (std::size_t o = 0; o < surfaces.size(); ++o) {
    SurfaceBRep& brep = surfaces[o].brep;
    detail::set_normals(*surfaces[o].object, brep);
    colour(o);
    std::vector<std::uint32_t> position;  // by vertex index
    for (const brep::VertexId v : brep::vertices(brep)) {
      if (v.index >= position.size()) { position.resize(v.index + 1, 0); }
      position[v.index] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(brep.data(v).position);
    }
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).node == no_node) { continue; }
      const auto exposed_here = [&](brep::FaceId g) { return exposed(o, g); };
      if (!detail::is_seen(surfaces, surfaces[o], f, light, exposed_here)) { continue; }
      detail::add_face(surfaces[o], f, position, light, !exposed(o, f), mesh);
    }
  }
  return mesh;
}

HALFLIGHT_INLINE Mesh reconstruct(std::vector<Surface>& surfaces, const LeafLight& light, Reconstruction kind) {
  const auto exposed = [&](std::size_t o, brep::FaceId f) { return light.exposure.area[surfaces[o].brep.data(f).node] > 0.0; };
  return read_mesh(surfaces, light, exposed, [&](std::size_t o) {
    SurfaceBRep& brep = surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t leaf = brep.data(f).node;
      if (leaf != no_node) { detail::colour_face(brep, f, leaf, light, kind); }
    }
  });
}

}  // namespace radiosity
