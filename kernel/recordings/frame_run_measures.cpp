// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>

#include <bch/hierarchy.hpp>

#include "kernel/recordings/frame_run.hpp"
#include "layout/base/number_class.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::detail {
namespace {

/// The radii of discs around the ways of people: a tenth larger each, to those of somebody at some 50 m/s.
constexpr std::size_t sweep_sizes = 64;
const std::array<double, sweep_sizes>& sweep_radii() {
  static const std::array<double, sweep_sizes> radii = [] {
    std::array<double, sweep_sizes> all{};
    double next = 0.3;
    for (double& radius : all) radius = next, next *= 1.1;
    return all;
  }();
  return radii;
}

const ShapeSet& sweep_discs() {
  static const ShapeSet discs = [] {
    std::vector<Shape> shapes(sweep_sizes);
    for (std::size_t k = 0; k < sweep_sizes; ++k)
      shapes[k].hierarchy = detail::fixed_cylinder(static_cast<float>(sweep_radii()[k]));
    return ShapeSet(shapes);
  }();
  return discs;
}

std::uint32_t sweep_size(double radius) {
  const auto found = std::lower_bound(sweep_radii().begin(), sweep_radii().end() - 1, radius);
  return static_cast<std::uint32_t>(found - sweep_radii().begin());
}

/// Intrusions are summed in whole parts, because the order of pairs depends on which frames a run has.
constexpr double intrusion_parts = 1 << 20, largest_intrusion = 1e9;

/// Returns how far a body's discs reach from its place, or a disc where that is farther. (Discs of a cut stick out of the smallest disc.)
double reach_of(const ShapeSetView& shapes, const Agents& agents, std::size_t agent) {
  constexpr double rounding = 1 + 1e-6;
  const auto number = static_cast<std::uint32_t>(agents.root(agent, shapes.level_count));
  const Root& root = shapes.roots[number];
  const double x = static_cast<double>(root.x), y = static_cast<double>(root.y);
  return std::max(measured_disc, rounding * (std::sqrt(x * x + y * y) + outer_radius(shapes, number)));
}

}  // namespace

void FrameRun::measure_neighbours() {
  measured_people_.assign(size(), {});
  intrusion_.assign(size(), 0);
  clearances_.clear();
  std::vector<double> step_x(size()), step_y(size());
  const auto next_of = own(block_->next_of());
  for (std::size_t i = 0; i < size(); ++i) {
    if (!is_finite(square_step(i))) continue;
    step_x[i] = block_->x()[next_of[i]] - own(block_->x())[i];
    step_y[i] = block_->y()[next_of[i]] - own(block_->y())[i];
  }
  for (std::size_t frame = first_; frame < last_; ++frame) {
    const std::size_t begin = block_->begin(frame) - begin_,
                      count = block_->begin(frame + 1) - block_->begin(frame);
    const auto of_frame = [&](auto people) { return people.subspan(begin, count); };
    neighbour_measures_.measure(
        of_frame(own(block_->x())), of_frame(own(block_->y())), of_frame(std::span<const double>(step_x)),
        of_frame(std::span<const double>(step_y)), of_frame(std::span(measured_people_)));
  }
}

/// Takes the clearance of two people, at most measured_clearance.
void FrameRun::measure_clearance(Pair pair, float clearance, bool overlaps) {
  clearances_.push_back({pair, clearance, overlaps});
  const double gap = static_cast<double>(clearance);
  const double intrusion = gap > 0 ? std::min(square(measured_clearance / gap), largest_intrusion) : 0;
  for (const std::uint32_t i : {pair.first, pair.second}) {
    MeasuredPerson& person = measured_people_[i];
    person.clearance = std::min(person.clearance, clearance);
    intrusion_[i] += static_cast<std::uint64_t>(intrusion * intrusion_parts);
    person.collides |= clearance <= 0;
  }
}

void FrameRun::sum_intrusions() {
  for (std::size_t i = 0; i < size(); ++i)
    measured_people_[i].intrusion =
        measured_people_[i].clearance <= 0
            ? MeasuredPerson::infinite
            : static_cast<float>(static_cast<double>(intrusion_[i]) / intrusion_parts);
}

