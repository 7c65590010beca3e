// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstddef>
#include <memory>
#include <string>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/outlines.hpp"
#include "kernel/c_api/posing.hpp"

using namespace bch;
using namespace bch::c_api;

bch_status bch_pose_shaper_create(const bch_character* character, const bch_plan* plan,
                                  bch_pose_shaper** shaper) {
  return guarded([&] {
    required(shaper, "shaper");
    hand_out(std::make_unique<bch_pose_shaper>(object_of(character, "character"), plan_of(plan),
                                               threshold_of(plan)),
             shaper);
  });
}

bch_status bch_pose_shaper_make(bch_pose_shaper* handle, bch_pose pose) {
  return guarded([&] {
    bch_pose_shaper& shaper = object_of(handle, "shaper");
    shaper.made = nullptr;
    shaper.at = {pose.clip, pose.seconds};
    shaper.made = &shaper.shaper.shape(shaper.at);
  });
}

bch_status bch_pose_shaper_make_from_arrays(bch_pose_shaper* handle, const bch_pose_arrays* poses,
                                            size_t index) {
  return guarded([&] {
    bch_pose_shaper& shaper = object_of(handle, "shaper");
    const OwnPoses own(poses, index < SIZE_MAX ? index + 1 : index);
    shaper.made = nullptr;
    shaper.at = {};
    shaper.made = &shape_of_pose(shaper.shaper, own[index], index);
  });
}

bch_status bch_pose_shaper_get_outline(const bch_pose_shaper* handle, bch_outline* outline) {
  return guarded([&] {
    const Outline& made = made_by(object_of(handle, "shaper")).outline;
    OutlineWriter to(outline);
    for (std::size_t i = 0; i < made.contours(); ++i) to.add(made.contour(i));
    to.finish();
  });
}

bch_status bch_pose_shaper_free(bch_pose_shaper* shaper) {
  return free_object(shaper, "shaper");
}
