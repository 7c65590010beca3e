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

bch_status bch_shape_builder_create(const bch_character* character, const bch_plan* plan,
                                    bch_shape_builder** shape_builder) {
  return guarded([&] {
    required(shape_builder, "shape_builder");
    hand_out(std::make_unique<bch_shape_builder>(object_of(character, "character"), plan_of(plan),
                                                 threshold_of(plan)),
             shape_builder);
  });
}

bch_status bch_shape_builder_make(bch_shape_builder* handle, bch_pose pose) {
  return guarded([&] {
    bch_shape_builder& shape_builder = object_of(handle, "shape_builder");
    shape_builder.made = nullptr;
    shape_builder.at = {pose.clip, pose.seconds};
    shape_builder.made = &shape_builder.shape_builder.shape(shape_builder.at);
  });
}

bch_status bch_shape_builder_make_from_arrays(bch_shape_builder* handle, const bch_pose_arrays* poses,
                                              size_t index) {
  return guarded([&] {
    bch_shape_builder& shape_builder = object_of(handle, "shape_builder");
    const CustomPoses own(poses, index < SIZE_MAX ? index + 1 : index);
    shape_builder.made = nullptr;
    shape_builder.at = {};
    shape_builder.made = &shape_of_pose(shape_builder.shape_builder, own[index], index);
  });
}

bch_status bch_shape_builder_get_outline(const bch_shape_builder* handle, bch_outline* outline) {
  return guarded([&] {
    const Outline& made = made_by(object_of(handle, "shape_builder")).outline;
    OutlineWriter to(outline);
    for (std::size_t i = 0; i < made.contours(); ++i) to.add(made.contour(i));
    to.finish();
  });
}

bch_status bch_shape_builder_free(bch_shape_builder* shape_builder) {
  return free_object(shape_builder, "shape_builder");
}
