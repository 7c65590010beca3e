// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bch::detail {
namespace {

/// A face bounded by n segments has O(n alpha(n)) stretches (Pollack, Sharir, Sifrony, "Separating two simple
/// polygons by a sequence of translations", 1988), with alpha(n) <= 4 for any n that fits a computer.
constexpr std::size_t max_stretches_per_segment = 256;

/// From so many candidates on, more than poses of characters have, they are found through the tree.
constexpr std::size_t many_candidates = 16384;

/// A line is searched in pieces. The first one is of at least so many steps, and so many times as long as the
/// last stretch; each further one is so many times as long as the one before.
constexpr double shortest_piece = 64, more_than_last = 1.125, piece_growth = 4;

double length_of(GridVector direction) {
  return std::sqrt(static_cast<double>(dot(direction, direction)));
}

GridPlace place_on(const Place& line, double at) {
  const GridVector direction = line.direction();
  return {line.from.x + at * static_cast<double>(direction.x),
          line.from.y + at * static_cast<double>(direction.y)};
}

/// The coordinates of a cell that steps are in.
std::int16_t cell(std::int32_t steps) {
  return static_cast<std::int16_t>(steps >> cell_bits);
}

}  // namespace

void OutlineWalk::begin(const CandidateList& candidates) {
  candidates_ = &candidates;
  if (const std::size_t most = candidates.capacity(); near_.size() < most) {
    for (std::vector<double>* const each : {&side_a_, &side_b_, &along_, &at_}) each->resize(most);
    for (std::vector<std::uint64_t>* const each : {&crossing_, &ending_}) each->resize(most / 64 + 1);
    near_.resize(most);  // the last one, which tells that the others have room
  }
  candidates_->boxes().describe(search_);
  search_.segments = candidates_->segments().data();
  search_.near = near_.data();
  search_.side_a = side_a_.data(), search_.side_b = side_b_.data();
  search_.along = along_.data(), search_.at = at_.data();
  search_.crossing = crossing_.data(), search_.ending = ending_.data();
  touched_.assign(candidates.component_points().size(), 0);
  has_tree_ = candidates_->segments().size() >= many_candidates;
  if (has_tree_) tree_.assign(candidates_->segments());
}

void OutlineWalk::walk(GridPoint start, std::vector<Stretch>& contour) {
  const std::size_t first = contour.size(),
                    most = first + max_stretches_per_segment * candidates_->segments().size();
  const Place arriving{{start.x - 1, start.y}, start, {}};
  if (has_tree_)
    find_near_piece(arriving, 0, 1);
  else
    find_near(arriving, start);
  take_first_direction(arriving, contour.emplace_back());
  while (contour.size() <= most) {
    contour.emplace_back();  // filled in place: copies would wait for what has just been written in parts
    const Stretch& now = contour[contour.size() - 2];
    Stretch& next = contour.back();
    if (has_tree_) {
      if (cross_in_pieces(now, next)) continue;
    } else {
      find_near(now.begin, now.rounded_begin);
      if (take_first_crossing(now.begin, 1, next)) continue;
    }
    take_first_direction(now.begin, next);
    if (now.begin.to == start && same_direction(next.begin.direction(), contour[first].begin.direction()))
      return contour.pop_back();
  }
  throw std::logic_error("outline: the walk from (" + std::to_string(start.x) + ", " +
                         std::to_string(start.y) + ") on the grid does not return");
}

/// Examines the candidates near the line from a place to the end of its line.
void OutlineWalk::find_near(const Place& here, GridPoint rounded_here) {
  const GridPoint from = rounded_here, to = here.to;
  near_count_ =
      loops_->find_near(search_, {here.from.x, here.from.y, to.x, to.y, here.at.value,
                                  cell(std::min(from.x - 1, to.x)), cell(std::min(from.y - 1, to.y)),
                                  cell(std::max(from.x + 1, to.x)), cell(std::max(from.y + 1, to.y))});
}

/// Finds the candidates near the part of the line between two fractions of it, through the tree.
void OutlineWalk::find_near_piece(const Place& here, double begin, double end) {
  near_count_ = tree_.find(place_on(here, begin), place_on(here, end), near_.data());
  std::fill_n(near_.begin() + static_cast<std::ptrdiff_t>(near_count_), boxes_per_block, 0u);
  loops_->test_near(search_, {here.from.x, here.from.y, here.to.x, here.to.y, here.at.value, 0, 0, 0, 0},
                    near_count_);
}

