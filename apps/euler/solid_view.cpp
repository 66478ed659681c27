// SPDX-License-Identifier: MIT

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <brep/handles.hpp>

#include "apps/euler/outputs.hpp"
#include "apps/text.hpp"

namespace apps::euler {
namespace {

// An oblique projection, seen from the front, right and above.
glm::dvec2 projected(const glm::dvec3& p) { return {p.x + 0.42 * p.y, -p.z - 0.3 * p.y + 0.08 * p.x}; }

// Elements farther from the eye are drawn first.
double depth(const glm::dvec3& p) { return p.y - 0.3 * p.z - 0.2 * p.x; }

std::string point(const glm::dvec2& p) { return trimmed(p.x, 1) + " " + trimmed(p.y, 1); }

struct FaceShape {
  std::uint32_t face = 0;
  std::vector<std::uint32_t> corners;
  double depth = 0.0;
};

std::vector<FaceShape> shapes(const Records& records, const Coordinates& at) {
  std::vector<FaceShape> faces;
  for (std::uint32_t f = 0; f < records.faces.size(); ++f) {
    if (records.faces[f] == brep::invalid_index) { continue; }
    FaceShape shape{f, {}, 0.0};
    std::uint32_t h = records.faces[f];
    do {
      const auto found = at.find(records.halfedges[h].vertex);
      if (found == at.end()) { break; }
      shape.corners.push_back(found->first);
      shape.depth += depth(found->second);
      h = records.halfedges[h].next;
    } while (h != records.faces[f]);
    if (h != records.faces[f] || shape.corners.empty()) { continue; }
    shape.depth /= static_cast<double>(shape.corners.size());
    faces.push_back(std::move(shape));
  }
  std::stable_sort(faces.begin(), faces.end(), [](const FaceShape& a, const FaceShape& b) { return a.depth > b.depth; });
  return faces;
}

}  // namespace

Coordinates take_coordinates(std::string& text) {
  Coordinates coordinates;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text.compare(at, 2, "#@") == 0) {
      std::istringstream words(text.substr(at + 2, end - at - 2));
      Coordinates read;
      std::string name;
      bool good = true;
      while (good && words >> name) {
        glm::dvec3 p{0.0};
        good = name.size() > 1 && name.size() < 8 && name[0] == 'v' && name.find_first_not_of("0123456789", 1) == name.npos &&
               static_cast<bool>(words >> p.x >> p.y >> p.z);
        if (good) { read[static_cast<std::uint32_t>(std::stoul(name.substr(1)))] = p; }
      }
      if (good) {
        coordinates.merge(read);
        text.replace(at, end - at, "");
        at += at < text.size() ? 1 : 0;
        continue;
      }
    }
    at = end + 1;
  }
  return coordinates;
}

std::string solid_view(const Frame& frame, const Coordinates& coordinates, double width) {
  const Records& records = frame.drawn;
  const std::vector<FaceShape> faces = shapes(records, coordinates);
  glm::dvec2 low{1e30}, high{-1e30};
  for (const auto& [v, p] : coordinates) {
    low = glm::dvec2{std::min(low.x, projected(p).x), std::min(low.y, projected(p).y)};
    high = glm::dvec2{std::max(high.x, projected(p).x), std::max(high.y, projected(p).y)};
  }
  const double scale = 0.8 * width / std::max({1e-9, high.x - low.x, high.y - low.y});
  const auto place = [&](std::uint32_t v) { return scale * (projected(coordinates.at(v)) - 0.5 * (low + high)); };
  // The radius of the vertex disks is limited by the smallest distance between two vertices of any step; names are as wide as the disk.
  double radius = 0.035 * width;
  for (auto a = coordinates.begin(); a != coordinates.end(); ++a) {
    for (auto b = std::next(a); b != coordinates.end(); ++b) {
      radius = std::min(radius, 0.48 * glm::length(place(a->first) - place(b->first)));
    }
  }
  radius = std::max(radius, 0.012 * width);  // vertices that are projected onto each other overlap anyway
  std::string out;
  for (const FaceShape& face : faces) {
    if (face.corners.size() < 3) { continue; }
    std::string d;
    for (const std::uint32_t v : face.corners) { d += (d.empty() ? "M" : "L") + point(place(v)); }
    out += "<path class='area' data-of='f" + std::to_string(face.face) + "' fill-opacity='.55' fill='" + tint(face.face) + "' d='" + d +
           "Z'/>\n";
  }
  for (std::uint32_t h = 0; h < records.halfedges.size(); h += 2) {
    if (!records.halfedges[h].alive) { continue; }
    const std::uint32_t a = records.halfedges[h].vertex, b = records.halfedges[h + 1].vertex;
    if (!coordinates.contains(a) || !coordinates.contains(b)) { continue; }
    out += "<path class='edge' data-of='h" + std::to_string(h) + " h" + std::to_string(h + 1) + "' d='M" + point(place(a)) + "L" +
           point(place(b)) + "'/>\n";
  }
  for (std::uint32_t v = 0; v < records.vertices.size(); ++v) {
    if (records.vertices[v] == brep::invalid_index || !coordinates.contains(v)) { continue; }
    const std::string name = "v" + std::to_string(v);
    const double size = std::min(1.15, 2.8 / static_cast<double>(name.size())) * radius;  // a letter is .64 of its size wide
    out += "<g class='vertex' data-of='" + name + "' transform='translate(" + point(place(v)) + ")'><circle r='" + trimmed(radius, 2) +
           "'/><text font-size='" + trimmed(size, 2) + "' y='.35em'>" + name + "</text></g>\n";
  }
  return out.empty() ? out : "<g class='drawing'>\n" + out + "</g>\n";
}

}  // namespace apps::euler
