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

bch_status bch_pose_shaper_make(bch_pose_shaper* handle, bch_pose pose, int32_t whole) {
  return guarded([&] {
    bch_pose_shaper& shaper = object_of(handle, "shaper");
    shaper.made = nullptr;
    shaper.at = {pose.clip, pose.seconds};
    shaper.made = &shaper.shaper.shape(shaper.at, whole != 0);
  });
}

bch_status bch_pose_shaper_make_own(bch_pose_shaper* handle, const bch_pose_arrays* poses, size_t index,
                                    int32_t whole) {
  return guarded([&] {
    bch_pose_shaper& shaper = object_of(handle, "shaper");
    const OwnPoses own(poses, index < SIZE_MAX ? index + 1 : index);
    shaper.made = nullptr;
    shaper.at = {};
    shaper.made = &shape_of_pose(shaper.shaper, own[index], index, whole != 0);
  });
}

bch_status bch_pose_shaper_get_outline(const bch_pose_shaper* handle, uint32_t slab, bch_outline* outline) {
  return guarded([&] {
    const Shape& shape = made_by(object_of(handle, "shaper"));
    if (slab != BCH_ALL_SLABS && slab > 0 && slab >= shape.slabs.size())
      throw Failure(BCH_OUT_OF_RANGE, "slab is " + std::to_string(slab));
    OutlineWriter to(outline);
    const auto add = [&](const Outline& one) {
      for (std::size_t i = 0; i < one.contours(); ++i) to.add(one.contour(i));
    };
    if (shape.slabs.empty()) add(shape.outline);
    for (std::size_t i = 0; i < shape.slabs.size(); ++i)
      if (slab == BCH_ALL_SLABS || slab == i) add(shape.slabs[i].outline);
    to.finish();
  });
}

bch_status bch_pose_shaper_free(bch_pose_shaper* shaper) {
  return free_object(shaper, "shaper");
}
