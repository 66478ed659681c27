// SPDX-License-Identifier: MIT
#include <radiosity/audit/warnings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

namespace detail {

inline constexpr std::size_t most_warnings = 20;  // of each kind

// The border edges of open surfaces, each by its two end points in the direction of its face's half-edge.
struct Borders {
  using Edge = std::array<double, 6>;

  explicit Borders(const std::vector<Surface>& surfaces) {
    for (const Surface& surface : surfaces) {
      if (!surface.object->solid()) {
        each_edge(surface, [&](const Edge& edge) { edges.push_back(edge); });
      }
    }
    std::sort(edges.begin(), edges.end());
  }

  template <class Visit>
  static void each_edge(const Surface& surface, const Visit& visit) {
    const SurfaceBRep& brep = surface.brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).sheet != brep::no_sheet) { continue; }
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        if (brep.data(brep.face(brep::twin(h))).sheet == brep::no_sheet) { continue; }
        const glm::dvec3 &p = brep.data(brep.vertex(h)).position, &q = brep.data(brep.vertex(brep::twin(h))).position;
        visit(Edge{p.x, p.y, p.z, q.x, q.y, q.z});
      }
    }
  }
  // Number of border edges of the surface that no border edge of opposite direction matches. A match continues the surface: as another
  // part of the same shell, or as the other side of a sheet.
  [[nodiscard]] std::size_t open(const Surface& surface) const {
    std::size_t count = 0;
    each_edge(surface, [&](const Edge& e) {
      count += std::binary_search(edges.begin(), edges.end(), Edge{e[3], e[4], e[5], e[0], e[1], e[2]}) ? 0 : 1;
    });
    return count;
  }

  std::vector<Edge> edges;
};

// The first names out of `count`, as a list.
template <class Name>
[[nodiscard]] std::string first_of(std::size_t count, const Name& name) {
  constexpr std::size_t most = 5;
  std::string list;
  for (std::size_t k = 0; k < std::min(count, most); ++k) { list += (k > 0 ? ", " : "") + name(k); }
  return list + (count > most ? " and others" : "");
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::string> warnings(const Scene& scene, const Frame& frame, const std::vector<Surface>& surfaces) {
  std::vector<std::string> sentences;
  const auto name = [&](std::uint32_t o) { return "'" + scene.objects[o].name + "'"; };
  const auto pairs = twins(surfaces);
  if (pairs.size() == 1) {
    const auto& [a, b] = pairs[0];
    sentences.push_back("objects " + name(a) + " and " + name(b) + " are the same surface at the same place: duplicates; " + name(b) +
                        " is seen, being the later one, and " + name(a) + " is covered by it");
  } else if (!pairs.empty()) {
    sentences.push_back(
        std::to_string(pairs.size()) +
        " objects are duplicates, left out of the rays: each is covered by a later one that is the same surface at the same place: " +
        detail::first_of(pairs.size(), [&](std::size_t k) { return name(pairs[k][0]) + " by " + name(pairs[k][1]); }));
  }
  std::vector<std::uint32_t> open;
  std::size_t edges = 0;
  const detail::Borders borders(surfaces);
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (surfaces[o].object->solid() || input_faces(surfaces[o]).size() < 2) { continue; }
    const std::size_t its_edges = borders.open(surfaces[o]);
    if (its_edges == 0) { continue; }
    open.push_back(o);
    edges += its_edges;
  }
  if (open.size() == 1) {
    sentences.push_back("object " + name(open[0]) + " is an open shell with " + std::to_string(edges) +
                        " open edges: its back is black and takes no light");
  } else if (!open.empty()) {
    sentences.push_back(std::to_string(open.size()) + " objects are open shells, with " + std::to_string(edges) +
                        " open edges: their backs are black and take no light: " +
                        detail::first_of(open.size(), [&](std::size_t k) { return name(open[k]); }));
  }
  // Rounding error of the scene's coordinates, in the frame: half a unit in the last place of the largest.
  const double magnitude = std::max({std::abs(frame.centre.x), std::abs(frame.centre.y), std::abs(frame.centre.z)});
  const double known = raycast::unit_roundoff * magnitude * frame.scale;
  if (known > 1e-10) {
    char text[160] = "";
    std::snprintf(text, sizeof text, "the scene lies %.0e of its sizes from the origin, where coordinates are rounded to %.0e of its size",
                  magnitude * frame.scale, known);
    sentences.push_back(text + std::string{": surfaces that are nearer to each other may touch or not"});
  }
  return sentences;
}

HALFLIGHT_INLINE std::vector<std::string> warnings_of_buried(const Scene& scene, const Hierarchy& hierarchy, const Exposure& exposure) {
  std::vector<double> area(scene.objects.size(), 0.0);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].leaf()) { area[hierarchy[i].object] += exposure.area[i]; }
  }
  std::vector<bool> shines(area.size(), false);
  for (const InputSurface& input : surfaces(scene)) {
    shines[input.object] = shines[input.object] || !is_black(scene.materials[input.material].emission);
  }
  // Buried lamps come first, each (up to a limit) in a sentence of its own, because their light is missing.
  std::vector<std::string> sentences;
  std::vector<std::size_t> others;
  for (std::size_t o = 0; o < area.size(); ++o) {
    if (area[o] > 0.0) { continue; }
    if (shines[o] && sentences.size() < detail::most_warnings) {
      sentences.push_back("object '" + scene.objects[o].name +
                          "' is buried: all of its surface lies in or under other objects and is dark, and its light is lost");
    } else {
      others.push_back(o);
    }
  }
  if (others.size() == 1) {
    sentences.push_back("object '" + scene.objects[others[0]].name +
                        "' is buried: all of its surface lies in or under other objects and is dark");
  } else if (!others.empty()) {
    sentences.push_back(std::to_string(others.size()) +
                        " objects are buried: all of their surfaces lie in or under other objects and are dark: " +
                        detail::first_of(others.size(), [&](std::size_t k) { return "'" + scene.objects[others[k]].name + "'"; }));
  }
  return sentences;
}

HALFLIGHT_INLINE std::string warning_of_lost_light(const DiscreteScene& scene, const std::vector<Color>& radiosity) {
  double emitted = 0.0, reflected = 0.0, unlit = 0.0;  // unlit: area that does not emit
  bool reflects = false;
  for (std::size_t i = 0; i < scene.hierarchy.size(); ++i) {
    const std::uint32_t surface = scene.hierarchy[i].surface;
    const double area = scene.exposure.area[i];
    if (!scene.hierarchy[i].leaf() || !(area > 0.0)) { continue; }
    const Color& emission = scene.emission[surface];
    emitted += area * sum_of_channels(emission);
    const Color rest = radiosity[i] - emission;
    reflected += area * sum_of_channels(rest);
    reflects = reflects || (is_black(emission) && !is_black(scene.reflectance[surface]));
    unlit += is_black(emission) ? area : 0.0;
  }
  // Of a sun's light, only the fraction that the lit surfaces take of the sphere around it can arrive, even in a correct scene.
  const double reach = scene.objects.diameter(), share = reach > 0.0 ? std::min(1.0, unlit / (reach * reach)) : 1.0;
  if (!reflects || !(emitted > 0.0) || reflected >= 1e-6 * share * emitted) { return {}; }
  return std::string(reflected > 0.0 ? "less than a millionth" : "nothing") +
         " of the light that is emitted is reflected by any surface: lamps may look away from what they should light, or lie behind "
         "a wall, or what they shine on shows its back; turn their polygons, or give them two sides";
}

}  // namespace radiosity
