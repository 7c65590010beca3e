// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/baked.hpp>

#include <gtest/gtest.h>

#include <vector>

#include "layout/baked/format.hpp"
#include "tests/support/baked_bytes.hpp"

// Clips as moving discs beside the shapes of a baked file.

namespace bch::test {
namespace {

using detail::baked::Section;

const ShapeSetPlan full_plan{.depths = {0, 3, all_depths}, .outlines = true, .culling = true};

TEST(BakedFile, HasItsClips) {
  const ShapeSet set(few_shapes(), full_plan);
  const std::vector<BakedClip> clips = few_clips();
  BakedBytes bytes(set, origins_of(3), clips);
  EXPECT_EQ(bytes.load().clips, clips);
  // The first one's numbers are multiples of 1/8, the second one's are of nothing below 2^15.
  EXPECT_EQ(bytes.entry(Section::disc_steps).count, 3 * 9 + 3 * 4u);
  EXPECT_EQ(bytes.entry(Section::disc_floats).count, 3 * 2u);
  const auto chunks = bytes.section<detail::baked::ChunkRecord>(Section::chunks);
  EXPECT_EQ(chunks[0].step, -3);
  EXPECT_EQ(chunks[1].step, 0);
  EXPECT_EQ(chunks[2].step, detail::baked::float_step);
  EXPECT_EQ(BakedBytes(set, origins_of(3)).load().clips.size(), 0u);
}

/// Numbers at the ends of 16 bits, and one bit beyond.
TEST(BakedFile, ClipsAreStoredExactly) {
  const ShapeSet set(few_shapes(), full_plan);
  for (const float step : {0x1p-30f, 0x1p-15f, 1.0f, 0x1p3f})
    for (const float most : {32767.0f, 32769.0f}) {
      const AnimatedChunk chunk{{0, 1}, 1, {{most * step, -most * step, step}, {0, 0, step}}, {}};
      if (most * step * 3 > 1e6f || most * step < 1e-5f) continue;
      BakedBytes bytes(set, origins_of(3), std::vector<BakedClip>{{0, 1, {{chunk}, false}}});
      EXPECT_EQ(bytes.load().clips[0].discs.chunks[0], chunk) << most << " x " << step;
      EXPECT_EQ(bytes.entry(Section::disc_floats).count == 0, most < 0x1p15f) << most << " x " << step;
    }
}

TEST(BakedFile, HasClipsThatAreCut) {
  const ShapeSet set(few_shapes(), full_plan);
  const AnimatedChunk low{{0, 2}, 1, {{0, 0, 1}, {1, 0, 1}}, {}}, nothing{{0, 1}, 0, {}, {}},
      high{{1, 2}, 1, {{0, 0, 0.5f}, {0, 1, 0.5f}}, {}};
  std::vector<BakedClip> clips = few_clips();
  clips.push_back({0, 1, {{}, true, {0.5f}, {{{low}}, {{nothing, high}}}, {0, 2}}});
  clips.push_back(clips[0]);
  BakedBytes bytes(set, origins_of(3), clips);
  EXPECT_EQ(bytes.load().clips, clips);
  bytes.section<std::uint32_t>(Section::slab_chunks)[3] = 1;
  bytes.seal();
  EXPECT_EQ(bytes.error(),
            "file: clips 2: animated shape: slab 1: it begins or ends at another time than slab 0");
}

TEST(BakedFile, HasNoLoopsOfNextToNoTime) {
  const ShapeSet set(few_shapes(), full_plan);
  const AnimatedChunk chunk{{0, 1e-12}, 1, {{0, 0, 1}, {0, 0, 1}}, {}};
  BakedBytes bytes(set, origins_of(3), std::vector<BakedClip>{{0, 1, {{chunk}, false}}});
  EXPECT_EQ(bytes.load().clips[0].discs.chunks[0], chunk);
  bytes.section<detail::baked::ClipRecord>(Section::clips)[0].loops = 1;
  bytes.seal();
  EXPECT_EQ(bytes.error(), "file: clips 0: animated shape: a loop of 1e-12 s, which is shorter than 0.001 s");
}

}  // namespace
}  // namespace bch::test
