// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "baselines/capsule_fit.hpp"
#include "baselines/ragdoll.hpp"
#include "layout/character/eigen.hpp"

// Which vertices share a capsule? Joints that nearly move together are merged, long and flat groups are halved: what costs least, until
// the number is right.

namespace bch::baselines {
namespace {

using Eigen::Vector3d;

constexpr int most_exchanges = 20;

Eigen::Affine3d to_eigen(const Affine3d& map) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) result.matrix()(row, column) = map.rows[row][column];
  return result;
}

/// Returns the transforms of joints with the root's point on the ground as the origin.
std::vector<Eigen::Affine3d> rooted(const Character& character, std::span<const Affine3d> joints) {
  std::vector<Eigen::Affine3d> maps;
  for (const Affine3d& joint : joints) maps.push_back(to_eigen(joint));
  if (character.root_joint < 0) return maps;
  const Vector3d root = maps[static_cast<std::size_t>(character.root_joint)].translation();
  for (Eigen::Affine3d& map : maps) map.pretranslate(Vector3d(-root.x(), -root.y(), 0));
  return maps;
}

Vector3d to_eigen(const Vec3& p) {
  return detail::to_eigen(p).cast<double>();
}

/// Holds vertices that share a capsule, and the joint that moves it.
struct Group {
  std::vector<std::uint32_t> vertices, joints;  ///< joints: of the vertices, in order
  std::uint32_t joint = 0;
  double error = 0;
};

class Fit {
 public:
  Fit(const Character& character, std::span<const std::vector<Affine3d>> poses)
      : character_(character), weights_(areas()), joint_of_vertex_(strongest_joints()) {
    for (const std::vector<Affine3d>& joints : poses) {
      maps_.push_back(rooted(character, joints));
      posed_.push_back(posed(maps_.back()));
    }
  }

  std::vector<Capsule> capsules(std::uint32_t count) {
    split_by_joints();
    while (groups_.size() > count) merge();
    while (groups_.size() < count) halve();
    for (int i = 0; i < most_exchanges; ++i) {
      const std::vector<Group> before = groups_;
      const double error = total_error();
      halve(), merge();
      if (total_error() < error) continue;
      groups_ = before;
      break;
    }
    std::vector<Capsule> capsules;
    for (const Group& group : groups_) capsules.push_back(capsule(group));
    return capsules;
  }

 private:
  /// A third of the area of all triangles at a vertex, where bind positions are.
  std::vector<double> areas() const {
    std::vector<double> areas(character_.vertices.size());
    for (const auto& corners : character_.triangles) {
      const auto at = [&](std::size_t i) { return to_eigen(character_.vertices[corners[i]]); };
      const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 6;
      for (const std::uint32_t corner : corners) areas[corner] += area;
    }
    return areas;
  }
  std::span<const Influence> influences(std::size_t vertex) const {
    return std::span(character_.influences)
        .subspan(character_.influence_begin[vertex],
                 character_.influence_begin[vertex + 1] - character_.influence_begin[vertex]);
  }
  std::vector<std::uint32_t> strongest_joints() const {
    std::vector<std::uint32_t> joints;
    for (std::size_t v = 0; v < character_.vertices.size(); ++v) {
      const auto of = influences(v);
      joints.push_back(character_
                           .bones[std::max_element(of.begin(), of.end(),
                                                   [](const Influence& a, const Influence& b) {
                                                     return a.weight < b.weight;
                                                   })
                                      ->bone]
                           .joint);
    }
    return joints;
  }
  std::vector<Vector3d> posed(std::span<const Eigen::Affine3d> joints) const {
    std::vector<Eigen::Affine3d> bones;
    for (const Bone& bone : character_.bones)
      bones.push_back(joints[bone.joint] * detail::to_eigen(bone.inverse_bind).cast<double>());
    std::vector<Vector3d> positions;
    for (std::size_t v = 0; v < character_.vertices.size(); ++v) {
      Vector3d& at = positions.emplace_back(Vector3d::Zero());
      for (const Influence& of : influences(v))
        at += static_cast<double>(of.weight) * (bones[of.bone] * to_eigen(character_.vertices[v]));
    }
    return positions;
  }

  /// Where a joint sees vertices in all poses: in metres, as they are in the first pose.
  std::vector<WeightedPoint> points(const Group& group) const {
    std::vector<WeightedPoint> points;
    for (std::size_t p = 0; p < posed_.size(); ++p) {
      const Eigen::Affine3d back = maps_[0][group.joint] * maps_[p][group.joint].inverse();
      for (const std::uint32_t v : group.vertices) points.push_back({back * posed_[p][v], weights_[v]});
    }
    return points;
  }

  void split_by_joints() {
    std::map<std::uint32_t, Group> of_joint;
    for (std::size_t v = 0; v < weights_.size(); ++v)
      if (weights_[v] > 0) of_joint[joint_of_vertex_[v]].vertices.push_back(static_cast<std::uint32_t>(v));
    for (auto& [joint, group] : of_joint) {
      group.joints = {joint}, group.joint = joint;
      measure(group);
      groups_.push_back(std::move(group));
    }
    if (groups_.empty()) throw std::invalid_argument("a ragdoll of a character without triangles");
  }

