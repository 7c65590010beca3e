// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/runtime/all_options.hpp"
#include "tests/support/implementations.hpp"
#include "tests/support/scenes.hpp"

// All queries over pairs at once: what they are asked, what they answer, and what brute force does.

namespace bch::test {

/// Pairs, and what every query is to know of them.
struct Questions : PairScene {
  double limit = std::numeric_limits<double>::infinity();  ///< of clearances
  std::uint32_t lines = 16;                                ///< of penetration()
  std::vector<Vec2> directions;                            ///< of penetration_along()
  std::vector<double> distances;                           ///< of within()
  std::vector<double> way_x, way_y;                        ///< of time_of_impact()

  Questions part(std::size_t begin, std::size_t count) const;
  /// Returns the same with both agents of every pair exchanged.
  Questions exchanged() const;
};

/// Draws what to ask about pairs: a limit, directions of any length, distances of which most are as the pairs' clearances but
/// for some bits, and ways of which a third lead about towards the other agent.
Questions questions_about(Random& random, const ShapeSet& set, PairScene scene);

/// What clearance() says of a pair.
struct NearestFeatures {
  float distance;
  Vec2 direction;
  DiscPair discs;
  NearestPoints points;
  /// Compares bits: -0 is not 0.
  friend bool operator==(const NearestFeatures& a, const NearestFeatures& b);
};

/// Asks clearance() for all of it.
std::vector<NearestFeatures> nearest_features(const ShapeSet& set, const PairScene& of,
                                              const detail::AllOptions& options);

/// What all queries say of a pair.
struct PairAnswers {
  std::uint8_t hit, hit_of_discs, within;
  NearestFeatures deepest, nearest, exact;
  float time;
  Penetration best, along;
  std::vector<DiscPair> contacts, contacts_of_discs;

  PairAnswers exchanged() const;
};

/// Expects the same answers to all pairs, or says which one differs.
void expect_same(const std::vector<PairAnswers>& found, const std::vector<PairAnswers>& expected,
                 const std::string& what);

/// Asks all queries. Expects that nothing beside the answers is written.
std::vector<PairAnswers> run_query(const ShapeSet& set, const Questions& questions,
                                   const Implementation& implementation = best_implementation());

/// Expects these answers of every implementation.
void expect_answers(const ShapeSet& set, const Questions& questions, const std::vector<PairAnswers>& expected,
                    const std::string& what);

}  // namespace bch::test
