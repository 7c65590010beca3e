// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked_format.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace bch::baked {

std::uint64_t checksum(Preamble preamble) {
  preamble.header.checksum = 0;
  return XXH3_64bits(&preamble, sizeof preamble);
}

std::uint64_t checksum(std::span<const std::byte> section_with_zeros) {
  return XXH3_64bits(section_with_zeros.data(), section_with_zeros.size());
}

std::uint64_t checksum(std::span<const std::byte> section, std::size_t zeros) {
  constexpr std::byte zero[alignment] = {};
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  XXH3_64bits_update(&state, section.data(), section.size());
  XXH3_64bits_update(&state, zero, zeros);
  return XXH3_64bits_digest(&state);
}

}  // namespace bch::baked
