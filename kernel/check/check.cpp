// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_set>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/hierarchy.hpp>
#include <bch/penetration.hpp>
#include <bch/scene_plan.hpp>
#include <bch/time_of_impact.hpp>

#include "kernel/check/events.hpp"
#include "kernel/check/frame_block.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t directions = 32;
constexpr double near_distance = 1.2;
constexpr double crowded = 4;        ///< people per square metre: from there on they turn their shoulders
constexpr double beside = 0.6;       ///< metres: for somebody who is so near at a side
constexpr double farthest_step = 6;  ///< metres, of two people together; beyond, it is a jump and no way
/// Metres: nobody passes through a body, an arm included, who moves by less than that.
constexpr double thinnest = 0.05;
constexpr double pi = 3.14159265358979323846;

ShapeSet near_discs() {
  Shape disc;
  disc.hierarchy = fixed_cylinder(static_cast<float>(near_distance / 2));
  return ShapeSet({&disc, 1});
}

/// Checks blocks of frames.
class Checker {
 public:
  Checker(const CheckOptions& options, const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen)
      : options_(options), seen_(seen), shapes_(options.plan) {}

  void check(const FrameBlock& block, bool at_end, double fps);
  CheckSummary finish();

 private:
  void find_near(const FrameBlock& block);
  void turn_shoulders(const FrameBlock& block);
  void pose(const FrameBlock& block);
  void ask_pairs(const FrameBlock& block);
  void ask_between(const FrameBlock& block);
  void ask_walls(const FrameBlock& block);
  void count(const FrameBlock& block, std::size_t people);
  void tell(const FrameBlock& block, std::size_t frame, double fps);

  Agents agents(const FrameBlock& block) const { return {shape_, block.x(), block.y(), block.heading()}; }

  const CheckOptions options_;
  const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen_;
  const ShapeSet near_discs_ = near_discs();
  WalkerShapes shapes_;
  BroadPhase near_phase_, body_phase_;
  CheckSummary summary_;
  EventLog events_;
  std::unordered_set<std::int64_t> ids_;

  // Of a block.
  std::vector<std::uint32_t> shape_, zeros_;
  std::vector<double> density_;
  std::vector<Shoulders> shoulders_;
  std::vector<WalkerPose> poses_;
  std::vector<Pair> pairs_, hits_, near_;
  std::vector<std::uint8_t> answers_, in_wall_;
  std::vector<std::uint8_t> overlaps_, in_discs_;  ///< by person; the latter a bit for each of compared_discs
  std::vector<CheckedPair> checked_;               ///< by frame, which is that of the block; then ids
  // Of a frame.
  std::vector<CheckedPerson> people_;
  std::vector<CheckedPair> of_frame_;
};