/// Finds whose ways of the next seconds come near each other. Each person's way is in a disc around its middle, seen by somebody who moves
/// as the people of the frame do on average: so people who walk together have small discs.
std::span<const Pair> FrameRun::find_sweeps(const RunBodies& bodies, const Agents& all) {
  const auto people = own(block_->people());
  reach_.clear();
  std::vector<double> x, y;
  std::vector<std::uint32_t> sizes;
  for (std::size_t frame = first_; frame < last_; ++frame) {
    const std::size_t begin = block_->begin(frame) - begin_, end = block_->begin(frame + 1) - begin_;
    double mean_x = 0, mean_y = 0;
    for (std::size_t i = begin; i < end; ++i) mean_x += people[i].velocity_x, mean_y += people[i].velocity_y;
    const auto count = static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double way_x = (people[i].velocity_x - mean_x / count) * measured_seconds / 2,
                   way_y = (people[i].velocity_y - mean_y / count) * measured_seconds / 2;
      reach_.push_back(reach_of(bodies.roots(), all, i));
      x.push_back(own(block_->apart_x())[i] + way_x), y.push_back(people[i].y + way_y);
      sizes.push_back(sweep_size(1.001 * (std::sqrt(way_x * way_x + way_y * way_y) + reach_.back())));
    }
  }
  return find(sweep_phase_, sweep_discs().view(), {sizes, x, y, own(block_->heading())}, 0);
}

/// Finds when people will collide who go on as they move now.
void FrameRun::measure_times(const RunBodies& bodies, const Agents& all) {
  const auto people = own(block_->people());
  const auto frame_of = own(block_->frame_of());
  std::vector<Pair> near;
  for (const Pair pair : find_sweeps(bodies, all)) {
    const Walker &a = people[pair.first], &b = people[pair.second];
    if (frame_of[pair.first] == frame_of[pair.second] &&
        disc_collision(a.x - b.x, a.y - b.y, a.velocity_x - b.velocity_x, a.velocity_y - b.velocity_y,
                       reach_[pair.first] + reach_[pair.second]) <= measured_seconds)
      near.push_back(pair);
  }
  std::sort(near.begin(), near.end(), by_place);
  std::vector<double> way_x, way_y;
  for (const Pair pair : near) {
    const Walker &a = people[pair.first], &b = people[pair.second];
    way_x.push_back((a.velocity_x - b.velocity_x) * measured_seconds);
    way_y.push_back((a.velocity_y - b.velocity_y) * measured_seconds);
  }
  measure_pairs(near, bodies.times_of_impact(all, near, {way_x, way_y}));
}

/// Keeps the pairs that collide, and their people's least times. `pairs` are by place, and `times` of bodies, shares of the seconds that are
/// looked ahead.
void FrameRun::measure_pairs(std::span<const Pair> pairs, std::span<const float> times) {
  const auto people = own(block_->people());
  const auto frame_of = own(block_->frame_of());
  measured_pairs_.clear();
  measured_pairs_of_.assign(last_ - first_, 0);
  std::sort(clearances_.begin(), clearances_.end(),
            [](const auto& a, const auto& b) { return by_place(a.people, b.people); });
  auto near = clearances_.begin();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [first, second] = pairs[i];
    const Walker &a = people[first], &b = people[second];
    while (near != clearances_.end() && by_place(near->people, pairs[i])) ++near;
    const bool is_near = near != clearances_.end() && !by_place(pairs[i], near->people);
    const double disc_time = disc_collision(a.x - b.x, a.y - b.y, a.velocity_x - b.velocity_x,
                                            a.velocity_y - b.velocity_y, 2 * measured_disc);
    const float time = is_near && near->overlaps ? 0 : times[i] * static_cast<float>(measured_seconds);
    if (disc_time > measured_seconds && !is_finite(time)) continue;
    MeasuredPair& pair = measured_pairs_.emplace_back();
    pair.first = a.id, pair.second = b.id;
    pair.distance = static_cast<float>(std::sqrt(square_distance(pairs[i])));
    pair.disc_clearance = static_cast<float>(std::sqrt(square_distance(pairs[i])) - 2 * measured_disc);
    pair.clearance = is_near ? near->clearance : MeasuredPerson::infinite;
    pair.time = is_near ? time_to_collision(*near, time) : time;
    pair.disc_time = disc_time <= measured_seconds ? static_cast<float>(disc_time) : MeasuredPerson::infinite;
    for (const std::uint32_t k : {first, second}) {
      measured_people_[k].time = std::min(measured_people_[k].time, pair.time);
      measured_people_[k].disc_time = std::min(measured_people_[k].disc_time, pair.disc_time);
    }
    ++measured_pairs_of_[frame_of[first] - first_];
  }
}

/// Returns when two people collide whose discs at leaves touch after a time, which may be before their outlines do: nobody collides before the
/// clearance is used up.
float FrameRun::time_to_collision(const MeasuredClearance& near, float time) const {
  if (near.clearance <= 0) return time;
  const Walker &a = own(block_->people())[near.people.first], &b = own(block_->people())[near.people.second];
  const double speed = std::sqrt(square(a.velocity_x - b.velocity_x) + square(a.velocity_y - b.velocity_y));
  const double earliest = static_cast<double>(near.clearance) / speed;
  return earliest > measured_seconds ? MeasuredPerson::infinite
                                     : std::max(time, static_cast<float>(earliest));
}

}  // namespace bch::detail
