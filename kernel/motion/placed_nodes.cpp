// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/placed_nodes.hpp"

#include <algorithm>
#include <cmath>

// Loops over eight nodes are in separate functions: inside other loops they would be unrolled before they are
// vectorised.

namespace bch::detail {

void PlacedNodes::place(const MovingBody& body, const PathKey& from, const PathKey& to, bool in_space) {
  const std::size_t key = body.key();
  chunk_ = &body.chunk(), first_ = chunk_->key(key), last_ = chunk_->key(key + 1);
  fraction_ = body.fraction(from.time), fraction_at_end_ = body.fraction(to.time);
  turn_ = rotation(from.heading), turn_at_end_ = rotation(to.heading);
  x_ = from.x, y_ = from.y, x_at_end_ = to.x, y_at_end_ = to.y;
  z_ = from.z, z_at_end_ = to.z, in_space_ = in_space;
  const double turn = std::abs(to.heading - from.heading), max_extent = body.tree().max_extent,
               seconds = chunk_->times[key + 1] - chunk_->times[key],
               distance =
                   std::min(2 * max_extent, double{chunk_->speed} * seconds * (fraction_at_end_ - fraction_));
  deviation_ = (turn * turn * max_extent + 2 * turn * distance) / 8;
  const std::size_t margin = chunk_->nodes() + animated_width;
  if (discs_[0].size() < margin)
    for (std::vector<double>& numbers : discs_) numbers.resize(margin);
  if (placed_in_.size() < chunk_->first_leaf()) placed_in_.resize(chunk_->first_leaf(), 0);
  if (++interval_ == 0) std::fill(placed_in_.begin(), placed_in_.end(), 0), interval_ = 1;
  place_eight(0);
}

void PlacedNodes::first_overlaps(std::uint32_t from, const MovingDisc& other, double margin, double last,
                                 std::array<double, animated_width>& times) const noexcept {
  const double *const x = discs_[0].data() + from, *const y = discs_[1].data() + from,
                      *const radius = discs_[2].data() + from, *const move_x = discs_[3].data() + from,
                      *const move_y = discs_[4].data() + from, *const growth = discs_[5].data() + from,
                      *const z = discs_[6].data() + from, *const move_z = discs_[7].data() + from;
  for (std::uint32_t lane = 0; lane < animated_width; ++lane)
    times[lane] = first_overlap(
        {x[lane], y[lane], radius[lane], move_x[lane], move_y[lane], growth[lane], z[lane], move_z[lane]},
        other, margin, last);
}

void PlacedNodes::place_eight(std::uint32_t from) noexcept {
  // Copies of members, because the compiler assumes that the writes below may change members.
  const double step = chunk_->step, fraction = fraction_, fraction_at_end = fraction_at_end_;
  const double cosine = turn_.cosine, sine = turn_.sine, cosine_at_end = turn_at_end_.cosine,
               sine_at_end = turn_at_end_.sine;
  const double body_x = x_, body_y = y_, body_x_at_end = x_at_end_, body_y_at_end = y_at_end_;
  const auto in_metres = [step](const auto* numbers) {
    // By way of floats: compilers do not vectorise conversions from 16 bits to 64.
    std::array<float, animated_width> steps;
    std::array<double, animated_width> metres;
    for (std::uint32_t lane = 0; lane < animated_width; ++lane)
      steps[lane] = static_cast<float>(numbers[lane]);
    for (std::uint32_t lane = 0; lane < animated_width; ++lane) metres[lane] = double{steps[lane]} * step;
    return metres;
  };
  auto first_x = in_metres(first_.x + from), first_y = in_metres(first_.y + from),
       first_radius = in_metres(first_.radius + from), last_x = in_metres(last_.x + from),
       last_y = in_metres(last_.y + from), last_radius = in_metres(last_.radius + from);
  std::array<std::array<double, animated_width>, 8> placed;
  auto& [x, y, radius, move_x, move_y, growth, z, move_z] = placed;
  for (std::uint32_t lane = 0; lane < animated_width; ++lane) {
    const double dx = last_x[lane] - first_x[lane], dy = last_y[lane] - first_y[lane],
                 growing = last_radius[lane] - first_radius[lane];
    const double from_x = first_x[lane] + dx * fraction, from_y = first_y[lane] + dy * fraction;
    const double to_x = first_x[lane] + dx * fraction_at_end, to_y = first_y[lane] + dy * fraction_at_end;
    x[lane] = body_x + (cosine * from_x - sine * from_y);
    y[lane] = body_y + (sine * from_x + cosine * from_y);
    radius[lane] = first_radius[lane] + growing * fraction;
    move_x[lane] = body_x_at_end + (cosine_at_end * to_x - sine_at_end * to_y) - x[lane];
    move_y[lane] = body_y_at_end + (sine_at_end * to_x + cosine_at_end * to_y) - y[lane];
    growth[lane] = growing * (fraction_at_end - fraction);
  }
  if (in_space_) {
    const auto first_z = in_metres(first_.z + from), last_z = in_metres(last_.z + from);
    const double body_z = z_, body_z_at_end = z_at_end_;
    for (std::uint32_t lane = 0; lane < animated_width; ++lane) {
      const double dz = last_z[lane] - first_z[lane];
      z[lane] = body_z + (first_z[lane] + dz * fraction);
      move_z[lane] = body_z_at_end + (first_z[lane] + dz * fraction_at_end) - z[lane];
    }
  } else {
    z.fill(0), move_z.fill(0);
  }
  for (std::size_t part = 0; part < placed.size(); ++part)
    std::copy(placed[part].begin(), placed[part].end(), discs_[part].begin() + from);
}

}  // namespace bch::detail
