// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <bch/shape_set.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

// Every allocation of a call of the C interface fails once, and once with all that follow it.

namespace bch::test {

/// Makes one call of a round twice: without the memory that it needs, and again with it.
class Attempt {
 public:
  using Call = std::function<bch_status()>;
  using Holds = std::function<bool()>;
  Attempt(Failing mode, std::size_t after) : mode_(mode), after_(after) {}

  /// `untouched` is asked after a failure.
  void operator()(
      const Call& call, const Holds& untouched = [] { return true; }) {
    fail_allocations(mode_, after_);
    const bch_status status = call();
    failures = stop_failing_allocations();
    if (failures == 0) return expect_ok(status);
    EXPECT_EQ(status, BCH_NO_MEMORY) << "allocation " << after_;
    EXPECT_STREQ(bch_last_error(), "out of memory");
    EXPECT_TRUE(untouched()) << "allocation " << after_;
    expect_ok(call());
  }

  std::size_t failures = 0;

 private:
  const Failing mode_;
  const std::size_t after_;
};

/// Runs a round, which leaves nothing behind, with the first, second ... allocation of its attempt failing, or with every
/// `step`-th, until there are no more.
/// Returns: how many allocations the attempt takes.
template <class Round>
std::size_t fail_each(Round round, std::size_t step = 1) {
  Attempt first(Failing::none, 0);
  round(first);  // what is made once in a program is made
  for (std::size_t after = 0;; after += step)
    for (const Failing mode : {Failing::one, Failing::all}) {
      const std::size_t live = live_allocations();
      Attempt attempt(mode, after);
      round(attempt);
      const std::size_t leaked = live_allocations() - live;
      EXPECT_EQ(leaked, 0u) << "allocation " << after;
      if (attempt.failures == 0 || testing::Test::HasFailure()) return after;
    }
}

/// The same for a function that makes an object.
template <class Object, class Make>
std::size_t fail_each_making(Make make, bch_status (*free)(Object*), std::size_t step = 1) {
  return fail_each(
      [&](Attempt& attempt) {
        Object* object = nullptr;
        attempt([&] { return make(&object); }, [&] { return object == nullptr; });
        EXPECT_NE(object, nullptr);
        expect_ok(free(object));
      },
      step);
}

/// The levels of all sets here.
inline const std::vector<std::uint32_t> depths = {0, 2, all_depths};

inline bch_plan c_plan() {
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths.data(), plan.depth_count = depths.size(), plan.heights = 1;
  return plan;
}

/// The file of a set.
inline std::string bytes_of(const bch_shape_set* set) {
  static const TemporaryFolder folder;
  const std::string file = folder.file("set.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return read_text(file);
}

/// A set, a crowd and builders whose calls lack memory.
class CApiAllocationFaults : public testing::Test {
 protected:
  CApiAllocationFaults() {
    Random random(91);
    for (int i = 0; i < 100; ++i)
      crowd.add({random.below(set_of_shapes.shape_count()), random.uniform(0, 4), random.uniform(0, 4),
                 random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3))});
    agents = c_agents(crowd);
    one_thread.threads = 1;
  }

  /// A builder that has a shape already, which stays whatever happens to the next.
  OwnedBuilder begun() const {
    const auto create = [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); };
    auto builder = made<OwnedBuilder>(create);
    const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.125f}};
    expect_ok(bch_shape_set_builder_add_discs(builder.get(), discs, 2, nullptr));
    return builder;
  }

  std::string finished(const OwnedBuilder& builder) const {
    return bytes_of(made<OwnedSet>([&](bch_shape_set** to) {
                      return bch_shape_set_builder_finish(builder.get(), to);
                    }).get());
  }

  /// What a function adds to a builder it adds once, after whatever failed.
  template <class Add>
  std::size_t fail_each_adding(Add add, std::size_t step = 1) {
    const auto expected = begun();
    expect_ok(add(expected.get()));
    const std::string bytes = finished(expected);
    return fail_each(
        [&](Attempt& attempt) {
          const auto builder = begun();
          attempt([&] { return add(builder.get()); });
          EXPECT_EQ(finished(builder), bytes);
        },
        step);
  }

  /// A man who stands, of whom shapes are made.
  OwnedCharacter man() const {
    return made<OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_MALE, to); });
  }

  OwnedShaper standing(const OwnedCharacter& of) const {
    auto shaper =
        made<OwnedShaper>([&](bch_pose_shaper** to) { return bch_pose_shaper_create(of.get(), &plan, to); });
    expect_ok(bch_pose_shaper_make(shaper.get(), {BCH_REST_POSE, 0}, 0));
    return shaper;
  }

  const ShapeSet set_of_shapes{few_shapes(), {.depths = depths, .heights = true}};
  const OwnedSet set = c_set(set_of_shapes);
  const bch_plan plan = c_plan();
  Crowd crowd;
  bch_agents agents;
  bch_query_options one_thread = BCH_QUERY_OPTIONS_INIT;
};

}  // namespace bch::test
