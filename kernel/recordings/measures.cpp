// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace bch::detail {
namespace {

constexpr double grid_cell = farthest_neighbour / 2;  ///< metres
constexpr std::int64_t grid_reach = 2;                ///< cells on each side that neighbours are in

double squared(double value) {
  return value * value;
}

/// The corners of a regular polygon on the unit circle; plain numbers, because sines differ from library to library.
constexpr double half = 0.5, high = std::numbers::sqrt3 / 2;
constexpr std::array<std::array<double, 2>, cell_sides> unit_corners{{{1, 0},
                                                                      {high, half},
                                                                      {half, high},
                                                                      {0, 1},
                                                                      {-half, high},
                                                                      {-high, half},
                                                                      {-1, 0},
                                                                      {-high, -half},
                                                                      {-half, -high},
                                                                      {0, -1},
                                                                      {half, -high},
                                                                      {high, -half}}};

}  // namespace

void NeighbourMeasures::measure(std::span<const double> x, std::span<const double> y,
                                std::span<const double> step_x, std::span<const double> step_y,
                                std::span<MeasuredPerson> people) {
  placed_.clear();
  for (std::uint32_t i = 0; i < x.size(); ++i)
    placed_.push_back({static_cast<std::int64_t>(std::floor(y[i] / grid_cell)),
                       static_cast<std::int64_t>(std::floor(x[i] / grid_cell)), i, x[i], y[i], step_x[i],
                       step_y[i]});
  const auto cell_of = [](const Placed& placed) { return std::tie(placed.row, placed.column); };
  std::sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.row, a.column, a.person) < std::tie(b.row, b.column, b.person);
  });
  // People of one cell have the same cells around them.
  const Placed *const begin = placed_.data(), *const end = begin + placed_.size();
  for (const Placed* first = begin; first != end;) {
    const Placed* const last =
        std::find_if(first, end, [&](const Placed& placed) { return cell_of(placed) != cell_of(*first); });
    std::array<std::span<const Placed>, 2 * grid_reach + 1> rows;
    for (std::int64_t k = 0; k <= 2 * grid_reach; ++k) {
      const auto at = [&](std::int64_t column) {
        return std::lower_bound(
            begin, end, std::tuple(first->row + k - grid_reach, column),
            [&](const Placed& placed, const auto& wanted) { return cell_of(placed) < wanted; });
      };
      const Placed* const from = at(first->column - grid_reach);
      const Placed* const to = at(first->column + grid_reach + 1);
      rows[static_cast<std::size_t>(k)] = {from, static_cast<std::size_t>(to - from)};
    }
    for (; first != last; ++first) {
      MeasuredPerson& person = people[first->person];
      neighbours_.clear();
      for (const std::span<const Placed> row : rows) add(row, *first, person);
      person.voronoi_density = static_cast<float>(1 / cell_area());
    }
  }
}

/// Adds what some people, among whom the person himself may be, are to a person.
void NeighbourMeasures::add(std::span<const Placed> some, const Placed& own, MeasuredPerson& person) {
  constexpr double diameter = 2 * measured_disc;
  double intrusion = 0, least = squared(farthest_neighbour);
  for (const Placed& other : some) {
    const double x = other.x - own.x, y = other.y - own.y, square = x * x + y * y;
    if (square > squared(farthest_neighbour) || other.person == own.person) continue;
    neighbours_.push_back({square, x, y});
    least = std::min(least, square);
    const double gap = std::sqrt(square) - diameter;
    intrusion += gap > 0 ? squared(measured_clearance / gap) : std::numeric_limits<double>::infinity();
    person.intimate += square <= squared(intimate_space);
    person.personal += square <= squared(personal_space);
    const double half_x = x + (other.step_x - own.step_x) / 2, half_y = y + (other.step_y - own.step_y) / 2;
    person.disc_collides |= std::min(square, half_x * half_x + half_y * half_y) <= squared(diameter);
  }
  person.disc_intrusion += static_cast<float>(intrusion);
  if (least < squared(farthest_neighbour))
    person.disc_clearance = std::min(person.disc_clearance, static_cast<float>(std::sqrt(least) - diameter));
}

/// Returns the area that is nearer to a person than to his neighbours, and within a polygon around him. The nearest ones cut the cell
/// first, until others are too far away, which most of them are.
double NeighbourMeasures::cell_area() {
  cell_.clear();
  for (const auto& [x, y] : unit_corners) cell_.push_back({cell_radius * x, cell_radius * y});
  const auto middle = std::partition(neighbours_.begin(), neighbours_.end(), [](const Neighbour& each) {
    return each.square <= squared(cell_radius);
  });
  double extent = squared(cell_radius);
  const auto cut_by = [&](auto first, auto last) {
    std::sort(first, last, [](const Neighbour& a, const Neighbour& b) {
      return std::tie(a.square, a.x, a.y) < std::tie(b.square, b.x, b.y);
    });
    for (; first != last && first->square < 4 * extent; ++first) {
      if (first->square == 0) continue;  // nothing is nearer to one of the two
      cut(*first);
      extent = square_extent();
    }
  };
  cut_by(neighbours_.begin(), middle);
  if (squared(cell_radius) < 4 * extent) cut_by(middle, neighbours_.end());
  double twice = 0;
  for (std::size_t i = 0, before = cell_.size() - 1; i < cell_.size(); before = i++)
    twice += cell_[before].x * cell_[i].y - cell_[before].y * cell_[i].x;
  return twice / 2;
}

double NeighbourMeasures::square_extent() const {
  double extent = 0;
  for (const Corner& corner : cell_) extent = std::max(extent, squared(corner.x) + squared(corner.y));
  return extent;
}

/// Keeps the part of the cell that is nearer to the person than to a neighbour.
void NeighbourMeasures::cut(const Neighbour& neighbour) {
  const auto beyond = [&](const Corner& corner) {
    return neighbour.x * corner.x + neighbour.y * corner.y - neighbour.square / 2;
  };
  kept_.clear();
  Corner from = cell_.back();
  double from_beyond = beyond(from);
  for (const Corner& to : cell_) {
    const double to_beyond = beyond(to);
    if ((from_beyond > 0) != (to_beyond > 0)) {
      const double share = from_beyond / (from_beyond - to_beyond);
      kept_.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
    if (to_beyond <= 0) kept_.push_back(to);
    from = to, from_beyond = to_beyond;
  }
  if (!kept_.empty()) cell_.swap(kept_);  // of a cell without an area, rounding may leave nothing
}

}  // namespace bch::detail
