// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#define XXH_INLINE_ALL  // nothing is linked
#include <xxhash.h>

#include "layout/base/floating_point_register.hpp"
#include "layout/base/floating_point_state.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/executors.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/query_answers.hpp"
#include "tests/support/test.hpp"

// The answers to one crowd as hashes, the same for every compiler, optimisation, processor, instruction set, number of
// threads, split of the batch, and floating-point state of the threads. Where an answer changes on purpose, so do these.

namespace bch {
namespace {

/// How a thread computes with floating point, as its processor's register says it.
struct FloatState {
  const char* name;
  unsigned bits;
};

unsigned float_state() {
  return detail::floating_point_register::read() & ~detail::floating_point_register::flags;
}
void set_float_state(unsigned bits) {
  detail::floating_point_register::write(bits);
}

std::vector<FloatState> odd_float_states() {
#if defined(__x86_64__)
  return {{"denormals are zero, both ways", 0x1f80 | 0x8040},
          {"down", 0x1f80 | 0x2000},
          {"up", 0x1f80 | 0x4000},
          {"towards zero", 0x1f80 | 0x6000},
          {"traps", 0x1f80 & ~0x680u}};
#elif defined(__aarch64__)  // traps are left out, because processors may do without
  return {{"denormals are zero", 1u << 24},
          {"one NaN", 1u << 25},
          {"up", 1u << 22},
          {"down", 2u << 22},
          {"towards zero", 3u << 22}};
#else
  return {{"down", FE_DOWNWARD}, {"up", FE_UPWARD}, {"towards zero", FE_TOWARDZERO}};
#endif
}

using Hashes = std::vector<std::uint64_t>;

const Hashes golden{0xb001f2145d76abf1, 0x0df165085461f9bf, 0x22e4be2a917a2aab, 0x6208885fb451fee7,
                    0xbf5f940cfee4332d, 0x32e95ab86c5b93fd, 0x04ad4df0d6203a5b, 0xe67190d710f1ec09,
                    0xebec44f58f6fc63e, 0x8a060f5623b47a02, 0x80ad28f139efe06b, 0x027c45c6b6487bc1,
                    0x7bec31661896997c, 0x5e031d2172db198f, 0xd1e385adc7ef1bda, 0xa79ec264efb3b3fc,
                    0x693851ffcce83169, 0xb9a994ab0bd8c196};

/// The same of bodies with heights, half of them on grounds of their own.
const Hashes golden_with_heights{
    0x60d060ac74320fc2, 0x735bdd4c18df5000, 0x5baa5d16b2371efa, 0xbc646285f1da6d36, 0xe6ec558db14e283c,
    0x79a3a5ff4a0df064, 0xbe398da63b382eb9, 0x792a2fd8987a813d, 0x4fd6551bd76212b5, 0x8f79e5c6333d541c,
    0xb61a8ef7db5f6ae8, 0x0a95b052543f3735, 0x218c7955d4983943, 0x1122a1c7bd6825b2, 0xa4567057f88f1c7d,
    0x469800c6291d3bac, 0xa7a5d96074dbdddc, 0xfffad584d6936eb3};

/// In this order, bytes of all answers.
class AnswerBytes {
 public:
  enum Query {
    hits,
    neighbours,
    distances,
    directions,
    nodes,
    times,
    depths,
    contact_counts,
    contact_discs,
    exact_hits,
    exact_contacts,
    distances_or_zero,
    within,
    nearest_points,
    exact_distances,
    exact_directions,
    exact_nodes,
    exact_points
  };

  AnswerBytes() : bytes_(exact_points + 1) {}

  template <class Values>
  void add(Query query, const Values& values) {
    const auto* begin = reinterpret_cast<const char*>(values.data());
    bytes_[query].append(begin, values.size() * sizeof(values[0]));
  }
  Hashes hashes() const {
    Hashes all;
    for (const std::string& bytes : bytes_) all.push_back(XXH3_64bits(bytes.data(), bytes.size()));
    return all;
  }

 private:
  std::vector<std::string> bytes_;
};

enum class Grounds { one, many };

class Determinism : public testing::TestWithParam<Grounds> {
 protected:
  Determinism() {
    test::Random random(62);
    for (int i = 0; i < 1'500; ++i)
      crowd.add({random.below(16), random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-7, 7),
                 static_cast<std::uint8_t>(random.below(3))});
    // Apart by less than the least normal number.
    crowd.add({16, 30, 0, 0, 0});
    crowd.add({16, 30, 1e-40, 0, 0});
    // Half of them on the same ground.
    for (std::size_t i = 0; i < crowd.x.size() && has_heights; ++i)
      crowd.z.push_back(random.below(2) == 0 ? 0 : random.uniform(-1, 1));
    pairs = test::candidate_pairs(set, crowd.agents());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      questions.way_x.push_back(random.uniform(-2, 2)), questions.way_y.push_back(random.uniform(-2, 2));
      if (i % 2 == 0) std::swap(pairs[i].first, pairs[i].second);
    }
    questions.limit = 1.5;
    questions.distances.assign(pairs.size(), 0.1);
    questions.directions.assign(pairs.size(), {1, 0});
  }

