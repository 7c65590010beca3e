// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <bch/time_of_impact.hpp>

#include "kernel/motion/moving_body.hpp"

namespace bch::detail {

/// Says of what a query complains.
[[noreturn]] void reject(const char* query, const std::string& why);

/// Requires an interval and a tolerance to be as first_contact() says.
/// Errors:  throws std::invalid_argument.
void require_valid(const char* query, const TimeInterval& interval, double tolerance);

/// Holds motions as searches read them: slab by slab those whose bodies are cut, others once.
class MotionParts {
 public:
  /// Checks motions, which are named in errors by the index that the first one has and those behind it.
  /// Errors:  throws std::invalid_argument as first_contact() does.
  MotionParts(const char* query, std::span<const Motion> motions, std::size_t named_from = 0);

  std::size_t size() const noexcept { return motions_.size(); }
  std::span<const MotionFacts> operator[](std::size_t motion) const noexcept {
    return std::span(facts_).subspan(begin_[motion], begin_[motion + 1] - begin_[motion]);
  }
  std::span<const float> slices(std::size_t motion) const noexcept {
    return motions_[motion].shape->slices();
  }
  /// Returns the body of a motion in a slab of planes, which are its own, or those of another one if it is whole; none where a whole body
  /// does not reach into the slab.
  const MotionFacts* slab(std::size_t motion, std::span<const float> slices, std::size_t slab) const;
  /// Returns whether the bodies of two motions are cut at the same planes, or one is whole.
  bool are_cut_alike(std::size_t motion, const MotionParts& others, std::size_t other) const;

 private:
  std::span<const Motion> motions_;
  std::vector<MotionFacts> facts_;
  std::vector<std::size_t> begin_ = {0};
};

}  // namespace bch::detail
