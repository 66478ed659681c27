// SPDX-License-Identifier: MIT
#include "apps/intake/draco_rans.hpp"

#include <algorithm>

namespace apps::intake::draco {
namespace {

// Symbols with the probabilities of a table, in units of 2^-precision_bits. The constructor reads the table and the coded bytes.
class SymbolDecoder {
 public:
  SymbolDecoder(StreamBytes& in, unsigned precision_bits)
      : precision_bits_(precision_bits), first_(table(in, precision_bits)), rans_(in, in.take(in.varint()), 4U << precision_bits) {}

  [[nodiscard]] std::uint32_t next() {
    rans_.refill();
    const std::uint32_t quotient = rans_.state >> precision_bits_, rest = rans_.state & ((1U << precision_bits_) - 1U);
    const auto behind = std::upper_bound(first_.begin(), first_.end(), rest);  // exists: the last entry is 2^precision_bits
    rans_.state = quotient * (behind[0] - behind[-1]) + rest - behind[-1];
    return static_cast<std::uint32_t>(behind - first_.begin() - 1);
  }

 private:
  // The sum of the probabilities of all symbols before each one, and then of all.
  [[nodiscard]] static std::vector<std::uint32_t> table(StreamBytes& in, unsigned precision_bits) {
    const std::uint32_t symbols = in.varint();
    if (symbols / 64 > in.left()) { in.refuse("a table has more symbols than bytes can describe"); }  // a byte describes at most 64
    std::vector<std::uint32_t> first{0};
    first.reserve(symbols + 1);
    while (first.size() <= symbols) {
      const std::uint32_t head = in.byte(), kind = head & 3U;
      std::uint32_t probability = head >> 2U;
      if (kind == 3) {  // that many more symbols do not occur
        if (probability + 1 > symbols + 1 - first.size()) { in.refuse("a table describes more symbols than it has"); }
        first.insert(first.end(), probability + 1, first.back());
        continue;
      }
      for (unsigned k = 0; k < kind; ++k) { probability |= in.byte() << (8 * k + 6); }
      first.push_back(first.back() + probability);
      if (first.back() > 1U << precision_bits) { break; }
    }
    if (first.back() != 1U << precision_bits) { in.refuse("the probabilities of a table do not add up to one"); }
    return first;
  }

  unsigned precision_bits_;
  std::vector<std::uint32_t> first_;
  Rans rans_;
};

}  // namespace

Rans::Rans(const StreamBytes& in, std::string_view data, std::uint32_t lowest_state) : bytes(data), lowest(lowest_state) {
  if (data.empty()) { in.refuse("coded numbers have no bytes"); }
  const std::size_t size = 1 + (static_cast<unsigned char>(data.back()) >> 6U);  // the two highest bits: bytes of the first state, less 1
  if (size > data.size()) { in.refuse("coded numbers have too few bytes"); }
  const auto bits = static_cast<std::uint32_t>(bits_at(data, data.size() - size, size));
  state = lowest + (bits & ((1U << (8 * size - 2)) - 1U));
  bytes.remove_suffix(size);
}

bool BitDecoder::next() {
  rans_.refill();
  const std::uint32_t quotient = rans_.state >> 8U, rest = rans_.state & 255U;
  const bool one = rest < one_;
  rans_.state = one ? quotient * one_ + rest : rans_.state - quotient * one_ - one_;
  return one;
}

std::vector<std::uint32_t> read_symbols(StreamBytes& in, std::size_t count, std::size_t components) {
  std::vector<std::uint32_t> numbers;
  if (count == 0) { return numbers; }
  const std::uint32_t scheme = in.byte();
  if (scheme > 1) { in.refuse("unknown coding of symbols " + std::to_string(scheme)); }
  numbers.reserve(count);
  if (scheme == 0) {  // tagged: the symbol is the number of bits in which each component of an element is written behind
    SymbolDecoder lengths(in, 12);
    while (numbers.size() < count) {
      const std::uint32_t length = lengths.next();
      if (length > 32) { in.refuse("a number has more than 32 bits"); }
      for (std::size_t k = 0; k < components; ++k) { numbers.push_back(in.bits(length)); }
    }
    in.end_bits();
    return numbers;
  }
  const std::uint32_t bits = in.byte();  // of the largest number
  if (bits > 18) { in.refuse("symbols of " + std::to_string(bits) + " bits"); }
  SymbolDecoder symbols(in, std::clamp(3 * bits / 2, 12U, 20U));
  for (std::size_t i = 0; i < count; ++i) { numbers.push_back(symbols.next()); }
  return numbers;
}

}  // namespace apps::intake::draco
