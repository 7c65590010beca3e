// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/rounding.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstdlib>

#include "baselines/placement.hpp"
#include "layout/base/heading.hpp"
#include "tests/support/near_tangent.hpp"
#include "tests/support/test.hpp"

// The bound of layout/base/rounding.hpp, attacked where it matters: discs that touch, far from their agents' origins, judged by
// exact arithmetic.

namespace bch {
namespace {

using baselines::Quad;
using baselines::QuadVector;
using test::NearTangent;
using test::Random;

constexpr std::uint32_t block = 10'000;  ///< pairs

struct Tally {
  std::uint64_t pairs = 0, meeting = 0, above = 0, misses = 0, far_false_positives = 0, false_positives = 0;
  double largest_gap = 0;  ///< of a false positive, per metre of reach
  std::uint64_t bare_misses = 0;
  double deepest_bare_miss = 0;  ///< in units of u (P_A + P_B)

  void add(const Tally& other) {
    pairs += other.pairs, meeting += other.meeting, above += other.above, misses += other.misses;
    far_false_positives += other.far_false_positives, false_positives += other.false_positives;
    largest_gap = std::max(largest_gap, other.largest_gap);
    bare_misses += other.bare_misses;
    deepest_bare_miss = std::max(deepest_bare_miss, other.deepest_bare_miss);
  }
};

/// A pair's agents, alone.
struct TwoAgents {
  std::uint32_t shape[2];
  double x[2], y[2], heading[2];

  explicit TwoAgents(const NearTangent& pair)
      : shape{pair.a->shape, pair.b->shape},
        x{pair.at_x, pair.x},
        y{pair.at_y, pair.y},
        heading{pair.a->heading, pair.b->heading} {}
  Agents agents() const { return {shape, x, y, heading}; }
};

/// The test that rounding.hpp lists, of a disc's centre in each agent's frame.
struct FloatTest {
  float x, y;  ///< of B's centre in A's frame
  float square_distance;

