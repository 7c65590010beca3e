// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baselines/pair_distances.hpp"
#include "baselines/structure.hpp"
#include "bench/base/random.hpp"
#include "bench/characters/crowd.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch::report {

/// The paper's experiment on errors: of each case, two people stand apart, turned at random, and the first one slides along
/// the x axis past the second, its own way up to half a metre beside the other, until something says that they collide;
/// then the two meshes are so far from each other. Cases are drawn again where the leaf discs over the outlines do not
/// meet on the way, so that nobody passes by.
class SlideCases {
 public:
  /// The same for the same shapes and seed everywhere.
  SlideCases(std::span<const Shape> shapes, std::uint32_t cases, std::uint64_t seed);

  std::size_t size() const { return pairs_.size(); }
  Agents agents() const { return crowd_.agents(); }
  std::span<const Pair> pairs() const { return pairs_; }

  /// Where on the x axis the first one is when it is seen to collide, metres: one a case, NaN where it never is. Both
  /// run on all threads. The answer is asked for every millimetre, and the place within that then halved to a micrometre;
  /// contact_time() says from where on.
  std::vector<double> contacts(const ShapeSet& set, Leaves leaves = Leaves::discs) const;
  std::vector<double> contacts(const baselines::Structure& structure, std::uint32_t max_depth) const;

  /// How far the bodies are from each other at such places, centimetres; 0 where they meet, NaN as above.
  std::vector<double> distances(const baselines::PairDistances& bodies, std::span<const double> places) const;

 private:
  void draw(cli::Random& random, std::size_t of);
  /// `meet`: whether the two of some agents do; not before so many steps.
  template <class Meet>
  double contact(std::size_t of, double first_step, Meet meet) const;

  cli::Crowd crowd_;  ///< agents 2 i and 2 i + 1 are case i
  std::vector<Pair> pairs_;
  std::vector<double> from_;  ///< where even boxes about boxes do not meet yet
};

/// Those that are numbers.
std::vector<double> known(std::span<const double> values);

}  // namespace bch::report
