// SPDX-License-Identifier: MIT
#include "apps/intake/draco.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "apps/bytes.hpp"
#include "apps/intake/draco_corners.hpp"
#include "apps/intake/draco_edgebreaker.hpp"
#include "apps/intake/draco_prediction.hpp"
#include "apps/intake/draco_rans.hpp"
#include "apps/intake/stream_bytes.hpp"

namespace apps::intake::draco {
namespace {

// How many triangles, times the groups of attributes, a stream of this size may have, and how many numbers for each of them. Triangles that
// cost nearly no bits exist, as in a flat grid, but not in large numbers.
constexpr std::size_t most_triangles(std::size_t bytes) { return std::min<std::size_t>(20'000'000, 1'000'000 + 32 * bytes); }
constexpr std::size_t most_numbers = 8;

enum class Coder : std::uint8_t { raw, integer, quantized, normal };

// Attributes that share a traversal. The tables are those of the positions and of the attributes with seams.
struct Group {
  const CornerTable* table = nullptr;  // null in sequential meshes
  Sequence sequence;
  struct Described {
    std::uint32_t type, data_type;
    std::size_t components;
    bool normalized;  // the largest integer of the type means 1
    std::uint32_t unique_id;
    Coder coder = Coder::raw;
    std::vector<double> values;          // of the entries
    std::vector<std::int32_t> integers;  // before they are scaled; empty if raw
  };
  std::vector<Described> attributes;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : in_(bytes), most_(most_triangles(bytes.size())) {}

  Mesh read() {
    const bool edgebreaker = header();
    edgebreaker ? read_edgebreaker_connectivity() : read_sequential_connectivity();
    read_groups(edgebreaker);
    for (Group& group : groups_) {
      for (Group::Described& attribute : group.attributes) { read_integers(group, attribute); }
      for (Group::Described& attribute : group.attributes) { scale(attribute); }
    }
    for (Group& group : groups_) {
      for (Group::Described& attribute : group.attributes) { give(group, attribute); }
    }
    return std::move(mesh_);
  }

 private:
  // Is the connectivity that of Edgebreaker?
  bool header() {
    if (in_.left() < 11 || in_.take(5) != "DRACO") { in_.refuse("expected a stream that begins with the letters DRACO"); }
    const std::uint32_t major = in_.byte(), minor = in_.byte(), type = in_.byte(), method = in_.byte(), flags = in_.number(2);
    if (major != 2 || minor != 2) {
      in_.refuse("expected version 2.2 of Draco, found version " + std::to_string(major) + "." + std::to_string(minor));
    }
    if (type != 1) { in_.refuse("clouds of points are not read"); }
    if (method > 1) { in_.refuse("unknown connectivity " + std::to_string(method)); }
    if ((flags & 0x8000U) != 0) { skip_metadata(); }
    return method == 1;
  }

  // Those of some attributes and then those of the file. An element has pairs of names and values, and elements in itself, each behind
  // its name; so all elements stand in a row.
  void skip_metadata() {
    const auto skip = [&](std::size_t size) { static_cast<void>(in_.take(size)); };
    for (std::uint32_t attributes = in_.varint(), i = 0; i <= attributes; ++i) {
      if (i < attributes) { static_cast<void>(in_.varint()); }
      bool named = false;
      for (std::uint64_t open = 1; open > 0; --open) {
        if (std::exchange(named, true)) { skip(in_.byte()); }
        for (std::uint32_t pairs = in_.varint(); pairs > 0; --pairs) {
          skip(in_.byte());
          skip(in_.varint());
        }
        open += in_.varint();
      }
    }
  }

  void read_sequential_connectivity() {
    const std::uint32_t faces = in_.varint(), points = in_.varint(), method = in_.byte();
    if (faces > most_ || points > 3 * most_) { in_.refuse("the stream has more triangles than its size allows"); }
    mesh_.points = points;
    if (method == 0) {  // compressed: each index as the difference from the one before, with its sign in the lowest bit
      mesh_.corners = read_symbols(in_, 3 * std::size_t{faces}, 1);
      std::uint32_t last = 0;
      for (std::uint32_t& corner : mesh_.corners) { last = corner = (corner & 1U) != 0 ? last - (corner >> 1U) : last + (corner >> 1U); }
    } else {
      const std::size_t size = points < 1U << 8U ? 1 : points < 1U << 16U ? 2 : points < 1U << 21U ? 0 : 4;  // 0: of varying size
      for (std::size_t i = 0; i < 3 * std::size_t{faces}; ++i) { mesh_.corners.push_back(size > 0 ? in_.number(size) : in_.varint()); }
    }
    for (const std::uint32_t corner : mesh_.corners) {
      if (corner >= points) { in_.refuse("a triangle names point " + std::to_string(corner) + " of " + std::to_string(points)); }
    }
  }

