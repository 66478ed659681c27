// SPDX-License-Identifier: MIT
#include "apps/euler/planar_map.hpp"

#include <algorithm>
#include <map>

#include <brep/union_find.hpp>

namespace apps::euler {
namespace {

// The map while edges are added: each half-edge h is a dart that leaves its vertex; if its edge is cut, a second dart, h + n, returns to
// it.
class Opening {
 public:
  Opening(const Records& records, const std::vector<std::uint32_t>& shell)
      : records_(records), shell_(shell), n_(static_cast<std::uint32_t>(records.halfedges.size())), whole_(n_ / 2, false), face_(2 * n_) {}

  [[nodiscard]] bool whole(std::uint32_t h) const { return whole_[h / 2]; }
  [[nodiscard]] std::uint32_t next(std::uint32_t d) const {
    if (d >= n_) { return records_.halfedges[(d - n_) ^ 1U].next; }
    return whole(d) ? records_.halfedges[d].next : d + n_;
  }
  [[nodiscard]] std::uint32_t count() const { return n_; }

  // Adds, in this order, all edges that keep the map planar.
  void add(const std::vector<std::uint32_t>& order) {
    brep::detail::UnionFind joined(records_.vertices.size());
    label_faces();
    for (const std::uint32_t e : order) {
      const std::uint32_t a = records_.halfedges[2 * e].vertex, b = records_.halfedges[2 * e + 1].vertex;
      if (joined.find(a) == joined.find(b) && face_[2 * e] != face_[2 * e + 1]) { continue; }
      joined.unite(a, b);
      whole_[e] = true;
      label_faces();
    }
  }
  void keep_all() { std::fill(whole_.begin(), whole_.end(), true); }

 private:
  void label_faces() {
    std::uint32_t label = 0;
    std::fill(face_.begin(), face_.end(), brep::invalid_index);
    for (const std::uint32_t h : shell_) {
      if (face_[h] != brep::invalid_index) { continue; }
      for (std::uint32_t d = h; face_[d] == brep::invalid_index; d = next(d)) { face_[d] = label; }
      ++label;
    }
  }

  const Records& records_;
  const std::vector<std::uint32_t>& shell_;
  std::uint32_t n_;
  std::vector<bool> whole_;
  std::vector<std::uint32_t> face_;
};

// Does the shell have no handles, i.e. is v - e + f = 2?
bool is_plane(const Records& records, const std::vector<std::uint32_t>& shell) {
  std::vector<std::uint32_t> v, f;
  for (const std::uint32_t h : shell) {
    v.push_back(records.halfedges[h].vertex);
    f.push_back(records.halfedges[h].face);
  }
  const auto different = [](std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    return static_cast<std::size_t>(std::unique(list.begin(), list.end()) - list.begin());
  };
  return different(v) + different(f) == shell.size() / 2 + 2;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shells_of(const Records& records) {
  std::vector<bool> seen(records.halfedges.size(), false);
  std::vector<std::vector<std::uint32_t>> shells;
  for (std::uint32_t first = 0; first < records.halfedges.size(); ++first) {
    if (seen[first] || !records.halfedges[first].alive) { continue; }
    std::vector<std::uint32_t> shell{first};
    seen[first] = true;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      for (const std::uint32_t h : {shell[i] ^ 1U, records.halfedges[shell[i]].next}) {
        if (!seen[h]) { shell.push_back(h); }
        seen[h] = true;
      }
    }
    std::sort(shell.begin(), shell.end());
    shells.push_back(std::move(shell));
  }
  return shells;
}

PlanarMap planar_map(const Records& records, const std::vector<std::uint32_t>& shell, const std::vector<bool>& was_cut) {
  Opening opening(records, shell);
  if (is_plane(records, shell)) {
    opening.keep_all();
  } else {
    std::vector<std::uint32_t> order;
    for (const std::uint32_t h : shell) {
      if (h % 2 == 0) { order.push_back(h / 2); }
    }
    std::stable_partition(order.begin(), order.end(), [&](std::uint32_t e) { return e >= was_cut.size() || !was_cut[e]; });
    opening.add(order);
  }

  PlanarMap map;
  std::map<std::uint32_t, std::uint32_t> vertex_index;
  const auto vertex = [&](std::uint32_t name) {
    const auto found = vertex_index.emplace(name, static_cast<std::uint32_t>(map.vertices.size()));
    if (found.second) { map.vertices.push_back(name); }
    return found.first->second;
  };
  std::vector<std::uint32_t> dart(2 * std::size_t{opening.count()}), walk;  // dart: from numbers of Opening to those of the map
  const auto new_dart = [&](std::uint32_t d, std::uint32_t start, std::uint32_t name) {
    dart[d] = static_cast<std::uint32_t>(map.darts.size());
    walk.push_back(d);
    map.darts.push_back({0, start, brep::invalid_index, name, records.halfedges[name].face});
  };
  for (const std::uint32_t h : shell) {
    const std::uint32_t start = vertex(records.halfedges[h].vertex);
    if (opening.whole(h)) {
      if (h % 2 == 0) { map.edges.push_back({h / 2, false}); }
      if (h % 2 == 0) {
        new_dart(h, start, h);
        new_dart(h + 1, vertex(records.halfedges[h + 1].vertex), h + 1);
      }
    } else {
      map.edges.push_back({h / 2, true});
      new_dart(h, start, h);
      new_dart(h + opening.count(), static_cast<std::uint32_t>(map.vertices.size()), h ^ 1U);
      map.vertices.push_back(brep::invalid_index);
    }
  }
  for (std::size_t i = 0; i < walk.size(); ++i) { map.darts[i].next = dart[opening.next(walk[i])]; }
  for (std::uint32_t first = 0; first < map.darts.size(); ++first) {
    if (map.darts[first].face != brep::invalid_index) { continue; }
    const auto face = static_cast<std::uint32_t>(map.faces.size());
    map.faces.emplace_back();
    for (std::uint32_t d = first; map.darts[d].face == brep::invalid_index; d = map.darts[d].next) {
      map.darts[d].face = face;
      map.faces.back().push_back(d);
    }
  }
  return map;
}

}  // namespace apps::euler
