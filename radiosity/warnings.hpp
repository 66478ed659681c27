// SPDX-License-Identifier: MIT
#pragma once

// What a sound scene makes doubtful. It is solved all the same, by rules that are fixed, and the run says where they may not be what was
// meant: two objects at one place (the later one is seen, raycast/scene.hpp), objects of which nothing shows, open shells (their backs are
// black), coordinates that are known no better than surfaces must be told apart.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <brep/circulators.hpp>
#include <raycast/scene.hpp>

#include <radiosity/exposure.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/occlusion.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/random.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/surface.hpp>
#include <radiosity/visibility.hpp>

namespace radiosity {

// Where rays end that leave the exposed surfaces in cosine-distributed directions, as fractions.
struct StrayRays {
  double escaping = 0.0, to_backs = 0.0;
  double standard_error = 0.0;  // of either, at most
};

namespace detail {

inline constexpr std::size_t most_warnings = 20;  // of one kind

// Pairs (earlier, later) of objects whose surfaces are the same: each corner of one is a corner of the other, or lies on it when it is
// curved, and the other way round, to 1e-9 of the size, and both face the same way. Compared are objects whose bounds agree to a millionth
// of the scene.
inline std::vector<std::array<std::uint32_t, 2>> twins(const raycast::Scene& objects, const std::vector<Surface>& surfaces) {
  struct Place {
    std::array<double, 6> bounds;
    std::uint32_t object;
  };
  std::vector<Place> places;
  const double grid = 0x1p-20 * objects.diameter();
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    const raycast::Box& box = objects.object(o).bounds();
    Place place{{}, o};
    for (int k = 0; k < 3; ++k) {
      place.bounds[static_cast<std::size_t>(k)] = std::round(box.lo[k] / grid);
      place.bounds[static_cast<std::size_t>(k + 3)] = std::round(box.hi[k] / grid);
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.bounds != b.bounds ? a.bounds < b.bounds : a.object < b.object; });
  const auto corners = [&](std::uint32_t o) {
    std::vector<raycast::SurfacePoint> points;
    const SurfaceBRep& brep = surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      const std::uint32_t sheet = brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        const glm::dvec3& p = brep.data(brep.vertex(h)).position;
        points.push_back({p, objects.object(o).project(sheet, p).normal});
      }
    }
    return points;
  };
  // Is every corner of a one of b, or, when b is curved, on b? What is the same comes in the same order, as a rule.
  const auto on = [&](std::uint32_t a, std::uint32_t b) {
    const raycast::PlacedObject& other = objects.object(b);
    const double touch = 1e-9 * other.bounds().diameter() + other.slack() + objects.object(a).slack();
    const std::vector<raycast::SurfacePoint> of_a = corners(a);
    const std::vector<raycast::SurfacePoint> of_b = other.exact() ? corners(b) : std::vector<raycast::SurfacePoint>{};
    const std::size_t count = other.exact() ? of_b.size() : other.sheet_count();
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      bool found = false;
      for (std::size_t k = 0; k < count && !found; ++k) {
        const std::size_t j = (i + k) % count;
        const auto q = other.exact() ? of_b[j] : other.project(static_cast<std::uint32_t>(j), of_a[i].position);
        found = glm::length(q.position - of_a[i].position) <= touch && glm::dot(q.normal, of_a[i].normal) > 0.999;
      }
      if (!found) { return false; }
    }
    return true;
  };
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first + 1;
    while (last < places.size() && places[last].bounds == places[first].bounds) { ++last; }
    // Each with the next one that is its twin, among the 64 that follow: of many at one place each covers the one before.
    for (std::size_t i = first; i < last && pairs.size() <= most_warnings; ++i) {
      for (std::size_t k = i + 1; k < std::min(last, i + 65); ++k) {
        const std::uint32_t a = places[i].object;
        const std::uint32_t b = places[k].object;
        if (!on(a, b) || !on(b, a)) { continue; }
        pairs.push_back({a, b});
        break;
      }
    }
    first = last;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Edges at which the surface of an object ends.
inline std::size_t open_edges(const Surface& surface) {
  const SurfaceBRep& brep = surface.brep;
  std::size_t count = 0;
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).sheet != brep::no_sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      count += brep.data(brep.face(brep::twin(h))).sheet != brep::no_sheet ? 1 : 0;
    }
  }
  return count;
}

}  // namespace detail

