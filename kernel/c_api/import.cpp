// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bch_files.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include <bch/import.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"

namespace bch::c_api {
namespace {

ImportOptions import_options_of(const bch_import_options& given) {
  ImportOptions options;
  if (given.up != -1) options.up = one_of(given.up, ImportOptions::UpAxis::z, "options->up");
  if (given.scale != 0) options.scale = given.scale;
  for (const char* file : array_of(given.clip_files, given.clip_file_count, "options->clip_files"))
    options.clip_files.emplace_back(&required(file, "a path of options->clip_files"));
  options.force_clips = given.force_clips != 0;
  options.max_triangles = given.max_triangles;
  return options;
}

ImportLimits limits_of(const bch_import_options& given, bool& cancelled) {
  if (!(given.seconds > 0 && given.seconds <= 1e6))
    throw Failure(BCH_INVALID_ARGUMENT, "options->seconds is " + std::to_string(given.seconds) +
                                            "; expected above 0 and at most 1e6");
  ImportLimits limits;
  limits.time = std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(1000 * given.seconds)));
  limits.memory = given.memory;
  if (given.progress != nullptr)
    limits.go_on = [&] { return !(cancelled = cancelled || given.progress(given.user, 0, 0) != 0); };
  return limits;
}

std::unique_ptr<bch_character> import(const char* path, const bch_import_options& given) {
  bool cancelled = false;
  const ImportOptions options = import_options_of(given);
  const ImportLimits limits = limits_of(given, cancelled);
  require_file(path);
  try {
    ImportedCharacter imported = import_in_child(path, options, limits);
    std::string notes;
    for (const std::string& note : imported.report.notes) notes += note + "\n";
    return std::make_unique<bch_character>(
        bch_character{std::make_shared<const Character>(std::move(imported.character)),
                      std::filesystem::path(path).filename().string(), imported.report.height, notes});
  } catch (const ImportError& error) {
    throw Failure(cancelled ? BCH_CANCELLED : BCH_BAD_FILE, error.what());
  }
}

}  // namespace
}  // namespace bch::c_api

using namespace bch::c_api;

bch_status bch_character_import(const char* path, const bch_import_options* options,
                                bch_character** character) {
  return guarded([&] {
    required(path, "path");
    required(character, "character");
    hand_out(import(path, sized<bch_import_options>(options, BCH_IMPORT_OPTIONS_INIT, "options")), character);
  });
}