  void read_edgebreaker_connectivity() {
    tables_ = read_edgebreaker(in_, most_);
    mesh_.corners.assign(tables_[0].opposite.size(), no_corner);
    // Around a vertex a new point begins wherever an attribute has a seam.
    const auto differ = [&](std::uint32_t a, std::uint32_t b) {
      return std::any_of(tables_.begin(), tables_.end(), [&](const CornerTable& table) { return table.vertex[a] != table.vertex[b]; });
    };
    const CornerTable& table = tables_[0];
    for (const std::uint32_t leftmost : table.leftmost) {
      std::uint32_t first = leftmost, before = leftmost;
      for (std::uint32_t c = table.swing_right(first); c != no_corner && c != leftmost; c = table.swing_right(c)) {
        if (table.swing_left(leftmost) != no_corner && differ(before, c)) {
          first = c;  // the vertex is inside of the mesh, so its corners are a circle that may begin anywhere
          break;
        }
        before = c;
      }
      before = first;
      for (std::uint32_t c = first; c != no_corner && mesh_.corners[c] == no_corner; c = table.swing_right(c)) {
        mesh_.corners[c] = static_cast<std::uint32_t>(c != first && !differ(before, c) ? mesh_.points - 1 : mesh_.points++);
        before = c;
      }
    }
  }

  void read_groups(bool edgebreaker) {
    const std::uint32_t count = in_.byte();
    if (count * mesh_.corners.size() / 3 > most_) { in_.refuse("the stream has more attributes than its size allows"); }
    for (std::uint32_t i = 0; i < count; ++i) {
      Group& group = groups_.emplace_back();
      if (!edgebreaker) { continue; }
      const std::uint32_t seams = in_.byte(), at_corners = in_.byte(), by_degree = in_.byte();
      if (at_corners > 1 || by_degree > 1) { in_.refuse("unknown traversal of an attribute"); }
      if (at_corners == 1 && seams + 1 >= tables_.size()) { in_.refuse("an attribute names seams that are not there"); }
      group.table = &tables_[at_corners == 1 ? seams + 1 : 0];
      group.sequence = traverse(*group.table, by_degree == 1);
    }
    std::size_t components = 0;
    for (Group& group : groups_) {
      for (std::uint32_t attributes = in_.varint(); attributes > 0; --attributes) {
        Group::Described& attribute = group.attributes.emplace_back();
        attribute.type = in_.byte();
        attribute.data_type = in_.byte();
        attribute.components = in_.byte();
        attribute.normalized = in_.byte() != 0;
        attribute.unique_id = in_.varint();
        components += attribute.components;
        if (attribute.components == 0 || components * mesh_.points > most_numbers * most_) {
          in_.refuse("the attributes have " + std::to_string(components) + " numbers for each vertex");
        }
      }
      for (Group::Described& attribute : group.attributes) {
        const std::uint32_t coder = in_.byte();
        if (coder > 3) { in_.refuse("unknown coding of an attribute"); }
        attribute.coder = static_cast<Coder>(coder);
      }
    }
  }

  [[nodiscard]] std::size_t entries(const Group& group) const { return group.table ? group.sequence.corner_of_entry.size() : mesh_.points; }

  void read_integers(const Group& group, Group::Described& attribute) {
    if (attribute.coder == Coder::raw) { return read_raw(attribute, entries(group) * attribute.components); }
    const auto prediction = static_cast<Prediction>(static_cast<std::int8_t>(in_.byte()));
    const bool normal = attribute.coder == Coder::normal;
    if (prediction != Prediction::none) {
      const bool known = normal ? prediction == Prediction::difference || prediction == Prediction::geometric_normal
                                : prediction == Prediction::difference || prediction == Prediction::parallelogram ||
                                      prediction == Prediction::constrained_multi_parallelogram ||
                                      prediction == Prediction::texture_coordinates;
      if (!known || in_.byte() != (normal ? 3U : 1U)) { in_.refuse("a prediction of this kind is not read (deprecated)"); }
    }
    const std::size_t components = normal ? 2 : attribute.components, count = entries(group) * components;
    std::vector<std::uint32_t> symbols;
    if (in_.byte() != 0) {
      symbols = read_symbols(in_, count, components);
    } else {
      const std::uint32_t size = in_.byte();
      if (size > 4) { in_.refuse("an integer has more than 32 bits"); }
      if (size > 0 && count > in_.left() / size) { in_.refuse("the stream ends too early"); }
      for (std::size_t i = 0; i < count; ++i) { symbols.push_back(in_.number(size)); }
    }
    if (normal) {
      if (prediction != Prediction::none) { skip_normal_prediction(in_, prediction); }
      return;
    }
    attribute.integers.resize(count);  // the sign is in the lowest bit: 0, -1, 1, -2, ...
    std::transform(symbols.begin(), symbols.end(), attribute.integers.begin(),
                   [](std::uint32_t s) { return static_cast<std::int32_t>((s & 1U) != 0 ? ~(s >> 1U) : s >> 1U); });
    if (prediction == Prediction::none) { return; }
    if (!group.table) { return undo_prediction(in_, prediction, nullptr, components, attribute.integers); }
    const Surroundings around{*group.table, group.sequence,
                              prediction == Prediction::texture_coordinates ? positions_at(group) : std::vector<std::int32_t>{}};
    undo_prediction(in_, prediction, &around, components, attribute.integers);
  }

