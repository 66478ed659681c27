// SPDX-License-Identifier: MIT
#pragma once

// Vertices and shapes of MGF: v with p and n; f, fh, prism, sph, torus, cyl, cone, ring. Spheres and tori stay analytic; what is open,
// cylinders and cones without their ends, becomes polygons, of as many sides as rings, so that both fit together.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include "apps/input_errors.hpp"
#include "apps/intake/mgf_looks.hpp"
#include "apps/intake/mgf_transform.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake::mgf {

class Shapes {
 public:
  Shapes(Model& model, Notes& notes, Looks& looks) : model_{model}, notes_{notes}, looks_{looks} {}

  glm::dmat4 transform{1.0};  // where shapes are put
  std::string name;           // of analytic ones; empty: their kind

  // Carries the line out; false when its entity is none of these.
  bool take(const Line& line, Errors& errors);

 private:
  void choose_vertex(const Line& line, Errors& errors) { vertices_.choose(line, errors); }
  void position(const Line& line, Errors& errors) { vertices_.current().position = vector(line, errors); }
  void normal(const Line& line, Errors& errors) { vertices_.current().normal = vector(line, errors); }
  void face(const Line& line, Errors& errors);
  void face_with_holes(const Line& line, Errors& errors);
  void prism(const Line& line, Errors& errors);
  void sphere(const Line& line, Errors& errors);
  void torus(const Line& line, Errors& errors);
  void cylinder(const Line& line, Errors& errors) { strip_between_vertices(line, 2, errors); }
  void cone(const Line& line, Errors& errors) { strip_between_vertices(line, 4, errors); }
  void ring(const Line& line, Errors& errors);

  [[nodiscard]] static glm::dvec3 vector(const Line& line, Errors& errors);
  // The vertices that the words [first, end) name; fewer when there is an error.
  [[nodiscard]] std::vector<glm::dvec3> positions_of(const Line& line, std::size_t first, std::size_t end, Errors& errors);
  void polygon(std::vector<glm::dvec3> corners, const Line& line);
  void solid(const char* kind, std::shared_ptr<const raycast::Object> object, bool from_within, const Line& line);
  void strip_between_vertices(const Line& line, std::size_t second_radius, Errors& errors);
  void strip(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis, double from, double to, const Line& line);

  Model& model_;
  Notes& notes_;
  Looks& looks_;
  Contexts<Vertex> vertices_{"vertex"};
  std::map<std::array<double, 3>, std::uint32_t> positions_;
};

}  // namespace apps::intake::mgf
