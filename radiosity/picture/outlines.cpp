// SPDX-License-Identifier: MIT
#include <radiosity/picture/outlines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>

namespace radiosity {

namespace detail {

// A face as seen by the camera.
struct SeenFace {
  std::uint32_t sheet = brep::no_sheet;
  bool front = false;  // does it face the eye?
  glm::dvec3 middle{0.0};
};

// An outline edge: its ends, the face that faces the eye, and the other one.
struct OutlineEdge {
  std::uint32_t surface = 0;
  brep::FaceId front, other;
  glm::dvec3 a{0.0}, b{0.0};
  SeenFace near, far;
  double error = 0.0;  // squared, integrated over the picture
};

[[nodiscard]] HALFLIGHT_INLINE std::vector<SeenFace> seen_faces(const Surface& surface, const glm::dvec3& eye) {
  std::vector<SeenFace> seen(surface.brep.face_end());
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const Polygon corners = corner_polygon(surface.brep, f);
    SeenFace& face = seen[f.index];
    face.sheet = surface.brep.data(f).sheet;
    for (const glm::dvec3& p : corners) { face.middle += p / static_cast<double>(corners.size()); }
    face.front = face.sheet != brep::no_sheet && glm::dot(vector_area(corners), eye - face.middle) > 0.0;
  }
  return seen;
}

HALFLIGHT_INLINE void add_outline_edges(const Surface& surface, std::uint32_t number, const glm::dvec3& eye,
                                        std::vector<OutlineEdge>& edges) {
  const SurfaceBRep& brep = surface.brep;
  const std::vector<SeenFace> seen = seen_faces(surface, eye);
  for (const brep::EdgeId e : brep::edges(brep)) {
    const brep::HalfedgeId h = brep::halfedge(e);
    brep::FaceId front = brep.face(h), other = brep.face(brep::twin(h));
    if (!seen[front.index].front) { std::swap(front, other); }
    const SeenFace &near = seen[front.index], &far = seen[other.index];
    if (!near.front || (far.front && far.sheet == near.sheet)) { continue; }
    edges.push_back({number, front, other, brep.data(brep.vertex(h)).position, brep.data(brep.target(h)).position, near, far, 0.0});
  }
}

// Evaluates outlines for one eye. Lengths perpendicular to the line of sight are measured at the distance of the evaluated point.
class OutlineView {
 public:
  OutlineView(const FinalGather& light, const Viewpoint& from) : light_{&light}, from_{&from}, eye_{light.eye(from.eye)} {}

  [[nodiscard]] const glm::dvec3& eye() const { return eye_.position; }

  [[nodiscard]] double error(const OutlineEdge& edge) const {
    constexpr double gauss = 0.21132486540518712;  // two Gauss points on the edge: exact for a parabola
    return 0.5 * (error_at(edge, gauss) + error_at(edge, 1.0 - gauss));
  }

 private:
  [[nodiscard]] double error_at(const OutlineEdge& edge, double at) const;
  [[nodiscard]] double contrast(const OutlineEdge& edge, const glm::dvec3& inside, const glm::dvec3& outside) const;

  const FinalGather* light_;
  const Viewpoint* from_;
  FinalGather::Eye eye_;
};

// The squared difference of what is seen through two points; 0 if neither shows the object of the edge.
HALFLIGHT_INLINE double OutlineView::contrast(const OutlineEdge& edge, const glm::dvec3& inside, const glm::dvec3& outside) const {
  const std::array<glm::dvec3, 2> directions{inside - eye(), outside - eye()};
  const auto places = light_->seen16(eye_, directions, true);
  std::array<Color, 2> shown{Color{0.0}, Color{0.0}};
  bool own = false;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!places[i]) { continue; }
    if (!is_black(light_->material(places[i]->surface).emission)) { return 0.0; }
    own = own || places[i]->object == edge.surface;
    shown[i] = light_->solved(*places[i]).value_or(Color{0.0});
  }
  return own ? glm::dot(shown[0] - shown[1], shown[0] - shown[1]) : 0.0;
}

HALFLIGHT_INLINE double OutlineView::error_at(const OutlineEdge& edge, double at) const {
  const raycast::PlacedObject& object = light_->objects().object(edge.surface);
  const glm::dvec3 m = glm::mix(edge.a, edge.b, at);
  const double distance = glm::length(m - eye());
  if (!(distance > 0.0)) { return 0.0; }
  const glm::dvec3 sight = (m - eye()) / distance;
  const double share = from_->share(light_->frame().to_scene(m), -sight);
  glm::dvec3 out = glm::cross(sight, edge.b - edge.a);  // its length is the apparent length of the edge
  const double length = glm::length(out);
  if (!(share > 0.0) || !(length > 0.0)) { return 0.0; }
  out *= (glm::dot(out, edge.near.middle - m) > 0.0 ? -1.0 : 1.0) / length;
  const auto beyond = [&](const glm::dvec3& p) {
    const double ahead = glm::dot(sight, p - eye());
    return ahead > 0.0 ? glm::dot(out, p - m) * (distance / ahead) : 0.0;
  };
  double width = 0.0;
  if (edge.far.sheet == edge.near.sheet) {
    width = std::max(width, beyond(object.vertex(edge.near.sheet, m)));  // for the edge of a blade
    constexpr int steps = 4;                                             // towards the centre of either face
    const glm::dvec3 middle = 0.5 * (edge.a + edge.b);
    for (int k = -steps; k <= steps; ++k) {
      const glm::dvec3 across = (k < 0 ? edge.far.middle : edge.near.middle) - middle;
      width = std::max(width, beyond(object.project(edge.near.sheet, m + std::abs(k) / static_cast<double>(steps) * across).position));
    }
  } else {
    width = beyond(on_sheets(object, std::array{edge.near.sheet, edge.far.sheet}, m));
  }
  constexpr double beside = 0.02;  // relative to the edge: least offset, for strips of almost no width
  const double step = std::max(std::abs(width), beside * length);
  const double light = contrast(edge, m + (width - step) * out, m + (width + step) * out);
  const double pixel = light_->frame().scale * std::sqrt(from_->pixel / share);
  const double strip = pixel > 0.0 ? pixel * strip_in_pixels(std::abs(width) / pixel) : std::abs(width);
  return share * length * strip * light;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::vector<double>> outline_errors(const FinalGather& light, const std::vector<Surface>& surfaces,
                                                                 const Viewpoint& from, unsigned threads) {
  const detail::OutlineView view{light, from};
  std::vector<std::vector<double>> errors(surfaces.size());
  std::vector<detail::OutlineEdge> edges;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    errors[o].assign(surfaces[o].brep.face_end(), 0.0);
    if (!surfaces[o].object->flat()) { detail::add_outline_edges(surfaces[o], o, view.eye(), edges); }
  }
  parallel_for(
      edges.size(), threads, [&](std::size_t i) { edges[i].error = view.error(edges[i]); }, 16);
  for (const detail::OutlineEdge& edge : edges) {
    errors[edge.surface][edge.front.index] += 0.5 * edge.error;
    errors[edge.surface][edge.other.index] += 0.5 * edge.error;
  }
  return errors;
}

}  // namespace radiosity
