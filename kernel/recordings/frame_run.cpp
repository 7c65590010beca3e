// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/frame_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kernel/broad_phase/pair_limit.hpp"
#include "layout/base/number_class.hpp"

namespace bch::detail {
namespace {

/// Metres: nobody passes through a body, an arm included, who moves by less than that.
constexpr double thinnest = 0.05;

}  // namespace

bool FrameRun::by_place(Pair a, Pair b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// Returns the first people as agents, one for each body.
Agents FrameRun::agents(std::span<const std::uint32_t> bodies) const {
  const std::size_t count = bodies.size();
  return {bodies, block_->x().subspan(begin_, count), block_->y().subspan(begin_, count),
          block_->heading().subspan(begin_, count)};
}

double FrameRun::square_distance(Pair pair) const {
  const double *x = block_->x().data() + begin_, *y = block_->y().data() + begin_;
  return square(x[pair.first] - x[pair.second]) + square(y[pair.first] - y[pair.second]);
}

/// Returns the square of a person's way to the next frame: infinite where he is not there, or jumps.
double FrameRun::square_step(std::size_t person) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto x = own(block_->x()), y = own(block_->y());
  const std::size_t next = own(block_->next_of())[person];
  if (next == FrameBlock::nobody) return infinite;
  const double step = square(block_->x()[next] - x[person]) + square(block_->y()[next] - y[person]);
  return step > square(farthest_step) ? infinite : step;
}

/// Returns the longest way of a person to the next frame, metres.
double FrameRun::longest_step() const {
  double longest = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (const double step = square_step(i); is_finite(step)) longest = std::max(longest, step);
  return std::sqrt(longest);
}

/// What is known of any two people, who are neither in overlap nor near each other yet.
CheckedPair FrameRun::checked(Pair pair) const {
  const auto people = own(block_->people());
  return {block_->frame(own(block_->frame_of())[pair.first]),
          people[pair.first].id,
          people[pair.second].id,
          false,
          false,
          false,
          0,
          0,
          0,
          0,
          0,
          0,
          0};
}

void FrameRun::run_query(const RunBodies& bodies, std::span<const std::uint32_t> shapes,
                         std::uint32_t given_up) {
  const Agents all = agents(bodies.numbers().first(size()));
  checked_.clear();
  if (options_.measures) measure_neighbours();
  query_pairs(bodies, all);
  query_depths(bodies, all);
  query_between(bodies, agents(bodies.numbers()));
  query_walls(bodies, all);
  if (options_.measures) sum_intrusions(), measure_times(bodies, all);
  std::sort(checked_.begin(), checked_.end(), [](const CheckedPair& a, const CheckedPair& b) {
    return std::tie(a.frame, a.first, a.is_wall, a.second, a.passing) <
           std::tie(b.frame, b.first, b.is_wall, b.second, b.passing);
  });
  report_people(shapes, given_up);
  count_overlaps();
}

/// The pairs within a distance grow with its square.
double FrameRun::expected_pairs() const {
  const auto near = static_cast<double>(near_pairs_ + size());
  return near * square((margin_ + near_distance) / near_distance);
}

void FrameRun::let_go() {
  if (answers_.capacity() <= usual_pairs()) return;
  body_phase_ = BroadPhase(), sweep_phase_ = BroadPhase();
  let_go(answers_), let_go(hits_), let_go(apart_), let_go(checked_), let_go(measured_pairs_),
      let_go(clearances_);
}

/// Returns the people as if each frame stood far from the others.
Agents FrameRun::apart(Strided<std::uint32_t> shape_of) const {
  return {shape_of, own(block_->apart_x()), own(block_->y()), own(block_->heading())};
}

/// Finds the neighbours among agents, one for each person, which stand apart.
std::span<const Pair> FrameRun::find(BroadPhase& phase, const ShapeSetView& shapes, const Agents& agents,
                                     double margin) const {
  const std::size_t most = options_.max_pairs > 0 ? options_.max_pairs : usual_max_pairs(size());
  try {
    return phase.find(shapes, agents, margin, most);
  } catch (const std::length_error&) {
    const std::int64_t first = block_->frame(first_), last = block_->frame(last_ - 1);
    const std::string frames = last > first
                                   ? "frames " + std::to_string(first) + " to " + std::to_string(last)
                                   : "frame " + std::to_string(first);
    throw TooManyPairs(frames + ": more than " + std::to_string(most) +
                       " pairs of people are near each other");
  }
}

/// Finds who overlaps, and who does not but may be within the largest distance or touch before the next frame.
void FrameRun::query_pairs(const RunBodies& bodies, const Agents& all) {
  const std::span<const Pair> found = find(body_phase_, bodies.roots(), apart(all.shape), margin_);
  answers_.resize(found.size());
  bodies.collide(all, found, answers_);
  const auto frame_of = own(block_->frame_of());
  hits_.clear(), apart_.clear();
  for (std::size_t i = 0; i < found.size(); ++i)
    if (frame_of[found[i].first] == frame_of[found[i].second])
      (answers_[i] != 0 ? hits_ : apart_).push_back(found[i]);
  std::sort(hits_.begin(), hits_.end(), by_place);
}

/// Measures how deep people overlap, and how far others are apart.
void FrameRun::query_depths(const RunBodies& bodies, const Agents& all) {
  const std::vector<Penetration> depths = bodies.depths(all, hits_);
  overlaps_.assign(size(), 0);
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    overlaps_[hits_[i].first] = overlaps_[hits_[i].second] = 1;
    CheckedPair& pair = checked_.emplace_back(checked(hits_[i]));
    pair.overlap = true;
    pair.depth = depths[i].depth;
    pair.x = static_cast<float>(depths[i].x), pair.y = static_cast<float>(depths[i].y);
    if (options_.measures) measure_clearance(hits_[i], pair.depth > 0 ? -pair.depth : 0, true);
  }
  const double farthest =
      options_.measures ? std::max(options_.max_distance, measured_clearance) : options_.max_distance;
  if (farthest <= 0) return;
  const std::vector<float> gaps = bodies.gaps(all, apart_, farthest);
  for (std::size_t i = 0; i < apart_.size(); ++i) {
    if (options_.max_distance > 0 && static_cast<double>(gaps[i]) <= options_.max_distance)
      checked_.emplace_back(checked(apart_[i])).gap = gaps[i];
    if (options_.measures && static_cast<double>(gaps[i]) <= measured_clearance)
      measure_clearance(apart_[i], gaps[i], false);
  }
}

