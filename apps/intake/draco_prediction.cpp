// SPDX-License-Identifier: MIT
#include "apps/intake/draco_prediction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/intake/draco_rans.hpp"

namespace apps::intake::draco {
namespace {

constexpr std::size_t most_parallelograms = 4;

class Predictor {
 public:
  Predictor(const Surroundings& around, std::size_t components, std::vector<std::int32_t>& values)
      : around_(around), components_(components), values_(values) {}

  // Continues the triangle across the edge opposite to this corner to a parallelogram; false if its values do not stand before `entry`.
  [[nodiscard]] bool add_parallelogram(std::size_t entry, std::uint32_t corner, std::vector<std::int64_t>& sum) const {
    const std::uint32_t c = around_.table.across(corner);
    if (c == no_corner) { return false; }
    const std::size_t far = entry_at(c), a = entry_at(next(c)), b = entry_at(previous(c));
    if (far >= entry || a >= entry || b >= entry) { return false; }
    for (std::size_t k = 0; k < components_; ++k) { sum[k] += std::int64_t{value(a, k)} + value(b, k) - value(far, k); }
    return true;
  }
  // The mean of the parallelograms around the vertex, at most four, without those whose edge is a crease. Each number of parallelograms
  // has its own list of bits that say which edges are; `used` counts those that were looked at.
  [[nodiscard]] bool add_parallelograms(std::size_t entry, const StreamBytes& in,
                                        const std::array<std::vector<bool>, most_parallelograms>& creases,
                                        std::array<std::size_t, most_parallelograms>& used, std::vector<std::int64_t>& sum) {
    const CornerTable& table = around_.table;
    const std::uint32_t start = around_.sequence.corner_of_entry[entry];
    std::size_t count = 0;
    bool left = true;
    for (std::uint32_t c = start; c != no_corner && count < most_parallelograms;) {
      found_[count].assign(components_, 0);
      if (add_parallelogram(entry, c, found_[count])) { ++count; }
      c = left ? table.swing_left(c) : table.swing_right(c);
      if (c == start) { break; }
      if (c == no_corner && left) {
        left = false;
        c = table.swing_right(start);
      }
    }
    std::int64_t smooth = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = used[count - 1]++;
      if (at >= creases[count - 1].size()) { in.refuse("there are too few bits for the creases"); }
      if (creases[count - 1][at]) { continue; }
      ++smooth;
      for (std::size_t k = 0; k < components_; ++k) { sum[k] += found_[i][k]; }
    }
    for (std::int64_t& s : sum) { s = smooth > 0 ? s / smooth : 0; }
    return smooth > 0;
  }

  // Texture coordinates: the triangle in the plane of the picture is similar to the one in space (specification, TexCoords Prediction
  // Decoder). `turned`, from the back: on which side of the known edge its third vertex lies. All products are modulo 2^64.
  [[nodiscard]] bool add_similar(std::size_t entry, const StreamBytes& in, std::vector<bool>& turned,
                                 std::vector<std::int64_t>& sum) const {
    using Word = std::uint64_t;
    const std::uint32_t corner = around_.sequence.corner_of_entry[entry];
    const std::size_t a = entry_at(next(corner)), b = entry_at(previous(corner));
    if (a >= entry) { return false; }
    const std::array uv_a{std::int64_t{value(a, 0)}, std::int64_t{value(a, 1)}};
    std::array<std::int64_t, 2> edge_uv{};
    std::array<std::int64_t, 3> edge{}, tip{};
    Word length2 = 0, along = 0;
    for (std::size_t k = 0; k < 2 && b < entry; ++k) { edge_uv[k] = value(b, k) - uv_a[k]; }
    for (std::size_t k = 0; k < 3 && b < entry; ++k) {
      edge[k] = position(b, k) - position(a, k);
      tip[k] = position(entry, k) - position(a, k);
      length2 += Word(edge[k]) * Word(edge[k]);
      along += Word(tip[k]) * Word(edge[k]);
    }
    if (length2 == 0 || (edge_uv[0] == 0 && edge_uv[1] == 0)) {
      std::copy(uv_a.begin(), uv_a.end(), sum.begin());
      return true;
    }
    const auto over_length2 = [&](Word w) { return static_cast<std::int64_t>(w) / static_cast<std::int64_t>(length2); };
    Word height2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Word h = Word(tip[k]) - Word(over_length2(Word(edge[k]) * along));
      height2 += h * h;
    }
    if (turned.empty()) { in.refuse("there are too few bits for the texture coordinates"); }
    const Word across = root(height2 * length2) * (turned.back() ? Word{1} : ~Word{0});
    turned.pop_back();
    sum[0] = over_length2(Word(uv_a[0]) * length2 + Word(edge_uv[0]) * along + Word(edge_uv[1]) * across);
    sum[1] = over_length2(Word(uv_a[1]) * length2 + Word(edge_uv[1]) * along - Word(edge_uv[0]) * across);
    return true;
  }

