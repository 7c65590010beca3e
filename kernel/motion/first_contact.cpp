// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/time_of_impact.hpp>

#include "kernel/motion/contact_search.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t grain = 16;
constexpr double largest_time = 1e6, largest_turn = 1e3, least_tolerance = 1e-6;

[[noreturn]] void reject(const char* query, const std::string& why) {
  throw std::invalid_argument(std::string(query) + ": " + why);
}

bool is_time(double seconds) {
  return std::abs(seconds) <= largest_time;
}

void require_valid(const char* query, const TimeInterval& interval, double tolerance) {
  if (!is_time(interval.from) || !is_time(interval.to) || interval.from > interval.to)
    reject(query, "from " + shortest(interval.from) + " s to " + shortest(interval.to) +
                      " s is no interval within +-1e6 s");
  if (!(tolerance >= least_tolerance && std::isfinite(tolerance)))
    reject(query, "a tolerance of " + shortest(tolerance) + " m, not 1e-6 or more");
}

void require_valid(const char* query, const Motion& motion, std::size_t index) {
  const auto reject = [&](const std::string& why) {
    bch::reject(query, "motion " + std::to_string(index) + ": " + why);
  };
  if (motion.shape == nullptr) reject("no shape");
  if (!is_time(motion.clip_begin))
    reject("its clip begins at " + shortest(motion.clip_begin) + " s, not within +-1e6");
  if (motion.path.empty()) reject("a path without keys");
  for (std::size_t k = 0; k < motion.path.size(); ++k) {
    const auto& [time, x, y, heading] = motion.path[k];
    const auto reject_key = [&](const std::string& why) {
      reject("key " + std::to_string(k) + " of its path" + why);
    };
    if (!is_time(time)) reject_key(" at " + shortest(time) + " s, not within +-1e6");
    if (!(std::abs(x) <= rounding::largest_position && std::abs(y) <= rounding::largest_position))
      reject_key(" at (" + shortest(x) + ", " + shortest(y) + ") m, not within +-1e9");
    if (!(std::abs(heading) <= rounding::largest_heading))
      reject_key(" with a heading of " + shortest(heading) + " rad, not within +-1e9");
    if (k == 0) continue;
    if (!(motion.path[k - 1].time < time))
      reject_key(" at " + shortest(time) + " s after one at " + shortest(motion.path[k - 1].time) + " s");
    if (!(std::abs(heading - motion.path[k - 1].heading) <= largest_turn))
      reject_key(" turns by more than 1000 rad, to " + shortest(heading));
  }
}

/// Checks motions, and learns of them what a search wants to know.
std::vector<MotionFacts> facts_of(const char* query, std::span<const Motion> motions) {
  std::vector<MotionFacts> facts;
  facts.reserve(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    require_valid(query, motions[i], i);
    facts.emplace_back(motions[i]);
  }
  return facts;
}

}  // namespace

void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance) {
  constexpr const char* query = "first_contact";
  const FloatingPointStateGuard floats;
  require_as_many({query, "pair", pairs.size()}, times.size(), "times");
  require_valid(query, interval, tolerance);
  const std::vector<MotionFacts> facts = facts_of(query, motions);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (const std::uint32_t last = std::max(pairs[i].first, pairs[i].second); last >= motions.size())
      reject(query, "pair " + std::to_string(i) + ": motion " + std::to_string(last) + " of " +
                        std::to_string(motions.size()));
  for_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
    ContactSearch search(tolerance);
    for (std::size_t i = begin; i < end; ++i) {
      const auto [low, high] = std::minmax(pairs[i].first, pairs[i].second);
      times[i] = search.first(facts[low], facts[high], interval.from, interval.to);
    }
  });
}

double free_until(const Motion& motion, std::span<const Motion> others, const TimeInterval& interval,
                  double tolerance) {
  constexpr const char* query = "free_until";
  const FloatingPointStateGuard floats;
  require_valid(query, interval, tolerance);
  require_valid(query, motion, others.size());
  const MotionFacts own(motion);
  const std::vector<MotionFacts> facts = facts_of(query, others);
  ContactSearch search(tolerance);
  double first = never;
  for (const MotionFacts& other : facts)
    first = std::min(first, search.first(own, other, interval.from, std::min(first, interval.to)));
  return first;
}

}  // namespace bch
