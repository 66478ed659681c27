// SPDX-License-Identifier: MIT
#pragma once

// Are two BReps the same map under other names? An isomorphism is a one-to-one renaming of half-edges that keeps next and twin;
// faces and vertices are the loops and orbits of these, so it keeps them too. It may also reverse the orientation: next becomes
// prev, as in a mirror.
//
// A renaming of a connected shell is settled by the image of one half-edge: follow next and twin in both at once (Weinberg 1966).
// Which images come into question is narrowed down first: each half-edge gets a colour from the degrees of its face and vertex and, in a
// few rounds, from the colours of its next and its twin; isomorphic half-edges have equal colours. The root is a half-edge
// whose colour is rarest. Shells are matched one after another; as isomorphism is an equivalence, the first partner will do.
//
// Time: O(e) and a sort, times the number of images tried: one for most, at worst the symmetric-looking ones, O(e^2), where each
// wrong image is left at the first disagreement. Both BReps must be valid. Data are not compared.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>

namespace brep {

enum class Orientation { kept, reversed };

namespace detail {

// A BRep, or its mirror image, as the two permutations next and twin, with colours and shells.
template <class B>
class ColouredMap {
 public:
  using Colour = std::uint64_t;
  struct Shell {
    std::vector<HalfedgeId> halfedges;
    std::vector<Colour> colours;  // sorted
  };

  ColouredMap(const B& brep, Orientation orientation) : brep_(brep), orientation_(orientation), colour_(brep.halfedge_end()) {
    start_with_degrees();
    for (int round = 0; round < 8; ++round) { refine(); }
    find_shells();
  }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const { return orientation_ == Orientation::kept ? brep_.next(h) : brep_.prev(h); }
  [[nodiscard]] Colour colour(HalfedgeId h) const { return colour_[h.index]; }
  [[nodiscard]] const std::vector<Shell>& shells() const { return shells_; }

 private:
  static Colour mix(Colour a, Colour b) {  // any hash will do: colours only save time
    Colour x = (a ^ (b + 0x9e3779b97f4a7c15u + (a << 6) + (a >> 2))) * 0xbf58476d1ce4e5b9u;
    return x ^ (x >> 31);
  }
  void start_with_degrees() {
    for (FaceId f : faces(brep_)) {
      const std::size_t n = degree(brep_, f);
      for (HalfedgeId h : halfedges_of(brep_, f)) { colour_[h.index] = n; }
    }
    for (VertexId v : vertices(brep_)) {
      const std::size_t n = degree(brep_, v);
      for (HalfedgeId h : halfedges_from(brep_, v)) {  // in the mirror it is the twin that leaves v
        const HalfedgeId from_v = orientation_ == Orientation::kept ? h : twin(h);
        colour_[from_v.index] = mix(colour_[from_v.index], n);
      }
    }
  }
  void refine() {
    std::vector<Colour> finer(colour_.size());
    for (EdgeId e : edges(brep_)) {
      for (HalfedgeId h : {halfedge(e), twin(halfedge(e))}) { finer[h.index] = mix(mix(colour(h), colour(next(h))), colour(twin(h))); }
    }
    colour_ = std::move(finer);
  }
  void find_shells() {
    std::vector<bool> seen(brep_.halfedge_end(), false);
    for (EdgeId e : edges(brep_)) {
      if (seen[halfedge(e).index]) { continue; }
      Shell shell;
      const auto reach = [&](HalfedgeId h) {
        if (seen[h.index]) { return; }
        seen[h.index] = true;
        shell.halfedges.push_back(h);
        shell.colours.push_back(colour(h));
      };
      reach(halfedge(e));
      for (std::size_t i = 0; i < shell.halfedges.size(); ++i) {
        const HalfedgeId h = shell.halfedges[i];
        reach(twin(h));
        reach(brep_.next(h));
      }
      std::sort(shell.colours.begin(), shell.colours.end());
      shells_.push_back(std::move(shell));
    }
  }

