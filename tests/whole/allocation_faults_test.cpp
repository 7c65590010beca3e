// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bch.h>

#include "tests/support/allocation_count.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/test.hpp"

// Every function of the C interface that lacks memory writes nothing, and succeeds when it is called again. Thus what it calls of the C++
// library leaves everything as it was.

namespace bch::test {
namespace {

// Every allocation of a call of the C interface fails once, and once with all that follow it. So it does for what it calls of the C++
// library, which throws std::bad_alloc then.

/// Calls, and expects that nothing but memory is lacking.
/// Returns: whether it is.
template <class Call>
bool lacks_memory(const Call& call) {
  const bch_status status = call();
  if (status == BCH_OK) return false;
  EXPECT_EQ(status, BCH_NO_MEMORY);
  EXPECT_STREQ(bch_last_error(), "out of memory");
  return true;
}

/// Makes the calls of a round that are to lack memory.
class Attempt {
 public:
  Attempt(Failing mode, std::size_t after) : mode_(mode), after_(after) {}

  /// Makes a call without the memory that it needs.
  /// Returns: whether it failed for that.
  template <class Call>
  bool fails(const Call& call) {
    fail_allocations(mode_, after_);
    const bool failed = lacks_memory(call);
    const std::size_t failures = stop_failing_allocations();
    EXPECT_EQ(failed, failures > 0) << "allocation " << after_;
    any_failed = any_failed || failures > 0;
    return failed;
  }

  /// Makes a call without the memory that it needs, asks whether all is as it was, and makes the call again with memory.
  template <class Call>
  void operator()(
      const Call& call, const std::function<bool()>& untouched = [] { return true; }) {
    if (!fails(call)) return;
    EXPECT_TRUE(untouched()) << "allocation " << after_;
    EXPECT_FALSE(lacks_memory(call)) << "after allocation " << after_;
  }

  bool any_failed = false;

 private:
  const Failing mode_;
  const std::size_t after_;
};

/// Runs a round, which leaves nothing behind, with the first, second ... allocation of what it attempts failing, or with every
/// `step`-th, until no more are left. Expects that these are more than `least`.
template <class Round>
void fail_each(std::size_t least, Round round, std::size_t step = 1) {
  Attempt first(Failing::none, 0);
  round(first);  // what is made once in a program is made
  for (std::size_t after = 0;; after += step)
    for (const Failing mode : {Failing::one, Failing::all}) {
      const std::size_t live = live_allocations();
      Attempt attempt(mode, after);
      round(attempt);
      const std::size_t leaked = live_allocations() - live;
      EXPECT_EQ(leaked, 0u) << "allocation " << after;
      if (testing::Test::HasFailure()) return;
      if (!attempt.any_failed) {
        EXPECT_GT(after, least);
        return;
      }
    }
}

const std::vector<std::uint32_t> depths = {0, 2, all_depths};
constexpr float none = 77;

bch_plan c_plan() {
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths.data(), plan.depth_count = depths.size(), plan.heights = 1;
  return plan;
}

/// The same for a function that makes an object.
template <class Object>
void fail_each_making(std::size_t least, const std::function<bch_status(Object**)>& make,
                      bch_status (*free)(Object*), std::size_t step = 1) {
  fail_each(
      least,
      [&](Attempt& attempt) {
        Object* object = nullptr;
        attempt([&] { return make(&object); }, [&] { return object == nullptr; });
        EXPECT_NE(object, nullptr);
        expect_ok(free(object));
      },
      step);
}

/// The same for a function that writes numbers: none of them before all are there.
template <class Number, class RunQuery>
void fail_each_writing(std::size_t least, std::vector<Number>& numbers, RunQuery run_query) {
  const auto untouched = [&] { return std::count(numbers.begin(), numbers.end(), Number(none)); };
  fail_each(least, [&](Attempt& attempt) {
    numbers.assign(numbers.size(), Number(none));
    attempt(run_query, [&] { return untouched() == std::ssize(numbers); });
    EXPECT_EQ(untouched(), 0);
  });
}

std::string bytes_of(const bch_shape_set* set) {
  static const TemporaryFolder folder;
  const std::string file = folder.file("set.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return read_text(file);
}

class AllocationFaults : public testing::Test {
 protected:
  AllocationFaults() {
    Random random(91);
    for (int i = 0; i < 100; ++i)
      crowd.add({random.below(shapes.shape_count()), random.uniform(0, 4), random.uniform(0, 4),
                 random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3))});
    agents = c_agents(crowd);
    options.threads = work.threads = 1;
  }

