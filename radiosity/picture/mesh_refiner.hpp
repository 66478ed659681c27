// SPDX-License-Identifier: MIT
#pragma once

// A mesh whose colours are gathered as those of a picture are (final_gather.hpp), and which is split where the light between its corners is
// another than what is interpolated from them. The faces of the leaves are split on, on the BRep and by the meshing strategy of the run, so
// T-vertices are known by their levels as ever; the hierarchy and its solution stay as they are, and each part belongs to the leaf of its
// face.
//
// Colours: direct light is exact at each corner; indirect light comes from points that lie apart (irradiance_cache.hpp). A corner is looked
// at a thousandth of its face inside that face, so that at the foot of a box it has the light of its own side. Where faces around a vertex
// agree, it has one colour.
//
// Errors: direct and indirect light at some random points of each face, against what its corners say there; for a camera also what facets
// of curved objects have wrong at their outlines (outlines.hpp).

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
  // `surfaces`: with the faces of the leaves, whose T-vertices are still there. The references must outlive this.
  // `control.viewpoint`: errors count by the picture.
  MeshRefiner(const FinalGather& light, std::vector<Surface> surfaces, const LeafLight& leaves, Meshing meshing, unsigned threads,
              const Control& control);

  // Gathers the light of the faces that are new since the last call. False when cancelled.
  [[nodiscard]] bool gather();
  // Relative L2 error over all surfaces by the points of the faces, and the outlines.
  [[nodiscard]] double error() const;
  // The squared error at outlines, integrated over the picture; 0 without a camera. Light need not be gathered for it.
  [[nodiscard]] double outlines() const;
  [[nodiscard]] std::uint64_t faces() const { return faces_; }  // that are exposed
  // Splits the faces with the largest errors, until the others together would be half of the error that is wanted, or there are `most`.
  // Returns how many it has split.
  std::size_t split(double wanted, std::uint64_t most);
  // In the frame, without T-vertices.
  [[nodiscard]] Mesh mesh() const;

 private:
  // The light of a face.
  struct Cell {
    std::vector<std::pair<brep::VertexId, Color>> corners;  // those that are not buried
    double error = 0.0, square = 0.0;                       // squares of the error and of the reflected light, times area
    bool exposed = false;                                   // at some of the places that were looked at
    [[nodiscard]] const Color* at(brep::VertexId v) const;
  };
  struct Face {
    std::uint32_t surface = 0;
    brep::FaceId face;
  };
  // Where a face is looked at.
  struct Test {
    FinalGather::Place place;
    std::uint32_t second = 0;  // corners 0, second and second + 1
    glm::dvec3 weight{0.0};    // of these
    double area = 0.0;         // or what it takes of the picture
  };
  struct Places {
    std::vector<std::pair<std::size_t, FinalGather::Place>> corners;  // by number
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
  std::vector<std::vector<Cell>> cells_;       // of each surface, by the index of the face,
  std::vector<std::vector<double>> outlines_;  // and the squared error at its outlines
  std::vector<Face> fresh_;
  std::uint64_t faces_ = 0;
  double total_area_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/picture/mesh_refiner.cpp>
#endif