 private:
  [[nodiscard]] std::size_t entry_at(std::uint32_t c) const { return around_.sequence.entry_of_vertex[around_.table.vertex[c]]; }
  [[nodiscard]] std::int32_t value(std::size_t entry, std::size_t k) const { return values_[entry * components_ + k]; }
  [[nodiscard]] std::int64_t position(std::size_t entry, std::size_t k) const { return around_.positions[3 * entry + k]; }

  // The largest integer whose square is not larger.
  static std::uint64_t root(std::uint64_t square) {
    constexpr std::uint64_t largest = 0xffffffffU;
    auto r = std::min(largest, static_cast<std::uint64_t>(std::sqrt(static_cast<double>(square))));
    while (r * r > square) { --r; }
    while (r < largest && (r + 1) * (r + 1) <= square) { ++r; }
    return r;
  }

  const Surroundings& around_;
  std::size_t components_;
  std::vector<std::int32_t>& values_;
  std::array<std::vector<std::int64_t>, most_parallelograms> found_;
};

std::vector<bool> read_bits(StreamBytes& in, std::size_t count) {
  std::vector<bool> bits(count);
  BitDecoder decoder(in);
  for (std::size_t i = 0; i < count; ++i) { bits[i] = decoder.next(); }
  return bits;
}

// The range of all values: a prediction is clamped to it, and a sum beyond it is meant modulo its size (specification, wrap transform).
struct Wrap {
  explicit Wrap(StreamBytes& in) : least(in.int32()), most(in.int32()) {
    if (least > most) { in.refuse("the range of an attribute is empty"); }
  }
  [[nodiscard]] std::int32_t sum(std::int64_t predicted, std::int32_t difference) const {
    std::int64_t value = std::clamp(predicted, least, most) + difference;
    if (value > most) { value -= 1 + most - least; }
    if (value < least) { value += 1 + most - least; }
    return static_cast<std::int32_t>(value);
  }
  std::int64_t least, most;
};

}  // namespace

void undo_prediction(StreamBytes& in, Prediction prediction, const Surroundings* around, std::size_t components,
                     std::vector<std::int32_t>& values) {
  const std::size_t entries = values.size() / components;
  std::array<std::vector<bool>, most_parallelograms> creases;
  std::array<std::size_t, most_parallelograms> used{};
  std::vector<bool> turned;
  if (prediction == Prediction::constrained_multi_parallelogram) {
    for (std::vector<bool>& bits : creases) {
      const std::uint32_t count = in.varint();
      if (count > most_parallelograms * entries) { in.refuse("there are more creases than edges"); }
      if (count > 0) { bits = read_bits(in, count); }
    }
  } else if (prediction == Prediction::texture_coordinates) {
    const std::uint32_t count = in.number(4);
    if (components != 2 || !around || around->positions.empty()) { in.refuse("texture coordinates are predicted without positions"); }
    if (count > entries) { in.refuse("there are more texture coordinates than vertices"); }
    turned = read_bits(in, count);  // each bit: the same side as the one before?
    bool side = true;
    for (std::size_t i = 0; i < count; ++i) { turned[i] = side = turned[i] ? side : !side; }
  }
  const Wrap wrap(in);
  if (prediction != Prediction::difference && !around) { in.refuse("a prediction asks for neighbours, which the stream does not have"); }
  std::optional<Predictor> predictor;
  if (around) { predictor.emplace(*around, components, values); }
  std::vector<std::int64_t> sum(components);
  for (std::size_t entry = 0; entry < entries; ++entry) {
    std::fill(sum.begin(), sum.end(), 0);
    bool predicted = entry == 0 && prediction != Prediction::texture_coordinates;  // the first value is predicted as zero
    if (!predicted && prediction != Prediction::difference) {
      const std::uint32_t corner = around->sequence.corner_of_entry[entry];
      predicted = prediction == Prediction::parallelogram         ? predictor->add_parallelogram(entry, corner, sum)
                  : prediction == Prediction::texture_coordinates ? predictor->add_similar(entry, in, turned, sum)
                                                                  : predictor->add_parallelograms(entry, in, creases, used, sum);
    }
    const std::size_t at = entry * components;
    for (std::size_t k = 0; k < components; ++k) {
      if (!predicted && entry > 0) { sum[k] = values[at - components + k]; }  // the value before
      values[at + k] = wrap.sum(sum[k], values[at + k]);
    }
  }
}

void skip_normal_prediction(StreamBytes& in, Prediction prediction) {
  static_cast<void>(in.take(8));  // the largest quantized value and the centre
  if (prediction != Prediction::geometric_normal) { return; }
  static_cast<void>(in.byte());
  static_cast<void>(in.take(in.varint()));
}

}  // namespace apps::intake::draco