bool by_place(Pair a, Pair b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

double square_distance(const FrameBlock& block, Pair pair) {
  const Walker &a = block.people()[pair.first], &b = block.people()[pair.second];
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

double square_of_diameter(std::size_t disc) {
  return 4 * compared_discs[disc] * compared_discs[disc];
}

std::size_t density_class(double density) {
  std::size_t found = 0;
  while (found + 1 < density_classes.size() && density >= density_classes[found + 1]) ++found;
  return found;
}

/// How far a shoulder has to be turned for somebody at a side: that on his side goes back where he is ahead, and forward where he is
/// behind.
Shoulders turned_for(double bearing) {
  const double off = std::abs(bearing);
  if (off < pi / 4 || off > 3 * pi / 4) return Shoulders::straight;
  return (bearing > 0) == (off < pi / 2) ? Shoulders::left : Shoulders::right;
}

/// Finds who is within 1.2 m of whom, and what discs say of them.
void Checker::find_near(const FrameBlock& block) {
  zeros_.resize(block.people().size());
  const std::span<const Pair> found =
      near_phase_.find(near_discs_, {zeros_, block.x(), block.y(), block.heading()});
  near_.clear();
  in_discs_.assign(block.people().size(), 0);
  for (const Pair pair : found) {
    const double square = square_distance(block, pair);
    if (square > near_distance * near_distance) continue;
    near_.push_back(pair);
    for (std::size_t k = 0; k < compared_discs.size(); ++k)
      if (square < square_of_diameter(k)) {
        in_discs_[pair.first] |= static_cast<std::uint8_t>(1u << k);
        in_discs_[pair.second] |= static_cast<std::uint8_t>(1u << k);
      }
  }
  density_ = local_densities(block.x(), block.y(), 1);
}

/// Finds who turns his shoulders: in a crowd, for whoever is nearest, if he is at a side.
void Checker::turn_shoulders(const FrameBlock& block) {
  const auto people = block.people();
  shoulders_.assign(people.size(), Shoulders::straight);
  std::vector<double> nearest(people.size(), beside * beside);
  for (const Pair pair : near_) {
    const double square = square_distance(block, pair);
    for (const auto& [i, j] : {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (density_[i] < crowded || square >= nearest[i]) continue;
      nearest[i] = square;
      const double bearing =
          std::atan2(people[j].y - people[i].y, people[j].x - people[i].x) - people[i].heading;
      shoulders_[i] = turned_for(bearing - 2 * pi * std::round(bearing / (2 * pi)));
    }
  }
}

void Checker::pose(const FrameBlock& block) {
  poses_.clear();
  for (std::size_t i = 0; i < block.people().size(); ++i)
    poses_.emplace_back(block.people()[i], shoulders_[i], options_.coarse);
  shape_.resize(poses_.size());
  shapes_.find(poses_, shape_);
}

void Checker::ask_pairs(const FrameBlock& block) {
  const Agents all = agents(block);
  const ShapeSet& set = shapes_.set();
  const double margin = std::max(options_.max_distance, std::min(2 * block.longest_step(), farthest_step));
  const std::span<const Pair> found = body_phase_.find(set, all, margin);
  pairs_.assign(found.begin(), found.end());
  answers_.resize(pairs_.size());
  collide(set, all, pairs_, answers_, {.semantics = Semantics::solid});
  hits_.clear();
  std::size_t apart = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (answers_[i] != 0)
      hits_.push_back(pairs_[i]);
    else
      pairs_[apart++] = pairs_[i];
  pairs_.resize(apart);
  std::sort(hits_.begin(), hits_.end(), by_place);

  std::vector<Penetration> depths(hits_.size());
  penetration(set, all, hits_, directions, depths);
  const auto people = block.people();
  checked_.clear();
  overlaps_.assign(people.size(), 0);
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const auto [first, second] = hits_[i];
    overlaps_[first] = overlaps_[second] = 1;
    checked_.push_back({static_cast<std::int64_t>(block.frame_of(first)), people[first].id, people[second].id,
                        false, true, false, depths[i].depth, 0, static_cast<float>(depths[i].x),
                        static_cast<float>(depths[i].y)});
  }
  if (options_.max_distance <= 0) return;
  std::vector<float> gaps(apart);
  clearance(set, all, pairs_, {gaps}, {.max_distance = options_.max_distance});
  for (std::size_t i = 0; i < apart; ++i) {
    const auto [first, second] = pairs_[i];
    if (std::isfinite(gaps[i]))
      checked_.push_back({static_cast<std::int64_t>(block.frame_of(first)), people[first].id,
                          people[second].id, false, false, false, 0, gaps[i], 0, 0});
  }
}

/// Finds who passes through whom between two frames: people who do not overlap in either.
void Checker::ask_between(const FrameBlock& block) {
  const auto people = block.people();
  std::vector<Pair> moving, later;
  std::vector<double> x, y;
  for (const Pair pair : pairs_) {
    const std::size_t next = block.frame_of(pair.first) + 1;
    if (next >= block.frames()) continue;
    const std::size_t first = block.find(next, people[pair.first].id),
                      second = block.find(next, people[pair.second].id);
    if (first == people.size() || second == people.size()) continue;
    const double dx = people[first].x - people[pair.first].x - people[second].x + people[pair.second].x,
                 dy = people[first].y - people[pair.first].y - people[second].y + people[pair.second].y;
    if (dx * dx + dy * dy < thinnest * thinnest) continue;
    moving.push_back(pair);
    later.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)});
    x.push_back(dx), y.push_back(dy);
  }
  std::vector<float> times(moving.size());
  time_of_impact(shapes_.set(), agents(block), moving, {x, y}, times);
  // Discs decide about times, so that they have to be clear of each other before and after: who touches now, or then, does not pass.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < moving.size(); ++i)
    if (times[i] > 0 && times[i] < 1) moving[kept] = moving[i], later[kept++] = later[i];
  later.resize(kept);
  answers_.resize(kept);
  collide(shapes_.set(), agents(block), later, answers_,
          {.semantics = Semantics::solid, .leaves = Leaves::discs});
  for (std::size_t i = 0; i < kept; ++i)
    if (answers_[i] == 0)
      checked_.push_back({static_cast<std::int64_t>(block.frame_of(moving[i].first)),
                          people[moving[i].first].id, people[moving[i].second].id, false, false, true, 0, 0,
                          0, 0});
}

