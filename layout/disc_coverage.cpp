// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/disc_coverage.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace bch {
namespace {

/// Bits 0 .. end - 1.
std::uint32_t below(int end) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << end) - 1);
}

/// The first cell whose centre is not before a coordinate; they are at 0.5, 1.5 ...
int first_cell(float from) {
  constexpr float past = DiscCoverage::cells;
  return static_cast<int>(std::clamp(from + 0.5f, 0.0f, past));
}

/// Returns the number of cells.
int draw(float x, float y, float radius, std::array<std::uint32_t, DiscCoverage::cells>& rows) {
  rows.fill(0);
  int drawn = 0;
  const int end_row = first_cell(y + radius);
  for (int j = first_cell(y - radius); j < end_row; ++j) {
    const float dy = static_cast<float>(j) + 0.5f - y;
    const float half = std::sqrt(std::max(radius * radius - dy * dy, 0.0f));
    const int begin = first_cell(x - half), end = first_cell(x + half);
    rows[static_cast<std::uint32_t>(j)] = below(end) - below(begin);
    drawn += end - begin;
  }
  return drawn;
}

/// How many bits of a are not in b. Written for vectors: baseline x86-64 has no instruction that counts.
std::int32_t count_new(const std::array<std::uint32_t, DiscCoverage::cells>& a,
                       const std::array<std::uint32_t, DiscCoverage::cells>& b) {
  std::uint32_t sum = 0;
  for (std::uint32_t j = 0; j < DiscCoverage::cells; ++j) {
    std::uint32_t v = a[j] & ~b[j];
    v = v - (v >> 1 & 0x55555555);
    v = (v & 0x33333333) + (v >> 2 & 0x33333333);
    v = (v + (v >> 4)) & 0x0f0f0f0f;
    sum += (v & 0x00ff00ff) + (v >> 8 & 0x00ff00ff);
  }
  return static_cast<std::int32_t>((sum & 0xffff) + (sum >> 16));
}

}  // namespace

void DiscCoverage::offer(const CandidateDiscs& discs, float dilation) {
  covered_.fill(0);
  promise_.fill(gone);
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    const int drawn = draw(discs.x[k], discs.y[k], discs.radius[k] + dilation, mask_[k]);
    promise_[k] = promise(k, drawn);
  }
}

std::int32_t DiscCoverage::promise(std::uint32_t disc, int gain) {
  return gain * static_cast<std::int32_t>(most_touches) + static_cast<std::int32_t>(most_touches - 1 - disc);
}

std::uint32_t DiscCoverage::choose() {
  const auto named = [](std::int32_t value) {
    return most_touches - 1 - static_cast<std::uint32_t>(value) % most_touches;
  };
  const auto renew = [&](std::uint32_t disc) {
    return promise_[disc] = promise(disc, count_new(mask_[disc], covered_));
  };
  std::int32_t best = gone;
  for (const std::int32_t value : promise_) best = best < value ? value : best;
  assert(best != gone);
  best = renew(named(best));
  // No other disc is worth a count unless it promises more than that.
  for (std::uint32_t k = 0; k < most_touches; ++k)
    if (promise_[k] > best) best = std::max(best, renew(k));
  const std::uint32_t disc = named(best);
  for (std::uint32_t j = 0; j < cells; ++j) covered_[j] |= mask_[disc][j];
  promise_[disc] = gone;
  return disc;
}

}  // namespace bch
