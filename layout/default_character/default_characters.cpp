// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <bch/characters.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/eigen.hpp"
#include "layout/default_character/body_weights.hpp"
#include "layout/default_character/character_at_rest.hpp"
#include "layout/default_character/parametric_body.hpp"
#include "layout/default_character/parametric_motion.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::array<const char*, midline_joints + side_joints> joint_names{
    "pelvis", "spine",   "chest", "neck",    "head", "clavicle", "shoulder", "upper arm",
    "elbow",  "forearm", "wrist", "fingers", "hip",  "knee",     "ankle",    "toes"};

std::string joint_name(std::uint32_t joint) {
  if (joint < midline_joints) return joint_names[joint];
  const bool left = joint < midline_joints + side_joints;
  return (left ? "left " : "right ") + std::string(joint_names[left ? joint : joint - side_joints]);
}

}  // namespace

Character detail::character_at_rest(std::string name, const BodyShape& shape) {
  const JointPositions joints = joint_positions(shape);
  Character character;
  character.name = std::move(name);
  for (std::uint32_t j = 0; j < body_joint_count; ++j) {
    Joint joint;
    joint.name = joint_name(j);
    joint.parent = j == 0 ? -1 : static_cast<std::int32_t>(parent_index(j));
    const Eigen::Vector3d parent_at = j == 0 ? Eigen::Vector3d::Zero() : joints[parent_index(j)];
    joint.rest = translation((joints[j] - parent_at).cast<float>());
    character.joints.push_back(joint);
  }
  character.root_joint = 0;
  attach_skin(character, parametric_body(shape), joints);
  return character;
}

namespace {

/// 212 s, the length of the paper's recordings.
void add_clips(Character& character, const Manner& m) {
  const auto add = [&](const char* name, int seconds, Travel travel, const Motion& motion) {
    character.clips.push_back(bake(character, m.joints, name, seconds, travel, motion));
  };
  add("walk", 24, Travel::by_feet, walking(m, {0.98, 1.0}));
  add("walk slow", 12, Travel::by_feet, walking(m, {0.75, 0.82}));
  add("walk fast", 16, Travel::by_feet, walking(m, {1.05, 1.14}));
  add("walk curve left", 12, Travel::by_feet, walking(m, {0.85, 0.92, 0.45}));
  add("walk curve right", 12, Travel::by_feet, walking(m, {0.85, 0.92, -0.45}));
  add("turn left", 10, Travel::authored, turning(m, 1));
  add("turn right", 10, Travel::authored, turning(m, -1));
  add("side-step left", 12, Travel::authored, side_stepping(m, 1));
  add("side-step right", 12, Travel::authored, side_stepping(m, -1));
  add("idle shift", 14, Travel::authored, idling(m, Idle::shift));
  add("idle look around", 10, Travel::authored, idling(m, Idle::search_around));
  add("idle akimbo", 15, Travel::authored, idling(m, Idle::akimbo));
  add("idle arms crossed", 7, Travel::authored, idling(m, Idle::arms_crossed));
  add("idle phone", 14, Travel::authored, idling(m, Idle::phone));
  add("idle wave", 12, Travel::authored, idling(m, Idle::wave));
  add("idle talk", 14, Travel::authored, idling(m, Idle::talk));
  add("idle think", 6, Travel::authored, idling(m, Idle::think));
}

/// Scales a character's metres.
void scale(Character& character, float factor) {
  for (auto& row : character.to_ground.rows)
    for (float& number : row) number *= factor;
}

}  // namespace

double pedestrian_strides_per_second(double metres_per_second) {
  const FloatingPointStateGuard floats;
  return strides_per_second(metres_per_second);
}

Character default_pedestrian(Sex sex, double stature, double shoulders) {
  const FloatingPointStateGuard floats;
  if (!(stature >= 0.8 && stature <= 2.4))
    throw std::invalid_argument("stature of a pedestrian is " + shortest(stature) +
                                ", not from 0.8 to 2.4 m");
  if (!(std::abs(shoulders) <= 1))
    throw std::invalid_argument("shoulders of a pedestrian are turned by " + shortest(shoulders) +
                                ", not from -1 to 1");
  const BodyShape shape = sex == Sex::male ? male_shape() : female_shape();
  const JointPositions joints = joint_positions(shape);
  Character character = character_at_rest(sex == Sex::male ? "pedestrian male" : "pedestrian female", shape);
  const Manner manner{joints, shape.stature, 1, 1, 0.05, 0.8, 0.15, 1};
  for (std::uint32_t k = 0; k < pedestrian_speeds; ++k) {
    const double speed = k * pedestrian_speed_step;
    // The body walks as it is drawn, and is scaled below.
    const Stride stride{speed * shape.stature / stature, strides_per_second(speed), shoulders};
    character.clips.push_back(bake(character, joints, "walk " + shortest(static_cast<float>(speed)) + " m/s",
                                   1 / stride.strides_per_second, Travel::authored,
                                   striding(manner, stride)));
  }
  character.root_joint = static_cast<std::int32_t>(joint_index(BodyJoint::head));
  scale(character, static_cast<float>(stature / shape.stature));
  return character;
}

Character default_male() {
  const FloatingPointStateGuard floats;
  const BodyShape shape = male_shape();
  const JointPositions joints = joint_positions(shape);
  Character character = character_at_rest("default male", shape);
  add_clips(character, {joints, shape.stature, 1.06, 1.04, 0.27, 1.0, 0.27, 1.25});
  return character;
}

Character default_bulky_male() {
  const FloatingPointStateGuard floats;
  const BodyShape shape = bulky_male_shape();
  const JointPositions joints = joint_positions(shape);
  Character character = character_at_rest("default bulky male", shape);
  add_clips(character, {joints, shape.stature, 0.95, 1.02, 0.24, 0.80, 0.30, 0.75});
  return character;
}

Character default_female() {
  const FloatingPointStateGuard floats;
  const BodyShape shape = female_shape();
  const JointPositions joints = joint_positions(shape);
  Character character = character_at_rest("default female", shape);
  add_clips(character, {joints, shape.stature, 0.96, 1.10, 0.19, 1.0, 0.20, 0.9});
  return character;
}

}  // namespace bch
