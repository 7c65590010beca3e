// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distance/distance_input.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

/// Returns the beginning of a message about one pair or agent.
std::string place(const QueryName& context, std::size_t i) {
  return std::string(context.query) + ": " + context.one + " " + std::to_string(i) + ": ";
}

void check_size_or_none(const QueryName& context, std::size_t size, const char* what) {
  if (size != 0) check_size(context, size, what);
}

/// Checks the sizes of all answers except discs or spheres, and the options.
template <class Answers, class Options>
void require_valid_answers(const QueryName& context, const Answers& answers, const Options& options) {
  check_size(context, answers.distance.size(), "distances");
  check_size_or_none(context, answers.direction.size(), "directions");
  check_size_or_none(context, answers.points.size(), "points");
  if (!(options.max_distance >= 0))
    throw std::invalid_argument(std::string(context.query) +
                                ": expected a max_distance of at least 0 m, found " +
                                shortest(options.max_distance));
  require_choice(context.query, "an overlap", static_cast<int>(options.overlap), "0 (zero) or 1 (deepest)");
}

template <class Answers>
void store_common(const Answers& answers, std::size_t i, float distance) noexcept {
  answers.distance[i] = distance;
  if (!answers.direction.empty()) answers.direction[i] = {};
  if (!answers.points.empty()) answers.points[i] = {};
}

}  // namespace

void require_valid(const QueryName& context, const ClearanceAnswers& answers,
                   const ClearanceOptions& options) {
  check_size_or_none(context, answers.discs.size(), "discs");
  require_valid_answers(context, answers, options);
}

void require_valid(const QueryName& context, const BodyClearanceAnswers& answers,
                   const BodyClearanceOptions& options) {
  check_size_or_none(context, answers.spheres.size(), "spheres");
  require_valid_answers(context, answers, options);
}

void require_distances(const QueryName& context, std::span<const double> distances) {
  const bool one_for_all = distances.size() == 1;
  if (!one_for_all) check_size(context, distances.size(), "distances");
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (!(distances[i] >= 0))
      throw std::invalid_argument((one_for_all ? std::string(context.query) + ": " : place(context, i)) +
                                  "expected a distance of at least 0 m, found " + shortest(distances[i]));
}

void require_valid(const QueryName& context, const Displacements& displacements, std::size_t times) {
  check_size(context, displacements.x.size(), "displacements in x");
  check_size(context, displacements.y.size(), "displacements in y");
  check_size_or_none(context, displacements.z.size(), "displacements in z");
  check_size(context, times, "times");
  const auto good = [](double length) { return std::abs(length) <= rounding::largest_position; };
  for (std::size_t i = 0; i < displacements.x.size(); ++i)
    if (!good(displacements.x[i]) || !good(displacements.y[i]))
      throw std::invalid_argument(place(context, i) + "expected a displacement within +-1e9 m, found (" +
                                  shortest(displacements.x[i]) + ", " + shortest(displacements.y[i]) + ")");
  for (std::size_t i = 0; i < displacements.z.size(); ++i)
    if (!good(displacements.z[i]))
      throw std::invalid_argument(place(context, i) + "expected a displacement in z within +-1e9 m, found " +
                                  shortest(displacements.z[i]));
}

void require_on_ground(const QueryName& context, const Displacements& displacements) {
  if (!displacements.z.empty())
    throw std::invalid_argument(std::string(context.query) +
                                ": expected no displacements in z of outlines, found " +
                                std::to_string(displacements.z.size()));
}

void store_distance(const ClearanceAnswers& answers, std::size_t i, float distance) noexcept {
  store_common(answers, i, distance);
  if (!answers.discs.empty()) answers.discs[i] = DiscPair::none;
}

void store_distance(const BodyClearanceAnswers& answers, std::size_t i, float distance) noexcept {
  store_common(answers, i, distance);
  if (!answers.spheres.empty()) answers.spheres[i] = DiscPair::none;
}

}  // namespace bch::detail
