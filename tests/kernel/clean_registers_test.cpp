// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cpuid.h>

#include "layout/base/build_implementation.hpp"
#include "layout/culling/interior.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/test.hpp"

// Whoever leaves something in the upper halves of the registers makes all SSE code after him slow, up to five times.

namespace bch {
namespace {

/// What the processor tells of registers in use (XGETBV with 1): bit 2 the upper halves of YMM, bit 6 those of ZMM.
std::uint32_t upper_halves_in_use() {
  std::uint32_t low = 0, high = 0;
  asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));
  return low & (1u << 2 | 1u << 6);
}

bool can_tell() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  const bool has_xgetbv = __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_OSXSAVE) != 0;
  return has_xgetbv && __get_cpuid_count(0xd, 1, &a, &b, &c, &d) != 0 && (a & 1u << 2) != 0;
}

class CleanRegisters : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_tell()) GTEST_SKIP() << "this processor does not tell which registers are in use";
  }

  static void expect_clean(const std::string& name, const std::function<void()>& call) {
    if (__builtin_cpu_supports("avx") != 0) asm volatile("vzeroupper");
    call();
    EXPECT_EQ(upper_halves_in_use(), 0u) << name;
  }
};

TEST_F(CleanRegisters, AfterQueries) {
  test::Random random(256);
  const ShapeSet shapes(test::synthetic_shapes(257, 16), {{0, 3, all_depths}, true});
  // Less than a register of pairs, whole packets, and some that are left over.
  for (const std::uint32_t count : {1u, 3u, 16u, 256u, 512u, 700u}) {
    const test::PairScene scene = test::random_scene(random, shapes, count);
    const Agents agents = scene.crowd.agents();
    const std::span<const Pair> pairs = scene.pairs;
    std::vector<std::uint8_t> hits(pairs.size());
    std::vector<float> values(pairs.size());
    std::vector<Vec2> directions(pairs.size());
    std::vector<double> x(pairs.size(), 0.5), y(pairs.size(), -0.25);
    std::vector<Penetration> ways(pairs.size());
    bch::Crowd finder;
    for (const Implementation& isa : test::supported()) {
      SCOPED_TRACE(std::string(isa.name) + ", " + std::to_string(count) + " pairs");
      expect_clean("collide", [&] { collide(shapes, agents, pairs, hits, {&isa}); });
      for (const double limit : {0.0, 0.5, 10.0})
        expect_clean("clearance", [&] {
          clearance(shapes, agents, pairs, {values, directions},
                    {.implementation = &isa, .max_distance = limit});
        });
      expect_clean("within", [&] { within(shapes, agents, pairs, x, hits, &isa); });
      expect_clean("time_of_impact", [&] { time_of_impact(shapes, agents, pairs, {x, y}, values, &isa); });
      expect_clean("penetration", [&] { penetration(shapes, agents, pairs, 16, ways, &isa); });
      expect_clean("contacts", [&] { finder.contacts(shapes, agents, pairs, {.implementation = &isa}); });
    }
  }
}

TEST_F(CleanRegisters, AfterConstruction) {
  const Character character = default_male();
  Outline outline;
  for (const detail::BuildImplementation& row : detail::build_implementations()) {
    if (!row.supported()) continue;
    OutlineBuilder builder(character.triangles, character.vertices.size(), character.vertices, row);
    expect_clean(std::string("outline, ") + row.name, [&] { builder.build(character.vertices, outline); });
    detail::HierarchyBuilder hierarchy_builder(row);
    Hierarchy hierarchy;
    expect_clean(std::string("discs, ") + row.name,
                 [&] { hierarchy_builder.contour(outline, 0.01f, detail::SplitRule::centroid, hierarchy); });
    detail::InteriorBuilder interior_builder(row);
    expect_clean(std::string("interior, ") + row.name, [&] { interior_builder.build(outline, 1.0); });
  }
}

}  // namespace
}  // namespace bch
