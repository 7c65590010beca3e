// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <string>
#include <vector>

#include <bch/poses.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"

namespace bch::c_api {
namespace {

enum class Kind : std::int32_t { parents, world, bones, vertices };
enum class Layout : std::int32_t { float_rows, float_columns, double_rows, double_columns };

bool has_columns(const bch_pose_arrays& arrays) {
  return arrays.layout == BCH_FLOAT_COLUMNS || arrays.layout == BCH_DOUBLE_COLUMNS;
}

/// Returns how many numbers a transform or a vertex takes.
std::size_t numbers_of(const bch_pose_arrays& arrays) {
  if (arrays.kind == BCH_POSED_VERTICES) return 3;
  return has_columns(arrays) ? 16 : 12;
}

template <class Number>
Transforms transforms_of(const bch_pose_arrays& arrays, std::size_t stride, std::size_t pose) {
  const auto* const first = static_cast<const Number*>(arrays.data) + pose * stride * arrays.count;
  return has_columns(arrays) ? Transforms::column_major(first, arrays.count, stride)
                             : Transforms::row_major(first, arrays.count, stride);
}

void write(std::span<const Affine3d> maps, double* rows) {
  required(rows, "rows");
  for (const Affine3d& map : maps) rows = std::copy_n(map.rows[0], 12, rows);
}

PoseTime time_of(const Character& character, const bch_pose& pose) {
  check_pose(character, pose, 0);
  return {pose.clip, pose.seconds};
}

}  // namespace

CustomPoses::CustomPoses(const bch_pose_arrays* given, std::size_t poses)
    : arrays_(sized(&required(given, "poses"), bch_pose_arrays BCH_POSE_ARRAYS_INIT, "poses")) {
  const Kind kind = one_of(arrays_.kind, Kind::vertices, "poses->kind");
  const Layout layout = one_of(arrays_.layout, Layout::double_columns, "poses->layout");
  const std::size_t numbers = numbers_of(arrays_);
  stride_ = arrays_.stride == 0 ? numbers : arrays_.stride;
  const auto reject = [](const char* member, auto value) {
    throw Failure(BCH_INVALID_ARGUMENT, std::string("poses->") + member + " is " + std::to_string(value));
  };
  if (stride_ < numbers || (kind == Kind::vertices && stride_ != numbers)) reject("stride", stride_);
  if (kind == Kind::vertices && layout != Layout::float_rows) reject("layout", arrays_.layout);
  if (stride_ > PTRDIFF_MAX / sizeof(double) ||
      (arrays_.count > 0 && poses > PTRDIFF_MAX / sizeof(double) / stride_ / arrays_.count))
    reject("count", arrays_.count);
  if (poses > 0 && arrays_.count > 0) required(static_cast<const char*>(arrays_.data), "poses->data");
  if (kind != Kind::bones && arrays_.origins != nullptr)
    throw Failure(BCH_INVALID_ARGUMENT, "poses->origins is not NULL, and there are no bone matrices");
}

Pose CustomPoses::operator[](std::size_t i) const {
  if (arrays_.kind == BCH_POSED_VERTICES)
    return PosedVertices{{static_cast<const Vec3*>(arrays_.data) + i * arrays_.count, arrays_.count}};
  const bool is_double = arrays_.layout == BCH_DOUBLE_ROWS || arrays_.layout == BCH_DOUBLE_COLUMNS;
  const Transforms maps =
      is_double ? transforms_of<double>(arrays_, stride_, i) : transforms_of<float>(arrays_, stride_, i);
  if (arrays_.kind == BCH_JOINTS_IN_PARENTS) return LocalPose{maps};
  if (arrays_.kind == BCH_JOINTS_IN_WORLD) return WorldPose{maps};
  if (arrays_.origins == nullptr) return SkinningPalette{maps};
  return SkinningPalette{maps, arrays_.origins[2 * i], arrays_.origins[2 * i + 1]};
}

}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_character_get_joint(const bch_character* character, uint32_t joint, const char** name,
                                   int32_t* parent) {
  return guarded([&] {
    const std::vector<Joint>& joints = object_of(character, "character").character->joints;
    check_index(joint, joints.size(), "joint");
    if (name != nullptr) *name = joints[joint].name.c_str();
    if (parent != nullptr) *parent = joints[joint].parent;
  });
}

bch_status bch_character_find_joint(const bch_character* character, const char* name, uint32_t* joint) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    required(joint, "joint");
    *joint = find_joint(of, &required(name, "name"));
  });
}

bch_status bch_character_get_transforms(const bch_character* character, bch_pose pose, int32_t kind,
                                        double* rows) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    const JointFrame frame = one_of(kind, JointFrame::world, "kind");
    write(joint_transforms(of, time_of(of, pose), frame), rows);
  });
}

bch_status bch_character_blend(const bch_character* character, const bch_pose* poses, const float* weights,
                               size_t count, double* rows) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    const auto times = array_of(poses, count, "poses");
    const auto fractions = array_of(weights, count, "weights");
    check_poses(of, times);
    std::vector<WeightedPose> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back({{times[i].clip, times[i].seconds}, fractions[i]});
    write(blend(of, all), rows);
  });
}

bch_status bch_character_get_vertices(const bch_character* character, bch_pose pose, bch_vec3* positions) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    const auto to = same_array<Vec3>(positions, of.vertices.size(), "positions");
    const std::vector<Vec3> posed = pose_vertices(of, time_of(of, pose));
    std::copy(posed.begin(), posed.end(), to.begin());
  });
}
