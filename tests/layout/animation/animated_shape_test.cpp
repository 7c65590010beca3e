// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/discs.hpp"
#include "layout/shape_set/animated_tree.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/test.hpp"

// Animated shapes: their discs at a time, the trees over them, and what is refused.

namespace bch {
namespace {

using test::Random;

AnimatedDiscs moving(std::vector<AnimatedChunk> chunks, bool loops = false) {
  return {std::move(chunks), loops};
}

/// From 1 s to 3 s a disc goes from (0, 0) to (2, 4) and doubles; from there to 4 s two discs stand.
std::vector<AnimatedChunk> two_chunks() {
  return {{{1, 3}, 1, {{0, 0, 1}, {2, 4, 2}}}, {{3, 4}, 2, {{5, 0, 1}, {6, 0, 1}, {5, 0, 1}, {6, 0, 1}}}};
}

TEST(AnimatedShape, HasItsDiscsAtEveryTime) {
  const AnimatedShape once(moving(two_chunks())), loop(moving(two_chunks(), true));
  const std::vector<Disc> first = {{0, 0, 1}}, half = {{1, 2, 1.5f}}, last = {{5, 0, 1}, {6, 0, 1}};
  EXPECT_EQ(once.begin(), 1);
  EXPECT_EQ(once.end(), 4);
  EXPECT_FALSE(once.loops());
  EXPECT_NEAR(once.bounding_radius(), 7, 1e-9);
  EXPECT_EQ(once.discs(-5), first);
  EXPECT_EQ(once.discs(2), half);
  EXPECT_EQ(once.discs(3), last);  // where a chunk begins its discs count alone
  EXPECT_EQ(once.discs(3.5), last);
  EXPECT_EQ(once.discs(9), last);
  EXPECT_TRUE(loop.loops());
  for (const double round : {-30.0, -3.0, 0.0, 3.0, 300.0}) {
    EXPECT_EQ(loop.discs(2 + round), half) << round;
    EXPECT_EQ(loop.discs(3.5 + round), last) << round;
  }
  EXPECT_GT(once.bytes(), 4 * sizeof(Disc));
}

/// Calls at(node, disc) for every disc and the nodes above it.
void for_each_enclosed(const detail::AnimatedTreeChunk& chunk,
                       const std::function<void(std::uint32_t, std::uint32_t)>& at) {
  std::vector<std::uint32_t> above(chunk.nodes(), 0);
  for (std::uint32_t i = 0; i < chunk.first_leaf(); ++i)
    for (std::uint32_t child = chunk.children(i).begin; child < chunk.children(i).end; ++child)
      above[child] = i;
  for (const std::uint32_t leaf : chunk.leaf_of_disc) {
    EXPECT_TRUE(chunk.is_leaf(leaf));
    for (std::uint32_t node = leaf; node != 0; node = above[node]) at(above[node], leaf);
  }
}

/// Expects that a chunk's nodes stand as AnimatedTreeChunk says, and are few.
void expect_tree(const detail::AnimatedTreeChunk& chunk) {
  std::vector<std::uint32_t> leaves(chunk.leaf_of_disc.begin(), chunk.leaf_of_disc.end());
  std::sort(leaves.begin(), leaves.end());
  EXPECT_EQ(chunk.first_leaf() + leaves.size(), chunk.nodes());
  for (std::uint32_t i = 0; i < leaves.size(); ++i) EXPECT_EQ(leaves[i], chunk.first_leaf() + i);
  std::uint32_t next = 1;
  for (std::uint32_t i = 0; i < chunk.first_leaf(); ++i) {
    const detail::NodeRange children = chunk.children(i);
    EXPECT_EQ(children.begin, next);
    EXPECT_GE(children.end, children.begin + 1);
    EXPECT_LE(children.end, children.begin + detail::animated_width);
    next = children.end;
  }
  EXPECT_EQ(next, chunk.nodes());
  EXPECT_LE(chunk.first_leaf(), 4 + leaves.size() / 4);
}

TEST(AnimatedShape, NodesHoldTheirDiscsAtEveryTime) {
  Random random(3111);
  for (std::uint32_t i = 0; i < test::samples(80); ++i) {
    AnimatedDiscs body = i % 4 == 0 ? test::loose_discs(random, i % 8 == 0 ? 1 + 13 * i : 1 + i)
                                    : test::swinging_body(random, 2, 8 + i);
    const AnimatedShape shape(i % 2 == 0 ? std::move(body) : test::in_space(random, std::move(body), 1.8));
    EXPECT_EQ(shape.in_space(), i % 2 != 0);
    for (const detail::AnimatedTreeChunk& chunk : shape.tree().chunks) {
      expect_tree(chunk);
      for (int k = 0; k < 30; ++k) {
        const std::size_t key = random.below(static_cast<std::uint32_t>(chunk.times.size() - 1));
        const double fraction = random.below(8) == 0 ? random.below(2) : random.uniform(0, 1);
        const auto at = [&](std::uint32_t node, float Disc::*part) {
          return std::lerp(double{chunk.disc(key, node).*part}, double{chunk.disc(key + 1, node).*part},
                           fraction);
        };
        for_each_enclosed(chunk, [&](std::uint32_t node, std::uint32_t disc) {
          const auto height = [&](std::uint32_t of) {
            return std::lerp(double{chunk.z(key, of)}, double{chunk.z(key + 1, of)}, fraction);
          };
          const double away =
              std::hypot(at(node, &Disc::x) - at(disc, &Disc::x), at(node, &Disc::y) - at(disc, &Disc::y),
                         height(node) - height(disc));
          EXPECT_LE(away + at(disc, &Disc::radius), at(node, &Disc::radius) + 1e-14);
        });
      }
    }
  }
}

/// 4096 discs fill a tree without a gap.
TEST(AnimatedShape, HasRoomForAllDiscsThatAreAllowed) {
  Random random(3114);
  for (const std::uint32_t discs : {7u, 8u, 9u, 57u, 64u, 65u, 512u, 513u, 4095u, 4096u})
    expect_tree(AnimatedShape(test::loose_discs(random, discs)).tree().chunks[0]);
}

/// Discs of numbers of 16 bits are kept, others held by ones that reach out by less than 1.5e-4 of the extent; spheres alike, by less than
/// 2e-4 of the extent in space.
TEST(AnimatedShape, RoundsOutward) {
  Random random(3115);
  int kept = 0, moved = 0;
  for (std::uint32_t i = 0; i < test::samples(4000); ++i) {
    const bool in_space = i % 2 == 0;
    const double size = std::exp(random.uniform(-12, 12)), tall = size * std::exp(random.uniform(-3, 1));
    AnimatedChunk chunk{{0, 1}, 1 + random.below(4), {}};
    double max_extent = 0;
    for (std::uint32_t k = 0; k < 2 * chunk.disc_count; ++k) {
      chunk.keys.push_back(
          {static_cast<float>(random.uniform(-size, size)), static_cast<float>(random.uniform(-size, size)),
           static_cast<float>(random.uniform(0, random.below(3) == 0 ? 2 * size : 0.4 * size))});
      const double z = in_space ? random.uniform(-tall, tall) : 0;
      if (in_space) chunk.z.push_back(static_cast<float>(z));
      const Disc& disc = chunk.keys.back();
      max_extent = std::max(max_extent, std::hypot(double{disc.x}, double{disc.y}, z) + double{disc.radius});
    }
    const AnimatedShape shape(moving({chunk}));
    std::vector<Sphere> rounded;
    for (const double seconds : {0.0, 1.0}) {
      for (const Disc& disc : in_space ? std::vector<Disc>() : shape.discs(seconds))
        rounded.push_back({disc.x, disc.y, 0, disc.radius});
      for (const Sphere& sphere : shape.spheres(seconds)) rounded.push_back(sphere);
    }
    ASSERT_EQ(rounded.size(), chunk.keys.size());
    for (std::size_t k = 0; k < rounded.size(); ++k) {
      const Disc& disc = chunk.keys[k];
      const double away =
          std::hypot(double{rounded[k].x} - double{disc.x}, double{rounded[k].y} - double{disc.y},
                     in_space ? double{rounded[k].z} - double{chunk.z[k]} : 0);
      const double room = double{rounded[k].radius} - double{disc.radius};
      EXPECT_LE(away, room * (1 + 1e-12)) << i;
      EXPECT_LT(away + room, (in_space ? 2e-4 : 1.5e-4) * max_extent) << i;
      moved += away > 0;
    }
    if (in_space) continue;
    EXPECT_GE(shape.bounding_radius(), max_extent * (1 - 1e-12));
    AnimatedChunk again{{0, 1}, chunk.disc_count, {}};
    const double widest = std::max(double{std::abs(rounded[0].x)}, double{std::abs(rounded[0].y)});
    bool small = true;
    for (const Sphere& each : rounded) {
      again.keys.push_back({each.x, each.y, each.radius});
      small = small && double{each.radius} < 0.4 * widest;
    }
    if (!small) continue;
    ++kept;
    EXPECT_EQ(AnimatedShape(moving({again})).discs(0), shape.discs(0));
  }
  EXPECT_GT(kept, static_cast<int>(test::samples(100)));
  EXPECT_GT(moved, static_cast<int>(test::samples(1000)));
}

/// A hull's extents, in any direction and at any time of its interval, are those of the discs at least, and in the mean hardly more.
TEST(AnimatedShape, HullsHoldDiscsThroughTheirWindows) {
  Random random(3116);
  double more = 0;
  const std::uint32_t bodies = test::samples(100);
  for (std::uint32_t i = 0; i < bodies; ++i) {
    AnimatedDiscs body = i % 4 == 0 ? test::loose_discs(random) : test::swinging_body(random, 1 + i % 11);
    const AnimatedShape shape(i % 2 == 0 ? std::move(body) : test::in_space(random, std::move(body), 1.8));
    const detail::AnimatedTree& tree = shape.tree();
    for (unsigned level = 0; level < detail::AnimatedHulls::level_count; ++level) {
      const std::size_t width = std::size_t{1} << level, chunks = tree.chunks.size();
      ASSERT_EQ(tree.hulls.levels[level].size(), (chunks + width - 1) / width);
      for (std::size_t interval = 0; interval * width < chunks; ++interval) {
        const detail::HullInterval& hull = tree.hulls.levels[level][interval];
        EXPECT_EQ(hull.begin, tree.chunks[interval * width].times.front());
        EXPECT_EQ(hull.end, tree.chunks[std::min((interval + 1) * width, chunks) - 1].times.back());
        const double fraction = random.uniform(0, 1), angle = random.uniform(-4, 4);
        const detail::PlanePoint d{std::cos(angle), std::sin(angle)};
        const auto [from, to] = detail::HullDirection(d).extent(hull.extents);
        const double reached = tree.hulls.step * std::lerp(from, to, fraction);
        double of_discs = -1;
        for (const Disc& disc : shape.discs(std::lerp(hull.begin, hull.end, fraction)))
          of_discs = std::max(of_discs, d.x * double{disc.x} + d.y * double{disc.y} + double{disc.radius});
        EXPECT_GE(reached, of_discs - 1e-7);
        for (const Sphere& s : shape.spheres(std::lerp(hull.begin, hull.end, fraction)))
          for (std::uint32_t band = 0; band < detail::hull_bands; ++band) {
            const double low = band == 0 ? -1e9 : band * detail::hull_band - detail::hull_overlap,
                         high = band + 1 == detail::hull_bands
                                    ? 1e9
                                    : (band + 1) * detail::hull_band + detail::hull_overlap;
            if (double{s.z} + double{s.radius} < low || double{s.z} - double{s.radius} > high) continue;
            const detail::HullBands& bands = tree.hulls.bands[level][interval];
            EXPECT_TRUE(bands.occupied >> band & 1);
            const auto [begin, end] = detail::HullDirection(d).extent(bands.extents[band]);
            EXPECT_GE(tree.hulls.step * std::lerp(begin, end, fraction),
                      d.x * double{s.x} + d.y * double{s.y} + double{s.radius} - 1e-7);
          }
        if (level == 0) more += (reached - of_discs) / static_cast<double>(bodies * chunks);
      }
    }
  }
  EXPECT_LT(more, 0.1);
}

/// Nodes are hardly larger than the smallest discs.
TEST(AnimatedShape, TreesAreTight) {
  Random random(3112);
  for (int i = 0; i < 4; ++i) {
    const AnimatedDiscs body = test::swinging_body(random, 1, 32);
    const AnimatedShape shape(body);
    const detail::AnimatedTreeChunk& chunk = shape.tree().chunks[0];
    for (const std::size_t key : {std::size_t{0}, chunk.times.size() - 1}) {
      const std::span<const Disc> discs = std::span(body.chunks[0].keys).subspan(key * 32, 32);
      EXPECT_LT(chunk.disc(key, 0).radius, 1.01f * detail::disc_hierarchy(discs).nodes[0].disc.radius);
    }
  }
}

/// Queries of a body's shape at a time answer as its discs do.
TEST(AnimatedShape, IsAShapeAtEveryTime) {
  Random random(3113);
  int hits = 0;
  for (std::uint32_t i = 0; i < test::samples(2000); ++i) {
    const auto body = [&] {
      const auto key =
          PathKey{0, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-4, 4)};
      return test::MotionCase{
          i % 3 != 0 ? test::swinging_body(random) : test::loose_discs(random), {key}, random.uniform(-1, 1)};
    };
    const test::MotionCase a = body(), b = body();
    const double time = random.uniform(-3, 3);
    const auto shape_of = [&](const test::MotionCase& of) {
      return of.shape.shape(time - of.clip_begin + of.shape.begin());
    };
    const ShapeSet set({{shape_of(a), shape_of(b)}});
    const std::vector<std::uint32_t> shape = {0, 1};
    const std::vector<double> x = {a.path[0].x, b.path[0].x}, y = {a.path[0].y, b.path[0].y},
                              heading = {a.path[0].heading, b.path[0].heading};
    std::vector<std::uint8_t> hit(1);
    collide(set, {shape, x, y, heading}, std::vector<Pair>{{0, 1}}, hit);
    const double gap = test::gap_at(a, b, time);
    if (gap <= 0) {
      EXPECT_EQ(hit[0], 1) << i;
    }
    if (hit[0] == 1) {
      EXPECT_LE(gap, 1e-5) << i;
    }
    hits += hit[0];
  }
  EXPECT_GT(hits, static_cast<int>(test::samples(400)));
}

using Damage = std::pair<std::function<void(AnimatedDiscs&)>, const char*>;

/// Expects of each change of a body that it is refused, and why.
void expect_refused(const AnimatedDiscs& good, const std::vector<Damage>& cases) {
  const auto said = [](const AnimatedDiscs& body) { return test::complaint([&] { AnimatedShape{body}; }); };
  EXPECT_EQ(said(good), "accepted");
  for (const auto& [change, message] : cases) {
    AnimatedDiscs bad = good;
    change(bad);
    EXPECT_EQ(said(bad), std::string("animated shape: ") + message);
  }
}

TEST(AnimatedShape, RefusesWhatDoesNotMove) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  using Body = AnimatedDiscs;
  expect_refused(
      moving(two_chunks()),
      {{[](Body& b) { b.chunks.clear(); }, "expected at least one chunk, found none"},
       {[](Body& b) { b.chunks[0].times = {1}; }, "chunk 0: expected at least two keys, found 1"},
       {[](Body& b) { b.chunks[0].times[0] = 3; }, "chunk 0: expected a key after 3 s, found 3"},
       {[](Body& b) { b.chunks[0].times[1] = HUGE_VAL; },
        "chunk 0: expected a key within +-1e6 s, found inf"},
       {[](Body& b) { b.chunks[1].times[0] = 3.5; },
        "chunk 1: expected a beginning at 3 s, where the one before ends, found 3.5"},
       {[](Body& b) { b.chunks[0].disc_count = 0, b.chunks[0].keys.clear(); },
        "chunk 0: expected 1 to 4096 discs, found 0"},
       {[](Body& b) { b.chunks[0].keys.pop_back(); }, "chunk 0: expected 1 discs at each of 2 keys, found 1"},
       {[=](Body& b) { b.chunks[0].keys[1].y = nan; },
        "chunk 0: disc 0 at key 1: expected a radius of at least 0 m about a finite centre, found 2 about "
        "(2, nan)"},
       {[](Body& b) { b.chunks[0].keys[0].radius = -1; },
        "chunk 0: disc 0 at key 0: expected a radius of at least 0 m about a finite centre, found -1 about "
        "(0, 0)"},
       {[](Body& b) {
          b.chunks[1].z = {1, 1, 1, 1};
        },
        "chunk 1: expected 0 heights, found 4"},
       {[](Body& b) { b.chunks[0].z = {1}; }, "chunk 0: expected 2 heights, found 1"},
       {[=](Body& b) {
          b.chunks[0].z = {1, nan};
        },
        "chunk 0: expected a sphere within +-1e6 m of the ground, found one at nan"},
       {[](Body& b) { b.heights.bottom = 1, b.heights.top = 0; }, "heights from 1 to 0 m"}});
  Body large = moving(two_chunks());
  large.chunks[0].keys[0].radius = 2e6f;
  EXPECT_EQ(test::complaint([&] { AnimatedShape{large}; }),
            "hierarchy: expected an extent of 1e-6 to 1e6 m, found 2e+06");
}

TEST(AnimatedShape, RefusesLoopsOfNextToNoTime) {
  const auto said = [](double begin, double end, bool loops) {
    AnimatedDiscs discs = test::still_disc(0.25f);
    discs.chunks[0].times = {begin, end};
    discs.loops = loops;
    return test::complaint([&] { validate(discs); });
  };
  EXPECT_EQ(said(0, 1e-12, true), "animated shape: expected a loop of at least 0.001 s, found 1e-12");
  EXPECT_EQ(said(0, 1e-300, false), "accepted");
  EXPECT_EQ(said(0, 0.001, true), "accepted");
  EXPECT_NE(said(-1e6, -1e6 + 0.0005, true), "accepted");
}

}  // namespace
}  // namespace bch