  void measure(Group& group) const { group.error = rough_capsule(points(group)).error; }

  double total_error() const {
    double sum = 0;
    for (const Group& group : groups_) sum += group.error;
    return sum;
  }

  bool has_group(std::int32_t joint) const {
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& group) {
      return std::binary_search(group.joints.begin(), group.joints.end(), static_cast<std::uint32_t>(joint));
    });
  }
  /// The next joint up that moves vertices the most; -1: none.
  std::int32_t parent(std::uint32_t joint) const {
    std::int32_t up = character_.joints[joint].parent;
    while (up >= 0 && !has_group(up)) up = character_.joints[static_cast<std::size_t>(up)].parent;
    return up;
  }
  bool adjacent(const Group& a, const Group& b) const {
    const auto reaches = [&](const Group& from, const Group& to) {
      return std::any_of(from.joints.begin(), from.joints.end(), [&](std::uint32_t joint) {
        const std::int32_t up = parent(joint);
        return std::binary_search(to.joints.begin(), to.joints.end(), joint) ||
               (up >= 0 &&
                std::binary_search(to.joints.begin(), to.joints.end(), static_cast<std::uint32_t>(up)));
      });
    };
    return reaches(a, b) || reaches(b, a);
  }

  static std::vector<std::uint32_t> united(const std::vector<std::uint32_t>& a,
                                           const std::vector<std::uint32_t>& b) {
    std::vector<std::uint32_t> all;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
    return all;
  }

  /// Merges the two neighbours that then have the least error more, on the joint of one of them.
  void merge() {
    double least = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0;
    Group best;
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (std::size_t j = i + 1; j < groups_.size(); ++j) {
        const Group &a = groups_[i], &b = groups_[j];
        if (!adjacent(a, b)) continue;
        for (const std::uint32_t joint : {a.joint, b.joint}) {
          Group both{united(a.vertices, b.vertices), united(a.joints, b.joints), joint};
          measure(both);
          if (both.error - a.error - b.error < least)
            least = both.error - a.error - b.error, first = i, second = j, best = std::move(both);
        }
      }
    groups_[first] = std::move(best);
    groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(second));
  }

  /// Halves the group that then has the least error, across one of its axes.
  void halve() {
    double most = -std::numeric_limits<double>::infinity();
    std::size_t of = 0;
    std::array<Group, 2> best;
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        std::optional<std::array<Group, 2>> halves = halved(groups_[i], axis);
        if (!halves) continue;
        const double gain = groups_[i].error - (*halves)[0].error - (*halves)[1].error;
        if (gain > most) most = gain, of = i, best = std::move(*halves);
      }
    groups_[of] = std::move(best[0]);
    groups_.push_back(std::move(best[1]));
  }

  std::optional<std::array<Group, 2>> halved(const Group& group, int axis) const {
    const auto seen = points(group);  // the first of these are those of the first pose
    std::vector<double> along;
    for (std::size_t i = 0; i < group.vertices.size(); ++i) along.push_back(seen[i].at[axis]);
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    const double middle = (*low + *high) / 2;
    std::array<Group, 2> halves;
    for (std::size_t i = 0; i < along.size(); ++i)
      halves[along[i] < middle ? 0 : 1].vertices.push_back(group.vertices[i]);
    for (Group& half : halves) {
      half.joints = group.joints, half.joint = group.joint;
      if (half.vertices.size() < 4) return {};
      measure(half);
    }
    return halves;
  }

  Capsule capsule(const Group& group) const {
    const auto seen = points(group);
    const FittedCapsule fit = best_capsule(seen);
    double holding = fit.radius;
    for (const WeightedPoint& p : seen) holding = std::max(holding, distance(p.at, fit.ends));
    Capsule capsule{group.joint, {}, static_cast<float>(fit.radius), static_cast<float>(holding)};
    const Eigen::Affine3d to_joint = maps_[0][group.joint].inverse();
    for (std::size_t end = 0; end < 2; ++end) {
      const Eigen::Vector3f at = (to_joint * fit.ends[end]).cast<float>();
      capsule.ends[end] = {at.x(), at.y(), at.z()};
    }
    return capsule;
  }

  const Character& character_;
  std::vector<double> weights_;
  std::vector<std::uint32_t> joint_of_vertex_;
  std::vector<std::vector<Eigen::Affine3d>> maps_;
  std::vector<std::vector<Vector3d>> posed_;
  std::vector<Group> groups_;
};

}  // namespace

std::vector<Capsule> fit_ragdoll(const Character& character, std::span<const std::vector<Affine3d>> poses,
                                 std::uint32_t capsules) {
  if (poses.empty()) throw std::invalid_argument("a ragdoll of no poses");
  return Fit(character, poses).capsules(capsules);
}

}  // namespace bch::baselines
