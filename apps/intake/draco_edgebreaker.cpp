// SPDX-License-Identifier: MIT
#include "apps/intake/draco_edgebreaker.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "apps/intake/draco_rans.hpp"

namespace apps::intake::draco {
namespace {

// How the next triangle is glued to the mesh. Triangles grow at the active edge, which lies opposite to the active corner a; after each
// symbol one of the other two edges of the new triangle is active.
enum class Symbol : std::uint8_t {
  c = 0,  // it fills the gap between two boundary edges, whose common vertex is inside of the mesh from now on
  s = 1,  // it joins the two latest active edges
  l = 3,  // its third vertex is new, and the active edge runs from there to the vertex at previous(a) ...
  r = 5,  // ... or to that at next(a)
  e = 7,  // it is glued to nothing: all its vertices are new
};

// The symbols in the order of the decoder.
class Symbols {
 public:
  // Standard: one bit for C, three for the others.
  explicit Symbols(StreamBytes standard) : standard_(standard) {}
  // By valence: coded apart for each number of edges, from 2 to 7, at the vertex where the last triangle ended.
  Symbols() = default;
  void read_contexts(StreamBytes& in, std::size_t most) {
    for (auto& context : contexts_) {
      const std::uint32_t count = in.varint();
      if (count > most) { in.refuse("there are more symbols than triangles"); }
      context = read_symbols(in, count, 1);
    }
  }

  // `valence`: of that vertex; nothing before the first triangle.
  [[nodiscard]] Symbol next(const StreamBytes& in, std::optional<std::uint32_t> valence) {
    if (standard_) { return standard_->bits(1) == 0 ? Symbol::c : static_cast<Symbol>(1 + 2 * standard_->bits(2)); }
    if (!valence) { return Symbol::e; }
    auto& context = contexts_[std::clamp(*valence, 2U, 7U) - 2U];
    constexpr std::array names{Symbol::c, Symbol::s, Symbol::l, Symbol::r, Symbol::e};
    if (context.empty() || context.back() >= names.size()) { in.refuse("the symbols of the triangles are damaged"); }
    const Symbol symbol = names[context.back()];
    context.pop_back();
    return symbol;
  }

 private:
  std::optional<StreamBytes> standard_;
  std::array<std::vector<std::uint32_t>, 6> contexts_;
};

class Edgebreaker {
 public:
  explicit Edgebreaker(StreamBytes& in) : in_(in) {}

  std::vector<CornerTable> read(std::size_t most) {
    const std::uint32_t traversal = in_.byte();
    if (traversal != 0 && traversal != 2) { in_.refuse("Edgebreaker with predicted symbols is not read (deprecated)"); }
    static_cast<void>(in_.varint());  // vertices
    faces_ = in_.varint();
    const std::uint32_t attributes = in_.byte();
    if (faces_ > most / (attributes + 1)) { in_.refuse("the stream has more triangles than its size allows"); }
    count_ = in_.varint();
    if (count_ > faces_) { in_.refuse("there are more symbols than triangles"); }
    static_cast<void>(in_.varint());  // vertices that are merged
    read_splits();
    if (traversal == 0) { symbols_ = Symbols(in_.part(in_.varint())); }
    BitDecoder inner_starts(in_);
    std::vector<BitDecoder> seams;
    for (std::uint32_t i = 0; i < attributes; ++i) { seams.emplace_back(in_); }
    if (traversal == 2) { symbols_.read_contexts(in_, faces_); }
    for (std::uint32_t i = 0; i < count_; ++i) { add_triangle(i); }
    while (!active_.empty()) {
      const std::uint32_t edge = active_.back();
      active_.pop_back();
      if (inner_starts.next()) { fill(edge); }
    }
    if (table_.opposite.size() != 3 * std::size_t{faces_}) { in_.refuse("the stream does not have the triangles that it announces"); }
    table_.find_vertices();
    std::vector<CornerTable> tables = cut(seams);
    tables.insert(tables.begin(), std::move(table_));
    return tables;
  }

 private:
  // After the triangle `source`, the boundary has one more place at which triangles will be glued: when S comes as triangle `split`.
  struct Split {
    std::uint32_t source, split;
    bool right;
  };
  void read_splits() {
    const std::uint32_t count = in_.varint();
    if (count > in_.left() / 2) { in_.refuse("the stream ends too early"); }
    std::uint32_t last = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t source = last + in_.varint(), back = in_.varint();
      if (source < last || source >= count_ || back > source) { in_.refuse("a split of the boundary names no triangle"); }
      splits_.push_back({source, source - back, false});
      last = source;
    }
    for (Split& split : splits_) { split.right = in_.bits(1) != 0; }
    in_.end_bits();
  }

  // The boundary edge that shares the vertex next(a), or with `step` = next the vertex previous(a), with the boundary edge of a.
  template <class Step>
  [[nodiscard]] std::uint32_t other_edge(std::uint32_t a, const Step& step) const {
    if (table_.opposite[a] != no_corner) { in_.refuse("more than two triangles share an edge"); }  // the walk would have no end
    std::uint32_t b = step(a);
    while (table_.opposite[b] != no_corner) { b = step(table_.opposite[b]); }
    return b;
  }
  void glue(std::uint32_t a, std::uint32_t b) {
    if (a == b || table_.opposite[a] != no_corner || table_.opposite[b] != no_corner) {
      in_.refuse("more than two triangles share an edge");
    }
    table_.opposite[a] = b;
    table_.opposite[b] = a;
  }
  [[nodiscard]] std::uint32_t active() const {
    if (active_.empty()) { in_.refuse("a triangle is glued to nothing"); }
    return active_.back();
  }

