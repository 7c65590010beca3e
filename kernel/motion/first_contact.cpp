// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <string>
#include <vector>

#include <bch/time_of_impact.hpp>

#include "kernel/motion/contact_search.hpp"
#include "kernel/motion/motion_parts.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t grain = 16;

void require_valid(const char* query, std::span<const Pair> pairs, const MotionParts& motions) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [first, second] = pairs[i];
    const std::string pair = "pair " + std::to_string(i) + ": ";
    if (const std::uint32_t last = std::max(first, second); last >= motions.size())
      reject(query, pair + "motion " + std::to_string(last) + " of " + std::to_string(motions.size()));
    if (!motions.are_cut_alike(first, motions, second))
      reject(query, pair + "motions " + std::to_string(first) + " and " + std::to_string(second) +
                        " have bodies that are cut at different planes");
  }
}

/// Returns the first contact of the slabs of two motions' bodies.
double first_of_slabs(ContactSearch& search, const MotionParts& a, std::size_t i, const MotionParts& b,
                      std::size_t j, double from, double to) {
  const std::span<const float> slices = a.slices(i).empty() ? b.slices(j) : a.slices(i);
  double first = never;
  for (std::size_t slab = 0; slab <= slices.size(); ++slab) {
    const MotionFacts *const of_a = a.slab(i, slices, slab), *const of_b = b.slab(j, slices, slab);
    if (of_a != nullptr && of_b != nullptr)
      first = std::min(first, search.first(*of_a, *of_b, from, std::min(first, to)));
  }
  return first;
}

}  // namespace

void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance) {
  constexpr const char* query = "first_contact";
  const FloatingPointStateGuard floats;
  require_as_many({query, "pair", pairs.size()}, times.size(), "times");
  require_valid(query, interval, tolerance);
  const MotionParts parts(query, motions);
  require_valid(query, pairs, parts);
  std::vector<double> found(pairs.size());
  for_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t end) {
    ContactSearch search(tolerance);
    for (std::size_t i = begin; i < end; ++i) {
      const auto [low, high] = std::minmax(pairs[i].first, pairs[i].second);
      found[i] = within_limit(
          query, [i] { return "pair " + std::to_string(i); },
          [&, low = low, high = high] {
            return first_of_slabs(search, parts, low, parts, high, interval.from, interval.to);
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
  const MotionParts own(query, {&motion, 1}, others.size()), parts(query, others);
  for (std::size_t i = 0; i < others.size(); ++i)
    if (!own.are_cut_alike(0, parts, i))
      reject(query, "motion " + std::to_string(i) + " has a body that is cut at other planes");
  ContactSearch search(tolerance);
  double first = never;
  for (std::size_t i = 0; i < others.size(); ++i)
    first = std::min(first, within_limit(
                                query, [i] { return "motion " + std::to_string(i); },
                                [&] {
                                  return first_of_slabs(search, own, 0, parts, i, interval.from,
                                                        std::min(first, interval.to));
                                }));
  return first;
}

}  // namespace bch
