// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/disc_coverage.hpp"

#include <algorithm>
#include <cassert>

namespace bch::detail {
void DiscCoverage::offer(const InteriorLoops& loops, const CandidateDiscs& discs, float dilation) {
  loops_ = &loops;
  covered_.fill(0);
  promise_.fill(gone);
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    const int drawn = loops.draw(discs.x[k], discs.y[k], discs.radius[k] + dilation, mask_[k].data());
    promise_[k] = promise(k, drawn);
  }
}

std::int32_t DiscCoverage::promise(std::uint32_t disc, int gain) {
  return gain * static_cast<std::int32_t>(max_touches) + static_cast<std::int32_t>(max_touches - 1 - disc);
}

std::uint32_t DiscCoverage::choose() {
  const auto named = [](std::int32_t value) {
    return max_touches - 1 - static_cast<std::uint32_t>(value) % max_touches;
  };
  const auto renew = [&](std::uint32_t disc) {
    return promise_[disc] = promise(disc, loops_->count_new(mask_[disc].data(), covered_.data()));
  };
  std::int32_t best = gone;
  for (const std::int32_t value : promise_) best = best < value ? value : best;
  assert(best != gone);
  best = renew(named(best));
  // No other disc is worth a count unless it promises more than that.
  for (std::uint32_t k = 0; k < max_touches; ++k)
    if (promise_[k] > best) best = std::max(best, renew(k));
  const std::uint32_t disc = named(best);
  for (std::uint32_t j = 0; j < cells; ++j) covered_[j] |= mask_[disc][j];
  promise_[disc] = gone;
  return disc;
}

}  // namespace bch::detail
