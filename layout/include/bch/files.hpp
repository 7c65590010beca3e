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

#include <bch/shapes.hpp>

namespace bch {

/// Tells which character, clip and time a baked shape was made from.
/// Character and clip are indices into ShapeOrigins::names.
struct ShapeOrigin {
  static constexpr std::uint32_t no_clip = 0xffffffff;

  std::uint32_t character = 0;
  std::uint32_t clip = no_clip;
  float seconds = 0;  ///< from the start of the clip
  friend bool operator==(const ShapeOrigin&, const ShapeOrigin&) = default;
};

/// Holds a clip of a character as moving discs, or moving discs of other origin.
/// Character and clip are indices into ShapeOrigins::names.
struct BakedClip {
  std::uint32_t character = 0;
  std::uint32_t clip = ShapeOrigin::no_clip;  ///< by default no name; no_clip means nothing else here
  AnimatedDiscs discs;                        ///< the discs from which an AnimatedShape is made
  friend bool operator==(const BakedClip&, const BakedClip&) = default;
};

/// Holds a model of bodies of spheres as to_bytes() writes it, with its character.
/// body_model() reads it and checks it then, so programs that load only shapes need not link characters.
using BakedBody = std::vector<std::byte>;

/// Tells which characters, clips and times the shapes of a set come from. Queries do not use them.
struct ShapeOrigins {
  double threshold = 0;              ///< of all hierarchies, metres; see contour_hierarchy()
  std::vector<std::string> names;    ///< of characters and clips, as their files have them
  std::vector<ShapeOrigin> origins;  ///< one per shape, or none at all
  friend bool operator==(const ShapeOrigins&, const ShapeOrigins&) = default;
};

/// Reports a baked file that cannot be read, written or trusted.
/// The message is one line that names the file and, where it applies, the section, the place in it and the
/// value.
class BakedFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds the content of a baked file: a set, the origins of its shapes, clips as moving discs, and models of
/// bodies of spheres.
struct BakedShapes {
  ShapeSet set;
  ShapeOrigins origins;
  std::vector<BakedClip> clips = {};
  std::vector<BakedBody> bodies = {};
};

/// Selects how load_baked() accesses the bytes of a file.
enum class FileAccess {
  read,  ///< copies them into memory: safe whatever happens to the file afterwards
  map,   ///< maps them without a copy: for files that no process writes to or shortens while the set lives
};

/// Loads a set from a baked file. The set views the file's bytes without parsing them; clips are copied.
/// Checksums and content are checked first, so even a malicious file can at worst give wrong answers. While
/// the set lives, no process may write to a mapped file or shorten it: bytes that are gone end the process by
/// SIGBUS. Replacing the file (writing another and renaming it) is safe.
/// Cost:    reading or mapping, a pass for the checksums and one for the content.
/// Errors:  throws BakedFileError, std::bad_alloc.
BakedShapes load_baked(const std::filesystem::path& file, FileAccess access = FileAccess::read);

/// Loads a set from bytes in memory, which begin on a cache line and stay unchanged while `memory` lives.
/// Errors call the bytes `name`.
BakedShapes load_baked(std::span<const std::byte> bytes, const std::string& name,
                       std::shared_ptr<const void> memory);

/// Writes a set, clips and models of bodies as a baked file; the same content gives the same bytes.
/// It writes a temporary file beside `file`, and renames it over `file` once it is complete. "Baked files" in
/// layout/README.md has the sizes.
/// Errors:  throws BakedFileError where the file cannot be written, and leaves none; std::invalid_argument
///          where load_baked() would refuse it: on a set() of a DynamicShapeSet of which a shape was
///          replaced, another number of origins than of shapes, names that do not exist, and clips that
///          validate() refuses.
void save_baked(const std::filesystem::path& file, const ShapeSet& set, const ShapeOrigins& origins = {},
                std::span<const BakedClip> clips = {}, std::span<const BakedBody> bodies = {});

}  // namespace bch
