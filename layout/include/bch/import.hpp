// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/characters.hpp>

namespace bch {

/// Reports a file that cannot be imported. The message is one line: the file, a colon, the reason.
class ImportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds the options of import_character(): limits, and values that override the file's.
/// In Collada, `scale` is relative to metres, because assimp applies the file's own unit. The up axis becomes
/// z without any other rotation: in a y-up file, x stays and z becomes -y. So a y-up character that faces +z,
/// as in glTF, faces -y at heading 0: it walks along heading - pi/2.
struct ImportOptions {
  /// Selects the axis of a file's frame that points up.
  enum class UpAxis : std::uint8_t { x, y, z };

  std::optional<UpAxis> up;                       ///< overrides the file's or the guessed axis
  std::optional<float> scale;                     ///< metres per unit; overrides the file's or the guess
  std::vector<std::filesystem::path> clip_files;  ///< files whose clips follow the file's own, in this order
  bool force_clips = false;                       ///< accepts clips of another skeleton, with a note
  std::size_t max_triangles = 0x7fffffff;         ///< every instance counts; files with more are rejected
};

/// Reports on an import by import_character(): what the file contained, and what was imported.
struct ImportReport {
  /// Describes the part of a clip that was imported.
  struct Clip {
    std::string name;
    float seconds = 0;
    std::size_t channels = 0;          ///< channels that move a joint of the character
    std::size_t channels_in_file = 0;  ///< all; others move cameras, helpers, joints without vertices
  };

  std::string format;        ///< the name of the reader
  std::size_t meshes = 0;    ///< instances with triangles
  std::size_t vertices = 0;  ///< after vertices of equal position and influences were merged
  std::size_t triangles = 0;
  std::size_t dropped_faces = 0;     ///< points, lines, and faces whose vertex index is out of range
  std::size_t dropped_vertices = 0;  ///< used by no triangle
  std::size_t bones = 0;             ///< joints that move vertices or are bones of a skin
  float height = 0;                  ///< of the rest pose, metres
  std::vector<Clip> clips;
  std::vector<std::string> notes;  ///< a sentence for every conversion, guess and repair
};

/// Holds a character, and the report on its import.
struct ImportedCharacter {
  Character character;
  ImportReport report;
};

/// Reads a character from a file of glTF 2, PLY, FBX, Collada, MD5, IQM, OBJ or STL; clips also from BVH.
/// The file may have up to 1 GiB and refer to files in its own folder; no file elsewhere is read. All meshes
/// of the scene are read. Units become metres, z up; the notes of the report name what was guessed.
/// "Characters" in layout/README.md says what each format may contain and how clips are matched.
/// Returns: a character that validate() accepts; the same files give the same character.
/// Errors:  throws ImportError.
ImportedCharacter import_character(const std::filesystem::path& file, const ImportOptions& options = {});

/// Holds the limits of import_in_child().
struct ImportLimits {
  std::chrono::milliseconds time{60'000};
  /// The bytes of address space beyond those of this process when the import begins.
  /// Builds with sanitizers need far more and have no such limit.
  std::size_t memory = std::size_t{2} << 30;
  /// Called twenty times per second on the caller's thread; returning false ends the import.
  std::function<bool()> go_on = {};
};

/// Imports a character from an untrusted file in a child process: assimp crashes on some malformed files.
/// The child reads the file as import_character() does, within limits; this process runs no code of assimp.
/// Errors:  throws ImportError, also if the child crashes or exceeds its limits; std::runtime_error if no
///          child can be created.
/// Threads: the child is made by fork() and has only the caller's thread. If another thread holds a lock at
///          the fork, it stays locked in the child (except locks of the C library), and the import may then
///          run into its time limit.
ImportedCharacter import_in_child(const std::filesystem::path& file, const ImportOptions& options = {},
                                  const ImportLimits& limits = {});

}  // namespace bch
