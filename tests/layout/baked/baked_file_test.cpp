// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/baked.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <new>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/penetration.hpp>
#include <bch/time_of_impact.hpp>

#include "layout/baked/checksum.hpp"
#include "layout/baked/image.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {
namespace {

using detail::baked::Section;

const ShapeSetPlan full_plan{.depths = {0, 3, all_depths}, .outlines = true, .culling = true};

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

std::vector<std::uint8_t> answers(const ShapeSet& set, Semantics semantics) {
  Random random(72);
  const PairScene scene = random_scene(random, set, 4000);
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, hits, {semantics, nullptr});
  return hits;
}

/// The queries for collision response.
void expect_same_measures(const ShapeSet& loaded, const ShapeSet& expected) {
  Random random(74);
  const PairScene scene = random_scene(random, expected, 300);
  const Agents agents = scene.crowd.agents();
  const std::vector<double> way(scene.pairs.size(), 0.5);
  ContactFinder finder[2];
  Rows<DiscPair> table[2];
  std::vector<Penetration> ways[2];
  std::vector<float> distances[2], times[2];
  std::vector<Vec2> directions(scene.pairs.size());
  for (int i = 0; i < 2; ++i) {
    const ShapeSet& set = i == 0 ? loaded : expected;
    ways[i].resize(scene.pairs.size()), distances[i].resize(scene.pairs.size()),
        times[i].resize(scene.pairs.size());
    table[i] = finder[i].find(set, agents, scene.pairs);
    penetration(set, agents, scene.pairs, 8, ways[i]);
    clearance(set, agents, scene.pairs, {distances[i], directions});
    time_of_impact(set, agents, scene.pairs, {way, way}, times[i]);
  }
  EXPECT_TRUE(std::ranges::equal(table[0].offsets, table[1].offsets));
  EXPECT_TRUE(std::ranges::equal(table[0].values, table[1].values));
  EXPECT_EQ(ways[0], ways[1]);
  EXPECT_EQ(distances[0], distances[1]);
  EXPECT_EQ(times[0], times[1]);
}

TEST(BakedFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  for (const std::vector<std::uint32_t>& depths :
       {std::vector<std::uint32_t>{0}, {all_depths}, {0, 3, all_depths}, {1, 2}})
    for (const bool solid : {false, true})
      for (const bool culling : {false, true}) {
        const std::vector<Shape> shapes = synthetic_shapes(73, 40);
        const ShapeSet set(shapes, {depths, solid, culling});
        const ShapeOrigins origins = origins_of(shapes.size());
        const auto file = folder.write("shapes.bch", BakedBytes(set, origins).text());
        for (const FileAccess access : {FileAccess::read, FileAccess::map}) {
          const BakedShapes loaded = load_baked(file, access);
          expect_same(loaded.set.arrays(), set.arrays());
          EXPECT_EQ(loaded.origins, origins);
          EXPECT_EQ(answers(loaded.set, Semantics::boundary), answers(set, Semantics::boundary));
          expect_same_measures(loaded.set, set);
          if (solid) {
            EXPECT_EQ(answers(loaded.set, Semantics::solid), answers(set, Semantics::solid));
          }
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
  EXPECT_EQ(answers(loaded.set, Semantics::solid), answers(set, Semantics::solid));
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
            "clips 1: animated shape: chunk 0: a key at 0 s after one at 0 s");
}

class SpoiledFile : public testing::Test {
 protected:
  BakedBytes bytes{ShapeSet(few_shapes(), full_plan), origins_of(3), few_clips()};

  void expect_error(const std::string& words) {
    const std::string error = bytes.error();
    EXPECT_TRUE(error.starts_with("file: ")) << error;
    EXPECT_NE(error.find(words), std::string::npos) << "no '" << words << "' in: " << error;
  }
};

TEST_F(SpoiledFile, IsSoundBefore) {
  EXPECT_EQ(bytes.error(), "");
  bytes.seal();
  EXPECT_EQ(bytes.error(), "");
}

TEST_F(SpoiledFile, TruncatedAtEveryByte) {
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(bytes.load_first(size), BakedFileError) << size;
}

/// The header agrees with the size, so that the sections have to be looked at.
TEST_F(SpoiledFile, TruncatedWithAHeaderThatAgrees) {
  for (std::size_t size = sizeof(detail::baked::Preamble); size < bytes.size(); ++size) {
    bytes.preamble().header.file_size = size;
    bytes.seal_header();
    EXPECT_THROW(bytes.load_first(size), BakedFileError) << size;
  }
}

TEST_F(SpoiledFile, TruncatedOnDisk) {
  const TemporaryFolder folder;
  const std::string text = bytes.text();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{4096}, text.size() - 1}) {
    const auto file = folder.write("short.bch", text.substr(0, size));
    EXPECT_THROW(load_baked(file, FileAccess::read), BakedFileError);
    EXPECT_THROW(load_baked(file, FileAccess::map), BakedFileError);
  }
  EXPECT_THROW(load_baked(folder.write("long.bch", text + std::string(64, '\0'))), BakedFileError);
}

