// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/characters.hpp>

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
      throw Failure(BCH_INVALID_ARGUMENT,
                    "which is " + std::to_string(which) + "; expected a built-in character");
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

bch_status bch_character_get_info(const bch_character* handle, bch_character_info* info) {
  return guarded([&] {
    const bch_character& of = object_of(handle, "character");
    const Character& character = *of.character;
    bch_character_info all = BCH_CHARACTER_INFO_INIT;
    all.joints = static_cast<uint32_t>(character.joints.size());
    all.clips = static_cast<uint32_t>(character.clips.size());
    all.height = of.height;
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
