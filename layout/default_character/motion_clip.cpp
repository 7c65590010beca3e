// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/motion_clip.hpp"

#include <algorithm>
#include <cmath>

#include "layout/character/eigen.hpp"

namespace bch::detail {
namespace {

using Eigen::Vector3d;

constexpr int keys_per_second = 16;

/// The vertices that can touch the ground.
class Soles {
 public:
  Soles(const Character& character, const JointPositions& joints) : character_(character), joints_(joints) {
    const float sole_height = 0.02f;
    for (std::uint32_t v = 0; v < character.vertices.size(); ++v)
      if (character.vertices[v].z < sole_height) vertices_.push_back(v);
  }

  std::vector<Vector3d> place(const HumanPose& pose) const {
    const auto to_ground = detail::place(pose, joints_);
    std::vector<Vector3d> points;
    for (const std::uint32_t v : vertices_) {
      Vector3d sum = Vector3d::Zero();
      for (std::uint32_t i = character_.influence_begin[v]; i < character_.influence_begin[v + 1]; ++i) {
        const Influence& influence = character_.influences[i];
        sum += static_cast<double>(influence.weight) *
               (to_ground[influence.bone] *
                (to_eigen(character_.vertices[v]).cast<double>() - joints_[influence.bone]));
      }
      points.push_back(sum);
    }
    return points;
  }

 private:
  const Character& character_;
  const JointPositions& joints_;
  std::vector<std::uint32_t> vertices_;
};

double lowest_height(const std::vector<Vector3d>& points) {
  double low = points.front().z();
  for (const Vector3d& p : points) low = std::min(low, p.z());
  return low;
}

/// How far the pelvis goes while the points that carry stay where they are. The carrying weight of a point
/// falls off within millimetres of height, so that the load passes smoothly from foot to foot.
Vector3d ground_displacement(const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) {
  const double softness = 0.006;
  const double low_before = lowest_height(before);
  const double low_after = lowest_height(after);
  Vector3d displacement = Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double height = std::max(before[i].z() - low_before, after[i].z() - low_after);
    const double weight = std::exp(-height / softness);
    total += weight;
    displacement -= weight * (after[i] - before[i]);
  }
  displacement /= total;
  displacement.z() = 0;
  return displacement;
}

std::vector<HumanPose> grounded(const Soles& soles, const std::vector<double>& times, Travel travel,
                                const Motion& motion) {
  std::vector<HumanPose> poses;
  std::vector<Vector3d> before;
  Vector3d travelled = Vector3d::Zero();
  for (const double time : times) {
    HumanPose pose = motion(time);
    const std::vector<Vector3d> points = soles.place(pose);
    if (travel == Travel::by_feet) {
      if (!poses.empty()) travelled += ground_displacement(before, points);
      before = points;
    }
    pose.pelvis += travelled;
    pose.pelvis.z() -= lowest_height(points);
    poses.push_back(pose);
  }
  return poses;
}

/// The keys of a joint, or a single one if it never moves.
Channel channel(std::uint32_t joint, const std::vector<double>& times, const std::vector<HumanPose>& poses) {
  Channel c;
  c.joint = joint;
  bool moves = false;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Eigen::Quaterniond turn = poses[k].turn[joint].normalized();
    if (k > 0 && turn.dot(poses[k - 1].turn[joint]) < 0) turn.coeffs() *= -1;
    moves = moves || turn.angularDistance(poses[0].turn[joint]) > 1e-6;
    const auto time = static_cast<float>(times[k]);
    c.rotations.push_back({time, quaternion(turn.cast<float>())});
    if (joint == 0) c.positions.push_back({time, vec3(poses[k].pelvis.cast<float>())});
  }
  if (!moves) c.rotations.resize(1);
  return c;
}

}  // namespace

Clip bake(const Character& character, const JointPositions& joints, std::string name, double seconds,
          Travel travel, const Motion& motion) {
  Clip clip{std::move(name), static_cast<float>(seconds), {}};
  const double spans = std::ceil(seconds * keys_per_second);
  std::vector<double> times;
  for (int k = 0; k <= static_cast<int>(spans); ++k) times.push_back(k * seconds / spans);
  const std::vector<HumanPose> poses = grounded(Soles(character, joints), times, travel, motion);
  for (std::uint32_t j = 0; j < body_joint_count; ++j) clip.channels.push_back(channel(j, times, poses));
  return clip;
}

}  // namespace bch::detail
