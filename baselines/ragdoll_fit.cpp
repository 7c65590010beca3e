// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "baselines/posed_skin.hpp"
#include "baselines/ragdoll.hpp"
#include "layout/character/eigen.hpp"

// Which vertices share a capsule? Joints that nearly move together are merged, long and flat groups are halved: what costs least, until
// the number is right.

namespace bch::baselines {
namespace {

using Eigen::Vector3d;

constexpr int max_exchanges = 20, reassignments = 4;
constexpr std::size_t fewest_vertices = 4;  // of a group

/// Holds vertices that share a capsule, and the joint that moves it.
struct Group {
  std::vector<std::uint32_t> vertices, joints;  ///< joints: of the vertices, in order
  std::uint32_t joint = 0;
  double error = 0;
};

class Fit {
 public:
  explicit Fit(const PosedSkin& skin) : skin_(skin) {}

  std::vector<Capsule> capsules(std::uint32_t count) {
    split_by_joints();
    while (groups_.size() > count) merge();
    while (groups_.size() < count) halve();
    for (int i = 0; i < max_exchanges; ++i) {
      const std::vector<Group> before = groups_;
      const double error = total_error();
      halve(), merge();
      if (total_error() < error) continue;
      groups_ = before;
      break;
    }
    for (int i = 0; i < reassignments; ++i) reassign();
    return held(fitted());
  }

 private:
  void split_by_joints() {
    std::map<std::uint32_t, Group> of_joint;
    for (std::size_t v = 0; v < skin_.vertices(); ++v)
      if (skin_.area(v) > 0 && skin_.visible(v))
        of_joint[skin_.joint(v)].vertices.push_back(static_cast<std::uint32_t>(v));
    for (auto& [joint, group] : of_joint) {
      group.joints = {joint}, group.joint = joint;
      measure(group);
      groups_.push_back(std::move(group));
    }
    if (groups_.empty()) throw std::invalid_argument("a ragdoll of a character without triangles");
  }

  /// The joint that moves most of the area moves the capsule.
  void find_joints(Group& group) const {
    std::map<std::uint32_t, double> areas;
    for (const std::uint32_t v : group.vertices) areas[skin_.joint(v)] += skin_.area(v);
    double most = 0;
    for (const auto& [joint, area] : areas) {
      group.joints.push_back(joint);
      if (area > most) group.joint = joint, most = area;
    }
  }

  void measure(Group& group) const {
    group.error = rough_capsule(skin_.in_frame_of(group.joint, group.vertices)).error;
  }

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
    std::int32_t up = skin_.character().joints[joint].parent;
    while (up >= 0 && !has_group(up)) up = skin_.character().joints[static_cast<std::size_t>(up)].parent;
    return up;
  }
  bool adjacent(const Group& a, const Group& b) const {
    const auto meets = [&](const Group& from, const Group& to) {
      return std::any_of(from.joints.begin(), from.joints.end(), [&](std::uint32_t joint) {
        const std::int32_t up = parent(joint);
        return std::binary_search(to.joints.begin(), to.joints.end(), joint) ||
               (up >= 0 &&
                std::binary_search(to.joints.begin(), to.joints.end(), static_cast<std::uint32_t>(up)));
      });
    };
    return meets(a, b) || meets(b, a);
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
    const auto in_frame =
        skin_.in_frame_of(group.joint, group.vertices);  // the first of these are those of the first pose
    std::vector<double> along;
    for (std::size_t i = 0; i < group.vertices.size(); ++i) along.push_back(in_frame[i].at[axis]);
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    const double middle = (*low + *high) / 2;
    std::array<Group, 2> halves;
    for (std::size_t i = 0; i < along.size(); ++i)
      halves[along[i] < middle ? 0 : 1].vertices.push_back(group.vertices[i]);
    for (Group& half : halves) {
      if (half.vertices.size() < fewest_vertices) return {};
      find_joints(half);
      measure(half);
    }
    return halves;
  }