  FloatTest(const baselines::FloatPlacement& place, Vec2 a, Vec2 b)
      : x(place.x + (place.cosine * b.x - place.sine * b.y)),
        y(place.y + (place.sine * b.x + place.cosine * b.y)),
        square_distance((x - a.x) * (x - a.x) + (y - a.y) * (y - a.y)) {}
};

Vec2 in_own_frame(const test::PosedShape& pose, std::uint32_t disc) {
  const QuadVector centre = turned_back(pose.rotation, pose.cut.discs[disc].centre);
  return {static_cast<float>(centre.x), static_cast<float>(centre.y)};
}

/// What a test in float does without the bound: tight radii, rounded to nearest. Of the two discs that nearly touch alone,
/// without which there is no hit.
bool bare_hit(const NearTangent& pair, Vec2 a, Vec2 b) {
  const TwoAgents two(pair);
  const FloatTest test(baselines::float_placement(two.agents(), {0, 1}), a, b);
  const float radii = static_cast<float>(pair.disc_a().radius) + static_cast<float>(pair.disc_b().radius);
  return test.square_distance <= radii * radii;
}

void count(Tally& tally, const NearTangent& pair, bool hit) {
  ++tally.pairs;
  tally.meeting += pair.meet;
  tally.above += pair.meet && pair.above;
  if (pair.meet && !hit) ++tally.misses;
  if (!hit || pair.meet || !pair.lone()) return;
  ++tally.false_positives;
  const double gap = pair.gap / pair.reaches();
  tally.largest_gap = std::max(tally.largest_gap, gap);
  if (gap > detail::rounding::price) ++tally.far_false_positives;
}

void count_bare(Tally& tally, const NearTangent& pair) {
  tally.meeting += pair.meet;
  if (!pair.meet || bare_hit(pair, in_own_frame(*pair.a, pair.i), in_own_frame(*pair.b, pair.j))) return;
  ++tally.bare_misses;
  tally.above += pair.above;
  tally.deepest_bare_miss =
      std::max(tally.deepest_bare_miss, -pair.gap / (detail::rounding::unit_roundoff * pair.reaches()));
}

using Tallies = std::vector<Tally>;  ///< one an implementation

/// The same pairs for all of them.
void attack(const test::TangentShapes& shapes, std::uint64_t seed, Tallies& tallies) {
  Random random(seed);
  std::vector<NearTangent> near;
  test::PairScene scene;
  for (std::uint32_t i = 0; i < block; ++i) {
    const NearTangent& pair = near.emplace_back(near_tangent(random, shapes));
    scene.crowd.add({pair.a->shape, pair.at_x, pair.at_y, pair.a->heading, pair.a->level});
    scene.crowd.add({pair.b->shape, pair.x, pair.y, pair.b->heading, pair.b->level});
    scene.pairs.push_back(i % 2 == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  std::vector<std::uint8_t> hits(block);
  const auto implementations = test::supported();
  for (std::size_t k = 0; k < implementations.size(); ++k) {
    collide(shapes.set(), scene.crowd.agents(), scene.pairs, hits,
            {&implementations[k].get(), Leaves::discs});
    for (std::uint32_t i = 0; i < block; ++i) count(tallies[k], near[i], hits[i] != 0);
  }
}

Tallies attack(std::uint64_t pairs) {
  const test::TangentShapes shapes(1968, 2000, 8000);
  tbb::enumerable_thread_specific<Tallies> local([] { return Tallies(test::supported().size()); });
  tbb::parallel_for(std::uint64_t{0}, (pairs + block - 1) / block,
                    [&](std::uint64_t i) { attack(shapes, 0x5eed + i, local.local()); });
  Tallies all(test::supported().size());
  for (const Tallies& some : local)
    for (std::size_t k = 0; k < all.size(); ++k) all[k].add(some[k]);
  return all;
}

/// 10^6 pairs, or as many as the environment says; the preset nightly asks for 10^8.
std::uint64_t pairs_to_try() {
  const char* const wanted = std::getenv("BCH_TANGENT_PAIRS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : test::samples(1'000'000);
}

TEST(RoundingBound, NearTangentPairsAgainstExactArithmetic) {
  const std::uint64_t pairs = pairs_to_try();
  ASSERT_GE(pairs, block);
  const Tallies tallies = attack(pairs);
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Tally& tally = tallies[k];
    const char* const name = test::supported()[k].get().name;
    std::printf(
        "%s: %llu pairs, %llu meet, %llu of them by discs above their cuts, misses: %llu; false positives up "
        "to "
        "%.2g m per metre of reach\n",
        name, static_cast<unsigned long long>(tally.pairs), static_cast<unsigned long long>(tally.meeting),
        static_cast<unsigned long long>(tally.above), static_cast<unsigned long long>(tally.misses),
        tally.largest_gap);
    EXPECT_GE(tally.pairs, pairs);
    EXPECT_EQ(tally.misses, 0u) << name;
    EXPECT_EQ(tally.far_false_positives, 0u) << name;
    EXPECT_GT(tally.meeting, tally.pairs / 4);
    EXPECT_GT(tally.above, tally.pairs / 16);
    EXPECT_GT(tally.false_positives, tally.pairs / 8);
  }
}

/// The attack is one: without the bound it breaks the test in float.
TEST(RoundingBound, TheSamePairsBreakABareTest) {
  const test::TangentShapes shapes(1968, 2000, 8000);
  Random random(1969);
  Tally tally;
  for (std::uint32_t i = 0; i < test::samples(500'000); ++i) count_bare(tally, near_tangent(random, shapes));
  std::printf(
      "bare float test: %.1f %% of %llu meeting pairs missed, overlaps of up to %.1f u per metre of reach\n",
      100.0 * static_cast<double>(tally.bare_misses) / static_cast<double>(tally.meeting),
      static_cast<unsigned long long>(tally.meeting), tally.deepest_bare_miss);
  EXPECT_GT(tally.bare_misses, tally.meeting / 20);
  EXPECT_GT(tally.above, tally.bare_misses / 10);
  EXPECT_GT(tally.deepest_bare_miss, 2);
  EXPECT_LT(tally.deepest_bare_miss, detail::rounding::terms::contact_error);
}

/// The largest error seen of every step that rounding.hpp bounds by name, as a share of that bound.
class Steps {
 public:
  void pair(const NearTangent& pair) {
    const TwoAgents two(pair);
    const baselines::FloatPlacement place = baselines::float_placement(two.agents(), {0, 1});
    const QuadVector to = pair.a->rotation, by = pair.b->rotation, relative = turned_back(to, by);
    namespace terms = detail::rounding::terms;
    note(0, float_unit(pair.a->heading), to, terms::heading);
    const QuadVector between{Quad{pair.x} - pair.at_x, Quad{pair.y} - pair.at_y},
        at = turned_back(to, between);
    const Vec2 a = in_own_frame(*pair.a, pair.i), b = in_own_frame(*pair.b, pair.j);
    const QuadVector arm = turned(relative, {b.x, b.y});
    const double far = length(between), p = pair.b->reach, s = pair.reaches();
    note(1, {place.cosine, place.sine}, relative, terms::turn);
    note(2, {place.cosine * b.x - place.sine * b.y, place.sine * b.x + place.cosine * b.y}, arm,
         terms::arm * p);
    note(3, {place.x, place.y}, at, terms::position * far);
    const FloatTest test(place, a, b);
    note(4, {test.x, test.y}, at + arm, terms::arm * p + terms::position * far + terms::sum * (far + p));
    const QuadVector apart = at + arm - QuadVector{a.x, a.y};
    const Quad measured = baselines::square_root(test.square_distance);
    note(5, {measured, 0}, {length(apart), 0}, (terms::query_error - terms::radii) * s);
  }

  const double* shares() const { return shares_; }

 private:
  static QuadVector float_unit(double heading) {
    const detail::UnitVector v = detail::unit_vector(heading);
    return {v.cosine, v.sine};
  }
  static double length(QuadVector v) { return static_cast<double>(baselines::square_root(square(v))); }
  void note(int step, QuadVector computed, QuadVector exact, double bound_in_u) {
    const double error = length(computed - exact) / detail::rounding::unit_roundoff;
    shares_[step] = std::max(shares_[step], error / bound_in_u);
  }

  double shares_[6] = {};
};

TEST(RoundingBound, EveryStepStaysBelowItsOwnBound) {
  const test::TangentShapes shapes(1970, 500, 2000);
  Random random(1971);
  Steps steps;
  for (std::uint32_t i = 0; i < test::samples(100'000); ++i) {
    steps.pair(near_tangent(random, shapes));
  }
  const char* const names[] = {"heading", "turn", "arm", "shift", "centre", "distance"};
  for (int i = 0; i < 6; ++i) {
    std::printf("(%s) up to %.2f of its bound\n", names[i], steps.shares()[i]);
    EXPECT_LE(steps.shares()[i], 1) << names[i];
    EXPECT_GT(steps.shares()[i], 0.1) << names[i];
  }
}

/// The midpoints of a segment that is halved again and again, along one coordinate, in units in the last place.
class Halvings {
 public:
  /// Between two integers, which are off the segment by so much. `halvings`: with these.
  void halve(std::int64_t a, std::int64_t b, double a_off, double b_off, std::size_t halvings) {
    if (std::abs(b - a) <= 1) return;  // no midpoint but the ends
    const std::int64_t twice = a + b, below = (twice - (twice & 1)) / 2;
    const std::int64_t middle = below + (twice & below & 1);  // as floats are rounded: a tie to even
    const double off = (a_off + b_off) / 2 + static_cast<double>(2 * middle - twice) / 2;
    most_.resize(std::max(most_.size(), halvings));
    most_[halvings - 1] = std::max(most_[halvings - 1], std::abs(off));
    halve(a, middle, a_off, off, halvings + 1);
    halve(middle, b, off, b_off, halvings + 1);
  }
  const std::vector<double>& most() const { return most_; }

 private:
  std::vector<double> most_;
};

/// What layout/base/rounding.hpp says about (halving); half a unit is u times the least power of two with that unit.
TEST(RoundingBound, HalvedSegmentsDriftLessThanDerived) {
  Halvings all;
  for (std::int64_t difference = 2; difference < 1 << 13; ++difference)
    for (const std::int64_t begin : {0, 1}) all.halve(begin, begin + difference, 0, 0, 1);
  ASSERT_EQ(all.most().size(), 13u);
  for (int k = 1; k <= 13; ++k) {
    const double off = 2 * all.most()[static_cast<std::size_t>(k) - 1];
    EXPECT_LE(off, detail::rounding::terms::halved(k)) << k;
    EXPECT_LE(off, (4 * k + 6) / 9.0) << k;
    EXPECT_GE(off, 0.9 * (4 * k + 1) / 9.0) << k;
  }
}

}  // namespace
}  // namespace bch
