// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <limits>

#include <bch/query.hpp>

namespace bch::detail {

/// Holds a choice for each option that some query has, for callers that ask many queries alike. Each query takes what it knows.
struct AllOptions {
  const Implementation* implementation = nullptr;
  Leaves leaves = Leaves::segments;
  double max_distance = std::numeric_limits<double>::infinity();
  Overlap overlap = Overlap::zero;
  Leaves distance_leaves = Leaves::discs;

  operator const Implementation*() const noexcept {  // NOLINT(google-explicit-constructor)
    return implementation;
  }
  operator CollideOptions() const noexcept {
    return {implementation, leaves};
  }                                             // NOLINT(google-explicit-constructor)
  operator ClearanceOptions() const noexcept {  // NOLINT(google-explicit-constructor)
    return {implementation, max_distance, overlap, distance_leaves};
  }
  operator BodyClearanceOptions() const noexcept {  // NOLINT(google-explicit-constructor)
    return {implementation, max_distance, overlap};
  }
};

}  // namespace bch::detail
