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

/// Names the character, clip and time that a baked shape was made from.
/// Character and clip are indices into ShapeOrigins::names.
struct ShapeOrigin {
  static constexpr std::uint32_t no_clip = 0xffffffff;  ///< in place of a clip: the rest pose

  std::uint32_t character = 0;
  std::uint32_t clip = no_clip;
  float seconds = 0;  ///< from the start of the clip
  friend bool operator==(const ShapeOrigin&, const ShapeOrigin&) = default;
};

/// Holds moving discs, made from a character's clip or by the caller.
/// Character and clip are indices into ShapeOrigins::names.
struct BakedClip {
  std::uint32_t character = 0;
  std::uint32_t clip = ShapeOrigin::no_clip;  ///< no_clip: the discs have no clip name
  AnimatedDiscs discs;                        ///< what AnimatedShape is made from
  friend bool operator==(const BakedClip&, const BakedClip&) = default;
};

/// Holds a model of bodies of spheres as to_bytes() writes it, with its character.
/// Only body_model() reads and checks it, so programs that load shapes alone need not link characters.
using BakedBody = std::vector<std::byte>;

/// Holds the origins of the shapes of a set. Queries do not use them.
struct ShapeOrigins {
  double threshold = 0;              ///< of all hierarchies, metres; see contour_hierarchy()
  std::vector<std::string> names;    ///< of characters and clips, as in their files
  std::vector<ShapeOrigin> origins;  ///< one per shape, or empty
  friend bool operator==(const ShapeOrigins&, const ShapeOrigins&) = default;
};

/// Reports a baked file that cannot be read, written or trusted.
/// The message is one line that names the file and, where they apply, the section, the position in it and the
/// value.
class BakedFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds the content of a baked file.
/// It is a set, the origins of its shapes, moving discs, and models of bodies of spheres.
struct BakedShapes {
  ShapeSet set;
  ShapeOrigins origins;
  std::vector<BakedClip> clips = {};
  std::vector<BakedBody> bodies = {};
};

/// Selects how load_baked() accesses the bytes of a file.
enum class FileAccess {
  read,  ///< copies the file into memory: safe whatever happens to the file afterwards
  map,   ///< maps the file: no process may write to it or shorten it while the set lives
};

/// Loads a set from a baked file. The set views the file's bytes without parsing them; clips are copied.
/// Checksums and content are checked first, so even a malicious file can at worst give wrong answers. While
/// the set lives, no process may write to a mapped file or shorten it: access to removed bytes ends the
/// process with SIGBUS. Replacing the file (writing another and renaming it) is safe.
/// Cost:    reading or mapping, one pass for the checksums and one for the content.
/// Errors:  throws BakedFileError, std::bad_alloc.
BakedShapes load_baked(const std::filesystem::path& file, FileAccess access = FileAccess::read);

/// Loads a set from bytes in memory.
/// They must be aligned to 64 bytes and stay unchanged while `memory` lives. Error messages use `name` as the
/// name of the file.
BakedShapes load_baked(std::span<const std::byte> bytes, const std::string& name,
                       std::shared_ptr<const void> memory);

/// Writes a set, clips and models of bodies to a baked file. The same content gives the same bytes.
/// The bytes go to a temporary file beside `file`, which is renamed to `file` once it is complete.
/// Errors:  throws BakedFileError if the file cannot be written, and removes the temporary one;
///          std::invalid_argument if load_baked() would reject the content, such as the set() of a
///          DynamicShapeSet after a shape was replaced, fewer or more origins than shapes, indices beyond the
///          names, clips that validate() rejects.
void save_baked(const std::filesystem::path& file, const ShapeSet& set, const ShapeOrigins& origins = {},
                std::span<const BakedClip> clips = {}, std::span<const BakedBody> bodies = {});

}  // namespace bch
