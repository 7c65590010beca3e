// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/shape_set.hpp>

namespace bch {

/// The character, clip and time that a baked shape was made from; names by their index in ShapeOrigins.
struct ShapeOrigin {
  static constexpr std::uint32_t rest_pose = 0xffffffff;

  std::uint32_t character = 0;
  std::uint32_t clip = rest_pose;
  float seconds = 0;  ///< from the start of the clip
  friend bool operator==(const ShapeOrigin&, const ShapeOrigin&) = default;
};

/// A clip of a character as moving discs, or moving discs of one's own; names by their index in ShapeOrigins.
struct BakedClip {
  std::uint32_t character = 0;
  std::uint32_t clip = ShapeOrigin::rest_pose;  ///< without a name by default
  AnimatedDiscs discs;                          ///< what an AnimatedShape is made of
  friend bool operator==(const BakedClip&, const BakedClip&) = default;
};

/// The characters, clips and times that the shapes of a set come from. Queries do not use them.
struct ShapeOrigins {
  double threshold = 0;              ///< of all hierarchies, metres; see contour_hierarchy()
  std::vector<std::string> names;    ///< of characters and clips, as their files have them
  std::vector<ShapeOrigin> origins;  ///< one a shape, or none at all
  friend bool operator==(const ShapeOrigins&, const ShapeOrigins&) = default;
};

/// The error of a baked file that cannot be read, written or trusted. The message is one line that names the file and, where it
/// applies, the section, the place in it and the value.
class BakedFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a baked file holds: a set, what its shapes show, and clips as moving discs.
struct BakedShapes {
  ShapeSet set;
  ShapeOrigins origins;
  std::vector<BakedClip> clips = {};
};

/// How load_baked() accesses the bytes of a file.
enum class FileAccess {
  read,  ///< copies them into memory: safe whatever happens to the file afterwards
  map,   ///< maps them without a copy: for files that no process writes to or shortens while the set lives
};

/// Loads a set from a baked file. The set views the file's bytes; nothing of it is parsed, and clips are copied. Checksums and content are checked first,
/// so even a malicious file can give wrong answers at worst.
/// Mapping: while the set lives, no process may write to a mapped file or make it shorter: bytes that were checked would change,
///          and reading those that are gone ends the process by SIGBUS. To replace the file (write another, rename it over
///          this) is fine: the mapping keeps the old one.
/// Cost:    reading or mapping, a pass for the checksums and one for the content.
/// Errors:  throws BakedFileError, std::bad_alloc.
BakedShapes load_baked(const std::filesystem::path& file, FileAccess access = FileAccess::read);

/// Loads a set from bytes in memory, which begin on a cache line and stay unchanged while `memory` lives. Errors call
/// them `name`.
BakedShapes load_baked(std::span<const std::byte> bytes, const std::string& name,
                       std::shared_ptr<const void> memory);

/// Writes a set, and clips, as a baked file: under a temporary name beside it, and renames that over `file` once it is whole. The
/// same set and clips give the same bytes. A clip takes 6 bytes a disc and key where numbers are of 16 bits times a power of two, as
/// those of animate() are, else 12.
/// Errors:  throws BakedFileError where the file cannot be written, and leaves none; std::invalid_argument where load_baked()
///          would refuse it: a set() of a DynamicShapeSet of which a shape was replaced, origins of another number of
///          shapes, origins or clips with names that are not there, and clips that validate() refuses.
void save_baked(const std::filesystem::path& file, const ShapeSet& set, const ShapeOrigins& origins = {},
                std::span<const BakedClip> clips = {});

}  // namespace bch