/// Finds who passes through whom between two frames: people who do not overlap in either.
void FrameRun::query_between(const RunBodies& bodies, const Agents& with_next) {
  const auto next_of = own(block_->next_of());
  std::vector<Pair> moving, later;
  std::vector<double> x, y;
  for (const Pair pair : apart_) {
    if (!is_finite(square_step(pair.first)) || !is_finite(square_step(pair.second))) continue;
    const std::uint32_t first = next_of[pair.first], second = next_of[pair.second];
    const Walker *from = block_->people().data() + begin_, *to = block_->people().data();
    const double dx = to[first].x - from[pair.first].x - to[second].x + from[pair.second].x,
                 dy = to[first].y - from[pair.first].y - to[second].y + from[pair.second].y;
    if (dx * dx + dy * dy < thinnest * thinnest) continue;
    moving.push_back(pair);
    const auto begin = static_cast<std::uint32_t>(begin_);
    later.push_back({first - begin, second - begin});
    x.push_back(dx), y.push_back(dy);
  }
  std::vector<float> times = bodies.times_of_impact(with_next, moving, {x, y});
  // Bodies have to be clear of each other before and after, in the sense of times: who touches now, or then, does not pass.
  const auto keep_if = [&](auto is_kept) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < moving.size(); ++i)
      if (is_kept(i)) times[kept] = times[i], moving[kept] = moving[i], later[kept++] = later[i];
    moving.resize(kept), later.resize(kept);
  };
  keep_if([&](std::size_t i) { return times[i] > 0 && times[i] < 1; });
  answers_.resize(later.size());
  bodies.touch(with_next, later, answers_);
  keep_if([&](std::size_t i) { return answers_[i] == 0; });
  const std::vector<float> gaps = bodies.gaps(with_next, moving, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < moving.size(); ++i)
    add_pass(moving[i], begin_ + later[i].first, times[i], gaps[i]);
}

/// `next`: the first person in the next frame, of the block. `time`: of the contact, a share of the time until then.
void FrameRun::add_pass(Pair people, std::size_t next, float time, float gap) {
  const std::size_t now = begin_ + people.first;
  const auto frame = [&](std::size_t person) { return block_->frame(block_->frame_of()[person]); };
  const auto until_then = [time](auto from, auto to) { return time * static_cast<float>(to - from); };
  CheckedPair& pair = checked_.emplace_back(checked(people));
  pair.passing = true;
  if (options_.measures)
    measured_people_[people.first].collides = measured_people_[people.second].collides = true;
  pair.gap = gap;
  pair.after = until_then(frame(now), frame(next));
  pair.way_x = until_then(block_->x()[now], block_->x()[next]);
  pair.way_y = until_then(block_->y()[now], block_->y()[next]);
}

void FrameRun::query_walls(const RunBodies& bodies, const Agents& all) {
  in_wall_.assign(size(), 0);
  if (options_.walls == nullptr) return;
  bodies.collide(all, *options_.walls, in_wall_);
  std::vector<std::uint32_t> who, body;
  std::vector<double> x, y, heading;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (in_wall_[i] != 0) {
      who.push_back(i), body.push_back(all.shape[i]);
      x.push_back(all.x[i]), y.push_back(all.y[i]), heading.push_back(all.heading.x()[i]);
    }
  const std::vector<WallDepth> depths = bodies.wall_depths({body, x, y, heading}, *options_.walls);
  for (std::size_t k = 0; k < who.size(); ++k) {
    const std::uint32_t segment = depths[k].segment;
    const std::uint32_t wall = segment == DiscPair::none.second ? 0 : options_.walls->obstacle_of(segment);
    if (borders_[wall] != 0 && own(block_->people())[who[k]].comes_or_goes) {
      in_wall_[who[k]] = 0;
      continue;
    }
    CheckedPair& pair = checked_.emplace_back(checked({who[k], who[k]}));
    pair.second = wall;
    pair.is_wall = pair.overlap = true;
    pair.depth = depths[k].depth;
    pair.x = depths[k].x, pair.y = depths[k].y;
  }
}

void FrameRun::report_people(std::span<const std::uint32_t> shapes, std::uint32_t given_up) {
  const auto people = own(block_->people());
  checked_people_.clear();
  for (std::size_t i = 0; i < size(); ++i)
    checked_people_.push_back({people[i], shapes[i], given_up + shapes[i], static_cast<float>(density_[i]),
                               overlaps_[i] != 0, in_wall_[i] != 0});
}

std::uint8_t FrameRun::class_of(Pair pair) const {
  return std::max(density_class_[pair.first], density_class_[pair.second]);
}

void FrameRun::count_overlaps() {
  for (std::size_t i = 0; i < size(); ++i) {
    counts_[density_class_[i]].overlapping += overlaps_[i];
    counts_[density_class_[i]].in_walls += in_wall_[i];
  }
  for (const Pair pair : hits_)
    counts_[class_of(pair)].overlapping_pairs += square_distance(pair) <= square(near_distance);
}

}  // namespace bch::detail