  std::vector<FittedCapsule> fitted() const {
    std::vector<FittedCapsule> capsules;
    for (const Group& group : groups_)
      capsules.push_back(best_capsule(skin_.in_frame_of(group.joint, group.vertices)));
    return capsules;
  }

  /// Calls visit(vertex, group, point, capsule) for every vertex and the capsule of every group, in every pose.
  template <class Visit>
  void for_capsules(const std::vector<FittedCapsule>& capsules, Visit visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (std::size_t p = 0; p < skin_.poses(); ++p) {
        const Eigen::Affine3d there =
            skin_.map(p, groups_[g].joint) * skin_.map(0, groups_[g].joint).inverse();
        const FittedCapsule posed{
            {there * capsules[g].ends[0], there * capsules[g].ends[1]}, capsules[g].radius, 0};
        for (std::uint32_t v = 0; v < skin_.vertices(); ++v)
          if (skin_.area(v) > 0) visit(v, g, skin_.point(p, v), posed);
      }
  }
  /// Calls visit(vertex, group, least) for every vertex that counts with the group that has the least of something.
  template <class Visit>
  void for_least(const std::vector<double>& of_each, Visit visit) const {
    for (std::uint32_t v = 0; v < skin_.vertices(); ++v) {
      if (skin_.area(v) <= 0) continue;
      const auto of = of_each.begin() + static_cast<std::ptrdiff_t>(v * groups_.size());
      const auto least = std::min_element(of, of + std::ssize(groups_));
      visit(v, static_cast<std::size_t>(least - of), *least);
    }
  }

  /// Gives each vertex to the capsule that fits it best, as k-means does.
  void reassign() {
    std::vector<double> errors(skin_.vertices() * groups_.size());
    for_capsules(fitted(),
                 [&](std::uint32_t v, std::size_t g, const SkinPoint& point, const FittedCapsule& capsule) {
                   errors[v * groups_.size() + g] += square_error(point, capsule);
                 });
    std::vector<std::vector<std::uint32_t>> vertices(groups_.size());
    for_least(errors, [&](std::uint32_t v, std::size_t g, double) {
      if (skin_.visible(v)) vertices[g].push_back(v);
    });
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (vertices[g].size() >= fewest_vertices) groups_[g].vertices = std::move(vertices[g]);
  }

  /// Grows each capsule until it holds the vertices that need the least of it.
  std::vector<Capsule> held(const std::vector<FittedCapsule>& fits) const {
    std::vector<double> outside(skin_.vertices() * groups_.size(), -std::numeric_limits<double>::infinity());
    for_capsules(fits,
                 [&](std::uint32_t v, std::size_t g, const SkinPoint& point, const FittedCapsule& capsule) {
                   double& most = outside[v * groups_.size() + g];
                   most = std::max(most, offset_from(capsule.ends, point.at).norm() - capsule.radius);
                 });
    std::vector<double> grown(groups_.size());
    for_least(outside, [&](std::uint32_t, std::size_t g, double by) { grown[g] = std::max(grown[g], by); });
    std::vector<Capsule> capsules;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      capsules.push_back(capsule(groups_[g].joint, fits[g], grown[g]));
    return capsules;
  }

  Capsule capsule(std::uint32_t joint, const FittedCapsule& fit, double grown) const {
    Capsule capsule{joint, {}, static_cast<float>(fit.radius), static_cast<float>(fit.radius + grown)};
    const Eigen::Affine3d to_joint = skin_.map(0, joint).inverse();
    for (std::size_t end = 0; end < 2; ++end)
      capsule.ends[end] = detail::vec3((to_joint * fit.ends[end]).cast<float>());
    return capsule;
  }

  const PosedSkin& skin_;
  std::vector<Group> groups_;
};

}  // namespace

std::vector<Capsule> fit_ragdoll(const Character& character, std::span<const std::vector<Affine3d>> poses,
                                 std::uint32_t capsules) {
  if (poses.empty()) throw std::invalid_argument("a ragdoll of no poses");
  const PosedSkin skin(character, poses);
  return Fit(skin).capsules(capsules);
}

}  // namespace bch::baselines
