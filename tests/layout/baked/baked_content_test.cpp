// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <new>
#include <system_error>

#include "layout/baked/checksum.hpp"
#include "layout/baked/image.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/format/shape_validation.hpp"
#include "tests/support/all_queries.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// Baked files whose checksums are right and whose content is not.

namespace bch::test {
namespace {

using detail::baked::Section;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

BakedBytes sound_bytes() {
  return BakedBytes(ShapeSet(few_shapes(), full_plan), origins_of(3), few_clips(), few_bodies());
}

struct Crime {
  const char* error;
  std::function<void(BakedBytes&)> commit;
};

/// Of what no other test of arrays does: shape_preconditions_test has the damage of a set's own.
std::vector<Crime> crimes() {
  const auto floats = [](Section section, std::size_t at, float value) {
    return [=](BakedBytes& b) { b.section<float>(section).data()[at] = value; };
  };
  const auto word = [](Section section, std::size_t at, std::uint32_t value) {
    // Of the section's bytes, whatever its elements are.
    return [=](BakedBytes& b) { b.section<std::uint32_t>(section).data()[at] = value; };
  };
  const auto origin = [](std::size_t at, auto member, auto value) {
    return [=](BakedBytes& b) { b.section<ShapeOrigin>(Section::origins)[at].*member = value; };
  };
  const auto step = [](std::size_t at, std::int16_t value) {
    return [=](BakedBytes& b) { b.section<std::int16_t>(Section::disc_steps)[at] = value; };
  };
  return {
      {"depths 2: expected more than", word(Section::depths, 2, 0)},
      {"threshold",
       [](BakedBytes& b) { b.section<detail::baked::Settings>(Section::settings)[0].threshold = -1; }},
      {"origins 1: character", origin(1, &ShapeOrigin::character, 4u)},
      {"origins 2: clip", origin(2, &ShapeOrigin::clip, 4u)},
      {"origins 0: time", origin(0, &ShapeOrigin::seconds, nan)},
      {"clips 1: character has name 5", word(Section::clips, 6, 5)},
      {"clips 0: clip has name 4", word(Section::clips, 1, 4)},
      {"clips 1: it is of kind 4", word(Section::clips, 8, 4)},
      {"clips 0: 4 of chunks, which has 3 left", word(Section::clips, 3, 4)},
      {"clips 1: 4294967295 of chunks, which has 1 left", word(Section::clips, 9, ~0u)},
      {"clips 1: animated shape: expected at least one chunk, found none", word(Section::clips, 9, 0)},
      {"clips 0: animated shape: heights from nan", floats(Section::clips, 4, nan)},
      {"chunks 0: 4294967295 of key_times, which has 7 left", word(Section::chunks, 0, ~0u)},
      {"chunks 0: 900 of disc_steps, which has 39 left", word(Section::chunks, 1, 100)},
      {"chunks 2: step 2^-150", word(Section::chunks, 8, static_cast<std::uint32_t>(-150))},
      {"chunks 2: step 2^21", word(Section::chunks, 8, 21)},
      {"chunks 0: 27 of disc_floats, which has 6 left", word(Section::chunks, 2, 0x7fffffff)},
      {"chunk 0: expected a key after 1 s, found 0",
       [](BakedBytes& b) { b.section<double>(Section::key_times)[1] = 0; }},
      {"found -0.125 about (0, 0)", step(2, -1)},
      {"clips 1: animated shape: chunk 0: disc 0 at key 1", floats(Section::disc_floats, 4, nan)},
      {"body_ends 1: 2 does not ascend", word(Section::body_ends, 2, 2)},
      {"body_ends: they end with 5, and there are 4 body_bytes", word(Section::body_ends, 4, 5)},
      {"name_begin 2", word(Section::name_begin, 2, 1)},
      {"name_begin 4", word(Section::name_begin, 4, 1000)},
  };
}

/// Damage is called damage, whatever it made of the content, and checked beyond checksums.
TEST(BakedContent, IsCheckedBeyondChecksums) {
  for (const Crime& crime : crimes()) {
    BakedBytes bytes = sound_bytes();
    crime.commit(bytes);
    const std::string damage = bytes.error();
    EXPECT_TRUE(damage.starts_with("file: section ") && damage.ends_with(": wrong checksum")) << damage;
    bytes.seal();
    EXPECT_TRUE(bytes.error().starts_with("file: ")) << bytes.error();
    EXPECT_TRUE(has(bytes.error(), crime.error));
  }
}

/// What no clip names is refused, too: a file says one thing only.
TEST(BakedContent, ClipsLeaveNothing) {
  std::vector<BakedClip> clips = few_clips();
  const ShapeSet set(few_shapes(), {});
  const auto without = [&](Section section, std::uint32_t at, std::uint32_t value) {
    BakedBytes bytes(set, origins_of(3), clips);
    bytes.section<std::uint32_t>(section).data()[at] = value;
    bytes.seal();
    return bytes.error();
  };
  EXPECT_EQ(without(Section::clips, 3, 1), "file: chunks 2: belongs to no clip");
  clips.resize(1);
  EXPECT_EQ(without(Section::chunks, 4, 2), "");
  EXPECT_EQ(without(Section::chunks, 4, 1), "file: disc_steps 33: belongs to no clip");
  EXPECT_EQ(without(Section::chunks, 1, 2), "file: disc_steps 30: belongs to no clip");
}

/// A set of one tree in which only the first disc of every block is not padding. All discs are the same: two of the cut, and
/// the root above them.
struct Chain {
  detail::AlignedVector<std::uint32_t> depths{all_depths};
  detail::AlignedVector<detail::Root> roots{{0, 0, 1, detail::first_row}};
  detail::AlignedVector<detail::Tree> trees;
  detail::AlignedVector<float> max_extent{1}, nodes;

