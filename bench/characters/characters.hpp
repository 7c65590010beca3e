// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <vector>

#include <bch/import.hpp>

namespace bch::cli {

/// Help for an option that takes a character.
constexpr const char* character_help = "Character file (glTF, FBX ...), default:male, :female or :bulky";

/// Help for an option that takes a baked file as well.
constexpr const char* character_or_baked_help =
    "Character file, default:male, :female, :bulky or baked file NAME.bch";

struct LoadedCharacter {
  std::string source;  ///< as the user named it
  Character character;
  ImportReport report;
};

/// Returns whether a file is a baked file by its name, which ends in .bch, in upper or lower case.
bool is_baked(const std::string& file);

/// Returns the name of the character's file without its folders.
std::string file_name(const LoadedCharacter& character);

/// Returns the notes of the imports, each behind its file's name; those of a file once.
std::vector<std::string> notes_of(std::span<const LoadedCharacter> characters);
/// Returns the same as text: a line a note.
std::string notes_text(std::span<const LoadedCharacter> characters);

/// Loads a built-in character or imports a file.
/// Errors:  throws UsageError on a built-in character with import options or an unknown "default:" name,
///          InputError and ImportError on a bad file.
LoadedCharacter load_character(const std::string& source, const ImportOptions& options);

/// Loads all characters: a bad file does not keep the next from being read.
/// Errors:  throws InputErrors of all bad files, and UsageError.
std::vector<LoadedCharacter> load_characters(std::span<const std::string> sources,
                                             const ImportOptions& options);

}  // namespace bch::cli
