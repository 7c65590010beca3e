// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdlib>
#include <mutex>

#include "baselines/exact_discs.hpp"
#include "baselines/placement.hpp"
#include "kernel/runtime/tasks.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "tests/support/test.hpp"

// The bound of layout/base/rounding.hpp, attacked where it matters: discs that touch, far from their agents' origins, judged by
// exact arithmetic.

namespace bch {
namespace {

using baselines::ExactDisc;
using baselines::Quad;
using baselines::QuadVector;
using test::Random;

/// A shape as it stands at a heading, with the exact discs of its cut at a level and of all nodes above.
struct PosedShape {
  std::uint32_t shape;
  std::uint8_t level;
  double heading, max_extent;
  baselines::QuadVector rotation;  ///< by the heading
  baselines::ExactCut cut;
};

/// Strokes and small trees, a millimetre to some metres, up to 8 m from their origins, at headings of all sizes. Nothing
/// but the bound of layout/base/rounding.hpp enlarges their discs: they have no grid.
class TangentShapes {
 public:
  TangentShapes(std::uint64_t seed, std::uint32_t shapes, std::uint32_t poses);

  const ShapeSet& set() const { return set_; }
  const PosedShape& pose(std::uint32_t i) const { return poses_[i]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(poses_.size()); }

 private:
  std::vector<Shape> shapes_;
  ShapeSet set_;
  std::vector<PosedShape> poses_;
};

/// A pair of agents at the edge of a hit. A disc of one's cut and one of the other's overlap, with all discs
/// above them, except for two of these discs, which are within a few units in the last place of touching.
/// Those two are the discs of the cuts, or discs above one of them or both.
struct NearTangent {
  const PosedShape *a, *b;
  double x, y;  ///< of b's agent; a's stands at (at_x, at_y)
  double at_x, at_y;
  std::uint32_t i, j;  ///< the two that nearly touch, among PosedShape::cut.discs
  bool above;          ///< whether one of them is above its cut
  bool
      meet;  ///< whether the discs of the cuts overlap with all above, exactly: then the pair has to be a hit
  double gap;  ///< of i and j, metres, less than zero where they overlap

