// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <new>

#include "layout/baked/checksum.hpp"
#include "layout/baked/image.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test.hpp"

namespace bch::test {
namespace {

using detail::baked::Section;

void expect_same(const detail::ShapeArrays& loaded, const detail::ShapeArrays& expected) {
  detail::baked::Arrays a{loaded, {}, {}, {}, {}}, b{expected, {}, {}, {}, {}};
  std::vector<std::span<const std::byte>> sections;
  detail::baked::for_each_section(
      a, [&](Section, const char*, const auto& span) { sections.push_back(std::as_bytes(span)); });
  detail::baked::for_each_section(b, [&](Section section, const char* name, const auto& span) {
    const auto bytes = sections[static_cast<std::size_t>(section)];
    ASSERT_EQ(bytes.size(), span.size_bytes()) << name;
    if (!bytes.empty()) {
      EXPECT_EQ(std::memcmp(bytes.data(), span.data(), bytes.size()), 0) << name;
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes.data()) % 64, 0u) << name;
    }
  });
}

std::vector<std::uint8_t> answers(const ShapeSet& set) {
  Random random(72);
  const PairScene scene = random_scene(random, set, 4000);
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, hits);
  return hits;
}

TEST(BakedFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  for (const std::vector<std::uint32_t>& depths :
       {std::vector<std::uint32_t>{0}, {all_depths}, {0, 3, all_depths}, {1, 2}})
    for (const bool outlines : {false, true})
      for (const bool culling : {false, true}) {
        const std::vector<Shape> shapes = synthetic_shapes(73, 40);
        const ShapeSet set(shapes, {depths, outlines, culling});
        const ShapeOrigins origins = origins_of(shapes.size());
        const auto file = folder.write("shapes.bch", BakedBytes(set, origins).text());
        for (const FileAccess access : {FileAccess::read, FileAccess::map}) {
          const BakedShapes loaded = load_baked(file, access);
          expect_same(loaded.set.arrays(), set.arrays());
          EXPECT_EQ(loaded.origins, origins);
          EXPECT_EQ(answers(loaded.set), answers(set));
        }
      }
}

TEST(BakedFile, MayHaveNoShapesAndNoOrigins) {
  const ShapeSet none(std::span<const Shape>{}, full_plan);
  EXPECT_EQ(BakedBytes(none, {}).load().set.shape_count(), 0u);
  const ShapeSet set(few_shapes(), full_plan);
  EXPECT_EQ(BakedBytes(set, {}).load().set.shape_count(), 3u);
}

TEST(BakedFile, OutlivesItsName) {
  const TemporaryFolder folder;
  const ShapeSet set(few_shapes(), full_plan);
  const auto file = folder.write("shapes.bch", BakedBytes(set, {}).text());
  const BakedShapes loaded = load_baked(file, FileAccess::map);
  std::filesystem::remove(file);
  EXPECT_EQ(answers(loaded.set), answers(set));
}

TEST(BakedFile, ImageRefusesWhatNobodyCouldLoad) {
  const ShapeSet set(few_shapes(), full_plan);
  EXPECT_THROW(detail::BakedImage(set, origins_of(2)), std::invalid_argument);
  ShapeOrigins origins = origins_of(3);
  origins.names.resize(1);
  EXPECT_THROW(detail::BakedImage(set, origins), std::invalid_argument);
  const auto refusal = [&](const std::function<void(BakedClip&)>& change) {
    std::vector<BakedClip> clips = few_clips();
    change(clips[1]);
    return complaint([&] { detail::BakedImage(set, origins_of(3), clips); });
  };
  EXPECT_EQ(refusal([](BakedClip&) {}), "accepted");
  EXPECT_EQ(refusal([](BakedClip& clip) { clip.character = 4; }), "clips 1: character has name 4");
  EXPECT_EQ(refusal([](BakedClip& clip) { clip.clip = 4; }), "clips 1: clip has name 4");
  EXPECT_EQ(refusal([](BakedClip& clip) { clip.discs.chunks[0].times[1] = 0; }),
            "clips 1: animated shape: chunk 0: expected a key after 0 s, found 0");
}

TEST(BakedFile, FilesThatAreNone) {
  const TemporaryFolder folder;
  EXPECT_THROW(load_baked(folder.path() / "missing.bch"), BakedFileError);
  EXPECT_THROW(load_baked(folder.path()), BakedFileError);
  EXPECT_THROW(load_baked("/dev/null"), BakedFileError);
  EXPECT_THROW(load_baked(folder.write("text.bch", std::string(9999, 'x'))), BakedFileError);
}

/// Such files of the system promise a page and hold a line: as if they had been cut meanwhile.
TEST(BakedFile, FileThatShrinksWhileItIsRead) {
  const std::filesystem::path file = "/sys/kernel/mm/transparent_hugepage/enabled";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file;
  EXPECT_TRUE(has(complaint<BakedFileError>([&] { load_baked(file); }), "shrank from 4096"));
}