void Checker::ask_walls(const FrameBlock& block) {
  const std::size_t people = block.people().size();
  in_wall_.assign(people, 0);
  if (options_.walls == nullptr) return;
  const Agents there{shape_, block.own_x(), block.y(), block.heading()};
  collide(shapes_.set(), there, *options_.walls, in_wall_, {.semantics = Semantics::solid});
  std::vector<std::uint32_t> who, shape;
  std::vector<double> x, y, heading;
  for (std::uint32_t i = 0; i < people; ++i)
    if (in_wall_[i] != 0) {
      who.push_back(i), shape.push_back(shape_[i]);
      x.push_back(there.x[i]), y.push_back(there.y[i]), heading.push_back(there.heading[i]);
    }
  std::vector<Penetration> depths(who.size());
  std::vector<float> gaps(who.size());
  std::vector<DiscPair> nearest(who.size());
  penetration(shapes_.set(), {shape, x, y, heading}, *options_.walls, depths);
  clearance(shapes_.set(), {shape, x, y, heading}, *options_.walls, {.distance = gaps, .discs = nearest},
            {.overlap = Overlap::deepest});
  for (std::size_t k = 0; k < who.size(); ++k) {
    const std::uint32_t segment = nearest[k].second;
    const std::int64_t wall = segment == no_discs.second ? 0 : options_.walls->obstacle_of(segment);
    checked_.push_back({static_cast<std::int64_t>(block.frame_of(who[k])), block.people()[who[k]].id, wall,
                        true, true, false, depths[k].depth, 0, static_cast<float>(depths[k].x),
                        static_cast<float>(depths[k].y)});
  }
}

/// Counts people and near pairs of the frames that belong to this block.
void Checker::count(const FrameBlock& block, std::size_t people) {
  for (std::size_t i = 0; i < people; ++i) {
    const auto add = [&](OverlapCount& to) {
      ++to.people;
      to.overlapping += overlaps_[i];
      to.in_walls += in_wall_[i];
      for (std::size_t k = 0; k < compared_discs.size(); ++k) to.discs[k] += in_discs_[i] >> k & 1;
    };
    add(summary_.all);
    add(summary_.by_density[density_class(density_[i])]);
    summary_.guessed += block.people()[i].is_guessed;
    ids_.insert(block.people()[i].id);
  }
  for (const Pair pair : near_) {
    if (pair.first >= people) continue;
    const double square = square_distance(block, pair);
    const bool overlap = std::binary_search(hits_.begin(), hits_.end(), pair, by_place);
    const auto add = [&](OverlapCount& to) {
      ++to.near_pairs;
      to.overlapping_pairs += overlap;
      for (std::size_t k = 0; k < compared_discs.size(); ++k)
        to.disc_pairs[k] += square < square_of_diameter(k);
    };
    add(summary_.all);
    add(summary_.by_density[density_class(std::max(density_[pair.first], density_[pair.second]))]);
  }
}

/// Tells a frame, and joins its overlaps to events.
void Checker::tell(const FrameBlock& block, std::size_t frame, double fps) {
  people_.clear();
  for (std::size_t i = block.begin(frame); i < block.begin(frame + 1); ++i)
    people_.push_back({block.people()[i], shape_[i], shapes_.given_up() + shape_[i],
                       static_cast<float>(density_[i]), overlaps_[i] != 0, in_wall_[i] != 0});
  const auto in_order = [](const CheckedPair& pair, std::int64_t number) { return pair.frame < number; };
  const auto number = static_cast<std::int64_t>(frame);
  of_frame_.assign(std::lower_bound(checked_.begin(), checked_.end(), number, in_order),
                   std::lower_bound(checked_.begin(), checked_.end(), number + 1, in_order));
  for (CheckedPair& pair : of_frame_) {
    pair.frame = block.frame(frame);
    summary_.passings += pair.passing;
  }
  const CheckedFrame told{block.frame(frame), static_cast<double>(block.frame(frame)) / fps, people_,
                          of_frame_};
  events_.add(told);
  if (seen_) seen_(told, shapes_.set());
  if (summary_.frames++ == 0) summary_.first_frame = told.frame;
  summary_.last_frame = told.frame;
}

void Checker::check(const FrameBlock& block, bool at_end, double fps) {
  const std::size_t frames = at_end ? block.frames() : block.frames() - 1;
  find_near(block);
  turn_shoulders(block);
  pose(block);
  ask_pairs(block);
  ask_between(block);
  ask_walls(block);
  std::sort(checked_.begin(), checked_.end(), [](const CheckedPair& a, const CheckedPair& b) {
    return std::tie(a.frame, a.first, a.is_wall, a.second, a.passing) <
           std::tie(b.frame, b.first, b.is_wall, b.second, b.passing);
  });
  count(block, block.begin(frames));
  for (std::size_t i = 0; i < frames; ++i) tell(block, i, fps);
}

CheckSummary Checker::finish() {
  summary_.events = events_.finish();
  summary_.people = ids_.size();
  summary_.shapes = shapes_.given_up() + shapes_.set().shape_count();
  return std::move(summary_);
}

}  // namespace

CheckSummary check(TrajectoryReader& reader, const CheckOptions& options,
                   const std::function<void(const CheckedFrame&, const ShapeSet&)>& seen) {
  WalkerReader walkers(reader);
  Checker checker(options, seen);
  FrameBlock block;
  for (bool at_end = false; !at_end;) {
    at_end = block.read(walkers, options.people_at_once);
    if (block.frames() > 0) checker.check(block, at_end, reader.info().fps);
  }
  return checker.finish();
}

}  // namespace bch::detail
