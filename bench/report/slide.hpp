// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <bch/shapes.hpp>

#include "baselines/pair_distances.hpp"
#include "bench/characters/crowd.hpp"
#include "layout/base/random.hpp"

namespace bch::report {

/// Answers the pairs of agents.
using Answer =
    std::function<void(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits)>;

/// Represents the cases of the paper's experiment on errors. In each case, two people stand apart, turned at
/// random. The first one slides along the x axis past the second, on a line up to half a metre beside the
/// other, until a collision is detected; then the distance between the two meshes is measured. A case is
/// drawn again where the leaf discs over the outlines do not meet on the way, so that in every case the two
/// collide.
class SlideCases {
 public:
  /// Draws the cases, which are the same for the same shapes and seed everywhere.
  SlideCases(std::span<const Shape> shapes, std::uint32_t cases, std::uint64_t seed);

  std::size_t size() const { return from_.size(); }
  Agents agents() const { return crowd_.agents(); }

  /// Returns where on the x axis the first person is when a collision is detected, metres: one place a case,
  /// NaN where there is none. The answer is asked for at every millimetre, and that interval is then bisected to a
  /// micrometre. Runs on all threads.
  std::vector<double> contacts(const Answer& answer) const;

  /// Returns how far the bodies are from each other at such places, centimetres; 0 where they meet, NaN as
  /// above.
  std::vector<double> distances(const baselines::PairDistances& bodies, std::span<const double> places) const;

 private:
  void draw(detail::Random& random, std::size_t of);

  cli::Crowd crowd_;          ///< agents 2 i and 2 i + 1 are case i
  std::vector<double> from_;  ///< where even boxes about boxes do not meet yet
};

}  // namespace bch::report
