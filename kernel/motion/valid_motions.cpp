// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/valid_motions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernel/runtime/validation.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

constexpr double largest_time = 1e6, largest_turn = 1e3, least_tolerance = 1e-6;

bool is_time(double seconds) {
  return std::abs(seconds) <= largest_time;
}

void require_valid(const char* query, const Motion& motion, std::size_t index) {
  const auto reject = [&](const std::string& why) {
    detail::reject(query, "motion " + std::to_string(index) + ": " + why);
  };
  if (motion.shape == nullptr) reject("expected a shape, found none");
  if (!is_time(motion.clip_begin))
    reject("expected a clip that begins within +-1e6 s, found " + shortest(motion.clip_begin));
  if (motion.path.empty()) reject("expected a path of keys, found none");
  for (std::size_t k = 0; k < motion.path.size(); ++k) {
    const auto& [time, x, y, heading, z] = motion.path[k];
    const auto reject_key = [&](const std::string& why) {
      reject("key " + std::to_string(k) + " of its path: " + why);
    };
    if (!is_time(time)) reject_key("expected a time within +-1e6 s, found " + shortest(time));
    if (const std::string why = misplacement(x, y, {heading}, z); !why.empty()) reject_key(why);
    if (k == 0) continue;
    if (!(motion.path[k - 1].time < time))
      reject_key("expected a time after " + shortest(motion.path[k - 1].time) + " s, found " +
                 shortest(time));
    if (!(std::abs(heading - motion.path[k - 1].heading) <= largest_turn))
      reject_key("expected a turn of at most 1000 rad, found one to " + shortest(heading));
  }
}

}  // namespace

void reject(const char* query, const std::string& why) {
  throw std::invalid_argument(std::string(query) + ": " + why);
}

void require_valid(const char* query, const TimeInterval& interval, double tolerance) {
  if (!is_time(interval.from) || !is_time(interval.to) || interval.from > interval.to)
    reject(query, "expected an interval within +-1e6 s, found " + shortest(interval.from) + " to " +
                      shortest(interval.to));
  if (!(tolerance >= least_tolerance && is_finite(tolerance)))
    reject(query, "expected a tolerance of at least 1e-6 m, found " + shortest(tolerance));
}

std::vector<MotionFacts> valid_motions(const char* query, std::span<const Motion> motions,
                                       std::size_t named_from) {
  std::vector<MotionFacts> facts;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    require_valid(query, motions[i], named_from + i);
    facts.emplace_back(motions[i]);
  }
  return facts;
}

}  // namespace bch::detail