  /// A builder that has a shape already, which stays whatever happens to the next.
  OwnedBuilder begun() const {
    auto builder = made<bch_shape_set_builder_free>(bch_shape_set_builder_create, &plan);
    add_discs(builder);
    return builder;
  }
  static void add_discs(const OwnedBuilder& to) {
    const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.125f}};
    expect_ok(bch_shape_set_builder_add_discs(to.get(), discs, 2, nullptr));
  }
  static std::string finished(const OwnedBuilder& builder) {
    return bytes_of(made<bch_shape_set_free>(bch_shape_set_builder_finish, builder.get()).get());
  }

  /// What a function adds to a builder it adds once, after whatever failed, and what it could not add leaves nothing behind.
  void fail_each_adding(std::size_t least, const std::function<bch_status(bch_shape_set_builder*)>& add,
                        std::size_t step = 1) {
    const auto expected = begun();
    expect_ok(add(expected.get()));
    const std::string with = finished(expected), without = finished(begun());
    fail_each(
        least,
        [&](Attempt& attempt) {
          const auto builder = begun();
          attempt([&] { return add(builder.get()); });
          EXPECT_EQ(finished(builder), with);
          const auto other = begun();
          const bool failed = attempt.fails([&] { return add(other.get()); });
          EXPECT_EQ(finished(other), failed ? without : with);
        },
        step);
  }

  OwnedCharacter man() const { return made<bch_character_free>(bch_character_default, BCH_MALE); }
  OwnedShapeBuilder standing(const OwnedCharacter& of) const {
    auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, of.get(), &plan);
    expect_ok(bch_shape_builder_make(shape_builder.get(), {BCH_REST_POSE, 0}));
    return shape_builder;
  }

  const ShapeSet shapes{few_shapes(), {.depths = depths, .heights = true}};
  const OwnedSet set = c_set(shapes);
  const bch_plan plan = c_plan();
  Crowd crowd;
  bch_agents agents;
  bch_query_options options = BCH_QUERY_OPTIONS_INIT;
  bch_work work = BCH_WORK_INIT;
  const bch_pose poses[2] = {{BCH_REST_POSE, 0}, {0, 0}};
};

TEST_F(AllocationFaults, Queries) {
  fail_each_making<bch_crowd>(
      1, [](bch_crowd** crowd) { return bch_crowd_create(nullptr, crowd); }, bch_crowd_free);
  for (const bool at_heights : {false, true}) {
    crowd.z.assign(at_heights ? crowd.x.size() : 0, 0);
    if (at_heights) crowd.z[1] = 0.5;
    CScene scene(shapes, crowd, candidate_pairs(shapes, crowd.agents()));
    for (const std::uint32_t threads : {1, 2}) {
      scene.options.threads = threads;
      for (std::size_t q = 0; q < all_queries(scene).size(); ++q) {
        const CQuery with_memory = all_queries(scene)[q];
        const std::string before = with_memory.answers();
        SCOPED_TRACE(with_memory.name);
        expect_ok(with_memory.run_query());
        if (!with_memory.needs_memory && before.size() == with_memory.answers().size()) continue;
        fail_each(1, [&](Attempt& attempt) {
          const CQuery query = all_queries(scene)[q];  // whose object has no memory yet
          attempt(query.run_query, [&] { return query.answers() == before; });
          EXPECT_TRUE(query.answers() == with_memory.answers());
        });
      }
    }
  }
}

TEST_F(AllocationFaults, Obstacles) {
  fail_each_making<bch_obstacles>(
      10,
      [](bch_obstacles** to) {
        return bch_obstacles_from_wkt("POLYGON((2 2, 4 2, 4 4, 2 4), (2.5 2.5, 3 2.5, 3 3))", 1, -1, 3, to);
      },
      bch_obstacles_free);
  const double x[] = {0, 1, 1}, y[] = {0, 0, 1};
  const std::uint64_t paths[] = {0, 2, 3};
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = x, arrays.y = y, arrays.polyline_offsets = paths, arrays.polyline_count = 2;
  fail_each_making<bch_obstacles>(
      5, [&](bch_obstacles** to) { return bch_obstacles_create(&arrays, to); }, bch_obstacles_free);
}

