// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <string>
#include <vector>

#include <bch/motion.hpp>

#include "kernel/motion/contact_search.hpp"
#include "kernel/motion/valid_motions.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t grain = 16;

void require_valid(const char* query, std::span<const Pair> pairs, std::size_t motions) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [first, second] = pairs[i];
    if (const std::uint32_t last = std::max(first, second); last >= motions)
      reject(query, "pair " + std::to_string(i) + ": expected one of " + std::to_string(motions) +
                        " motions, found " + std::to_string(last));
  }
}

}  // namespace

void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance) {
  constexpr const char* query = "first_contact";
  const FloatingPointStateGuard floats;
  check_size({query, "pair", pairs.size()}, times.size(), "times");
  require_valid(query, interval, tolerance);
  const std::vector<MotionFacts> facts = valid_motions(query, motions);
  require_valid(query, pairs, facts.size());
  std::vector<double> found(pairs.size());
  for_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
    ContactSearch search(tolerance);
    for (std::size_t i = begin; i < end; ++i) {
      const auto [low, high] = std::minmax(pairs[i].first, pairs[i].second);
      found[i] = within_limit(
          query, [i] { return "pair " + std::to_string(i); },
          [&, low = low, high = high] {
            return search.first(facts[low], facts[high], interval.from, interval.to);
          });
    }
  });
  std::copy(found.begin(), found.end(), times.begin());
}

double free_until(const Motion& motion, std::span<const Motion> others, const TimeInterval& interval,
                  double tolerance) {
  constexpr const char* query = "free_until";
  const FloatingPointStateGuard floats;
  require_valid(query, interval, tolerance);
  const std::vector<MotionFacts> own = valid_motions(query, {&motion, 1}, others.size()),
                                 facts = valid_motions(query, others);
  ContactSearch search(tolerance);
  double first = never;
  for (std::size_t i = 0; i < others.size(); ++i)
    first = std::min(
        first,
        within_limit(
            query, [i] { return "motion " + std::to_string(i); },
            [&] { return search.first(own[0], facts[i], interval.from, std::min(first, interval.to)); }));
  return first;
}

}  // namespace bch
