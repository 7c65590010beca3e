// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <bch/default_characters.hpp>
#include <bch/import.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"

namespace bch::c_api {
namespace {

std::unique_ptr<bch_character> character_of(Character character, std::string name) {
  return std::make_unique<bch_character>(
      bch_character{std::make_shared<const Character>(std::move(character)), std::move(name)});
}

std::unique_ptr<bch_character> default_character(int32_t which) {
  switch (which) {
    case BCH_MALE:
      return character_of(default_male(), "default:male");
    case BCH_FEMALE:
      return character_of(default_female(), "default:female");
    case BCH_BULKY_MALE:
      return character_of(default_bulky_male(), "default:bulky");
    default:
      throw Failure(BCH_INVALID_ARGUMENT, "which is " + std::to_string(which));
  }
}

ImportOptions import_options_of(const bch_import_options& given) {
  ImportOptions options;
  if (given.up != -1) options.up = one_of(given.up, UpAxis::z, "options->up");
  if (given.scale != 0) options.scale = given.scale;
  for (const char* file : array_of(given.clip_files, given.clip_file_count, "options->clip_files"))
    options.clip_files.emplace_back(&required(file, "a path of options->clip_files"));
  options.force_clips = given.force_clips != 0;
  options.most_triangles = given.most_triangles;
  return options;
}

ImportLimits limits_of(const bch_import_options& given, bool& cancelled) {
  if (!(given.seconds > 0 && given.seconds <= 1e6))
    throw Failure(BCH_INVALID_ARGUMENT, "options->seconds is " + std::to_string(given.seconds));
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
    auto character =
        character_of(std::move(imported.character), std::filesystem::path(path).filename().string());
    for (const std::string& note : imported.report.notes) character->notes += note + "\n";
    character->report = std::move(imported.report);
    return character;
  } catch (const ImportError& error) {
    if (cancelled) throw Failure(BCH_CANCELLED, error.what());
    throw;
  }
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_character_default(int32_t which, bch_character** character) {
  return guarded([&] {
    required(character, "character");
    hand_out(default_character(which), character);
  });
}

bch_status bch_character_pedestrian(int32_t sex, double stature, double shoulders,
                                    bch_character** character) {
  return guarded([&] {
    required(character, "character");
    const Sex of = one_of(sex, Sex::male, "sex");
    hand_out(character_of(default_pedestrian(of, stature, shoulders),
                          of == Sex::male ? "pedestrian:male" : "pedestrian:female"),
             character);
  });
}

double bch_pedestrian_strides_per_second(double metres_per_second) {
  return pedestrian_strides_per_second(metres_per_second);
}

bch_status bch_character_import(const char* path, const bch_import_options* options,
                                bch_character** character) {
  return guarded([&] {
    required(path, "path");
    required(character, "character");
    hand_out(import(path, sized<bch_import_options>(options, BCH_IMPORT_OPTIONS_INIT, "options")), character);
  });
}

bch_status bch_character_get_info(const bch_character* handle, bch_character_info* info) {
  return guarded([&] {
    const bch_character& of = object_of(handle, "character");
    const Character& character = *of.character;
    bch_character_info all = BCH_CHARACTER_INFO_INIT;
    all.joints = static_cast<uint32_t>(character.joints.size());
    all.clips = static_cast<uint32_t>(character.clips.size());
    all.height = of.report.height;
    all.vertices = character.vertices.size();
    all.triangles = character.triangles.size();
    all.name = of.name.c_str();
    all.notes = of.notes.c_str();
    fill(info, all, "info");
  });
}

bch_status bch_character_get_clip(const bch_character* character, uint32_t clip, const char** name,
                                  float* seconds) {
  return guarded([&] {
    const std::vector<Clip>& clips = object_of(character, "character").character->clips;
    check_index(clip, clips.size(), "clip");
    const Clip& found = clips[clip];
    if (name != nullptr) *name = found.name.c_str();
    if (seconds != nullptr) *seconds = found.seconds;
  });
}

bch_status bch_character_sample_poses(const bch_character* handle, uint32_t count, bch_pose* poses) {
  return guarded([&] {
    const Character& character = *object_of(handle, "character").character;
    const auto to = array_of(poses, count, "poses");
    const std::vector<PoseTime> times = sample_poses(character, count);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const PoseTime& time = times[std::min(i, times.size() - 1)];
      to[i] = {time.clip, time.seconds};
    }
  });
}

bch_status bch_character_free(bch_character* character) {
  return free_object(character, "character");
}
