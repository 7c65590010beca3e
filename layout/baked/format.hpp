// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <bch/files.hpp>

#include "layout/format/shape_arrays.hpp"

/// Describes the baked file: a shape set as it lies in memory.
///
/// Numbers have the byte order and the representation of the machine that wrote the file: IEEE 754 floats, two's
/// complement, no padding inside records. A file is
///
///     FileHeader                        64 bytes
///     SectionEntry[section_count]       32 bytes each
///     section 0, section 1, ...         each at the next multiple of 64 bytes; zeros up to there
///
/// and ends with the zeros after its last section. There is one entry for each Section, in the order of their numbers,
/// also for those without elements. Everything is determined but the sections' content: an entry's offset is where
/// the section before it, with its zeros, ends.
///
/// Checksums are XXH3, 64 bits, seed 0. That of a section covers its zeros. The header's covers the header, with 0 for
/// the checksum itself, and the entries. So every bit of a file is covered.
///
/// What sections hold. S shapes, L levels, R = S * L roots, index shape * L + level; "or 0" where the set was built
/// without. Records are those of shape_set_view.hpp, field after field, each 4 bytes:
///
///     depths          u32         L       cut depths, ascending; 0xffffffff are the leaves. 1 to 255 of them
///     roots           Root        R       a level's root disc; row is 0 where the cut is that disc; see below
///     trees           Tree        R or 0  where a level's nodes are; 0 where every cut is a single disc
///     nodes           f32         any     see below
///     max_extent      f32         S or 0  metres from the origin to the farthest point, 1e-6 to 1e6; like trees
///     support         f32         any     rows of 64, supports.hpp; or none. Rows 0 and 1 are plus infinity
///     inscribed       DiscBlock   S or 0  interior.hpp; this and the next where there are supports
///     profiles        Profile     S or 0  profile.hpp
///     shape_contours  ContourRange  S or 0  one behind the other; 0 where there are no trees
///     contours        Contour     any     its points, one at least, behind those of the contour before
///     points          Vec2        any     metres; after a contour's last point its first one again
///     leaf_segments   u32         any     see below; or none
///     segment_margin  f32         S or 0  metres, rounding.hpp; like shape_contours
///     heights         Heights     S or 0  metres: a shape's bottom and top, infinite where it has none
///     settings        Settings    1
///     origins         ShapeOrigin S or 0  what each shape shows
///     name_begin      u32         N + 1   name n is bytes [n] to [n + 1] of names
///     names           u8          any     UTF-8
///     clips           ClipRecord  A       moving discs, see below
///     chunks          ChunkRecord any     of one clip behind the other; so are the next three
///     key_times       f64         any     seconds, ascending in a chunk
///     disc_steps      i16         any     x, y and radius of the discs at each key, times the chunk's power of two
///     disc_floats     f32         any     the same of chunks whose numbers are no such, metres
///     body_ends       u64         any     where bytes of each model of a body end among the next; ascending
///     body_bytes      u8          any     of models, see to_bytes(); they are checked when a model is read
///
/// Clips. Each clip takes its number of chunks. Each chunk takes its number of key times, and three numbers a disc and key from disc_steps
/// or, where its step says so, disc_floats. Nothing is left. validate(AnimatedDiscs) lists what is checked of them.
///
/// Rows. Root::row is 0 where the level's cut is a single disc; else 1, except for a shape's last level, which has the row
/// after that of the shape before, from 2 on.
///
/// Nodes. A node's name is the index of its first float, with bit 31 set for a leaf block. A block is 48 floats: x, y
/// and radius of eight discs, eight and eight, the names of the eight nodes below them as u32, their outer radii, and which
/// node of the hierarchy each is, as u32: the number of an inner node, or 2^31 + the index of a cut disc's x. A disc whose x
/// is plus infinity is padding, and what else is said of it has no meaning; the first one is none. A level's blocks lie one
/// behind the other in breadth-first order, first Tree::top: those children that are blocks are the second, the third
/// and so on. After the last, at Tree::discs, come Tree::stride x, as many y and as many radii: the cut's discs, padding up to
/// eight. A leaf block is eight consecutive discs of these, named by the first one's x. At the next multiple of four floats come
/// Tree::count records of an InnerNode, which is numbered by the index of its x by four. From top on, first child after first child
/// leads to the leaf block at the first disc, top itself where it is a leaf block. Levels lie in the order of roots, with at
/// most 9 levels of blocks each. At least 48 floats follow the last one.
///
/// Exact leaves. Tree::segments is 2^32 - 1, or, at depth all_depths of a shape with contours, the index in
/// leaf_segments of the first of Tree::count words; Tree::points is then the index of the shape's first point, else 0.
/// shape_set_view.hpp says what the words, and the lists that follow them in their order, mean. The next tree's words
/// follow the last list.
///
/// Numbers. Coordinates and radii are finite and at most 1e7 m, a root's radius above 0, Extents within rounding.hpp's
/// domain. shape_preconditions() lists all that is checked.
namespace bch::detail::baked {

/// A byte that is no text, so that the file is not taken for text; then line ends that a transfer as text
/// would change.
constexpr std::array<std::uint8_t, 8> magic{0x89, 'B', 'C', 'H', '\r', '\n', 0x1a, '\n'};
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::uint32_t other_byte_order = 0x04030201;
constexpr std::uint32_t version = 9;
constexpr std::size_t alignment = 64;

struct FileHeader {
  std::array<std::uint8_t, 8> magic;
  std::uint32_t byte_order;
  std::uint32_t version;
  std::uint64_t file_size;  ///< bytes
  std::uint32_t section_count;
  std::uint32_t zero[7];
  std::uint64_t checksum;
};
static_assert(sizeof(FileHeader) == 64);

enum class Section : std::uint32_t {
  depths,
  roots,
  trees,
  nodes,
  max_extent,
  support,
  inscribed,
  profiles,
  shape_contours,
  contours,
  points,
  leaf_segments,
  segment_margin,
  heights,
  settings,
  origins,
  name_begin,
  names,
  clips,
  chunks,
  key_times,
  disc_steps,
  disc_floats,
  body_ends,
  body_bytes,
  count,
};
constexpr std::uint32_t section_count = static_cast<std::uint32_t>(Section::count);

struct SectionEntry {
  std::uint32_t section;       ///< its number
  std::uint32_t element_size;  ///< bytes
  std::uint64_t offset;        ///< from the start of the file
  std::uint64_t count;         ///< elements
  std::uint64_t checksum;
};
static_assert(sizeof(SectionEntry) == 32);

struct Settings {
  double threshold;  ///< metres
};

struct Preamble {
  FileHeader header;
  SectionEntry entries[section_count];
};
static_assert(sizeof(Preamble) == sizeof(FileHeader) + section_count * sizeof(SectionEntry));

/// Represents a clip; names by their index, that of the clip 2^32 - 1 where it has none.
struct ClipRecord {
  std::uint32_t character, clip;
  std::uint32_t kind;  ///< clip_loops and clip_in_space, added
  std::uint32_t chunks;
  Heights heights;
};

constexpr std::uint32_t clip_loops = 1,
                        clip_in_space = 2;  ///< discs are spheres, whose fourth numbers are heights

/// Represents a chunk of a clip.
struct ChunkRecord {
  std::uint32_t keys, discs;
  std::int32_t step;  ///< numbers are in disc_steps, times 2^step; or float_step
};
constexpr std::int32_t float_step = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t least_step = -149, largest_step = 20;  ///< of steps that can be

/// Holds the sections of clips.
struct ClipArrays {
  std::span<const ClipRecord> clips;
  std::span<const ChunkRecord> chunks;
  std::span<const double> key_times;
  std::span<const std::int16_t> disc_steps;
  std::span<const float> disc_floats;
};

/// Holds the sections of models of bodies.
struct BodyArrays {
  std::span<const std::uint64_t> ends;
  std::span<const std::byte> bytes;
};

/// Holds all sections of a file.
struct Arrays {
  ShapeArrays shapes;
  std::span<const Settings> settings;
  std::span<const ShapeOrigin> origins;
  std::span<const std::uint32_t> name_begin;
  std::span<const char> names;
  ClipArrays clips = {};
  BodyArrays bodies = {};
};

/// Calls visit(Section, name, span) for every section, in order.
template <class Visit>
void for_each_section(Arrays& arrays, Visit visit) {
  std::uint32_t next = 0;
  const auto visit_next = [&](const char* name, auto& span) { visit(Section{next++}, name, span); };
  for_each_array(visit_next, arrays.shapes);
  visit_next("settings", arrays.settings);
  visit_next("origins", arrays.origins);
  visit_next("name_begin", arrays.name_begin);
  visit_next("names", arrays.names);
  visit_next("clips", arrays.clips.clips);
  visit_next("chunks", arrays.clips.chunks);
  visit_next("key_times", arrays.clips.key_times);
  visit_next("disc_steps", arrays.clips.disc_steps);
  visit_next("disc_floats", arrays.clips.disc_floats);
  visit_next("body_ends", arrays.bodies.ends);
  visit_next("body_bytes", arrays.bodies.bytes);
}

/// Returns how many zeros follow a section of this size, in bytes.
constexpr std::size_t zeros_after(std::uint64_t size) {
  return static_cast<std::size_t>(-size % alignment);
}

/// Returns a section's size with the zeros after it, in bytes.
constexpr std::uint64_t padded(std::uint64_t size) {
  return size + zeros_after(size);
}

/// The offset of the first section, in bytes.
constexpr std::uint64_t sections_offset = padded(sizeof(Preamble));

}  // namespace bch::detail::baked