  const B& brep_;
  Orientation orientation_;
  std::vector<Colour> colour_;
  std::vector<Shell> shells_;
};

// The half-edge of the shell whose colour is rarest.
template <class Map, class Shell>
HalfedgeId rarest(const Map& map, const Shell& shell) {
  std::size_t fewest = shell.colours.size() + 1;
  auto rare = shell.colours.front();
  for (auto first = shell.colours.begin(); first != shell.colours.end();) {
    const auto last = std::upper_bound(first, shell.colours.end(), *first);
    if (static_cast<std::size_t>(last - first) < fewest) {
      fewest = static_cast<std::size_t>(last - first);
      rare = *first;
    }
    first = last;
  }
  return *std::find_if(shell.halfedges.begin(), shell.halfedges.end(), [&](HalfedgeId h) { return map.colour(h) == rare; });
}

// Does x -> y extend to the whole shell? Then the images are in `image`, else it is as before. Shells of one size: what is onto is
// one-to-one.
template <class A, class B>
bool extend(const ColouredMap<A>& a, const ColouredMap<B>& b, HalfedgeId x, HalfedgeId y, std::vector<HalfedgeId>& image) {
  std::vector<HalfedgeId> mapped;
  const auto set = [&](HalfedgeId from, HalfedgeId to) {
    HalfedgeId& known = image[from.index];
    if (known.valid()) { return known == to; }
    known = to;
    mapped.push_back(from);
    return a.colour(from) == b.colour(to);
  };
  bool agrees = set(x, y);
  for (std::size_t i = 0; agrees && i < mapped.size(); ++i) {
    const HalfedgeId from = mapped[i], to = image[from.index];
    agrees = set(twin(from), twin(to)) && set(a.next(from), b.next(to));
  }
  if (!agrees) {
    for (HalfedgeId h : mapped) { image[h.index] = HalfedgeId{}; }
  }
  return agrees;
}

// "3 with 4 edges" and so on: how many elements have which degree.
template <class Range, class B>
std::string degrees(Range&& range, const B& brep) {
  std::map<std::size_t, std::size_t> count;
  for (auto id : range) { ++count[degree(brep, id)]; }
  std::string text;
  for (const auto& [n, times] : count) {
    if (!text.empty()) { text += ", "; }
    text += std::to_string(times) + " of degree " + std::to_string(n);
  }
  return text.empty() ? "none" : text;
}

}  // namespace detail

// The image of each half-edge of a in b, indexed by half-edge (invalid for dead ones), or nothing when there is no isomorphism.
template <class A, class B>
[[nodiscard]] std::optional<std::vector<HalfedgeId>> find_isomorphism(const A& a, const B& b, Orientation orientation = Orientation::kept) {
  if (a.vertex_count() != b.vertex_count() || a.edge_count() != b.edge_count() || a.face_count() != b.face_count()) { return std::nullopt; }
  const detail::ColouredMap<A> from(a, Orientation::kept);
  const detail::ColouredMap<B> to(b, orientation);
  if (from.shells().size() != to.shells().size()) { return std::nullopt; }
  std::vector<HalfedgeId> image(a.halfedge_end());
  std::vector<bool> taken(to.shells().size(), false);
  for (const auto& shell : from.shells()) {
    const HalfedgeId root = detail::rarest(from, shell);
    bool found = false;
    for (std::size_t i = 0; i < taken.size() && !found; ++i) {
      const auto& partner = to.shells()[i];
      if (taken[i] || partner.colours != shell.colours) { continue; }
      for (HalfedgeId h : partner.halfedges) {
        if (to.colour(h) != from.colour(root) || !detail::extend(from, to, root, h, image)) { continue; }
        taken[i] = found = true;
        break;
      }
    }
    if (!found) { return std::nullopt; }
  }
  return image;
}

// What stands against an isomorphism, in sentences; empty when there is one. Says when b is the mirror image of a.
template <class A, class B>
[[nodiscard]] std::string difference(const A& a, const B& b) {
  if (find_isomorphism(a, b)) { return {}; }
  std::string text;
  const auto compare = [&](const char* what, const auto& x, const auto& y) {
    if (x != y) { text += std::string(text.empty() ? "" : "\n") + what + ": " + x + ", expected " + y; }
  };
  compare("vertices", detail::degrees(vertices(a), a), detail::degrees(vertices(b), b));
  compare("faces", detail::degrees(faces(a), a), detail::degrees(faces(b), b));
  compare("edges", std::to_string(a.edge_count()), std::to_string(b.edge_count()));
  compare("shells", std::to_string(shell_count(a)), std::to_string(shell_count(b)));
  compare("handles", std::to_string(genus(a)), std::to_string(genus(b)));
  if (!text.empty()) { return text; }
  if (find_isomorphism(a, b, Orientation::reversed)) { return "it is the mirror image: some faces run the wrong way round"; }
  return "all counts and degrees agree, but the elements are connected differently";
}

}  // namespace brep
