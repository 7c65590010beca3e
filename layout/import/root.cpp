// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "layout/import/clips.hpp"

namespace bch::detail::importing {
namespace {

constexpr double skeleton_fraction = 0.9;  // of all weight: such a joint carries the body, not a limb
constexpr double travel_of_clip = 0.5;     // metres: more than a body sways over its root
constexpr double travel_of_noise = 1e-3;   // metres

/// The joints that carry the body, from a root of the hierarchy down as long as one child carries it.
struct Trunk {
  std::vector<std::size_t> joints;
  std::size_t ancestor = 0;  ///< the lowest that carries all the weight
};

Trunk find_trunk(const Character& character, const std::vector<bool>& bone_is_skin) {
  const std::size_t size = character.joints.size();
  std::vector<double> weight(size, 0.0);
  for (const Influence& influence : character.influences)
    if (bone_is_skin[influence.bone])
      weight[character.bones[influence.bone].joint] += static_cast<double>(influence.weight);
  double total = 0;
  for (const double own : weight) total += own;
  Trunk trunk;
  if (total <= 0) return trunk;

  // Children stand behind their parents, so a sweep from the end sums up the trees below.
  for (std::size_t j = size; j-- > 0;)
    if (character.joints[j].parent >= 0)
      weight[static_cast<std::size_t>(character.joints[j].parent)] += weight[j];
  constexpr double all = 1 - 1e-9;
  for (std::size_t j = 0; j < size; ++j) {
    if (weight[j] >= skeleton_fraction * total) trunk.joints.push_back(j);
    if (weight[j] >= all * total) trunk.ancestor = j;
  }
  if (trunk.joints.empty()) trunk.joints.push_back(0);
  return trunk;
}

/// How far the clips move a joint against its parent, in metres: the largest diagonal of a box around its
/// keys.
double travel(const Character& character, std::size_t joint, double metres_per_unit) {
  double farthest = 0;
  for (const Clip& clip : character.clips)
    for (const Channel& channel : clip.channels) {
      if (channel.joint != joint || channel.positions.empty()) continue;
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3d& position : hull_of_positions(channel)) box.extend(position);
      farthest = std::max(farthest, metres_per_unit * box.diagonal().norm());
    }
  return farthest;
}

}  // namespace

/// Finds the lowest of the trunk's joints with which a clip walks away, so that no shape leaves its origin.
/// If all clips stay in place, it is the topmost that moves at all: what sways below it is motion of the body
/// over its root. Without motion it is the lowest that carries everything, the hips of most skeletons.
std::int32_t find_root_joint(const Character& character, const std::vector<bool>& bone_is_skin) {
  const Trunk trunk = find_trunk(character, bone_is_skin);
  if (trunk.joints.empty()) return -1;
  const std::vector<double> scales = metres_above(character);

  std::size_t root = trunk.ancestor;
  bool moves = false;
  for (const std::size_t joint : trunk.joints) {
    const double distance = travel(character, joint, scales[joint]);
    if (distance > travel_of_clip || (distance > travel_of_noise && !moves)) {
      root = joint;
      moves = true;
    }
  }
  return static_cast<std::int32_t>(root);
}

}  // namespace bch::detail::importing