TEST_F(AllocationFaults, NumbersThatFunctionsTell) {
  std::vector<std::size_t> count(1);
  std::vector<bch_disc> discs(1'000);
  fail_each_writing(0, count, [&] {
    return bch_shape_set_get_discs(set.get(), 0, 2, discs.data(), discs.size(), count.data());
  });
  fail_each_writing(2, count,
                    [&] { return bch_shape_set_verify(set.get(), 10, nullptr, nullptr, count.data()); });
  std::vector<double> densities(agents.count);
  fail_each_writing(1, densities, [&] {
    return bch_local_densities(crowd.x.data(), crowd.y.data(), agents.count, 1, densities.data());
  });
  const auto character = man();
  std::vector<std::uint64_t> sampled(5);
  fail_each_writing(0, sampled, [&] {
    return bch_character_sample_poses(character.get(), 5, reinterpret_cast<bch_pose*>(sampled.data()));
  });
  // The threads that a call asks for are made where there is memory for them.
  const bch_pair pair{0, 1};
  std::vector<std::uint8_t> hit(1);
  fail_each(0, [&](Attempt& attempt) {
    const auto run_query = [&](std::uint32_t threads) {
      options.threads = threads;
      return bch_collide(set.get(), &agents, &pair, 1, &options, hit.data());
    };
    expect_ok(run_query(2));
    hit[0] = 77;
    attempt([&] { return run_query(1); }, [&] { return hit[0] == 77; });
    EXPECT_NE(hit[0], 77);
  });
}

TEST_F(AllocationFaults, Files) {
  const TemporaryFolder folder;
  const ShapeOrigins origins = origins_of(shapes.shape_count());
  const auto file = folder.write("a.bch", BakedBytes(shapes, origins, few_clips()).text());
  const std::string copy = folder.file("b.bch"), bytes = bytes_of(set.get());
  for (const std::int32_t access : {BCH_READ, BCH_MAP})
    fail_each_making<bch_shape_set>(
        5, [&](bch_shape_set** to) { return bch_shape_set_load(file.c_str(), access, to); },
        bch_shape_set_free);
  fail_each(5, [&](Attempt& attempt) {
    attempt([&] { return bch_shape_set_save(set.get(), copy.c_str()); });
    EXPECT_EQ(read_text(copy), bytes);
  });
}

TEST_F(AllocationFaults, BuildersAndWhatTheyAdd) {
  fail_each_making<bch_shape_set_builder>(
      3, [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); },
      bch_shape_set_builder_free);
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::uint64_t square[] = {0, 4};
  const bch_heights heights{0, 1};
  const bch_capsule limb{{-0.25f, 0}, {0.25f, 0.125f}, 0.125f};
  const bch_disc disc{0.5f, 0, 0.25f};
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 2}};
  const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  const auto character = man();
  const auto shape_builder = standing(character);
  const bch_character* const people[] = {character.get()};
  const bch_pose_id sources[] = {{0, {BCH_REST_POSE, 0}}, {0, {0, 0}}};
  using To = bch_shape_set_builder*;
  fail_each_adding(
      5, [&](To to) { return bch_shape_set_builder_add_polygons(to, corners, square, 1, &heights); });
  fail_each_adding(5,
                   [&](To to) { return bch_shape_set_builder_add_capsules(to, &limb, 1, 0.01f, nullptr); });
  fail_each_adding(2, [&](To to) { return bch_shape_set_builder_add_discs(to, &disc, 1, &heights); });
  fail_each_adding(2, [&](To to) { return bch_shape_set_builder_add_cylinder(to, 0.25f, nullptr); });
  fail_each_adding(20, [&](To to) { return bch_shape_set_builder_add_mesh(to, positions, 4, triangles, 2); });
  fail_each_adding(5, [&](To to) { return bch_shape_set_builder_add_shape(to, shape_builder.get()); });
  fail_each_adding(
      20, [&](To to) { return bch_shape_set_builder_add_poses(to, character.get(), poses, 2, &work); }, 7);
  fail_each_adding(
      20, [&](To to) { return bch_shape_set_builder_add_pose_ids(to, people, 1, sources, 2, &work); }, 11);
}