  // The positions at the entries of this group, as integers.
  [[nodiscard]] std::vector<std::int32_t> positions_at(const Group& group) const {
    std::vector<std::int32_t> positions;
    for (const Group& other : groups_) {
      for (const Group::Described& attribute : other.attributes) {
        if (attribute.type != 0 || attribute.components != 3 || attribute.integers.empty()) { continue; }
        for (const std::uint32_t c : group.sequence.corner_of_entry) {
          const std::size_t entry = other.sequence.entry_of_vertex[other.table->vertex[c]];
          for (std::size_t k = 0; k < 3; ++k) { positions.push_back(attribute.integers[3 * entry + k]); }
        }
        constexpr std::int32_t most = 1 << 28;  // squares of distances then have fewer than 61 bits
        if (std::any_of(positions.begin(), positions.end(), [](std::int32_t p) { return p > most || p < -most; })) {
          in_.refuse("positions have more than 28 bits");
        }
        return positions;
      }
    }
    return positions;
  }

  void read_raw(Group::Described& attribute, std::size_t count) {
    const std::size_t size = size_of(attribute);
    if (count > in_.left() / size) { in_.refuse("the stream ends too early"); }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t bits = bits_at(in_.take(size), 0, size);
      const auto unused = static_cast<unsigned>(64 - 8 * size);
      attribute.values.push_back(attribute.data_type == 9    ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                                 : attribute.data_type == 10 ? std::bit_cast<double>(bits)
                                 : is_signed(attribute)      ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                                                             : static_cast<double>(bits));
    }
  }

  // Data types 1 to 11: integers of 8, 16, 32, 64 bits, signed and unsigned in turn; float, double, truth value.
  [[nodiscard]] std::size_t size_of(const Group::Described& attribute) const {
    constexpr std::array<std::size_t, 12> sizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 1};
    if (attribute.data_type == 0 || attribute.data_type >= sizes.size()) {
      in_.refuse("unknown type of numbers " + std::to_string(attribute.data_type));
    }
    return sizes[attribute.data_type];
  }
  static bool is_signed(const Group::Described& attribute) { return attribute.data_type < 8 && attribute.data_type % 2 == 1; }
  static bool is_integer(const Group::Described& attribute) { return attribute.data_type != 9 && attribute.data_type != 10; }

  // From integers to values, with what the stream says after the integers of the group.
  void scale(Group::Described& attribute) {
    if (attribute.coder == Coder::normal) { static_cast<void>(in_.byte()); }
    if (attribute.coder == Coder::integer) { attribute.values.assign(attribute.integers.begin(), attribute.integers.end()); }
    if (attribute.coder != Coder::quantized) { return; }
    std::vector<double> least;
    for (std::size_t k = 0; k < attribute.components; ++k) { least.push_back(static_cast<double>(in_.float32())); }
    const double range = static_cast<double>(in_.float32());
    const std::uint32_t bits = in_.byte();
    if (bits < 1 || bits > 30) { in_.refuse("values are quantized to " + std::to_string(bits) + " bits"); }
    const double step = range / (std::ldexp(1.0, static_cast<int>(bits)) - 1.0);
    for (std::size_t i = 0; i < attribute.integers.size(); ++i) {
      attribute.values.push_back(least[i % attribute.components] + step * attribute.integers[i]);
    }
  }

  // Adds the attribute to the mesh, with a value for each point.
  void give(const Group& group, Group::Described& attribute) {
    const bool integers = is_integer(attribute);
    Attribute& out = mesh_.attributes.emplace_back(
        Attribute{attribute.unique_id, attribute.components, integers && !attribute.normalized, std::move(attribute.values)});
    if (attribute.coder == Coder::normal) { return; }
    if (integers && attribute.normalized) {
      const double unit = std::ldexp(1.0, static_cast<int>(8 * size_of(attribute)) - (is_signed(attribute) ? 1 : 0)) - 1.0;
      for (double& value : out.values) { value /= unit; }
    }
    if (!group.table) { return; }
    const std::vector<double> of_entries = std::exchange(out.values, {});
    out.values.resize(mesh_.points * attribute.components);
    for (std::size_t c = 0; c < mesh_.corners.size(); ++c) {
      const std::size_t entry = group.sequence.entry_of_vertex[group.table->vertex[c]];
      const std::size_t point = mesh_.corners[c];
      for (std::size_t k = 0; k < attribute.components; ++k) {
        out.values[point * attribute.components + k] = of_entries[entry * attribute.components + k];
      }
    }
  }

  StreamBytes in_;
  std::size_t most_;
  std::vector<CornerTable> tables_;  // none in sequential meshes
  std::vector<Group> groups_;
  Mesh mesh_;
};

}  // namespace

std::optional<Mesh> read_mesh(std::string_view bytes, std::string& fault) {
  try {
    return Reader(bytes).read();
  } catch (const StreamFault& found) {
    fault = "byte " + std::to_string(found.offset) + " of the Draco stream: " + found.sentence;
    return std::nullopt;
  }
}

}  // namespace apps::intake::draco