  explicit Chain(std::uint32_t blocks) {
    const std::uint32_t discs = blocks * detail::block_floats;
    const detail::Tree& tree = trees.emplace_back(detail::Tree{0, discs, detail::block_width, 2, 1});
    const std::uint32_t root = tree.first_inner();
    nodes.resize((root + 2) * detail::inner_floats + detail::block_floats);
    for (std::uint32_t block = 0; block < discs; block += detail::block_floats) {
      const std::uint32_t next = block + detail::block_floats;
      store_discs(block, 1);
      nodes[block + detail::block_names] =
          std::bit_cast<float>(next == discs ? detail::leaf_bit + discs : next);
      nodes[block + detail::block_nodes] = std::bit_cast<float>(root);
    }
    store_discs(discs, 2);
    nodes[root * detail::inner_floats + 2] = 1;
    nodes[root * detail::inner_floats + 3] = std::bit_cast<float>(detail::parent_of_cut_disc + root);
  }

  void store_discs(std::uint32_t at, std::uint32_t count) {
    std::fill(nodes.begin() + at + count, nodes.begin() + at + detail::block_width, infinity);
    std::fill_n(nodes.begin() + at + 2 * detail::block_width, count, 1.0f);
  }

  detail::ShapeArrays arrays() const {
    detail::ShapeArrays all{};
    all.depths = depths, all.roots = roots, all.trees = trees, all.max_extent = max_extent, all.nodes = nodes;
    return all;
  }
};

TEST(BakedContent, TreesAreNoDeeperThanStacks) {
  for (std::uint32_t blocks = 1; blocks < 2 * detail::max_wide_levels; ++blocks) {
    const Chain chain(blocks);
    if (blocks < detail::max_wide_levels)
      EXPECT_NO_THROW(validate(chain.arrays())) << blocks;
    else
      EXPECT_THROW(validate(chain.arrays()), std::invalid_argument) << blocks;
  }
}

/// Everything that follows the set's links, also of a copy whose shapes are replaced.
void query(const ShapeSet& set, std::uint64_t seed) {
  Random random(seed);
  Crowd crowd;
  for (int i = 0; i < 24; ++i)
    crowd.add({random.below(set.shape_count()), random.uniform(0, 1.2), random.uniform(0, 1.2),
               random.uniform(0, 6), static_cast<std::uint8_t>(random.below(set.level_count()))});
  std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
  for (std::uint32_t i = 1; i < 24; ++i) pairs.push_back({0, i});
  for (const Implementation& row : test::supported()) {
    query_all(set, crowd.agents(), pairs, row);
    query_all_of_a_dynamic_copy(set, crowd.agents(), pairs, row);
  }
}

/// A shape of many discs, in which hardly anything would be pruned if inner discs might be as large as they like.
TEST(BakedContent, InnerDiscsAreNoLargerThanTheyNeed) {
  Random random(76);
  const std::vector<Shape> shapes = {contour_shape(star(random, 600, 0.2, 0.4), 0.002f)};
  BakedBytes bytes(ShapeSet(shapes, {}), origins_of(1));
  const detail::Tree tree = bytes.section<detail::Tree>(Section::trees)[0];
  ASSERT_GT(tree.discs, tree.top + 20 * detail::block_floats);
  for (const float radius : {0.5f, 1e3f, 1e6f}) {
    BakedBytes huge = bytes;
    const auto damaged = huge.section<float>(Section::nodes);
    for (std::size_t block = tree.top; block < tree.discs; block += detail::block_floats)
      for (std::uint32_t i = 0; i < detail::block_width; ++i)
        if (damaged[block + i] != infinity) damaged[block + 2 * detail::block_width + i] = radius;
    for (std::size_t k = 0; k + 1 < tree.count; ++k)
      damaged[(tree.first_inner() + k) * detail::inner_floats + 2] = radius;
    huge.section<detail::Root>(Section::roots)[0].radius = radius;
    huge.seal();
    EXPECT_TRUE(has(huge.error(), "than what is below it needs")) << radius;
  }
}

/// The plans of files: what a file names may be its only depth, or all it has may be roots.
std::vector<BakedBytes> sound_files() {
  std::vector<BakedBytes> files = {sound_bytes()};
  for (const ShapeSetPlan& plan : {ShapeSetPlan{}, ShapeSetPlan{{0}, false},
                                   ShapeSetPlan{{2, 5}, true, false}, ShapeSetPlan{{0, 1}, false}})
    files.emplace_back(ShapeSet(few_shapes(), plan), origins_of(3));
  return files;
}

/// Whatever gets through gives wrong answers at worst.
TEST(BakedContent, AnythingThatLoadsCanBeQueried) {
  Random random(75);
  const std::vector<BakedBytes> sound = sound_files();
  const std::uint32_t words[] = {0, 1, 0x80000000, ~0u, 0x7f800000, 0x7fc00000, 0xff800000, 0x4b000000};
  int loaded = 0, refused = 0;
  for (std::uint32_t i = 0; i < samples(2'000); ++i) {
    BakedBytes bytes = sound[i % sound.size()];
    const auto section = static_cast<Section>(random.below(static_cast<std::uint32_t>(Section::count)));
    const auto content = bytes.section<std::uint32_t>(section);
    const std::size_t size = content.size() * bytes.entry(section).element_size / 4;
    if (size == 0) continue;
    std::uint32_t& word = content.data()[random.below(static_cast<std::uint32_t>(size))];
    switch (random.below(3)) {
      case 0:
        word ^= 1u << random.below(32);
        break;
      case 1:
        word = words[random.below(std::size(words))];
        break;
      default:
        word += random.below(129) - 64;
    }
    bytes.seal();
    try {
      const BakedShapes shapes = bytes.load();
      ++loaded;
      query(shapes.set, random.next());
      for (const BakedClip& clip : shapes.clips)
        AnimatedShape(clip.discs).shape(clip.discs.chunks[0].times[1]);
    } catch (const BakedFileError&) {
      ++refused;
    }
  }
  EXPECT_GT(loaded, static_cast<int>(samples(100)));
  EXPECT_GT(refused, static_cast<int>(samples(100)));
}

// ---- Baked files that were cut, changed or made up, and the checksum that tells.

class SpoiledFile : public testing::Test {
 protected:
  BakedBytes bytes = sound_bytes();

  void expect_error(const std::string& words) {
    EXPECT_TRUE(bytes.error().starts_with("file: ")) << bytes.error();
    EXPECT_TRUE(has(bytes.error(), words));
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
  with([&] { header.section_count = 19; }, "sections, found 19");
  with([&] { header.zero[6] = 1; }, "expected 0, found");
}

TEST_F(SpoiledFile, SizesThatOverflow) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  for (detail::baked::SectionEntry& entry : bytes.preamble().entries) {
    const auto sound = entry;
    const auto expect_refused = [&](auto member, auto values) {
      for (const auto value : values) {
        entry.*member = value;
        bytes.seal_header();
        EXPECT_NE(bytes.error(), "") << &entry - bytes.preamble().entries << ' ' << value;
        entry = sound;
      }
    };
    const std::uint64_t size = entry.element_size, room = bytes.size();
    expect_refused(
        &detail::baked::SectionEntry::count,
        std::vector<std::uint64_t>{all, all / size, all / size + 1, all / size - 63, std::uint64_t{1} << 63,
                                   room / size + 1, (room - entry.offset) / size + 1,
                                   sound.count + (std::uint64_t{1} << 32)});
    expect_refused(&detail::baked::SectionEntry::offset,
                   std::vector<std::uint64_t>{all, all - 63, 0, room, sound.offset + 64, sound.offset + 1,
                                              sound.offset - 64});
    expect_refused(&detail::baked::SectionEntry::element_size,
                   std::vector<std::uint32_t>{0u, 1u + entry.element_size, ~0u});
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
        pieces.max_extent(random.below(static_cast<std::uint32_t>(size) + 1000));
      EXPECT_EQ(pieces.finish(), whole) << size;
    }
    detail::baked::SectionChecksum beyond(section);
    beyond.max_extent(std::numeric_limits<std::size_t>::max());
    EXPECT_EQ(beyond.finish(), whole) << size;
    section.resize(size + 8);
    EXPECT_EQ(detail::baked::SectionChecksum(std::span(section).first(size)).finish(8),
              detail::baked::checksum(section))
        << size;
  }
}

/// Tests files too large to read into memory: the errors in them are found in their first bytes.
TEST_F(SpoiledFile, SizesBeyondAllMemory) {
  const TemporaryFolder folder;
  constexpr std::uint64_t huge = std::uint64_t{4} << 40;
  const auto text = folder.write("text.bch", std::string(4096, 'x')),
             longer = folder.write("longer.bch", bytes.text());
  detail::baked::SectionEntry& last = bytes.entry(Section::body_bytes);
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
    EXPECT_NE(error(longer).find("bytes, found 4398046511104"), std::string::npos) << error(longer);
  }
  EXPECT_THROW(load_baked(honest), std::bad_alloc);
}

}  // namespace
}  // namespace bch::test