/// A set that could not be finished is finished later, or gets more shapes instead; its builder begins another one.
TEST_F(AllocationFaults, Finish) {
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}};
  const std::uint64_t offsets[] = {0, 3};
  const auto add = [&](const OwnedBuilder& to, std::size_t polygons) {
    for (std::size_t i = 0; i < polygons; ++i)
      expect_ok(bch_shape_set_builder_add_polygons(to.get(), corners, offsets, 1, nullptr));
  };
  for (const std::size_t polygons : {0, 1}) {  // discs alone are kept in another way
    const auto of = [&](std::size_t count) {
      auto builder = begun();
      add(builder, count);
      return builder;
    };
    const std::string expected = finished(of(polygons)), more = finished(of(polygons + 1));
    fail_each(5, [&](Attempt& attempt) {
      const auto builder = of(polygons);
      bch_shape_set* whole = nullptr;
      const auto finish = [&] { return bch_shape_set_builder_finish(builder.get(), &whole); };
      attempt(finish, [&] { return whole == nullptr; });
      EXPECT_EQ(bytes_of(whole), expected);
      expect_ok(bch_shape_set_free(whole));
      add_discs(builder), add(builder, polygons);
      if (attempt.fails(finish)) {
        add(builder, 1);
        EXPECT_EQ(finished(builder), more);
      } else {
        expect_ok(bch_shape_set_free(whole));
      }
    });
  }
}

/// Room is made for many.
TEST_F(AllocationFaults, BuildersOfManyShapes) {
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::uint64_t square[] = {0, 4};
  const auto fill = [&](auto add_one) {
    auto builder = begun();
    for (int i = 0; i < 70; ++i)
      add_one([&] { return bch_shape_set_builder_add_polygons(builder.get(), corners, square, 1, nullptr); });
    return finished(builder);
  };
  const std::string expected = fill([](auto add) { expect_ok(add()); });
  fail_each(5, [&](Attempt& attempt) { EXPECT_EQ(fill([&](auto add) { attempt(add); }), expected); });
}

/// A shape builder that ran out of memory makes the same shape later, at whichever allocation it was.
TEST_F(AllocationFaults, AShapeBuilderMakesTheShapeThatItCouldNot) {
  const auto character = man();
  const auto make = [&](auto try_to) {
    const auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, character.get(), &plan);
    try_to([&] { return bch_shape_builder_make(shape_builder.get(), {0, 0.25f}); });
    const auto builder = made<bch_shape_set_builder_free>(bch_shape_set_builder_create, &plan);
    expect_ok(bch_shape_set_builder_add_shape(builder.get(), shape_builder.get()));
    return finished(builder);
  };
  const std::string expected = make([](auto call) { expect_ok(call()); });
  fail_each(20, [&](Attempt& attempt) { EXPECT_EQ(make([&](auto call) { attempt(call); }), expected); });
}

/// A shape that could not be replaced is the one before, and so are all others.
TEST_F(AllocationFaults, DynamicSets) {
  fail_each_making<bch_dynamic_shape_set>(
      5, [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(set.get(), to); },
      bch_dynamic_shape_set_free);
  const auto character = man();
  const auto shape_builder = standing(character);
  fail_each(5, [&](Attempt& attempt) {
    const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, set.get());
    const bch_shape_set* lent = nullptr;
    expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &lent));
    const auto discs = [&] {
      std::string all;
      std::vector<bch_disc> of(1'000);
      for (std::uint32_t shape = 0; shape < shapes.shape_count(); ++shape) {
        std::size_t count = 0;
        expect_ok(bch_shape_set_get_discs(lent, shape, 2, of.data(), of.size(), &count));
        all += bytes(std::span(of).first(count));
      }
      return all;
    };
    const std::string before = discs();
    attempt([&] { return bch_dynamic_shape_set_replace(dynamic.get(), 1, shape_builder.get()); },
            [&] { return discs() == before; });
    EXPECT_TRUE(discs() != before);
  });
  const std::uint32_t which[] = {2, 0};
  fail_each(
      20,
      [&](Attempt& attempt) {
        const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, set.get());
        attempt([&] {
          return bch_dynamic_shape_set_replace_poses(dynamic.get(), character.get(), which, poses, 2, 0.01f,
                                                     &work);
        });
      },
      7);
}

