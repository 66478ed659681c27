// SPDX-License-Identifier: MIT
#include <radiosity/factors/factor_rows.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

HALFLIGHT_INLINE FactorRows name_rows(const Scene& scene) {
  FactorRows result;
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    const SceneObject& object = scene.objects[o];
    const std::uint32_t sheets = object.shape->sheet_count();
    const auto material = [&](std::uint32_t s) { return object.material[object.material.size() == 1 ? 0 : s]; };
    const bool several = !std::all_of(object.material.begin(), object.material.end(), [&](auto m) { return m == object.material[0]; });
    std::map<std::uint32_t, std::uint32_t> row_of_material;
    result.row_of.emplace_back();
    for (std::uint32_t s = 0; s < sheets; ++s) {
      const std::string_view sheet = object.shape->sheet_name(s);
      const bool numbered = sheet.starts_with('f') && sheet.substr(1) == std::to_string(s);
      auto row = static_cast<std::uint32_t>(result.rows.size());
      if (numbered) { row = row_of_material.try_emplace(material(s), row).first->second; }
      if (row == result.rows.size()) {
        std::string name = object.name;
        if (numbered && several) { name.append(1, '.').append(scene.materials[material(s)].name); }
        if (!numbered && sheets > 1) { name.append(1, '.').append(sheet); }
        result.rows.push_back({std::move(name), o, false, {}, material(s)});
      }
      result.row_of.back().push_back(row);
    }
  }
  return result;
}

HALFLIGHT_INLINE std::vector<FlatFace> flat_faces(const std::vector<Surface>& surfaces) {
  std::vector<FlatFace> faces;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (!surfaces[o].object->exact()) { continue; }
    const SurfaceBRep& brep = surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).sheet == brep::no_sheet) { continue; }
      Polygon contour = corner_polygon(brep, f);
      const glm::dvec3 area = vector_area(contour);
      if (!(glm::length(area) > 0.0)) { continue; }
      faces.push_back({std::move(contour), glm::normalize(area), o, brep.data(f).sheet});
    }
  }
  return faces;
}

namespace detail {

// Removes the parts of a face that one other object covers, contains, or touches without a gap.
class Burial {
 public:
  Burial(const raycast::Scene& scene, const std::vector<FlatFace>& faces, double slack) : scene_{&scene}, slack_{slack} {
    faces_of_.resize(scene.size());
    for (const FlatFace& face : faces) { faces_of_[face.object].push_back(&face); }
  }

  // Removes from `pieces` of `face` the parts buried by object `by`. Returns false if that cannot be done exactly.
  [[nodiscard]] bool apply(const FlatFace& face, std::uint32_t by, std::vector<Piece>& pieces) const {
    const raycast::PlacedObject& object = scene_->object(by);
    raycast::Box bounds;
    for (const glm::dvec3& p : face.contour) { bounds.extend(p); }
    const raycast::Box near = object.bounds().grown(slack_);
    if (!near.meets(bounds) && !object.inside()) { return true; }
    if (!object.exact()) {
      if (object.inside()) {
        return object.convex() && std::none_of(face.contour.begin(), face.contour.end(),
                                               [&](const glm::dvec3& p) { return scene_->covered(p, face.normal, face.object); });
      }
      return !touches(face, near);
    }
    for (const FlatFace* other : faces_of_[by]) { cover(face, *other, pieces); }
    if (!object.solid()) { return true; }
    if (!object.convex()) { return !pierced(face, by); }
    std::vector<HalfSpace> planes;  // inward planes of the body; of a room, of the space in it
    for (const FlatFace* other : faces_of_[by]) {
      const glm::dvec3 inwards = object.inside() ? other->normal : -other->normal;
      planes.push_back({other->contour[0] + (object.inside() ? -slack_ : slack_) * inwards, inwards});
    }
    if (!object.inside()) {
      cut_away(pieces, planes);
      return true;
    }
    Piece inside;
    Piece outside;
    for (const HalfSpace& plane : planes) {
      std::vector<Piece> kept;
      for (const Piece& piece : pieces) {
        part(piece, plane, inside, outside);
        if (!inside.empty()) { kept.push_back(inside); }
      }
      pieces = std::move(kept);
    }
    return true;
  }

