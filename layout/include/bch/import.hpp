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

/// Holds the options of import_character(): values that override those of the file, and limits.
/// In Collada, `scale` is relative to metres, because assimp applies the file's own unit. The up axis becomes
/// z and nothing else turns: in a file that is y up, x stays and z becomes -y. So a y-up character that faces
/// +z, as in glTF, faces -y at heading 0: it walks along heading - pi/2.
struct ImportOptions {
  /// Selects the axis of a file's frame that points up.
  enum class UpAxis : std::uint8_t { x, y, z };

  std::optional<UpAxis> up;                       ///< in place of what the file says or what is guessed
  std::optional<float> scale;                     ///< metres per unit of the file, likewise
  std::vector<std::filesystem::path> clip_files;  ///< files whose clips follow the file's own, in this order
  bool force_clips = false;  ///< also takes clips of another skeleton, with a note; `--force-clips`
  std::size_t max_triangles = 0x7fffffff;  ///< more are refused; those of every instance count
};

/// Reports on an import by import_character(): what the file had, and what became of it.
struct ImportReport {
  /// Describes the part of a clip that was imported.
  struct Clip {
    std::string name;
    float seconds = 0;
    std::size_t channels = 0;          ///< channels that move a joint of the character
    std::size_t channels_in_file = 0;  ///< all; the rest moves cameras, helpers, joints that carry nothing
  };

  std::string format;        ///< what read the file
  std::size_t meshes = 0;    ///< instances that brought triangles
  std::size_t vertices = 0;  ///< vertices that differ in position or influences
  std::size_t triangles = 0;
  std::size_t dropped_faces = 0;     ///< points, lines, faces that name a vertex that is not there
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
/// The file has up to 1 GiB and may name others in the same folder; no further file is read, wherever a path
/// leads. All meshes of the scene count. Units become metres, z up; what is guessed is in the report's notes.
/// "Characters" in layout/README.md says what each format may contain and how clips are matched.
/// Returns: a character that validate() accepts; the same files give the same character.
/// Errors:  throws ImportError.
ImportedCharacter import_character(const std::filesystem::path& file, const ImportOptions& options = {});

/// Holds the limits of import_in_child().
struct ImportLimits {
  std::chrono::milliseconds time{60'000};
  /// Limits the bytes of address space beyond what this process has when the import begins.
  /// Builds with sanitizers, which need far more, set no such limit.
  std::size_t memory = std::size_t{2} << 30;
  std::function<bool()> go_on =
      {};  ///< called twenty times a second on the caller's thread; returning false ends the import
};

/// Imports a character from an untrusted file in a child process: assimp crashes on some malformed files.
/// The child reads the file as import_character() does, within limits; no code of assimp runs in this
/// process.
/// Errors:  throws ImportError, also on a file that crashes or exhausts the child; std::runtime_error where
///          no child can be created.
/// Threads: the child is a fork with only the caller's thread. A lock that another thread holds then, except
///          the C library's own, stays locked in the child, and the import may run into its time limit.
ImportedCharacter import_in_child(const std::filesystem::path& file, const ImportOptions& options = {},
                                  const ImportLimits& limits = {});

}  // namespace bch
