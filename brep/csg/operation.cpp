// SPDX-License-Identifier: MIT
#include <brep/csg/operation.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/box_pairs.hpp>
#include <brep/csg/contacts.hpp>
#include <brep/csg/cut_faces.hpp>
#include <brep/csg/labels.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/point_table.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/split_edges.hpp>
#include <brep/csg/work.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE Arrangement::Arrangement(const PlaneTable& planes, const Boundary& a, const Boundary& b, bool reverse_b,
                                          std::uint32_t attributes_of_a)
    : work(both(planes, a, b, reverse_b, attributes_of_a)), contacts(work), radial(work), labels(work, contacts.table, reverse_b) {
  if (reverse_b && b.touching) {  // the wedges between its wedges are solid now
    std::vector<std::uint32_t> several;
    if (pair_wedges(work, static_cast<std::uint32_t>(a.halves.size()), several)) { fault = 0; }
  }
  find_contacts();
  if (a.touching || b.touching) { add_copies(); }
  if (!contacts.consistent) { fault = 0; }
  if (fault == invalid_index) { cut(); }
  if (fault == invalid_index) {
    labels.run(radial);
    fault = labels.fault;
  }
}

HALFLIGHT_INLINE Work Arrangement::both(const PlaneTable& planes, const Boundary& a, const Boundary& b, bool reverse_b,
                                        std::uint32_t attributes_of_a) {
  Work w(planes);
  const auto room = [](auto& list, std::size_t given) { list.reserve(given + given / 8 + 64); };  // an eighth for what the cut adds
  room(w.points, a.points.size() + b.points.size());
  room(w.halves, a.halves.size() + b.halves.size());
  room(w.faces, a.faces.size() + b.faces.size());
  w.add(a, false, false, 0);
  w.add(b, true, reverse_b, attributes_of_a);
  return w;
}

HALFLIGHT_INLINE void Arrangement::find_contacts() {
  Box boxes[2];
  for (const WorkFace& f : work.faces) { boxes[f.of_b].add(f.box); }
  BoxPairs pairs;
  for (std::uint32_t f = 0; f < work.faces.size(); ++f) {
    const WorkFace& face = work.faces[f];
    if (face.box.meets(boxes[!face.of_b])) { (face.of_b ? pairs.b : pairs.a).push_back({face.box, f}); }
  }
  pairs.run([&](std::uint32_t f, std::uint32_t g) { contacts.compare(f, g); });
  if (contacts.table.renamed()) {
    for (WorkHalf& h : work.halves) { h.point = contacts.table.name(h.point); }
  }
}

HALFLIGHT_INLINE void Arrangement::add_copies() {
  std::vector<std::array<std::uint32_t, 3>> edges;  // ends, lower half-edge
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) {
    const std::uint32_t p = work.halves[h].point, q = work.target(h);
    if (h < work.halves[h].twin) { edges.push_back({std::min(p, q), std::max(p, q), h}); }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> next(work.halves.size(), invalid_index);  // a ring of the edges at one place
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end][0] == edges[i][0] && edges[end][1] == edges[i][1]) { ++end; }
    for (std::size_t k = i; end - i > 1 && k < end; ++k) { next[edges[k][2]] = edges[k + 1 < end ? k + 1 : i][2]; }
  }
  const auto for_copies = [&](std::uint32_t e, auto&& visit) {
    for (std::uint32_t x = next[e]; x != invalid_index && x != e; x = next[x]) { visit(x); }
  };
  for (std::size_t i = 0, count = contacts.nodes.size(); i < count; ++i) {
    const EdgeNode node = contacts.nodes[i];
    for_copies(node.edge, [&](std::uint32_t x) { contacts.nodes.push_back({x, node.point}); });
  }
  for (std::size_t i = 0, count = contacts.along.size(); i < count; ++i) {
    for_copies(contacts.along[i], [&](std::uint32_t x) { contacts.along.push_back(x); });
  }
}

HALFLIGHT_INLINE void Arrangement::cut() {
  SplitEdges edges(work);
  edges.run(contacts.nodes);
  CutFaces faces(work);
  faces.run(contacts.segments, edges, contacts.table.points());
  fault = faces.fault;
  if (fault != invalid_index) { return; }
  cuts = std::move(faces.cuts);
  for (std::uint32_t c : cuts) { radial.add(c), radial.add(c + 1); }
  std::vector<std::uint32_t>& along = contacts.along;
  std::sort(along.begin(), along.end());
  along.erase(std::unique(along.begin(), along.end()), along.end());
  for (std::uint32_t e : along) {
    edges.for_parts(e, [&](std::uint32_t h) { radial.add(h); });
  }
  radial.run();
  fault = radial.fault;
}

}  // namespace brep::csg::detail
