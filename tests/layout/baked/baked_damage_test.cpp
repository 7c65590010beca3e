// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <new>
#include <system_error>

#include "layout/baked/checksum.hpp"
#include "layout/baked/image.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/test.hpp"

// Baked files that were cut, changed or made up, and the checksum that tells.

namespace bch::test {
namespace {

using detail::baked::Section;

const ShapeSetPlan full_plan{.depths = {0, 3, all_depths}, .outlines = true, .culling = true};

class SpoiledFile : public testing::Test {
 protected:
  BakedBytes bytes{ShapeSet(few_shapes(), full_plan), origins_of(3), few_clips(), few_bodies()};

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
  with([&] { header.section_count = 19; }, "19 sections");
  with([&] { header.zero[6] = 1; }, "where there has to be 0");
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
    EXPECT_NE(error(longer).find("bytes and has 4398046511104"), std::string::npos) << error(longer);
  }
  EXPECT_THROW(load_baked(honest), std::bad_alloc);
}

}  // namespace
}  // namespace bch::test