  // The vertex at a corner, and those of the new triangle. S makes one of two: then one is the parent of the other.
  [[nodiscard]] std::uint32_t vertex_at(std::uint32_t c) {
    std::uint32_t v = vertex_[c];
    while (parent_[v] != v) { v = parent_[v] = parent_[parent_[v]]; }
    return v;
  }
  std::uint32_t new_vertex() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    valence_.push_back(0);
    return parent_.back();
  }
  // Edges that the triangle adds to each vertex.
  void add_vertices(std::array<std::uint32_t, 3> v, std::array<std::uint32_t, 3> edges) {
    for (std::size_t k = 0; k < 3; ++k) {
      vertex_.push_back(v[k]);
      valence_[v[k]] += edges[k];
    }
  }

  // The triangle `i` with the corners c, c + 1 and c + 2: the edge opposite to c is the active one from now on.
  void add_triangle(std::uint32_t i) {
    const std::uint32_t c = 3 * i;
    const Symbol symbol = symbols_.next(in_, i == 0 ? std::nullopt : std::optional(valence_[vertex_at(c - 2)]));
    table_.opposite.insert(table_.opposite.end(), 3, no_corner);
    if (symbol == Symbol::e) {
      const std::uint32_t a = new_vertex(), b = new_vertex();
      add_vertices({a, b, new_vertex()}, {2, 2, 2});
      active_.push_back(c);
    } else if (symbol == Symbol::s) {
      const std::uint32_t b = active();
      active_.pop_back();
      if (const auto split = split_edges_.find(i); split != split_edges_.end()) { active_.push_back(split->second); }
      const std::uint32_t a = active(), merged = vertex_at(next(b)), v = vertex_at(previous(a));
      glue(a, c + 2);
      glue(b, c + 1);
      if (merged != v) {
        valence_[v] += valence_[merged];
        parent_[merged] = v;
      }
      add_vertices({v, vertex_at(next(a)), vertex_at(previous(b))}, {0, 1, 1});
    } else if (const std::uint32_t a = active(); symbol == Symbol::c) {
      const std::uint32_t b = other_edge(a, previous);
      add_vertices({vertex_at(next(a)), vertex_at(next(b)), vertex_at(previous(a))}, {0, 1, 1});
      glue(a, c + 1);
      glue(b, c + 2);
    } else if (symbol == Symbol::r) {
      add_vertices({vertex_at(previous(a)), vertex_at(next(a)), new_vertex()}, {1, 1, 2});
      glue(a, c + 2);
    } else {
      const std::uint32_t tip = new_vertex();
      add_vertices({vertex_at(next(a)), tip, vertex_at(previous(a))}, {1, 2, 1});
      glue(a, c + 1);
    }
    active_.back() = c;
    if (symbol != Symbol::c && symbol != Symbol::s) { begin_splits(i, c); }
  }

  // The stream counts the triangles in the order of the encoder, from the other end.
  void begin_splits(std::uint32_t i, std::uint32_t c) {
    const std::uint32_t encoded = count_ - 1 - i;
    for (; !splits_.empty() && splits_.back().source == encoded; splits_.pop_back()) {
      split_edges_[count_ - 1 - splits_.back().split] = splits_.back().right ? next(c) : previous(c);
    }
  }

  // The triangle at which the encoder began: three edges are left around it.
  void fill(std::uint32_t a) {
    if (table_.opposite.size() >= 3 * std::size_t{faces_}) { in_.refuse("there are more triangles than the stream announces"); }
    const auto c = static_cast<std::uint32_t>(table_.opposite.size());
    const std::uint32_t b = other_edge(a, previous), d = other_edge(a, next);
    table_.opposite.insert(table_.opposite.end(), 3, no_corner);
    glue(c, a);
    glue(c + 1, b);
    glue(c + 2, d);
  }

  // The table of each attribute: for each edge between two triangles a bit says whether it is a seam.
  std::vector<CornerTable> cut(std::vector<BitDecoder>& seams) const {
    std::vector<CornerTable> tables(seams.size());
    for (CornerTable& table : tables) { table.opposite = table_.opposite; }
    for (std::uint32_t c = 0; c < table_.opposite.size(); ++c) {
      const std::uint32_t other = table_.opposite[c];
      if (other == no_corner || other / 3 < c / 3) { continue; }
      for (std::size_t i = 0; i < seams.size(); ++i) {
        if (seams[i].next()) { tables[i].opposite[c] = tables[i].opposite[other] = no_corner; }
      }
    }
    for (CornerTable& table : tables) { table.find_vertices(); }
    return tables;
  }

  StreamBytes& in_;
  std::uint32_t faces_ = 0, count_ = 0;  // of triangles; of those that have a symbol
  Symbols symbols_;
  std::vector<Split> splits_;                           // by source
  std::map<std::uint32_t, std::uint32_t> split_edges_;  // edges for S, by its number
  CornerTable table_;
  std::vector<std::uint32_t> active_;  // corners opposite to boundary edges; at the last one triangles are glued
  std::vector<std::uint32_t> vertex_, parent_, valence_;
};

}  // namespace

std::vector<CornerTable> read_edgebreaker(StreamBytes& in, std::size_t most) { return Edgebreaker(in).read(most); }

}  // namespace apps::intake::draco