// `surfaces` before refinement: afterwards they have more edges.
[[nodiscard]] inline std::vector<std::string> warnings(const Scene& scene, const Frame& frame, const raycast::Scene& objects,
                                                       const std::vector<Surface>& surfaces) {
  std::vector<std::string> sentences;
  const auto name = [&](std::uint32_t o) { return "'" + scene.objects[o].name + "'"; };
  const auto add = [&](std::size_t& count, std::string sentence) {
    if (count++ < detail::most_warnings) { sentences.push_back(std::move(sentence)); }
  };
  const auto more = [&](std::size_t count, const char* what) {
    if (count > detail::most_warnings) { sentences.push_back("and more " + std::string{what}); }
  };
  std::size_t count = 0;
  for (const auto& [a, b] : detail::twins(objects, surfaces)) {
    add(count, "objects " + name(a) + " and " + name(b) + " are the same surface at the same place: duplicates; " + name(b) +
                   " is seen, being the later one, and " + name(a) + " is covered by it");
  }
  more(count, "duplicates");
  count = 0;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (surfaces[o].object->solid() || input_faces(surfaces[o]).size() < 2) { continue; }
    add(count, "object " + name(o) + " is an open shell with " + std::to_string(detail::open_edges(surfaces[o])) +
                   " open edges: its back is black and takes no light");
  }
  more(count, "open shells");
  // How well the coordinates of the scene are known, in the frame: half a unit in the last place of the largest.
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

// Objects of which nothing is exposed, those that a warning of duplicates names included.
[[nodiscard]] inline std::vector<std::string> warnings_of_buried(const Scene& scene, const Hierarchy& hierarchy, const Exposure& exposure) {
  std::vector<double> area(scene.objects.size(), 0.0);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (hierarchy[i].leaf()) { area[hierarchy[i].object] += exposure.area[i]; }
  }
  std::vector<std::string> sentences;
  for (std::size_t o = 0; o < area.size() && sentences.size() < detail::most_warnings; ++o) {
    if (area[o] > 0.0) { continue; }
    sentences.push_back("object '" + scene.objects[o].name + "' is buried: all of its surface lies in or under other objects and is dark");
  }
  return sentences;
}

// One ray from each of `rays` points spread over the exposed area.
[[nodiscard]] inline StrayRays stray_rays(const raycast::Scene& objects, const std::vector<Surface>& surfaces, const Hierarchy& hierarchy,
                                          const Patches& patches, const Exposure& exposure, std::uint32_t rays, unsigned threads,
                                          std::uint64_t seed) {
  std::vector<std::uint32_t> leaves;
  std::vector<double> until;  // cumulative area
  double total = 0.0;
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf() || !(exposure.area[i] > 0.0)) { continue; }
    leaves.push_back(i);
    until.push_back(total += exposure.area[i]);
  }
  if (leaves.empty()) { return {}; }
  enum class End : char { front, back, nowhere };
  std::vector<End> ends(rays, End::front);
  parallel_for(rays, threads, [&](std::size_t k) {
    Random random{seed, k, 0x7374726179ull};
    const double at = (static_cast<double>(k) + random.uniform()) / rays * total;
    const auto found = static_cast<std::size_t>(std::upper_bound(until.begin(), until.end(), at) - until.begin());
    const std::uint32_t i = leaves[std::min(found, leaves.size() - 1)];
    const ExposedPoints* const points = exposure.points(i);
    glm::dvec3 p{0.0};
    if (points != nullptr) {
      p = points->draw(patches[i], static_cast<std::uint32_t>(random.bits() & 15u), random);
    } else {
      const double u = random.uniform();
      p = sample(patches[i], u, random.uniform());
    }
    const Node& node = hierarchy[i];
    const raycast::SurfacePoint from = objects.object(node.object).project(node.surface - surfaces[node.object].first_surface, p);
    const double u = random.uniform();
    const auto hit = objects.closest({from.position, cosine_direction(from.normal, u, random.uniform()) * objects.diameter()}, node.object);
    ends[k] = !hit ? End::nowhere : hit->front ? End::front : End::back;
  });
  StrayRays stray;
  stray.escaping = static_cast<double>(std::count(ends.begin(), ends.end(), End::nowhere)) / rays;
  stray.to_backs = static_cast<double>(std::count(ends.begin(), ends.end(), End::back)) / rays;
  stray.standard_error = 0.5 / std::sqrt(static_cast<double>(rays));
  return stray;
}

}  // namespace radiosity
