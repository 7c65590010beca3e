// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/characters.hpp"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <set>
#include <string_view>

#include <bch/characters.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"
#include "layout/character/skinning.hpp"

namespace bch::cli {
namespace {

constexpr std::string_view built_in_prefix = "default:";

float rest_height(const Character& character) {
  detail::Skinner skinner(character);
  const auto positions = skinner.pose({});
  const auto lower = [](const auto& a, const auto& b) { return a.z < b.z; };
  const auto [low, high] = std::minmax_element(positions.begin(), positions.end(), lower);
  return high->z - low->z;
}

ImportReport describe(const Character& character) {
  ImportReport report;
  report.format = "built in";
  report.meshes = 1;
  report.vertices = character.vertices.size();
  report.triangles = character.triangles.size();
  report.bones = character.bones.size();
  report.height = rest_height(character);
  for (const Clip& clip : character.clips)
    report.clips.push_back({clip.name, clip.seconds, clip.channels.size(), clip.channels.size()});
  return report;
}

struct BuiltIn {
  std::string_view name;
  Character (*make)();
};
constexpr BuiltIn built_ins[] = {
    {"male", default_male}, {"female", default_female}, {"bulky", default_bulky_male}};

Character make_built_in(const std::string& source) {
  for (const auto& [name, make] : built_ins)
    if (source == std::string(built_in_prefix) + std::string(name)) return make();
  throw UsageError(source + ": the built-in characters are default:male, default:female and default:bulky");
}

LoadedCharacter built_in(const std::string& source, const ImportOptions& options) {
  if (options.up || options.scale || !options.clip_files.empty())
    throw UsageError(source + ": --clips, --up and --scale are for character files");
  LoadedCharacter loaded{source, make_built_in(source), {}};
  loaded.report = describe(loaded.character);
  return loaded;
}

/// The library's message with this program's name of the limit.
std::string with_own_option(std::string message) {
  constexpr std::string_view name = "ImportOptions::max_triangles";
  if (const std::size_t at = message.rfind(name); at != std::string::npos)
    message.replace(at, name.size(), "--max-triangles");
  return message;
}

}  // namespace

std::string file_name(const LoadedCharacter& character) {
  return character.source.substr(character.source.find_last_of('/') + 1);
}

std::vector<std::string> notes_of(std::span<const LoadedCharacter> characters) {
  std::vector<std::string> notes;
  std::set<std::string> files;
  for (const LoadedCharacter& character : characters) {
    if (!files.insert(character.source).second) continue;
    for (const std::string& note : character.report.notes) notes.push_back(character.source + ": " + note);
  }
  return notes;
}

std::string notes_text(std::span<const LoadedCharacter> characters) {
  std::string text;
  for (const std::string& note : notes_of(characters)) text += fact("  note", note);
  return text;
}

bool is_baked(const std::string& file) {
  constexpr std::string_view end = ".bch";
  return file.size() >= end.size() && strcasecmp(file.c_str() + file.size() - end.size(), end.data()) == 0;
}

LoadedCharacter load_character(const std::string& source, const ImportOptions& options) {
  if (is_baked(source)) throw InputError(source + ": is a baked file, where a character is expected");
  if (source.starts_with(built_in_prefix)) return built_in(source, options);
  try {
    ImportedCharacter imported = import_in_child(source, options);
    return {source, std::move(imported.character), std::move(imported.report)};
  } catch (const ImportError& error) {
    throw ImportError(with_own_option(error.what()));
  }
}

std::vector<LoadedCharacter> load_characters(std::span<const std::string> sources,
                                             const ImportOptions& options) {
  std::vector<LoadedCharacter> loaded;
  std::vector<std::string> errors;
  for (const std::string& source : sources) try {
      loaded.push_back(load_character(source, options));
    } catch (const InputError& error) {
      errors.push_back(error.what());
    } catch (const ImportError& error) {
      errors.push_back(error.what());
    }
  if (!errors.empty()) throw InputErrors(std::move(errors));
  return loaded;
}

}  // namespace bch::cli