  Hashes hashes(const Implementation* isa, std::size_t batch) const {
    AnswerBytes bytes;
    for (std::size_t i = 0; i < pairs.size(); i += batch)
      answer(isa, i, std::min(batch, pairs.size() - i), bytes);
    bch::Crowd collider;
    const bch::Crowd::Pairs colliding =
        collider.collisions(set, crowd.agents(), {.implementation = isa, .leaves = Leaves::discs});
    const Rows<bch::Crowd::Neighbour> all = colliding.by_agent();
    std::vector<std::uint32_t> neighbours;
    for (const bch::Crowd::Neighbour& neighbour : all.values) neighbours.push_back(neighbour.agent);
    bytes.add(AnswerBytes::neighbours, all.offsets);
    bytes.add(AnswerBytes::neighbours, neighbours);
    return bytes.hashes();
  }

  static std::vector<Shape> shapes() {
    std::vector<Shape> all = test::synthetic_shapes(61, 16);
    all.push_back(test::contour_shape(test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})));
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].heights = {0.1f * static_cast<float>(i % 3), 0.6f + 0.1f * static_cast<float>(i % 4)};
    return all;
  }

  const Hashes& expected() const { return has_heights ? golden_with_heights : golden; }

  const bool has_heights = GetParam() == Grounds::many;
  const ShapeSet set{shapes(), {.depths = {0, 3, all_depths}, .heights = has_heights}};
  test::Questions questions;
  test::Crowd& crowd = questions.crowd;
  std::vector<Pair>& pairs = questions.pairs;

 private:
  /// Without what pads them, and rounded here, to nearest; penetration_test compares directions bit by bit.
  static void add_depths(const std::vector<Penetration>& ways, AnswerBytes& bytes) {
    const detail::FloatingPointStateGuard to_nearest;
    for (const auto& [depth, x, y] : ways)
      bytes.add(AnswerBytes::depths, std::array{depth, static_cast<float>(x), static_cast<float>(y)});
  }

  void answer(const Implementation* isa, std::size_t begin, std::size_t size, AnswerBytes& bytes) const {
    const auto all =
        run_query(set, questions.part(begin, size), isa != nullptr ? *isa : best_implementation());
    std::vector<Penetration> ways;
    for (const test::PairAnswers& of : all) {
      bytes.add(AnswerBytes::hits, std::array{of.hit_of_discs});
      bytes.add(AnswerBytes::exact_hits, std::array{of.hit});
      bytes.add(AnswerBytes::distances, std::array{of.deepest.distance});
      bytes.add(AnswerBytes::directions, std::array{of.deepest.direction});
      bytes.add(AnswerBytes::nodes, std::array{of.deepest.discs});
      bytes.add(AnswerBytes::nearest_points, std::array{of.nearest.points});
      bytes.add(AnswerBytes::distances_or_zero, std::array{of.nearest.distance});
      bytes.add(AnswerBytes::exact_distances, std::array{of.exact.distance});
      bytes.add(AnswerBytes::exact_directions, std::array{of.exact.direction});
      bytes.add(AnswerBytes::exact_nodes, std::array{of.exact.discs});
      bytes.add(AnswerBytes::exact_points, std::array{of.exact.points});
      bytes.add(AnswerBytes::within, std::array{of.within});
      bytes.add(AnswerBytes::times, std::array{of.time});
      bytes.add(AnswerBytes::contact_counts, std::array{std::uint64_t{of.contacts_of_discs.size()}});
      bytes.add(AnswerBytes::contact_discs, of.contacts_of_discs);
      bytes.add(AnswerBytes::exact_contacts, of.contacts);
      ways.push_back(of.best);
    }
    add_depths(ways, bytes);
  }
};

INSTANTIATE_TEST_SUITE_P(OneGround, Determinism, testing::Values(Grounds::one));
INSTANTIATE_TEST_SUITE_P(ManyGrounds, Determinism, testing::Values(Grounds::many));