TEST_F(SpoiledFile, EveryBitOfTheHeader) {
  for (std::size_t bit = 0; bit < 8 * (sizeof(detail::baked::Preamble) + 32); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1u << bit % 8)};
    bytes[bit / 8] ^= mask;
    EXPECT_NE(bytes.error(), "") << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST_F(SpoiledFile, RandomBits) {
  Random random(74);
  const auto bits = static_cast<std::uint32_t>(8 * bytes.size());
  for (int i = 0; i < 100'000; ++i) {
    const std::uint32_t bit = random.below(bits);
    const std::byte mask{static_cast<unsigned char>(1u << bit % 8)};
    bytes[bit / 8] ^= mask;
    ASSERT_NE(bytes.error(), "") << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST_F(SpoiledFile, SaysWhatIsWrongWithTheHeader) {
  auto& header = bytes.preamble().header;
  const auto sound = header;
  const auto with = [&](auto change, const char* words) {
    change();
    bytes.seal_header();
    expect_error(words);
    header = sound;
  };
  with([&] { header.magic[1] = 'b'; }, "not a baked file");
  with([&] { header.version = 2; }, "version 2");
  with([&] { header.byte_order = detail::baked::other_byte_order; }, "byte order");
  with([&] { header.byte_order = 7; }, "byte order");
  with([&] { header.file_size = ~std::uint64_t{0}; }, "18446744073709551615 bytes");
  with([&] { header.section_count = 19; }, "19 sections");
  with([&] { header.zero[6] = 1; }, "where there has to be 0");
}

TEST_F(SpoiledFile, SizesThatOverflow) {
  for (std::uint32_t i = 0; i < detail::baked::section_count; ++i) {
    auto& entry = bytes.preamble().entries[i];
    const auto sound = entry;
    const std::uint64_t size = entry.element_size;
    for (const std::uint64_t count :
         {~std::uint64_t{0}, ~std::uint64_t{0} / size, ~std::uint64_t{0} / size + 1,
          ~std::uint64_t{0} / size - 63, std::uint64_t{1} << 63, bytes.size() / size + 1,
          (bytes.size() - entry.offset) / size + 1, sound.count + (std::uint64_t{1} << 32)}) {
      entry.count = count;
      bytes.seal_header();
      EXPECT_NE(bytes.error(), "") << i << ' ' << count;
    }
    entry = sound;
    for (const std::uint64_t offset : {~std::uint64_t{0}, ~std::uint64_t{63}, std::uint64_t{0}, bytes.size(),
                                       sound.offset + 64, sound.offset + 1, sound.offset - 64}) {
      entry.offset = offset;
      bytes.seal_header();
      EXPECT_NE(bytes.error(), "") << i << ' ' << offset;
    }
    entry = sound;
    for (const std::uint32_t element : {0u, 1u + entry.element_size, ~0u}) {
      entry.element_size = element;
      bytes.seal_header();
      EXPECT_NE(bytes.error(), "") << i << ' ' << element;
    }
    entry = sound;
  }
  bytes.seal_header();
  EXPECT_EQ(bytes.error(), "");
}

/// Times the elements' size they are the right size again.
TEST_F(SpoiledFile, SizesThatAreRightModulo64Bits) {
  for (detail::baked::SectionEntry& entry : bytes.preamble().entries) {
    const std::uint32_t power = entry.element_size & -entry.element_size;
    if (power == 1) continue;
    const auto sound = entry;
    entry.count += ~std::uint64_t{0} / power + 1;
    ASSERT_EQ(entry.count * entry.element_size, sound.count * entry.element_size);
    bytes.seal_header();
    expect_error("do not fit into the file");
    entry = sound;
  }
}

TEST_F(SpoiledFile, ZerosThatAreNone) {
  const auto& names = bytes.entry(Section::names);
  bytes[names.offset + names.count] = std::byte{1};
  bytes.seal();
  expect_error("section names: no zeros");
}

/// However many pieces it is taken in, and wherever they end.
TEST(SectionChecksum, IsThatOfTheWhole) {
  constexpr std::size_t piece = std::size_t{128} << 10;
  Random random(75);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{64}, piece - 64, piece, piece + 64, 5 * piece + 192}) {
    std::vector<std::byte> section(size);
    for (std::byte& byte : section) byte = static_cast<std::byte>(random.below(256));
    const std::uint64_t whole = detail::baked::checksum(section);
    EXPECT_EQ(detail::baked::SectionChecksum(section).finish(), whole) << size;
    for (int i = 0; i < 20; ++i) {
      detail::baked::SectionChecksum pieces(section);
      for (int step = 0; step < 5; ++step)
        pieces.reach(random.below(static_cast<std::uint32_t>(size) + 1000));
      EXPECT_EQ(pieces.finish(), whole) << size;
    }
    detail::baked::SectionChecksum beyond(section);
    beyond.reach(std::numeric_limits<std::size_t>::max());
    EXPECT_EQ(beyond.finish(), whole) << size;
    section.resize(size + 8);
    EXPECT_EQ(detail::baked::SectionChecksum(std::span(section).first(size)).finish(8),
              detail::baked::checksum(section))
        << size;
  }
}

