// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/query_answers.hpp"

#include <gtest/gtest.h>

namespace bch::test {
namespace {

/// Calls a query with room for `size` answers, and expects that it leaves what is beside them.
template <class Answer, class Query>
std::vector<Answer> answers_of(std::size_t size, Answer marker, Query query) {
  std::vector<Answer> all(size + 2, marker);
  query(std::span(all).subspan(1, size));
  EXPECT_TRUE(all.front() == marker && all.back() == marker);
  return {all.begin() + 1, all.end() - 1};
}

/// How far an agent's outermost discs extend from its position.
double extent(const ShapeSet& set, const Crowd& crowd, std::uint32_t agent) {
  return static_cast<double>(set.bounding_radius(crowd.shape[agent]));
}

/// Returns the name of an answer that differs, or "".
const char* difference(const PairAnswers& found, const PairAnswers& expected) {
  if (found.hit != expected.hit) return "collide()";
  if (found.hit_of_discs != expected.hit_of_discs) return "collide(), leaves of discs";
  if (found.within != expected.within) return "within()";
  if (!(found.deepest == expected.deepest)) return "clearance(), deepest overlap";
  if (!(found.nearest == expected.nearest)) return "clearance()";
  if (!(found.exact == expected.exact)) return "clearance(), exact leaves";
  if (found.time != expected.time) return "time_of_impact()";
  if (found.best != expected.best) return "penetration()";
  if (found.along != expected.along) return "penetration_along()";
  if (found.contacts != expected.contacts) return "contacts";
  if (found.contacts_of_discs != expected.contacts_of_discs) return "contacts, leaves of discs";
  return "";
}

}  // namespace

Questions Questions::part(std::size_t begin, std::size_t count) const {
  Questions some = *this;
  const auto keep = [&](auto& all) {
    all = {all.begin() + static_cast<std::ptrdiff_t>(begin),
           all.begin() + static_cast<std::ptrdiff_t>(begin + count)};
  };
  keep(some.pairs), keep(some.directions), keep(some.distances), keep(some.way_x), keep(some.way_y);
  return some;
}

Questions Questions::exchanged() const {
  Questions other = *this;
  for (Pair& pair : other.pairs) std::swap(pair.first, pair.second);
  for (Vec2& direction : other.directions) direction = {-direction.x, -direction.y};
  for (std::size_t i = 0; i < pairs.size(); ++i) other.way_x[i] = -way_x[i], other.way_y[i] = -way_y[i];
  return other;
}

Questions questions_about(Random& random, const ShapeSet& set, PairScene scene) {
  Questions all;
  static_cast<PairScene&>(all) = std::move(scene);
  constexpr double limits[] = {infinity, infinity, infinity, 0.5, 0.05, 1e-6, 0};
  constexpr std::uint32_t lines[] = {2, 4, 6, 10, 16, 18, 64};
  all.limit = limits[random.below(std::size(limits))];
  all.lines = lines[random.below(std::size(lines))];
  std::vector<float> clearances(all.pairs.size());
  clearance(set, all.crowd.agents(), all.pairs, {clearances});
  for (std::size_t i = 0; i < all.pairs.size(); ++i) {
    const auto [first, second] = all.pairs[i];
    const double both = extent(set, all.crowd, first) + extent(set, all.crowd, second);
    const double angle = random.uniform(-4, 4), size = std::exp(random.uniform(-20, 20));
    all.directions.push_back(
        {static_cast<float>(size * std::cos(angle)), static_cast<float>(size * std::sin(angle))});

    const double anything[] = {0, infinity, random.uniform(0, 2 * both),
                               std::pow(10, random.uniform(-30, 9))};
    all.distances.push_back(random.below(4) == 0
                                ? anything[random.below(4)]
                                : static_cast<double>(clearances[i]) * (1 + random.uniform(-2e-6, 0.5e-6)));

    const double x = all.crowd.x[second] - all.crowd.x[first], y = all.crowd.y[second] - all.crowd.y[first];
    constexpr double asides[] = {0.3, 2, std::numbers::pi};
    const double course = std::atan2(y, x) + random.uniform(-1, 1) * asides[random.below(3)];
    const double length = std::min(1e9, random.uniform(0, 1.5) * (std::hypot(x, y) + both));
    all.way_x.push_back(length * std::cos(course)), all.way_y.push_back(length * std::sin(course));
  }
  return all;
}

std::vector<NearestFeatures> nearest_features(const ShapeSet& set, const PairScene& of,
                                              const detail::AllOptions& options) {
  const std::size_t size = of.pairs.size();
  std::vector<Vec2> direction(size);
  std::vector<DiscPair> discs(size);
  std::vector<NearestPoints> points(size);
  const auto distance = answers_of(size, -77.0f, [&](std::span<float> out) {
    clearance(set, of.crowd.agents(), of.pairs, {out, direction, discs, points}, options);
  });
  std::vector<NearestFeatures> all;
  for (std::size_t i = 0; i < size; ++i) all.push_back({distance[i], direction[i], discs[i], points[i]});
  return all;
}

bool operator==(const NearestFeatures& a, const NearestFeatures& b) {
  using Bits = std::array<std::uint32_t, sizeof(NearestFeatures) / sizeof(std::uint32_t)>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

PairAnswers PairAnswers::exchanged() const {
  PairAnswers other = *this;
  for (NearestFeatures* each : {&other.deepest, &other.nearest, &other.exact}) {
    std::swap(each->discs.first, each->discs.second);
    std::swap(each->points.first, each->points.second);
    // A direction that is none has no sign.
    if (each->direction != Vec2{0, 0}) each->direction = {-each->direction.x, -each->direction.y};
  }
  for (Penetration* each : {&other.best, &other.along}) each->x = -each->x, each->y = -each->y;
  for (std::vector<DiscPair>* each : {&other.contacts, &other.contacts_of_discs}) {
    for (DiscPair& contact : *each) std::swap(contact.first, contact.second);
    std::ranges::sort(*each, {},
                      [](const DiscPair& contact) { return std::pair(contact.first, contact.second); });
  }
  return other;
}

void expect_same(const std::vector<PairAnswers>& found, const std::vector<PairAnswers>& expected,
                 const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_STREQ(difference(found[i], expected[i]), "") << what << ", pair " << i;
}

void expect_answers(const ShapeSet& set, const Questions& questions, const std::vector<PairAnswers>& expected,
                    const std::string& what) {
  for (const Implementation& each : supported())
    expect_same(run_query(set, questions, each), expected, what + ", " + each.name);
}

std::vector<PairAnswers> run_query(const ShapeSet& set, const Questions& of,
                                   const Implementation& implementation) {
  const Agents agents = of.crowd.agents();
  const std::size_t size = of.pairs.size();
  const auto hits = [&](Leaves leaves) {
    return answers_of<std::uint8_t>(size, 77, [&](std::span<std::uint8_t> out) {
      collide(set, agents, of.pairs, out, {&implementation, leaves});
    });
  };
  const auto near = answers_of<std::uint8_t>(size, 77, [&](std::span<std::uint8_t> out) {
    within(set, agents, of.pairs, of.distances, out, &implementation);
  });
  const auto nearest = [&](Overlap overlap, Leaves leaves) {
    return nearest_features(set, of,
                            {.implementation = &implementation,
                             .max_distance = of.limit,
                             .overlap = overlap,
                             .distance_leaves = leaves});
  };
  const auto of_segments = hits(Leaves::segments), of_discs = hits(Leaves::discs);
  const auto deepest = nearest(Overlap::deepest, Leaves::discs), zero = nearest(Overlap::zero, Leaves::discs),
             exact = nearest(Overlap::zero, Leaves::segments);
  const auto time = answers_of(size, -77.0f, [&](std::span<float> out) {
    time_of_impact(set, agents, of.pairs, {of.way_x, of.way_y}, out, &implementation);
  });
  const Penetration none{-77, -77, -77};
  const auto best = answers_of(size, none, [&](std::span<Penetration> out) {
    penetration(set, agents, of.pairs, of.lines, out, &implementation);
  });
  const auto along = answers_of(size, none, [&](std::span<Penetration> out) {
    penetration_along(set, agents, of.pairs, of.directions, out, &implementation);
  });
  bch::Crowd finder, finder_of_discs;
  const Rows<DiscPair> contacts = finder.contacts(set, agents, of.pairs, {.implementation = &implementation}),
                       contacts_of_discs = finder_of_discs.contacts(
                           set, agents, of.pairs,
                           {.implementation = &implementation, .leaves = Leaves::discs});
  const auto row = [](const Rows<DiscPair>& rows, std::size_t i) {
    return std::vector<DiscPair>(rows[i].begin(), rows[i].end());
  };
  EXPECT_EQ(contacts.size(), size);
  std::vector<PairAnswers> all;
  for (std::size_t i = 0; i < size; ++i)
    all.push_back({of_segments[i], of_discs[i], near[i], deepest[i], zero[i], exact[i], time[i], best[i],
                   along[i], row(contacts, i), row(contacts_of_discs, i)});
  return all;
}

}  // namespace bch::test