TEST_P(Determinism, OfInstructionSets) {
  EXPECT_GT(pairs.size(), 5'000u);
  for (const Implementation& isa : test::supported())
    EXPECT_EQ(hashes(&isa, pairs.size()), expected()) << isa.name;
}

TEST_P(Determinism, OfThreadsAndBatches) {
  // With sanitizers, which look for other mistakes, two of these.
  const std::vector<unsigned> counts =
      test::samples(8) == 8 ? std::vector{1u, 2u, 3u, 8u, 32u} : std::vector{3u, 32u};
  for (const unsigned threads : counts)
    for (const std::size_t batch : {pairs.size(), std::size_t{2049}, std::size_t{100}})
      test::on_threads(threads, [&] {
        EXPECT_EQ(hashes(nullptr, batch), expected()) << threads << " threads, " << batch;
      });
}

TEST_P(Determinism, OfExecutors) {
  test::expect_same_on_each_executor(
      [&] {
        const Hashes found = hashes(nullptr, pairs.size());
        EXPECT_EQ(found, expected());
        return found;
      },
      Executor::set);
}

/// New arenas give the state of the thread that makes them to their workers.
TEST_P(Determinism, OfTheThreadsFloatingPointState) {
  const unsigned before = float_state();
  for (const FloatState& state : odd_float_states()) {
    Hashes here;
    unsigned after = 0;
    set_float_state(state.bits);
    test::on_threads(4, [&] { here = hashes(nullptr, pairs.size()), after = float_state(); });
    set_float_state(before);
    EXPECT_EQ(here, expected()) << state.name;
    EXPECT_EQ(after, state.bits) << state.name;
  }
}

// What construction makes, as hashes of baked files: the same bytes for every compiler, optimisation and processor. Where
// they change on purpose, so do these.

std::uint64_t hash_of(const std::vector<Shape>& shapes, const ShapeSetPlan& plan) {
  const std::string bytes = test::BakedBytes(ShapeSet(shapes, plan), {}).text();
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t hash_of(const Character& character, const ShapeSetPlan& plan) {
  ShapeBuilder shape_builder(character, plan);
  std::vector<Shape> shapes;
  for (const PoseTime& time : sample_poses(character, 3)) shapes.push_back(shape_builder.shape(time));
  return hash_of(shapes, plan);
}

/// Shapes of outlines that are given, without characters: no function of the standard library has a part in them.
TEST(ConstructionDeterminism, OfHierarchiesAndSets) {
  EXPECT_EQ(hash_of(test::synthetic_shapes(7, 16), {{0, 3, all_depths}, true}), 0x64cf4affbfcb9f1c);
}

TEST(ConstructionDeterminism, OfCharactersInPoses) {
  EXPECT_EQ(hash_of(default_male(), {.depths = {0, 3, all_depths}}), 0x0ae29e8faea89305);
  EXPECT_EQ(hash_of(default_female(), {.depths = {0, all_depths}, .heights = true}), 0xd2eb98b938508f11);
}

std::uint64_t hash_of(const BodyModel& model) {
  std::vector<std::uint32_t> words(model.core.begin(), model.core.end());
  const auto add = [&](const auto& some) {
    for (const auto& each : some) {
      std::array<std::uint32_t, sizeof(each) / sizeof(std::uint32_t)> as_words;
      std::memcpy(as_words.data(), &each, sizeof(each));
      words.insert(words.end(), as_words.begin(), as_words.end());
    }
  };
  add(model.influence_begin), add(model.influences), add(model.midpoints), add(model.corner_begin),
      add(model.corners);
  return XXH3_64bits(words.data(), words.size() * sizeof(words[0]));
}

TEST(ConstructionDeterminism, OfModelsOfBodies) {
  EXPECT_EQ(hash_of(make_body(default_male(), {.spheres = 24, .draft = true})), 0x8b56a2ae2e26918bu);
  EXPECT_EQ(hash_of(make_body(default_male(), {.spheres = 24})), 0xeab1e0ce51280adeu);
}

/// Hashes of all that makes shapes: of given outlines, of capsules and discs, of characters as outlines, roots and moving discs.
std::vector<std::uint64_t> hashes_of_all(std::vector<Shape> given) {
  for (Shape& shape : given) shape.hierarchy = contour_hierarchy(shape.outline, 0.02f);
  const std::vector<Capsule> arm{{{0.1f, 0}, {0.1f, 0.7f}, 0.05f}};
  const std::vector<Disc> pair{{0, -0.2f, 0.15f}, {1e-40f, 0.2f, 0.15f}};
  const Character woman = default_pedestrian(Sex::female, 1.63);
  return {hash_of(given, {{0, 3, all_depths}, true}),
          hash_of({shape_from_capsules(arm)}, {}),
          hash_of({shape_from_discs(pair)}, {}),
          hash_of(default_male(), {.heights = true}),
          hash_of(woman, {.depths = {0}, .outlines = false}),
          hash_of({AnimatedShape(animate(default_body(woman, 64), 0)).shape(0.3)}, {})};
}

/// Whoever links with -ffast-math begins with denormal numbers off.
TEST(ConstructionDeterminism, OfTheThreadsFloatingPointState) {
  const std::vector<Shape> given = test::synthetic_shapes(7, 16);
  const std::vector<std::uint64_t> expected = hashes_of_all(given);
  const unsigned before = float_state();
  for (const FloatState& state : odd_float_states()) {
    set_float_state(state.bits);
    const std::vector<std::uint64_t> here = hashes_of_all(given);
    const unsigned after = float_state();
    set_float_state(before);
    EXPECT_EQ(here, expected) << state.name;
    EXPECT_EQ(after, state.bits) << state.name;
  }
}

}  // namespace
}  // namespace bch