TEST_F(AllocationFaults, CharactersAndScenes) {
  fail_each_making<bch_character>(
      10'000, [](bch_character** to) { return bch_character_default(BCH_FEMALE, to); }, bch_character_free,
      samples(8) == 8 ? 2'003 : 8'009);
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const std::uint32_t triangles[] = {0, 1, 2};
  bch_character_arrays arrays = BCH_CHARACTER_ARRAYS_INIT;
  arrays.vertices = positions, arrays.vertex_count = 3;
  arrays.triangles = triangles, arrays.triangle_count = 1;
  fail_each_making<bch_character>(
      5, [&](bch_character** to) { return bch_character_create(&arrays, to); }, bch_character_free);
  const auto character = man();
  fail_each_making<bch_shape_builder>(
      20, [&](bch_shape_builder** to) { return bch_shape_builder_create(character.get(), &plan, to); },
      bch_shape_builder_free, 3);
  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.poses = poses, of.count = 2;
  fail_each_making<bch_scene_plan>(
      5, [&](bch_scene_plan** to) { return bch_scene_plan_create(&of, nullptr, to); }, bch_scene_plan_free);
}

/// A mistake that there is no memory to describe.
TEST_F(AllocationFaults, Messages) {
  for (const bool memory : {true, false}) {
    float radius = 0;
    fail_allocations(memory ? Failing::none : Failing::all, 0);
    const bch_status status = bch_shape_set_get_radius(nullptr, 0, &radius);
    const bch_status far = bch_shape_set_get_radius(set.get(), 1'000, &radius);
    stop_failing_allocations();
    EXPECT_TRUE(status == BCH_INVALID_ARGUMENT || (!memory && status == BCH_NO_MEMORY)) << status;
    EXPECT_EQ(far, memory ? BCH_OUT_OF_RANGE : BCH_NO_MEMORY);
  }
}

// ---- Queries of pairs need no memory, and objects keep theirs: those of the C interface, and what they call of the C++ library.

/// By the number of threads that calls ask for.
class Allocations : public testing::TestWithParam<std::uint32_t> {
 protected:
  /// Of later calls, the first being over.
  static std::size_t count(const CQuery& query) {
    expect_ok(query.run_query());
    const std::size_t before = allocation_count();
    for (int i = 0; i < 5; ++i) expect_ok(query.run_query());
    return allocation_count() - before;
  }

  static void expect_none(const ShapeSet& set, double step) {
    Random random(53);
    Crowd crowd;
    for (int i = 0; i < 1'500; ++i) {
      crowd.add({random.below(16), random.uniform(0, 67), random.uniform(0, 67), random.uniform(-4, 4),
                 static_cast<std::uint8_t>(random.below(3))});
      if (step > 0) crowd.z.push_back(step * (i % 4));
    }
    std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
    ASSERT_GT(pairs.size(), 1'000u);
    pairs.resize(1'000);
    CScene scene(set, crowd, pairs);
    scene.options.threads = GetParam();
    for (const bool other : {false, true}) {
      scene.options.distance_leaves = other;
      scene.options.implementation = other ? "scalar" : nullptr;
      for (const CQuery& query : all_queries(scene)) {
        const std::size_t counted = count(query);
        EXPECT_EQ(counted > 0, query.needs_memory) << query.name << ": " << counted;
      }
    }
  }

  const std::vector<Shape> bodies = synthetic_shapes(54, 16);
};

TEST_P(Allocations, BodiesOnOneGround) {
  expect_none(ShapeSet(bodies, {{0, 3, all_depths}, true}), 0);
}

TEST_P(Allocations, BodiesAtDifferentHeights) {
  std::vector<Shape> high = bodies;
  for (Shape& body : high) body.heights = {0, 0.5f};
  expect_none(ShapeSet(high, {.depths = {0, 3, all_depths}, .heights = true}), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Threads, Allocations, testing::Values(0, 1, 2, 4),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace bch::test