TEST(BakedFile, FilesThatAreNone) {
  const TemporaryFolder folder;
  EXPECT_THROW(load_baked(folder.path() / "missing.bch"), BakedFileError);
  EXPECT_THROW(load_baked(folder.path()), BakedFileError);
  EXPECT_THROW(load_baked("/dev/null"), BakedFileError);
  EXPECT_THROW(load_baked(folder.write("text.bch", std::string(9999, 'x'))), BakedFileError);
}

/// Tests files too large to read into memory: the errors in them are found in their first bytes.
TEST_F(SpoiledFile, SizesBeyondAllMemory) {
  const TemporaryFolder folder;
  constexpr std::uint64_t huge = std::uint64_t{4} << 40;
  const auto text = folder.write("text.bch", std::string(4096, 'x')),
             longer = folder.write("longer.bch", bytes.text());
  detail::baked::SectionEntry& last = bytes.entry(Section::disc_floats);
  last.count = (huge - last.offset) / last.element_size;
  bytes.preamble().header.file_size = huge;
  bytes.seal_header();
  const auto honest = folder.write("honest.bch", bytes.text());
  for (const auto& file : {text, longer, honest}) {
    std::error_code failed;
    std::filesystem::resize_file(file, huge, failed);
    if (failed) GTEST_SKIP() << "no file of 4 TiB: " << failed.message();
  }
  for (const FileAccess access : {FileAccess::read, FileAccess::map}) {
    const auto error = [&](const auto& file) {
      return complaint<BakedFileError>([&] { load_baked(file, access); });
    };
    EXPECT_EQ(error(text), text.string() + ": not a baked file: it begins differently");
    EXPECT_NE(error(longer).find("bytes and has 4398046511104"), std::string::npos) << error(longer);
  }
  EXPECT_THROW(load_baked(honest), std::bad_alloc);
}

/// Such files of the system promise a page and hold a line: as if they had been cut meanwhile.
TEST(BakedFile, FileThatShrinksWhileItIsRead) {
  const std::filesystem::path file = "/sys/kernel/mm/transparent_hugepage/enabled";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file;
  try {
    load_baked(file);
    ADD_FAILURE() << "loaded";
  } catch (const BakedFileError& error) {
    EXPECT_NE(std::string(error.what()).find("shrank from 4096"), std::string::npos) << error.what();
  }
}

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SaveBaked, WritesTheBytesOfTheSetInPlaceOfAnotherFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "people.bch";
  std::ofstream(file) << "something else";
  const ShapeSet set(few_shapes(), full_plan);
  const ShapeOrigins origins = origins_of(set.shape_count());
  save_baked(file, set, origins, few_clips());
  EXPECT_EQ(text_of_file(file), BakedBytes(set, origins, few_clips()).text());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  const BakedShapes loaded = load_baked(file, FileAccess::map);
  EXPECT_EQ(loaded.origins, origins);
  EXPECT_EQ(loaded.clips, few_clips());
  expect_same(loaded.set.arrays(), set.arrays());
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
  EXPECT_EQ(text_of_file(file), "kept");
  std::filesystem::create_directories(folder.path() / "folder" / "full");
  EXPECT_THROW(save_baked(folder.path() / "folder", set), BakedFileError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

}  // namespace
}  // namespace bch::test
