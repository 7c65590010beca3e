// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace bch::detail {
namespace {

constexpr double usual_growth = 0.06;  // metres, of people; more is needed by few spheres only
constexpr int halvings = 12;           ///< of the search for the least growth

/// Says by how much a candidate has to grow to hold a piece in all poses, metres.
struct Growth {
  std::uint32_t piece;
  float growth;
};

/// Lists, for each candidate, the pieces that it can hold.
class GrowthTable {
 public:
  GrowthTable(const SkinPieces& skin, std::span<const BodyCandidate> candidates, const TrainingPoses& poses,
              double max_growth)
      : skin_(skin),
        candidates_(candidates),
        poses_(poses),
        max_growth_(max_growth),
        pieces_at_(poses.points(0).size()) {
    for (std::uint32_t p = 0; p < skin.pieces.size(); ++p)
      for (const std::uint32_t corner : skin.pieces[p]) pieces_at_[corner].push_back(p);
    growth_of_point_.resize(poses.points(0).size());
    corners_seen_.resize(skin.pieces.size(), 0);
    for (std::uint32_t c = 0; c < candidates.size(); ++c) add(c);
  }

  std::span<const Growth> operator[](std::size_t candidate) const {
    return {all_.data() + begin_[candidate], begin_[candidate + 1] - begin_[candidate]};
  }

 private:
  void add(std::uint32_t candidate) {
    const double radius = candidates_[candidate].radius, most = radius + max_growth_;
    std::vector<std::uint32_t> near;
    SpacePoint centre = poses_.centre(0, candidates_[candidate].influences);
    for (std::uint32_t i = 0; i < poses_.points(0).size(); ++i) {
      const double distance = squared_distance(poses_.points(0)[i], centre);
      if (distance > most * most) continue;
      near.push_back(i), growth_of_point_[i] = distance;
    }
    for (std::size_t pose = 1; pose < poses_.size(); ++pose) {
      centre = poses_.centre(pose, candidates_[candidate].influences);
      std::erase_if(near, [&](std::uint32_t i) {
        double& farthest = growth_of_point_[i];
        farthest = std::max(farthest, squared_distance(poses_.points(pose)[i], centre));
        return farthest > most * most;
      });
    }
    std::vector<std::uint32_t> whole;
    for (const std::uint32_t i : near)
      for (const std::uint32_t piece : pieces_at_[i])
        if (++corners_seen_[piece] == 3) whole.push_back(piece);
    for (const std::uint32_t i : near)
      for (const std::uint32_t piece : pieces_at_[i]) corners_seen_[piece] = 0;
    std::sort(whole.begin(), whole.end());
    for (const std::uint32_t piece : whole) {
      double farthest = 0;
      for (const std::uint32_t corner : skin_.pieces[piece])
        farthest = std::max(farthest, growth_of_point_[corner]);
      all_.push_back({piece, static_cast<float>(std::sqrt(farthest) - radius)});
    }
    begin_.push_back(all_.size());
  }

  const SkinPieces& skin_;
  std::span<const BodyCandidate> candidates_;
  const TrainingPoses& poses_;
  const double max_growth_;
  std::vector<std::vector<std::uint32_t>> pieces_at_;  ///< by point
  std::vector<double> growth_of_point_;  ///< squared distance from the centre, the largest of all poses
  std::vector<std::uint8_t> corners_seen_;
  std::vector<Growth> all_;
  std::vector<std::size_t> begin_{0};
};

/// Chooses candidates that hold, grown by so much, all pieces that any candidate can hold so.
std::vector<std::uint32_t> cover(const GrowthTable& table, std::size_t candidates, std::size_t pieces,
                                 float growth) {
  std::vector<std::uint8_t> covered(pieces, 0);
  const auto left = [&](std::uint32_t c) {
    std::uint32_t count = 0;
    for (const Growth& of : table[c]) count += of.growth <= growth && covered[of.piece] == 0;
    return count;
  };
  // Counts only fall: whoever still has the count that it stands with is the best.
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // count; the lowest index first among equals
  std::priority_queue<Entry> queue;
  for (std::uint32_t c = 0; c < candidates; ++c)
    if (const std::uint32_t count = left(c); count > 0) queue.push({count, ~c});
  std::vector<std::uint32_t> chosen;
  while (!queue.empty()) {
    const auto [count, name] = queue.top();
    queue.pop();
    const std::uint32_t now = left(~name);
    if (now == 0) continue;
    if (now < count) {
      queue.push({now, name});
      continue;
    }
    chosen.push_back(~name);
    for (const Growth& of : table[~name])
      if (of.growth <= growth) covered[of.piece] = 1;
  }
  return chosen;
}

}  // namespace

SphereChoice choose_spheres(const SkinPieces& skin, std::span<const BodyCandidate> candidates,
                            const TrainingPoses& poses, std::uint32_t most, double scale,
                            const std::function<void(double)>& advance) {
  const double max_growth = scale * usual_growth;
  const GrowthTable table(skin, candidates, poses, max_growth);
  advance(0.5);
  float low = 0, high = static_cast<float>(max_growth);
  std::vector<std::uint32_t> chosen = cover(table, candidates.size(), skin.pieces.size(), high);
  for (int i = 0; i < halvings && chosen.size() != most; ++i) {
    const float middle = 0.5f * (low + high);
    std::vector<std::uint32_t> tried = cover(table, candidates.size(), skin.pieces.size(), middle);
    advance(0.5 + 0.5 * (i + 1) / halvings);
    if (tried.size() <= most)
      high = middle, chosen = std::move(tried);
    else
      low = middle;
  }
  if (chosen.size() > most) chosen.resize(most);
  if (chosen.empty()) chosen.push_back(0);

  SphereChoice choice;
  choice.owner.assign(skin.pieces.size(), 0xffffffff);
  std::vector<float> least(skin.pieces.size(), std::numeric_limits<float>::infinity());
  for (std::uint32_t s = 0; s < chosen.size(); ++s) {
    choice.spheres.push_back(candidates[chosen[s]].influences);
    for (const Growth& of : table[chosen[s]])
      if (of.growth < least[of.piece]) least[of.piece] = of.growth, choice.owner[of.piece] = s;
  }
  for (std::size_t p = 0; p < skin.pieces.size(); ++p) {
    if (choice.owner[p] != 0xffffffff) continue;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t s = 0; s < chosen.size(); ++s) {
      double farthest = 0;
      for (std::size_t pose = 0; pose < poses.size(); ++pose)
        for (const std::uint32_t corner : skin.pieces[p])
          farthest = std::max(
              farthest, squared_distance(poses.points(pose)[corner], poses.centre(pose, choice.spheres[s])));
      const double growth = std::sqrt(farthest) - candidates[chosen[s]].radius;
      if (growth < best) best = growth, choice.owner[p] = s;
    }
  }
  return choice;
}

}  // namespace bch::detail