/// take_first_crossing() piece by piece, longer and longer ones: where candidates are many, most are beyond the first
/// crossing. Leaves the candidates near the end of the line where there is none.
bool OutlineWalk::cross_in_pieces(const Stretch& now, Stretch& next) {
  const Place& here = now.begin;
  const double length = length_of(here.direction());
  double begin = here.at.value;
  for (double piece = std::max(shortest_piece, more_than_last * last_length_);; piece *= piece_growth) {
    const double end = std::min(begin + piece / length, 1.0);
    find_near_piece(here, begin, end);
    const bool crosses = take_first_crossing(here, end, next);
    if (crosses || end == 1) {
      last_length_ = length_of((crosses ? next.rounded_begin : here.to) - now.rounded_begin);
      return crosses;
    }
    begin = end;
  }
}

/// Calls each(i) where bit i of those found is set, in order.
template <class Each>
void OutlineWalk::for_each(const std::vector<std::uint64_t>& bits, Each each) const {
  for (std::size_t word = 0; 64 * word < near_count_; ++word)
    for (std::uint64_t open = bits[word]; open != 0; open &= open - 1)
      each(64 * word + static_cast<std::size_t>(std::countr_zero(open)));
}

/// Fills `next` with the first branch to the right after `here` and before the end of its line, if there is one within that
/// fraction of the line.
bool OutlineWalk::take_first_crossing(const Place& here, double limit, Stretch& next) {
  constexpr std::size_t none = ~std::size_t{0};
  std::size_t first = none;
  Fraction nearest;
  const auto left = [&](std::size_t i) {
    const auto [a, b] = search_.segments[near_[i]];
    return side_a_[i] < 0 ? b : a;
  };
  const auto right = [&](std::size_t i) {
    const auto [a, b] = search_.segments[near_[i]];
    return side_a_[i] < 0 ? a : b;
  };
  const auto whole = [&](std::size_t i) {
    return static_cast<std::int64_t>(std::abs(side_a_[i] - side_b_[i]));
  };
  for_each(crossing_, [&](std::size_t i) {
    if (at_[i] > limit) return;
    const Fraction at(static_cast<std::int64_t>(along_[i]), whole(i), at_[i]);
    if (compare(at, here.at) <= 0) return;
    const int order = first != none ? compare(at, nearest) : -1;
    if (order > 0) return;
    if (order == 0 && cross(right(i) - left(i), right(first) - left(first)) <= 0) return;
    nearest = at;
    first = i;
  });
  if (first == none) return false;
  next.begin.from = left(first);
  next.begin.to = right(first);
  next.begin.at = {static_cast<std::int64_t>(std::max(side_a_[first], side_b_[first])), whole(first)};
  next.rounded_begin = rounded(next.begin);
  touch(near_[first]);
  return true;
}

/// Fills `next` with the first branch counter-clockwise from where `here` comes from, of all that candidates offer
/// from the end of its line: to the right of the line, straight on, to its left, and last back.
void OutlineWalk::take_first_direction(const Place& here, Stretch& next) {
  const GridPoint at = here.to;
  const GridVector direction = here.direction();
  GridVector first{0, 0};
  int first_part = 4;
  std::uint32_t first_segment = 0;
  const auto consider = [&](GridPoint end, double side, std::uint32_t segment) {
    const GridVector other = end - at;
    const int on_line = dot(direction, other) > 0 ? 1 : 3;
    const int part = side < 0 ? 0 : side > 0 ? 2 : on_line;
    if (part > first_part || (part == first_part && cross(other, first) <= 0)) return;
    first = other, first_part = part;
    first_segment = segment;
    next.begin.to = end;
  };
  for_each(ending_, [&](std::size_t i) {
    const auto [a, b] = search_.segments[near_[i]];
    if (!(a == at)) consider(a, side_a_[i], near_[i]);
    if (!(b == at)) consider(b, side_b_[i], near_[i]);
  });
  next.begin.from = next.rounded_begin = at;
  next.begin.at = {};
  touch(first_segment);
}

void OutlineWalk::touch(std::uint32_t segment) {
  touched_[candidates_->component(segment)] = 1;
}

}  // namespace bch::detail
