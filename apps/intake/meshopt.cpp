// SPDX-License-Identifier: MIT
#include "apps/intake/meshopt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "apps/bytes.hpp"
#include "apps/intake/stream_bytes.hpp"

namespace apps::intake {
namespace {

// The last `count` values, the newest first.
template <class T>
class Latest {
 public:
  void push(const T& value) { values_[begin_ = (begin_ + 15) % 16] = value; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return values_[(begin_ + i) % 16]; }

 private:
  std::array<T, 16> values_{};
  std::size_t begin_ = 0;
};

// 0, -1, 1, -2, ... modulo the numbers of the type.
template <class T>
T from_zigzag(T v) {
  return static_cast<T>((v & 1U) != 0 ? ~(v >> 1U) : v >> 1U);
}

// Mode ATTRIBUTES: each byte of an element as its difference from the same byte of the element before, in groups of sixteen.
class Attributes {
 public:
  Attributes(StreamBytes in, const MeshoptView& view) : in_(in), view_(view) {}

  std::string read() {
    const std::size_t stride = view_.stride, tail = std::max<std::size_t>(32, stride);
    if (stride == 0 || stride > 256 || stride % 4 != 0) { in_.refuse("elements of " + std::to_string(stride) + " bytes"); }
    if (in_.byte() != 0xa0) { in_.refuse("this version of compressed attributes is not read"); }
    if (in_.left() < tail || view_.count > 64 * in_.left() / stride) { in_.refuse("the view has more elements than its size allows"); }
    StreamBytes rest = in_.part(in_.left() - tail);
    std::string before(in_.take(tail).substr(tail - stride)), out(view_.count * stride, '\0');
    const std::size_t block = std::min<std::size_t>(8192 / stride / 16 * 16, 256);
    for (std::size_t begin = 0; begin < view_.count; begin += block) {
      const std::size_t elements = std::min(block, view_.count - begin), groups = (elements + 15) / 16;
      for (std::size_t k = 0; k < stride; ++k) {
        StreamBytes modes = rest.part((groups + 3) / 4);
        for (std::size_t g = 0; g < groups; ++g) {
          const std::array<std::uint8_t, 16> differences = group(rest, modes.bits(2));
          for (std::size_t i = 16 * g; i < std::min(elements, 16 * g + 16); ++i) {
            before[k] = static_cast<char>(static_cast<unsigned char>(before[k]) + from_zigzag(differences[i % 16]));
            out[(begin + i) * stride + k] = before[k];
          }
        }
      }
    }
    return out;
  }

 private:
  // Mode 0: all zero; 1 and 2: 2 and 4 bits each, the first in the highest bits, and all ones for a byte that follows; 3: bytes.
  static std::array<std::uint8_t, 16> group(StreamBytes& in, std::uint32_t mode) {
    std::array<std::uint8_t, 16> out{};
    if (mode == 0) { return out; }
    const std::size_t bits = std::size_t{1} << mode, in_byte = 8 / bits;
    const std::string_view packed = in.take(2 * bits);
    for (std::size_t i = 0; i < 16; ++i) {
      const auto byte = static_cast<unsigned char>(packed[i / in_byte]);
      const unsigned all = (1U << bits) - 1U, value = byte >> (8 - bits * (i % in_byte + 1)) & all;
      out[i] = static_cast<std::uint8_t>(mode < 3 && value == all ? in.byte() : value);
    }
    return out;
  }

  StreamBytes in_;
  const MeshoptView& view_;
};

// Mode TRIANGLES: a byte for each triangle says which of the latest edges it shares, and which vertex is new.
class Triangles {
 public:
  Triangles(StreamBytes in, std::size_t corners) : in_(in), corners_(corners) {}

  std::vector<std::uint32_t> read() {
    if (in_.byte() != 0xe1) { in_.refuse("this version of compressed triangles is not read"); }
    if (corners_ % 3 != 0 || in_.left() < 16 || corners_ / 3 > in_.left() - 16) {
      in_.refuse("the view has more triangles than its size allows");
    }
    const std::string_view codes = in_.take(corners_ / 3);
    StreamBytes data = in_.part(in_.left() - 16);
    const std::string_view table = in_.take(16);
    for (const char c : codes) {
      const auto code = static_cast<unsigned char>(c);
      const std::uint32_t high = code >> 4U, low = code & 15U;
      if (high < 15) {
        share_edge(data, high, low);
      } else if (low < 14) {
        const auto pair = static_cast<unsigned char>(table[low]);
        const std::uint32_t a = next_++, b = vertex(data, pair >> 4U), d = vertex(data, pair & 15U);
        emit(a, b, d, pair);
      } else {
        const std::uint32_t pair = data.byte();
        if (pair == 0) { next_ = 0; }
        const std::uint32_t a = low == 14 ? next_++ : far_vertex(data), b = vertex(data, pair >> 4U), d = vertex(data, pair & 15U);
        emit(a, b, d, pair);
      }
    }
    return std::move(out_);
  }

