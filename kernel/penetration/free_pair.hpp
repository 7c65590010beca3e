// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/penetration/free_search.hpp"

namespace bch::detail {

/// Finds how far an agent, A, has to move along directions until nothing of it overlaps another one, or a wall: by the search for what both
/// are made of, for one pair after the other.
class FreePair {
 public:
  enum class Kind : std::uint8_t { spheres, segments, walls };

  FreeBody a, b;      ///< to begin with
  FreeBound sampled;  ///< to bound with

  /// Takes both bodies. The margin says how near elements may come, `reaches` how far the elements of both are off, metres.
  void begin(Kind kind, double margin, double reaches);
  /// Bounds by some of the spheres that overlap.
  void sample() { spheres_.sample(sampled); }

  float bound(float x, float y) const noexcept { return sampled.place(x, y); }
  // As in FreeSearch.
  void turn(float x, float y);
  float next(float place);
  float after_gap(float place) const;
  FreeTouch touch(float place) const;

 private:
  /// Returns what use() returns of the search for this pair's kind.
  template <class Self, class Use>
  static auto with_search(Self& self, const Use& use) {
    if (self.kind_ == Kind::segments) return use(self.segments_);
    if (self.kind_ == Kind::walls) return use(self.walls_);
    return use(self.spheres_);
  }

  Kind kind_ = Kind::spheres;
  FreeSearch<FreeSpheres> spheres_;
  FreeSearch<FreeSegments> segments_;
  FreeSearch<FreeWalls> walls_;
};

}  // namespace bch::detail
