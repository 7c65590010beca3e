// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/assemble_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "layout/body/body_layout.hpp"
#include "layout/body/model/core_choice.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// Puts pieces together: the owner of a node is a sphere that holds all of it, or none.
class PieceMerger {
 public:
  PieceMerger(const SkinPieces& skin, const SphereChoice& choice, const TrainingPoses& poses)
      : poses_(poses), owner_(skin.nodes.size(), none), spheres_(choice.spheres.size()) {
    for (std::size_t pose = 0; pose < poses.size(); ++pose)
      for (const auto& sphere : choice.spheres) centres_.push_back(poses.centre(pose, sphere));
    squared_radii_.assign(centres_.size(), 0);
    for (std::size_t p = 0; p < skin.pieces.size(); ++p)
      for (const std::uint32_t corner : skin.pieces[p])
        for (std::size_t pose = 0; pose < poses.size(); ++pose) {
          const std::size_t at = pose * spheres_ + choice.owner[p];
          squared_radii_[at] =
              std::max(squared_radii_[at], squared_distance(poses.points(pose)[corner], centres_[at]));
        }
    for (std::size_t n = 0; n < skin.nodes.size(); ++n)
      if (skin.nodes[n].piece != SkinPieces::no_child) owner_[n] = choice.owner[skin.nodes[n].piece];
    // Children follow their parents.
    for (std::size_t n = skin.nodes.size(); n-- > 0;)
      if (skin.nodes[n].piece == SkinPieces::no_child) owner_[n] = owner_of_both(skin.nodes[n]);
  }

  std::uint32_t owner(std::uint32_t node) const { return owner_[node]; }
  /// Returns a sphere in a pose of the training.
  Sphere sphere(std::size_t pose, std::uint32_t number) const {
    const std::size_t at = pose * spheres_ + number;
    return {static_cast<float>(centres_[at].x), static_cast<float>(centres_[at].y),
            static_cast<float>(centres_[at].z), static_cast<float>(std::sqrt(squared_radii_[at]))};
  }

 private:
  std::uint32_t owner_of_both(const SkinPieces::Node& node) const {
    const std::uint32_t first = owner_[node.children[0]], second = owner_[node.children[1]];
    if (first == second || second == none || first == none) return first == second ? first : none;
    if (contains(first, node)) return first;
    return contains(second, node) ? second : none;
  }

  bool contains(std::uint32_t sphere, const SkinPieces::Node& node) const {
    for (std::size_t pose = 0; pose < poses_.size(); ++pose)
      for (const std::uint32_t corner : node.corners) {
        const std::size_t at = pose * spheres_ + sphere;
        if (squared_distance(poses_.points(pose)[corner], centres_[at]) > squared_radii_[at]) return false;
      }
    return true;
  }

  const TrainingPoses& poses_;
  std::vector<std::uint32_t> owner_;  ///< by node
  std::vector<SpacePoint> centres_;   ///< by pose, then sphere
  std::vector<double> squared_radii_;
  std::size_t spheres_;
};

/// Collects the corners of each sphere, and the cuts that these need.
class SphereCorners {
 public:
  SphereCorners(const SkinPieces& skin, std::size_t vertices, std::size_t spheres, const PieceMerger& merged)
      : skin_(skin),
        vertices_(static_cast<std::uint32_t>(vertices)),
        corners_(spheres),
        is_needed_(skin.cuts.size(), false) {
    for (const std::uint32_t root : skin.roots) add(root, merged);
    for (auto& of : corners_) {
      std::sort(of.begin(), of.end());
      of.erase(std::unique(of.begin(), of.end()), of.end());
      for (const std::uint32_t point : of) need(point);
    }
    number_.assign(skin.cuts.size(), none);
    for (std::uint32_t i = 0; i < skin.cuts.size(); ++i) {
      if (!is_needed_[i]) continue;
      number_[i] = vertices_ + static_cast<std::uint32_t>(cuts.size());
      cuts.push_back({numbered(skin.cuts[i][0]), numbered(skin.cuts[i][1])});
    }
  }

  bool has(std::size_t sphere) const { return !corners_[sphere].empty(); }
  /// Returns the corners of a sphere, as the model numbers points.
  std::vector<std::uint32_t> of(std::size_t sphere) const {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t point : corners_[sphere]) numbers.push_back(numbered(point));
    return numbers;
  }

  std::vector<std::array<std::uint32_t, 2>> cuts;

 private:
  void add(std::uint32_t node, const PieceMerger& merged) {
    const SkinPieces::Node& at = skin_.nodes[node];
    if (const std::uint32_t owner = merged.owner(node); owner != none) {
      corners_[owner].insert(corners_[owner].end(), at.corners.begin(), at.corners.end());
      return;
    }
    for (const std::uint32_t child : at.children) add(child, merged);
  }

  void need(std::uint32_t point) {
    if (point < vertices_ || is_needed_[point - vertices_]) return;
    is_needed_[point - vertices_] = true;
    for (const std::uint32_t end : skin_.cuts[point - vertices_]) need(end);
  }

  std::uint32_t numbered(std::uint32_t point) const {
    return point < vertices_ ? point : number_[point - vertices_];
  }

  const SkinPieces& skin_;
  std::uint32_t vertices_;
  std::vector<std::vector<std::uint32_t>> corners_;
  std::vector<bool> is_needed_;
  std::vector<std::uint32_t> number_;  ///< of a cut's point in the model
};

}  // namespace

BodyModel assemble_model(std::shared_ptr<const Character> character, const SkinPieces& skin,
                         const SphereChoice& choice, const TrainingPoses& poses) {
  const PieceMerger merged(skin, choice, poses);
  const SphereCorners corners(skin, character->vertices.size(), choice.spheres.size(), merged);
  std::vector<std::uint32_t> used;
  for (std::uint32_t s = 0; s < choice.spheres.size(); ++s)
    if (corners.has(s)) used.push_back(s);
  std::vector<std::vector<Sphere>> spheres(poses.size());
  for (std::size_t pose = 0; pose < poses.size(); ++pose)
    for (const std::uint32_t s : used) spheres[pose].push_back(merged.sphere(pose, s));

  const BodyLayout layout = body_layout(spheres);
  for (auto& in_pose : spheres) {
    const std::vector<Sphere> all = in_pose;
    for (std::size_t slot = 0; slot < all.size(); ++slot) in_pose[slot] = all[layout.sphere_in_slot[slot]];
  }
  BodyModel model;
  model.character = std::move(character);
  model.midpoints = corners.cuts;
  model.leaf_size = layout.leaf_size;
  model.core = choose_core(spheres, layout.core);
  model.influence_begin.push_back(0), model.corner_begin.push_back(0);
  for (const std::uint32_t in_slot : layout.sphere_in_slot) {
    const std::uint32_t sphere = used[in_slot];
    const auto& influences = choice.spheres[sphere];
    model.influences.insert(model.influences.end(), influences.begin(), influences.end());
    model.influence_begin.push_back(static_cast<std::uint32_t>(model.influences.size()));
    const std::vector<std::uint32_t> own = corners.of(sphere);
    model.corners.insert(model.corners.end(), own.begin(), own.end());
    model.corner_begin.push_back(static_cast<std::uint32_t>(model.corners.size()));
  }
  return model;
}

}  // namespace bch::detail
