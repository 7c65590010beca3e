// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/checksum.hpp"

#include <algorithm>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace bch::detail::baked {
namespace {

/// Bytes: several of them fit into a second cache.
constexpr std::size_t piece = std::size_t{128} << 10;

}  // namespace

std::uint64_t checksum(Preamble preamble) {
  preamble.header.checksum = 0;
  return XXH3_64bits(&preamble, sizeof preamble);
}

std::uint64_t checksum(std::span<const std::byte> section_with_zeros) {
  return XXH3_64bits(section_with_zeros.data(), section_with_zeros.size());
}

struct SectionChecksum::State {
  XXH3_state_t xxh3;
};

SectionChecksum::SectionChecksum(std::span<const std::byte> section)
    : section_(section), state_(std::make_unique<State>()) {
  XXH3_64bits_reset(&state_->xxh3);
}

SectionChecksum::~SectionChecksum() = default;

void SectionChecksum::take(std::size_t bytes) {
  XXH3_64bits_update(&state_->xxh3, section_.data() + taken_, bytes);
  taken_ += bytes;
}

void SectionChecksum::max_extent(std::size_t place) {
  while (taken_ < section_.size() && taken_ <= place) take(std::min(piece, section_.size() - taken_));
}

std::uint64_t SectionChecksum::finish(std::size_t zeros) {
  constexpr std::byte zero[alignment] = {};
  take(section_.size() - taken_);
  XXH3_64bits_update(&state_->xxh3, zero, zeros);
  return XXH3_64bits_digest(&state_->xxh3);
}

}  // namespace bch::detail::baked