TEST(BakedFile, HasItsClips) {
  const ShapeSet set(few_shapes(), full_plan);
  std::vector<BakedClip> clips = few_clips();
  clips[1].discs.heights = {0, 1.5f};
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
      const AnimatedChunk chunk{{0, 1}, 1, {{most * step, -most * step, step}, {0, 0, step}}};
      if (most * step * 3 > 1e6f || most * step < 1e-5f) continue;
      BakedBytes bytes(set, origins_of(3), std::vector<BakedClip>{{0, 1, {{chunk}, false}}});
      EXPECT_EQ(bytes.load().clips[0].discs.chunks[0], chunk) << most << " x " << step;
      EXPECT_EQ(bytes.entry(Section::disc_floats).count == 0, most < 0x1p15f) << most << " x " << step;
    }
}

TEST(BakedFile, HasSpheresOfClips) {
  const ShapeSet set(few_shapes(), full_plan);
  for (const float z : {1.5f, 0.1f}) {  // in 16 bits, and not
    const AnimatedChunk chunk{{0, 1}, 1, {{0, 0, 1}, {0.5f, 0, 1}}, {-1, z}};
    BakedBytes bytes(set, origins_of(3), std::vector<BakedClip>{{0, 1, {{chunk}, true}}});
    EXPECT_EQ(bytes.load().clips[0].discs, (AnimatedDiscs{{chunk}, true}));
    EXPECT_EQ(bytes.entry(Section::disc_floats).count, z == 0.1f ? 8u : 0u);
    bytes.section<detail::baked::ClipRecord>(Section::clips)[0].kind = detail::baked::clip_loops;
    bytes.seal();
    EXPECT_NE(bytes.error(), "");  // two numbers belong to no clip
  }
}

TEST(BakedFile, HasNoLoopsOfNextToNoTime) {
  const ShapeSet set(few_shapes(), full_plan);
  const AnimatedChunk chunk{{0, 1e-12}, 1, {{0, 0, 1}, {0, 0, 1}}};
  BakedBytes bytes(set, origins_of(3), std::vector<BakedClip>{{0, 1, {{chunk}, false}}});
  EXPECT_EQ(bytes.load().clips[0].discs.chunks[0], chunk);
  bytes.section<detail::baked::ClipRecord>(Section::clips)[0].kind = detail::baked::clip_loops;
  bytes.seal();
  EXPECT_EQ(bytes.error(), "file: clips 0: animated shape: expected a loop of at least 0.001 s, found 1e-12");
}

TEST(SaveBaked, WritesTheBytesOfTheSetInPlaceOfAnotherFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "people.bch";
  std::ofstream(file) << "something else";
  const ShapeSet set(few_shapes(), full_plan);
  const ShapeOrigins origins = origins_of(set.shape_count());
  save_baked(file, set, origins, few_clips(), few_bodies());
  EXPECT_EQ(read_text(file), BakedBytes(set, origins, few_clips(), few_bodies()).text());
  EXPECT_EQ(folder.files(), 1);
  const BakedShapes loaded = load_baked(file, FileAccess::map);
  EXPECT_EQ(loaded.origins, origins);
  EXPECT_EQ(loaded.clips, few_clips());
  EXPECT_EQ(loaded.bodies, few_bodies());
  expect_same(loaded.set.arrays(), set.arrays());
}

TEST(SaveBaked, KeepsModelsWithoutShapes) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "people.bch";
  save_baked(file, ShapeSet(std::span<const Shape>()), {}, {}, few_bodies());
  const BakedShapes loaded = load_baked(file);
  EXPECT_EQ(loaded.set.shape_count(), 0u);
  EXPECT_EQ(loaded.bodies, few_bodies());
}

TEST(SaveBaked, LeavesTheFileWhereItCannotWrite) {
  const TemporaryFolder folder;
  const ShapeSet set(few_shapes());
  const std::filesystem::path nowhere = folder.path() / "no folder" / "people.bch";
  EXPECT_EQ(complaint<BakedFileError>([&] { save_baked(nowhere, set); }),
            nowhere.string() + ": No such file or directory");
  const std::filesystem::path file = folder.path() / "people.bch";
  std::ofstream(file) << "kept";
  EXPECT_THROW(save_baked(file, set, origins_of(7)), std::invalid_argument);
  EXPECT_EQ(read_text(file), "kept");
  std::filesystem::create_directories(folder.path() / "folder" / "full");
  EXPECT_THROW(save_baked(folder.path() / "folder", set), BakedFileError);
  EXPECT_EQ(folder.files(), 2);
}

}  // namespace
}  // namespace bch::test
