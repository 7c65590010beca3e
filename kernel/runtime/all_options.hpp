// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <limits>

#include <bch/query.hpp>

namespace bch::detail {

/// Holds every option that some query has, for callers that run many queries with the same options. It converts to the options of
/// each query.
struct AllOptions {
  const Implementation* implementation = nullptr;
  Leaves leaves = Leaves::segments;
  double max_distance = std::numeric_limits<double>::infinity();
  Overlap overlap = Overlap::zero;
  Leaves distance_leaves = Leaves::discs;

  AllOptions within(double distance) const noexcept {
    AllOptions all = *this;
    all.max_distance = distance;
    return all;
  }
  // NOLINTBEGIN(google-explicit-constructor)
  operator const Implementation*() const noexcept { return implementation; }
  operator CollideOptions() const noexcept { return {implementation, leaves}; }
  operator ClearanceOptions() const noexcept {
    return {implementation, max_distance, overlap, distance_leaves};
  }
  operator BodyClearanceOptions() const noexcept { return {implementation, max_distance, overlap}; }
  // NOLINTEND(google-explicit-constructor)
};

}  // namespace bch::detail