  double max_extents() const { return a->max_extent + b->max_extent; }
  const baselines::ExactDisc& disc_a() const { return a->cut.discs[i]; }
  const baselines::ExactDisc& disc_b() const { return b->cut.discs[j]; }
  double radii() const { return static_cast<double>(disc_a().radius + disc_b().radius); }
  /// Returns whether the cuts have no other discs.
  bool lone() const { return a->cut.discs.size() == 1 && b->cut.discs.size() == 1; }
};

const ShapeSetPlan plan{{0, 2, all_depths}};

/// Its two ends lie on its smallest enclosing disc.
Outline stroke(Random& random) {
  const double far = std::exp2(random.uniform(-6, 3)), size = std::exp2(random.uniform(-10, 2));
  const double at = random.uniform(-4, 4), along = random.uniform(-4, 4);
  const double x = far * std::cos(at), y = far * std::sin(at);
  Outline outline;
  outline.points = {
      {static_cast<float>(x), static_cast<float>(y)},
      {static_cast<float>(x + size * std::cos(along)), static_cast<float>(y + size * std::sin(along))}};
  outline.contour_begin.push_back(2);
  return outline;
}

Shape tangent_shape(Random& random) {
  if (random.below(2) == 0) {
    const Outline outline = stroke(random);
    return {outline, contour_hierarchy(outline, 9.0f)};
  }
  Outline outline =
      test::star(random, 3 + random.below(8), 0.1, 0.4, random.uniform(-1, 1), random.uniform(-1, 1));
  outline.grid_step = 0;
  return {outline, contour_hierarchy(outline, 0.03f)};
}

double heading_of_any_size(Random& random) {
  const double sign = random.below(2) == 0 ? 1 : -1;
  switch (random.below(4)) {
    case 0:
      return sign * std::exp2(random.uniform(-60, 0));
    case 1:
      return sign * std::exp2(random.uniform(2, 29.8));
    default:
      return random.uniform(-4, 4);
  }
}

std::vector<Shape> make_shapes(Random& random, std::uint32_t count) {
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < count; ++i) shapes.push_back(tangent_shape(random));
  return shapes;
}

double extent(const ExactDisc& disc, double x, double y) {
  return static_cast<double>(disc.centre.x) * x + static_cast<double>(disc.centre.y) * y +
         static_cast<double>(disc.radius);
}

/// The disc of the cut that goes furthest along (x, y).
std::uint32_t outermost(const PosedShape& pose, double x, double y) {
  const auto& discs = pose.cut.discs;
  return *std::max_element(pose.cut.cut.begin(), pose.cut.cut.end(), [&](std::uint32_t i, std::uint32_t j) {
    return extent(discs[i], x, y) < extent(discs[j], x, y);
  });
}

/// Two discs, and the unit vector from the first one's centre to the second's where they touch.
struct Touching {
  std::uint32_t i, j;
  double distance;  ///< that b has gone until then
  double x, y;
};

/// Of all discs above a disc of each cut, these included, the first that part as b goes along (x, y) from where the centres
/// of the two are one point.
Touching first_to_part(const baselines::ExactCut& a, std::span<const std::uint32_t> path_a,
                       const baselines::ExactCut& b, std::span<const std::uint32_t> path_b, double x,
                       double y) {
  const QuadVector begin = a.discs[path_a[0]].centre - b.discs[path_b[0]].centre;
  Touching first{0, 0, HUGE_VAL, x, y};
  for (const std::uint32_t i : path_a)
    for (const std::uint32_t j : path_b) {
      const QuadVector between = a.discs[i].centre - b.discs[j].centre - begin;
      const double dx = static_cast<double>(between.x), dy = static_cast<double>(between.y);
      const double radii = static_cast<double>(a.discs[i].radius + b.discs[j].radius);
      const double across = x * dy - y * dx,
                   along = std::sqrt(std::max(0.0, radii * radii - across * across));
      const double distance = x * dx + y * dy + along;
      if (distance < first.distance)
        first = {i, j, distance, (along * x + across * y) / radii, (along * y - across * x) / radii};
    }
  return first;
}

/// How far the squares of two discs' distance and of their radii are apart, exactly; `shift` leads from a's agent to b's.
Quad excess(const ExactDisc& a, const ExactDisc& b, QuadVector shift) {
  const Quad radii = a.radius + b.radius;
  return square(shift - (a.centre - b.centre)) - radii * radii;
}

double near_gap(Random& random, double radii, double max_extents) {
  switch (random.below(4)) {
    case 0:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-52 * radii;
    case 1:
      return random.uniform(-8, 8) * detail::rounding::unit_roundoff * max_extents;
    default:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-24 * radii;
  }
}

void place(Random& random, NearTangent& pair, const Touching& touching) {
  const double radii = pair.radii(), distance = radii + near_gap(random, radii, pair.max_extents());
  const QuadVector between = pair.disc_a().centre - pair.disc_b().centre;
  pair.x = pair.at_x + (static_cast<double>(between.x) + distance * touching.x);
  pair.y = pair.at_y + (static_cast<double>(between.y) + distance * touching.y);
}

bool all_overlap(const NearTangent& pair, std::span<const std::uint32_t> path_a,
                 std::span<const std::uint32_t> path_b, QuadVector shift) {
  for (const std::uint32_t i : path_a)
    for (const std::uint32_t j : path_b)
      if (excess(pair.a->cut.discs[i], pair.b->cut.discs[j], shift) > 0) return false;
  return true;
}

TangentShapes::TangentShapes(std::uint64_t seed, std::uint32_t shapes, std::uint32_t poses)
    : shapes_([&] {
        Random random(seed);
        return make_shapes(random, shapes);
      }()),
      set_(shapes_, plan) {
  Random random(seed + 1);
  for (std::uint32_t i = 0; i < poses; ++i) {
    const std::uint32_t shape = i % shapes;
    const auto level = static_cast<std::uint8_t>(random.below(3));
    const double heading = heading_of_any_size(random);
    const auto rotation = baselines::quad_rotation(heading);
    const Hierarchy& hierarchy = shapes_[shape].hierarchy;
    poses_.push_back({shape, level, heading, hierarchy.max_extent, rotation,
                      baselines::exact_cut(hierarchy, plan.depths[level]).posed(rotation)});
  }
}

/// Draws a pair of agents that nearly touch. The discs of the cuts are the outermost along a random line, so
/// that hardly any others hide a miss of theirs. The two that nearly touch are those that separate the
/// agents: the first to do so as b moves away along that line from where the centres of both discs of the
/// cuts coincide. That point is then in all discs above, too, so that all overlap on the way.
///
/// Half of the gaps are -64 to 64 units in the last place of a float, a quarter as many of a double, and the rest up to 8 u
/// of the extents.
NearTangent near_tangent(Random& random, const TangentShapes& shapes) {
  NearTangent pair{};
  pair.a = &shapes.pose(random.below(shapes.size()));
  pair.b = &shapes.pose(random.below(shapes.size()));
  if (random.below(4) == 0) pair.at_x = random.uniform(-1e6, 1e6), pair.at_y = random.uniform(-1e6, 1e6);
  const double angle = random.uniform(-4, 4), along_x = std::cos(angle), along_y = std::sin(angle);
  const auto path_a = pair.a->cut.path(outermost(*pair.a, along_x, along_y)),
             path_b = pair.b->cut.path(outermost(*pair.b, -along_x, -along_y));
  const Touching touching = first_to_part(pair.a->cut, path_a, pair.b->cut, path_b, along_x, along_y);
  pair.i = touching.i, pair.j = touching.j;
  pair.above = pair.i != path_a[0] || pair.j != path_b[0];
  place(random, pair, touching);
  // The doubles that came out are the input; what is true of them:
  const QuadVector shift{Quad{pair.x} - pair.at_x, Quad{pair.y} - pair.at_y};
  pair.meet = all_overlap(pair, path_a, path_b, shift);
  pair.gap = static_cast<double>(excess(pair.disc_a(), pair.disc_b(), shift)) / (2 * pair.radii());
  return pair;
}

constexpr std::uint32_t block = 10'000;  ///< pairs

struct Tally {
  std::uint64_t pairs = 0, meeting = 0, above = 0, misses = 0, far_false_positives = 0, false_positives = 0;
  double largest_gap = 0;  ///< of a false positive, per metre of extent
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

Vec2 in_own_frame(const PosedShape& pose, std::uint32_t disc) {
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
  const double gap = pair.gap / pair.max_extents();
  tally.largest_gap = std::max(tally.largest_gap, gap);
  if (gap > detail::rounding::price) ++tally.far_false_positives;
}

void count_bare(Tally& tally, const NearTangent& pair) {
  tally.meeting += pair.meet;
  if (!pair.meet || bare_hit(pair, in_own_frame(*pair.a, pair.i), in_own_frame(*pair.b, pair.j))) return;
  ++tally.bare_misses;
  tally.above += pair.above;
  tally.deepest_bare_miss =
      std::max(tally.deepest_bare_miss, -pair.gap / (detail::rounding::unit_roundoff * pair.max_extents()));
}

using Tallies = std::vector<Tally>;  ///< one an implementation

/// The same pairs for all of them.
void attack(const TangentShapes& shapes, std::uint64_t seed, Tallies& tallies) {
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
  const TangentShapes shapes(1968, 2000, 8000);
  Tallies all(test::supported().size());
  std::mutex mutex;
  detail::run_each((pairs + block - 1) / block, [&](std::size_t i) {
    Tallies some(all.size());
    attack(shapes, 0x5eed + i, some);
    const std::lock_guard lock(mutex);
    for (std::size_t k = 0; k < all.size(); ++k) all[k].add(some[k]);
  });
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
        "%.2g m per metre of extent\n",
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
  const TangentShapes shapes(1968, 2000, 8000);
  Random random(1969);
  Tally tally;
  for (std::uint32_t i = 0; i < test::samples(500'000); ++i) count_bare(tally, near_tangent(random, shapes));
  std::printf(
      "bare float test: %.1f %% of %llu meeting pairs missed, overlaps of up to %.1f u per metre of extent\n",
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
    const double far = length(between), p = pair.b->max_extent, s = pair.max_extents();
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
  const TangentShapes shapes(1970, 500, 2000);
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
