// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/first_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/numbers.hpp"
#include "layout/recordings/row.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr std::size_t max_shown = 2, max_shown_fields = 12;

std::string shown_field(std::string_view field) {
  const std::optional<double> number = number_from(field);
  if (number) return shortest(*number);
  const std::string quoted = trajectory::shown(field);
  return quoted.substr(1, quoted.size() - 2);
}

/// The steps between numbers of a column, by their greatest common divisor.
class ColumnSteps {
 public:
  void add(std::int64_t number) {
    if (any_) divisor_ = std::gcd(divisor_, std::clamp<std::int64_t>(number, -most, most) - last_);
    last_ = std::clamp<std::int64_t>(number, -most, most);
    any_ = true;
  }
  std::int64_t divisor() const { return divisor_; }

 private:
  static constexpr std::int64_t most = std::int64_t{1} << 53;
  bool any_ = false;
  std::int64_t last_ = 0, divisor_ = 0;
};

}  // namespace

void FirstRows::add(std::uint64_t line, std::span<const std::string_view> fields) {
  if (lines_.empty()) columns_ = fields.size();
  if (lines_.size() < max_shown) {
    Line& kept = lines_.emplace_back(Line{line, {}});
    for (const std::string_view field : fields.first(std::min(fields.size(), max_shown_fields)))
      kept.fields.push_back(shown_field(field));
    if (fields.size() > max_shown_fields) kept.fields.emplace_back("...");
  }
  ++others_;
  if (fields.size() < 4) return;
  const std::optional<std::int64_t> first = whole_number_from(fields[0]),
                                    second = whole_number_from(fields[1]);
  const std::optional<double> x = number_from(fields[2]), y = number_from(fields[3]);
  if (!first || !second || !x || !y || !is_finite(*x) || !is_finite(*y)) return;
  const double z = fields.size() > 4 ? number_from(fields[4]).value_or(0) : 0;
  places_.push_back({*first, *second, *x, *y, z});
  --others_;
}

/// The places with the person first and the frame second, by both.
std::vector<FirstRows::Place> FirstRows::by_person(ColumnOrder order) const {
  std::vector<Place> places = places_;
  if (order == ColumnOrder::frame_first)
    for (Place& place : places) std::swap(place.first, place.second);
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return places;
}

double FirstRows::extent() const {
  Place low = places_.front(), high = low;
  for (const Place& place : places_) {
    low.x = std::min(low.x, place.x), low.y = std::min(low.y, place.y);
    high.x = std::max(high.x, place.x), high.y = std::max(high.y, place.y);
  }
  return std::hypot(high.x - low.x, high.y - low.y);
}

/// The median of the distances from row to row of a person; nothing where nobody has two rows.
std::optional<double> FirstRows::median_distance(ColumnOrder order) const {
  const std::vector<Place> places = by_person(order);
  std::vector<double> distances;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].first == places[i - 1].first && places[i].second != places[i - 1].second)
      distances.push_back(std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y));
  if (distances.empty()) return std::nullopt;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

ColumnOrder FirstRows::order_by_distances() const {
  constexpr double clearly = 3, one_path = 12;
  if (places_.empty()) return ColumnOrder::unclear;
  const std::optional<double> ids = median_distance(ColumnOrder::id_first),
                              frames = median_distance(ColumnOrder::frame_first);
  const auto is_better = [&](const std::optional<double>& distance, const std::optional<double>& other) {
    if (!distance) return false;
    return other ? *distance < *other && clearly * *distance <= *other : one_path * *distance <= extent();
  };
  return is_better(ids, frames)   ? ColumnOrder::id_first
         : is_better(frames, ids) ? ColumnOrder::frame_first
                                  : ColumnOrder::unclear;
}

bool FirstRows::may_be_one_person(double speed) const {
  constexpr std::size_t few = 12;  // more of them show a path
  constexpr double fastest = 12;   // metres a second
  const std::vector<Place> places = by_person(ColumnOrder::id_first);
  if (places.size() < 2 || places.size() >= few) return false;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Place &last = places[i - 1], &next = places[i];
    const double distance = std::hypot(next.x - last.x, next.y - last.y),
                 frames = static_cast<double>(next.second) - static_cast<double>(last.second);
    if (next.first != last.first || !(distance * speed <= fastest * frames)) return false;
  }
  return true;
}

ColumnOrder FirstRows::order_by_steps() const {
  ColumnSteps first, second;
  for (const Place& place : places_) {
    first.add(place.first);
    second.add(place.second);
  }
  if (first.divisor() > 1 && second.divisor() == 1) return ColumnOrder::frame_first;
  if (first.divisor() == 1 && second.divisor() > 1) return ColumnOrder::id_first;
  return ColumnOrder::unclear;
}

bool FirstRows::has_other_in_fifth(ColumnOrder order) const {
  if (columns_ != 5) return false;
  if (std::any_of(places_.begin(), places_.end(), [](const Place& place) { return place.z < 0; }))
    return true;
  const auto never_varies = [&](double Place::*value) {
    return std::all_of(places_.begin(), places_.end(),
                       [&](const Place& place) { return place.*value == places_.front().*value; });
  };
  if (!never_varies(&Place::x) && !never_varies(&Place::y)) return false;
  const std::vector<Place> places = by_person(order);
  return std::adjacent_find(places.begin(), places.end(), [](const Place& a, const Place& b) {
           return a.first == b.first && a.z != b.z;
         }) != places.end();
}

std::string FirstRows::shown() const {
  std::string text;
  for (const Line& line : lines_) {
    text += text.empty() ? "'" : " and '";
    for (std::size_t i = 0; i < line.fields.size(); ++i) text += (i == 0 ? "" : " ") + line.fields[i];
    text += '\'';
  }
  return text;
}

std::string FirstRows::read_as(const Columns& columns) const {
  std::string text;
  for (const Line& line : lines_) {
    text += (text.empty() ? "line " : "; line ") + std::to_string(line.number) + " has ";
    const char* between = "";
    for (std::size_t i = 0; i < std::min(columns.needed, line.fields.size()); ++i) {
      if (columns.roles[i] == Role::none) continue;
      text += between + columns.names[i] + " " + line.fields[i];
      between = ", ";
    }
  }
  return text;
}

}  // namespace bch::detail::trajectory
