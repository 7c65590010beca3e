// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/custom_characters.hpp"

#include <memory>
#include <string>
#include <vector>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"

namespace bch::c_api {
namespace {

std::string text_or(const char* text, const char* otherwise) {
  return text == nullptr ? otherwise : text;
}

Affine3 affine_of(const bch_affine3& given) {
  Affine3 map;
  for (std::size_t row = 0; row < 3; ++row)
    std::copy(std::begin(given.rows[row]), std::end(given.rows[row]), map.rows[row]);
  return map;
}

void add_mesh(Character& to, std::span<const bch_vec3> vertices, std::span<const std::uint32_t> corners) {
  for (const bch_vec3& vertex : vertices) to.vertices.push_back({vertex.x, vertex.y, vertex.z});
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    to.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
}

/// Lets all vertices follow the first bone.
void follow_one_bone(Character& to) {
  to.influences.assign(to.vertices.size(), {0, 1});
  for (std::size_t v = 0; v <= to.vertices.size(); ++v)
    to.influence_begin.push_back(static_cast<std::uint32_t>(v));
}

void stand_still(Character& to) {
  to.joints.push_back({"origin", -1, {}});
  to.bones.push_back({});
  to.root_joint = 0;
}

void add_skeleton(Character& to, const bch_character_arrays& from) {
  const auto parents = array_of(from.parents, from.joint_count, "arrays->parents");
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const char* const name = from.joint_names == nullptr ? nullptr : from.joint_names[i];
    to.joints.push_back(
        {text_or(name, ""), parents[i], from.rests == nullptr ? Affine3{} : affine_of(from.rests[i])});
  }
  const auto joints = array_of(from.bone_joints, from.bone_count, "arrays->bone_joints");
  for (std::size_t i = 0; i < joints.size(); ++i)
    to.bones.push_back(
        {joints[i], from.inverse_binds == nullptr ? Affine3{} : affine_of(from.inverse_binds[i])});
  to.root_joint = from.root_joint;
}

void add_influences(Character& to, const bch_character_arrays& from) {
  if (from.influence_offsets == nullptr) return follow_one_bone(to);
  const auto begin = offsets_of(from.influence_offsets, from.vertex_count, "arrays->influence_offsets");
  for (std::size_t v = 0; v < begin.size(); ++v) {
    if (begin[v] > UINT32_MAX || (v > 0 && begin[v] < begin[v - 1]))
      throw Failure(BCH_INVALID_ARGUMENT, "arrays->influence_offsets[" + std::to_string(v) + "] is " +
                                              std::to_string(begin[v]) + "; expected ascending offsets");
    to.influence_begin.push_back(static_cast<std::uint32_t>(begin[v]));
  }
  for (const bch_influence& each : array_of(from.influences, begin.back(), "arrays->influences"))
    to.influences.push_back({each.bone, each.weight});
}

Vec3 value_of(const float* numbers, Vec3) {
  return {numbers[0], numbers[1], numbers[2]};
}

Quaternion value_of(const float* numbers, Quaternion) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

/// Adds the keys of one part of a channel.
template <class Value>
void add_curve(const bch_curve& from, std::vector<Key<Value>>& keys, Curve<Value>& curve) {
  constexpr std::size_t width = sizeof(Value) / sizeof(float);
  curve.interpolation = one_of(from.interpolation, Interpolation::cubic, "the interpolation of a curve");
  const bool cubic = curve.interpolation == Interpolation::cubic;
  if (from.count > SIZE_MAX / (2 * width))
    throw Failure(BCH_INVALID_ARGUMENT, "the count of a curve is too large");
  const auto times = array_of(from.times, from.count, "the times of a curve");
  const auto values = array_of(from.values, width * from.count, "the values of a curve");
  const auto tangents =
      array_of(from.tangents, cubic ? 2 * width * from.count : 0, "the tangents of a curve");
  for (std::size_t k = 0; k < times.size(); ++k) {
    keys.push_back({times[k], value_of(&values[width * k], Value{})});
    if (cubic)
      curve.tangents.push_back(
          {value_of(&tangents[2 * width * k], Value{}), value_of(&tangents[2 * width * k + width], Value{})});
  }
}

Clip clip_of(const bch_clip& from) {
  Clip clip{text_or(from.name, ""), from.seconds, {}};
  for (const bch_channel& each : array_of(from.channels, from.channel_count, "the channels of a clip")) {
    Channel& channel = clip.channels.emplace_back();
    channel.joint = each.joint;
    add_curve(each.positions, channel.positions, channel.position_curve);
    add_curve(each.rotations, channel.rotations, channel.rotation_curve);
    add_curve(each.scales, channel.scales, channel.scale_curve);
  }
  return clip;
}

Character character_of(const bch_character_arrays& from) {
  Character to;
  to.name = text_or(from.name, "arrays");
  if (from.triangle_count > SIZE_MAX / 3)
    throw Failure(BCH_INVALID_ARGUMENT, "arrays->triangle_count is too large");
  add_mesh(to, array_of(from.vertices, from.vertex_count, "arrays->vertices"),
           array_of(from.triangles, 3 * from.triangle_count, "arrays->triangles"));
  from.joint_count == 0 ? stand_still(to) : add_skeleton(to, from);
  add_influences(to, from);
  for (const bch_clip& clip : array_of(from.clips, from.clip_count, "arrays->clips"))
    to.clips.push_back(clip_of(clip));
  if (from.to_ground != nullptr) to.to_ground = affine_of(*from.to_ground);
  validate(to);
  return to;
}

}  // namespace

Character character_of_mesh(std::span<const bch_vec3> positions, std::span<const std::uint32_t> corners) {
  Character character;
  character.name = "mesh";
  add_mesh(character, positions, corners);
  stand_still(character);
  follow_one_bone(character);
  validate(character);
  return character;
}

}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_character_create(const bch_character_arrays* given, bch_character** character) {
  return guarded([&] {
    required(character, "character");
    const bch_character_arrays arrays =
        sized(&required(given, "arrays"), bch_character_arrays BCH_CHARACTER_ARRAYS_INIT, "arrays");
    auto made = std::make_shared<const Character>(character_of(arrays));
    std::string name = made->name;
    hand_out(std::make_unique<bch_character>(bch_character{std::move(made), std::move(name)}), character);
  });
}