 private:
  // Removes what a coplanar face covers: of a later object if it faces the same way, or of a solid that stands on this face.
  void cover(const FlatFace& face, const FlatFace& other, std::vector<Piece>& pieces) const {
    const double cosine = glm::dot(face.normal, other.normal);
    const bool covers = cosine > 0.999 ? other.object > face.object : cosine < -0.999 && scene_->object(other.object).solid();
    const HalfSpace plane{face.contour[0], face.normal};
    if (!covers || !std::all_of(other.contour.begin(), other.contour.end(),
                                [&](const glm::dvec3& p) { return std::abs(plane.height(p)) <= slack_; })) {
      return;
    }
    std::vector<HalfSpace> planes;
    const std::size_t n = other.contour.size();
    for (std::size_t i = 0; i < n; ++i) {
      planes.push_back({other.contour[i], glm::cross(other.normal, other.contour[(i + 1) % n] - other.contour[i])});
    }
    cut_away(pieces, planes);
  }
  // Does a part of the face lie within the box?
  [[nodiscard]] static bool touches(const FlatFace& face, const raycast::Box& box) {
    Piece rest;
    Piece outside;
    for (const glm::dvec3& p : face.contour) { rest.push_back(p); }
    for (int k = 0; k < 3 && !rest.empty(); ++k) {
      glm::dvec3 n{0.0};
      n[k] = 1.0;
      Piece half;
      part(rest, {box.lo, n}, half, outside);
      part(half, {box.hi, -n}, rest, outside);
    }
    return !rest.empty();
  }
  // Does the concave solid cut the face? That is: is an edge of the face partly inside it, or does one of its edges pass through the face?
  [[nodiscard]] bool pierced(const FlatFace& face, std::uint32_t by) const {
    const std::size_t n = face.contour.size();
    for (std::size_t i = 0; i < n; ++i) {
      const raycast::Segment edge = raycast::between(face.contour[i], face.contour[(i + 1) % n]);
      if (!raycast::has_line(edge)) { continue; }
      raycast::Spans spans;
      scene_->object(by).spans(edge, spans);
      for (const raycast::Span& span : spans) {
        const double from = std::max(0.0, span.in.t);
        const double to = std::min(1.0, span.out.t);
        for (const double t : {0.25, 0.5, 0.75}) {
          if (to > from && deep(by, edge.at(from + t * (to - from)))) { return true; }
        }
      }
    }
    const HalfSpace plane{face.contour[0], face.normal};
    for (const FlatFace* other : faces_of_[by]) {
      for (std::size_t k = 0; k < other->contour.size(); ++k) {
        const glm::dvec3& a = other->contour[k];
        const glm::dvec3& b = other->contour[(k + 1) % other->contour.size()];
        const double from = plane.height(a);
        const double to = plane.height(b);
        if (!(std::min(from, to) < -slack_) || !(std::max(from, to) > slack_)) { continue; }
        const glm::dvec3 x = a + (b - a) * (from / (from - to));
        bool within = true;
        for (std::size_t i = 0; i < n; ++i) {
          const glm::dvec3 side = face.contour[(i + 1) % n] - face.contour[i];
          within = within && glm::dot(glm::cross(face.normal, side), x - face.contour[i]) > slack_ * glm::length(side);
        }
        if (within) { return true; }
      }
    }
    return false;
  }
  // Is a point inside or on the solid away from the planes of all its faces?
  [[nodiscard]] bool deep(std::uint32_t by, const glm::dvec3& p) const {
    return std::all_of(faces_of_[by].begin(), faces_of_[by].end(),
                       [&](const FlatFace* f) { return std::abs(glm::dot(f->normal, p - f->contour[0])) > slack_; });
  }

  const raycast::Scene* scene_;
  double slack_;
  std::vector<std::vector<const FlatFace*>> faces_of_;
};

}  // namespace detail

HALFLIGHT_INLINE void expose(FactorRows& rows, const raycast::Scene& scene, const std::vector<FlatFace>& faces, double slack) {
  for (FactorRow& row : rows.rows) { row.exact = scene.object(row.object).exact(); }
  const detail::Burial burial{scene, faces, slack};
  for (const FlatFace& face : faces) {
    FactorRow& row = rows.rows[rows.row_of[face.object][face.sheet]];
    std::vector<Piece> pieces(1);
    for (const glm::dvec3& p : face.contour) { pieces[0].push_back(p); }
    for (std::uint32_t o = 0; o < scene.size() && row.exact; ++o) {
      if (o != face.object && !burial.apply(face, o, pieces)) { row.exact = false; }
    }
    for (const Piece& piece : pieces) {
      const double area = glm::length(vector_area(piece));
      if (area > slack * slack) { row.facets.push_back({piece, face.normal, area}); }
    }
  }
  // Restores rows that turned out not to be exact after some of their faces had been cut.
  for (FactorRow& row : rows.rows) {
    if (!row.exact) { row.facets.clear(); }
  }
  for (const FlatFace& face : faces) {
    FactorRow& row = rows.rows[rows.row_of[face.object][face.sheet]];
    if (row.exact) { continue; }
    Piece piece;
    for (const glm::dvec3& p : face.contour) { piece.push_back(p); }
    row.facets.push_back({piece, face.normal, glm::length(vector_area(piece))});
  }
}

}  // namespace radiosity
