// SPDX-License-Identifier: MIT
#pragma once

// A mesh with gathered colours like those of a picture (final_gather.hpp), whose faces are split where the light between the corners
// differs from the interpolated light. The leaves' faces are split further on the BRep, by the meshing strategy of the run, so T-vertices
// are still recognised by their levels. The hierarchy and its solution do not change, and each part belongs to the leaf of its original
// face.
//
// Colours: direct light is computed at each corner; indirect light is interpolated between sparse points (irradiance_cache.hpp). The
// light of a corner is taken a thousandth of the face's size inside the face, so that at the foot of a box it is that of the right side.
// Where the faces around a vertex agree, the vertex has a single colour.
//
// Errors: direct and indirect light at random points of each face, compared with the interpolated colours; with a camera also the errors
// at the outlines of curved objects (outlines.hpp).

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/irradiance_cache.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

class MeshRefiner {
 public:
  // `surfaces`: with the leaves' faces, still including T-vertices. The references must outlive this. If control.viewpoint is
  // set, errors are weighted by the picture.
  MeshRefiner(const FinalGather& light, std::vector<Surface> surfaces, const LeafLight& leaves, Meshing meshing, unsigned threads,
              const Control& control);

  // Gathers the light of all faces made since the last call. False when cancelled.
  [[nodiscard]] bool gather();
  // Relative L2 error over all surfaces, from the test points of the faces, and the outlines.
  [[nodiscard]] double error() const;
  // The squared error at outlines, integrated over the picture; 0 without a camera. Does not require gather().
  [[nodiscard]] double outlines() const;
  // Splits the faces with the largest errors, until the others together have at most half of the wanted error, or there are `most` faces.
  // Returns the number of faces that were split.
  std::size_t split(double wanted, std::uint64_t most);
  // The mesh, in the frame, without T-vertices.
  [[nodiscard]] Mesh mesh() const;

 private:
  // The light on a face.
  struct Cell {
    std::vector<std::pair<brep::VertexId, Color>> corners;  // those that are not buried
    double error = 0.0, square = 0.0;                       // squared error and squared reflected light, times area
    bool exposed = false;                                   // at some of the tested places
    [[nodiscard]] const Color* at(brep::VertexId v) const;
  };
  struct Face {
    std::uint32_t surface = 0;
    brep::FaceId face;
  };
  // A test point of a face.
  struct Test {
    FinalGather::Place place;
    std::uint32_t second = 0;  // its triangle has the corners 0, second and second + 1
    glm::dvec3 weight{0.0};    // barycentric coordinates in it
    double area = 0.0;         // area that it represents, or that area in the picture
  };
  struct Places {
    std::vector<std::pair<std::size_t, FinalGather::Place>> corners;  // with the number of the corner
    std::vector<Test> tests;
    double side = 0.0;
  };
  [[nodiscard]] Places places_of(const Face& face) const;
  [[nodiscard]] Cell light_of(const Face& face, const Places& places) const;
  void measure_outlines();
  void unite_colours(Surface& surface, const std::vector<Cell>& cells, const std::vector<brep::FaceId>& origin) const;

  const FinalGather* light_;
  std::vector<Surface> surfaces_;
  const LeafLight* leaves_;
  Meshing meshing_;
  unsigned threads_;
  const Control* control_;
  IrradianceCache indirect_;
  std::vector<std::vector<Cell>> cells_;       // by surface and index of the face
  std::vector<std::vector<double>> outlines_;  // likewise: the squared error at its outlines
  std::vector<Face> fresh_;
  std::uint64_t faces_ = 0;
  double total_area_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/mesh_refiner.cpp>
#endif
