// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include <bch/hierarchy.hpp>

#include "kernel/recordings/frame_run.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::detail {
namespace {

constexpr double density_distance = 1;  ///< metres
constexpr double crowded = 4;           ///< people per square metre: from there on they turn their shoulders
constexpr double beside = 0.6;          ///< metres: for somebody who is so near at a side
using std::numbers::pi;

const ShapeSet& near_discs() {
  static const ShapeSet discs = [] {
    Shape disc;
    disc.hierarchy = detail::fixed_cylinder(static_cast<float>(FrameRun::near_distance / 2));
    return ShapeSet({&disc, 1});
  }();
  return discs;
}

/// A bit for each of the compared discs that are nearer than they are wide.
std::uint8_t discs_of(double square_distance) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < compared_discs.size(); ++k)
    bits |= unsigned{square_distance < 4 * compared_discs[k] * compared_discs[k]} << k;
  return static_cast<std::uint8_t>(bits);
}

std::uint8_t density_class(double density) {
  const auto next = std::upper_bound(density_classes.begin() + 1, density_classes.end(), density);
  return static_cast<std::uint8_t>(next - density_classes.begin() - 1);
}

/// How far a shoulder has to be turned for somebody at a side: that on his side goes back where he is ahead, and forward where he is
/// behind.
Shoulders turned_for(double bearing) {
  const double off = std::abs(bearing);
  if (off < pi / 4 || off > 3 * pi / 4) return Shoulders::straight;
  return (bearing > 0) == (off < pi / 2) ? Shoulders::left : Shoulders::right;
}

}  // namespace

void FrameRun::look(const FrameBlock& block, std::size_t first, std::size_t last) {
  block_ = &block;
  first_ = first, last_ = last;
  begin_ = block.begin(first), end_ = block.begin(last);
  find_near();
  count_near();
  turn_shoulders();
  margin_ = std::max(options_.max_distance, std::min(2 * longest_step(), farthest_step));
  if (options_.measures) margin_ = std::max(margin_, measured_clearance);
  near_pairs_ = near_.size();
  if (near_pairs_ > usual_pairs()) {
    near_phase_ = BroadPhase();
    let_go(near_), let_go(near_in_discs_);
  }
  poses_.clear();
  for (std::size_t i = 0; i < size(); ++i)
    poses_.emplace_back(block.people()[begin_ + i], shoulders_[i], options_.coarse, options_.library,
                        motions_);
}

/// Finds who is within 1.2 m of whom, what discs say of them, and how many are within 1 m.
void FrameRun::find_near() {
  zeros_.resize(size());
  const std::span<const Pair> found = find(near_phase_, near_discs().view(), apart(zeros_), 0);
  const auto frame_of = own(block_->frame_of());
  near_.clear(), near_in_discs_.clear();
  in_discs_.assign(size(), 0);
  near_count_.assign(size(), 1);
  for (const Pair pair : found) {
    const double distance = square_distance(pair);
    if (distance > square(near_distance) || frame_of[pair.first] != frame_of[pair.second]) continue;
    const std::uint8_t discs = discs_of(distance);
    near_.push_back(pair), near_in_discs_.push_back(discs);
    const bool is_within = distance <= square(density_distance);
    for (const std::uint32_t i : {pair.first, pair.second})
      in_discs_[i] |= discs, near_count_[i] += is_within;
  }
  density_.clear(), density_class_.clear();
  for (const std::uint32_t count : near_count_) {
    density_.push_back(static_cast<double>(count) / (pi * square(density_distance)));
    density_class_.push_back(density_class(density_.back()));
  }
}

/// Finds who turns his shoulders: in a crowd, for whoever is nearest, if he is at a side; of equally near ones, for the first.
void FrameRun::turn_shoulders() {
  const auto people = own(block_->people());
  std::vector<double> least(size(), square(beside));
  std::vector<std::uint32_t> nearest(size(), 0);
  for (const Pair pair : near_) {
    const double distance = square_distance(pair);
    const auto offer = [&](std::uint32_t i, std::uint32_t other) {
      if (density_[i] < crowded || std::tie(distance, other) >= std::tie(least[i], nearest[i])) return;
      least[i] = distance, nearest[i] = other;
    };
    offer(pair.first, pair.second), offer(pair.second, pair.first);
  }
  shoulders_.assign(size(), Shoulders::straight);
  for (std::size_t i = 0; i < size(); ++i) {
    if (least[i] == square(beside)) continue;
    const Walker& other = people[nearest[i]];
    const double bearing = std::atan2(other.y - people[i].y, other.x - people[i].x) - people[i].heading;
    shoulders_[i] = turned_for(bearing - 2 * pi * std::round(bearing / (2 * pi)));
  }
}

void FrameRun::count_near() {
  // How many people and pairs of each class are in each set of discs.
  constexpr std::size_t sets = std::size_t{1} << compared_discs.size();
  std::array<std::array<std::uint64_t, sets>, density_classes.size()> people{}, pairs{};
  counts_ = {};
  for (std::size_t i = 0; i < size(); ++i) {
    ++people[density_class_[i]][in_discs_[i]];
    counts_[density_class_[i]].guessed += block_->people()[begin_ + i].is_guessed;
  }
  for (std::size_t i = 0; i < near_.size(); ++i) ++pairs[class_of(near_[i])][near_in_discs_[i]];
  for (std::size_t c = 0; c < density_classes.size(); ++c)
    for (std::size_t set = 0; set < sets; ++set) {
      counts_[c].people += people[c][set], counts_[c].near_pairs += pairs[c][set];
      for (std::size_t k = 0; k < compared_discs.size(); ++k)
        if (set >> k & 1) counts_[c].discs[k] += people[c][set], counts_[c].disc_pairs[k] += pairs[c][set];
    }
}

}  // namespace bch::detail