 private:
  void share_edge(StreamBytes& data, std::uint32_t edge, std::uint32_t which) {
    const auto [a, b] = edges_[edge];
    const bool known = which > 0 && which < 13;
    const std::uint32_t c = which == 0    ? next_++
                            : known       ? vertices_[which]
                            : which == 15 ? far_vertex(data)
                                          : (last_ += which == 13 ? ~std::uint32_t{0} : 1U);
    if (!known) { vertices_.push(c); }
    edges_.push({c, b});
    edges_.push({a, c});
    out_.insert(out_.end(), {a, b, c});
  }
  // 0: the next new vertex; 15: one that is written; otherwise one of the latest.
  std::uint32_t vertex(StreamBytes& data, std::uint32_t which) {
    return which == 0 ? next_++ : which == 15 ? far_vertex(data) : vertices_[which - 1];
  }
  std::uint32_t far_vertex(StreamBytes& data) { return last_ += from_zigzag(data.varint()); }
  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t pair) {
    const auto is_new = [](std::uint32_t which) { return which == 0 || which == 15; };
    vertices_.push(a);
    if (is_new(pair >> 4U)) { vertices_.push(b); }
    if (is_new(pair & 15U)) { vertices_.push(c); }
    edges_.push({b, a});
    edges_.push({c, b});
    edges_.push({a, c});
    out_.insert(out_.end(), {a, b, c});
  }

  StreamBytes in_;
  std::size_t corners_;
  std::uint32_t next_ = 0, last_ = 0;
  Latest<std::array<std::uint32_t, 2>> edges_;
  Latest<std::uint32_t> vertices_;
  std::vector<std::uint32_t> out_;
};

// Mode INDICES: differences from one of two indices before.
std::vector<std::uint32_t> read_indices(StreamBytes in, std::size_t count) {
  if (in.byte() != 0xd1) { in.refuse("this version of compressed indices is not read"); }
  if (in.left() < 4 || count > in.left() - 4) { in.refuse("the view has more indices than its size allows"); }
  StreamBytes data = in.part(in.left() - 4);
  std::array<std::uint32_t, 2> last{};
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = data.varint();
    out.push_back(last[v & 1U] += from_zigzag(v >> 1U));
  }
  return out;
}

// Filter EXPONENTIAL: floats, as 24 bits times a power of two whose exponent is in the highest byte.
void undo_exponential(std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    const auto bits = static_cast<std::uint32_t>(bits_at(bytes, at, 4));
    const auto mantissa = static_cast<std::int32_t>(bits << 8U) >> 8, exponent = static_cast<std::int32_t>(bits) >> 24;
    put(out, static_cast<float>(std::ldexp(mantissa, exponent)));
  }
  bytes = std::move(out);
}

// Filter QUATERNION: of four components the largest, which is positive, is left out; its number and the unit of the others come last.
void undo_quaternion(std::string& bytes) {
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    const auto number = [&](std::size_t k) { return static_cast<std::int16_t>(bits_at(bytes, at + 2 * k, 2)); };
    const double unit = static_cast<double>(number(3) | 3) * std::numbers::sqrt2;
    const std::size_t largest = static_cast<std::size_t>(number(3) & 3);
    std::array<double, 4> components{};
    double rest = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double component = std::clamp(number(k) / unit, -1.0, 1.0);  // the unit is odd, so it is not zero
      components[(largest + k + 1) % 4] = component;
      rest -= component * component;
    }
    components[largest] = std::sqrt(std::max(0.0, rest));
    std::string out;
    for (const double component : components) { put(out, static_cast<std::int16_t>(std::lround(32767.0 * component))); }
    bytes.replace(at, 8, out);
  }
}

}  // namespace

std::optional<std::string> unpack_meshopt(std::string_view bytes, const MeshoptView& view, std::string& fault) {
  try {
    StreamBytes in(bytes);
    if (view.mode == "ATTRIBUTES") {
      std::string out = Attributes(in, view).read();
      if (view.filter == "EXPONENTIAL") { undo_exponential(out); }
      if (view.filter == "QUATERNION" && view.stride == 8) { undo_quaternion(out); }
      return out;
    }
    if (view.stride != 2 && view.stride != 4) { in.refuse("indices of " + std::to_string(view.stride) + " bytes"); }
    if (view.mode != "TRIANGLES" && view.mode != "INDICES") { in.refuse("a view of this mode is not read"); }
    std::string out;
    for (const std::uint32_t index : view.mode == "TRIANGLES" ? Triangles(in, view.count).read() : read_indices(in, view.count)) {
      view.stride == 2 ? put(out, static_cast<std::uint16_t>(index)) : put(out, index);
    }
    return out;
  } catch (const StreamFault& found) {
    fault = "byte " + std::to_string(found.offset) + " of the compressed view: " + found.sentence;
    return std::nullopt;
  }
}

}  // namespace apps::intake
