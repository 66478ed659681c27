// SPDX-License-Identifier: MIT
#pragma once

// The entropy coding of Draco: range asymmetric numeral systems (rANS, Duda 2013), of bits and of symbols. A rANS decoder is one integer,
// its state: the remainder modulo the precision tells the symbol, and the bytes that refill the state are read from back to front.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/intake/stream_bytes.hpp"

namespace apps::intake::draco {

struct Rans {
  Rans(const StreamBytes& in, std::string_view data, std::uint32_t lowest_state);
  void refill() {
    while (state < lowest && !bytes.empty()) {
      state = state << 8U | static_cast<unsigned char>(bytes.back());
      bytes.remove_suffix(1);
    }
  }

  std::string_view bytes;
  std::uint32_t lowest, state = 0;
};

// Bits that are all zero with the same probability (specification, RabsDescRead). The constructor reads probability, size and bytes.
class BitDecoder {
 public:
  explicit BitDecoder(StreamBytes& in) : BitDecoder(in, in.byte()) {}
  [[nodiscard]] bool next();

 private:
  BitDecoder(StreamBytes& in, std::uint32_t zero) : one_(256 - zero), rans_(in, in.take(in.varint()), 4096) {}
  std::uint32_t one_;  // probability of a one, in 1/256
  Rans rans_;
};

// `count` numbers, `components` of which belong together (specification, DecodeSymbols).
[[nodiscard]] std::vector<std::uint32_t> read_symbols(StreamBytes& in, std::size_t count, std::size_t components);

}  // namespace apps::intake::draco
