// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/disc_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bch::detail {
namespace {

// These are shares of the spacing.
constexpr double turn_cost = 0.8;       ///< of a contour's direction, in match_in_order()
constexpr double least_overlap = 0.32;  ///< of neighbours
constexpr double spare_radius =
    0.02;                            ///< so that the body is held at keys without need of the smallest pieces
constexpr double unevenness = 0.06;  ///< of a contour, which does not make a body narrow

/// Where discs are along the ways of all keys, in steps of each: key by key, ascending.
using Places = std::vector<std::vector<double>>;

PlanePoint at(const std::vector<PlanePoint>& points, double place) {
  const double whole = std::floor(place);
  const std::size_t i = static_cast<std::size_t>(whole), count = points.size();
  return points[i % count] + (place - whole) * (points[(i + 1) % count] - points[i % count]);
}

/// Returns how far the nearest vertex moves to the next key.
PlanePoint motion_near(const PlanePoint& p, const KeyContour& key) {
  double nearest = std::numeric_limits<double>::infinity();
  PlanePoint motion;
  for (std::size_t i = 0; i < key.here.size(); ++i)
    if (const double square = squared_length(plane_point(key.here[i]) - p); square < nearest) {
      nearest = square;
      motion = plane_point(key.next[i]) - plane_point(key.here[i]);
    }
  return motion;
}

/// Returns the steps from a disc to the next one.
double gap(const std::vector<double>& places, std::size_t i, const EvenContour& way) {
  const double next =
      i + 1 < places.size() ? places[i + 1] : places[0] + static_cast<double>(way.points.size());
  return next - places[i];
}

/// Puts more discs between neighbours that are farther apart than the spacing at the last key.
void fill_gaps(std::span<const KeyContour> keys, double spacing, Places& places) {
  Places filled(places.size());
  const EvenContour& last = keys[places.size() - 1].way;
  for (std::size_t i = 0; i < places[0].size(); ++i) {
    const double parts = std::max(1.0, std::ceil(gap(places.back(), i, last) * last.step / spacing - 1e-9));
    for (std::size_t k = 0; k < places.size(); ++k)
      for (double part = 0; part < parts; ++part)
        filled[k].push_back(places[k][i] + gap(places[k], i, keys[k].way) * (part / parts));
  }
  places = std::move(filled);
}

/// Leaves out discs without which their neighbours are near enough at all keys.
void leave_out(std::span<const KeyContour> keys, double spacing, Places& places) {
  for (std::size_t i = 1; i + 1 < places[0].size();) {
    bool needed = false;
    for (std::size_t k = 0; k < places.size(); ++k)
      needed |= (places[k][i + 1] - places[k][i - 1]) * keys[k].way.step > spacing;
    if (needed || places[0].size() <= 3)
      ++i;
    else
      for (auto& row : places) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

Places places_of_discs(std::span<const KeyContour> keys, double spacing) {
  Places places(1);
  const EvenContour& first = keys[0].way;
  const double size = static_cast<double>(first.points.size());
  const double count = std::max(3.0, std::ceil(size * first.step / spacing));
  for (double i = 0; i < count; ++i) places[0].push_back(size * i / count);
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const KeyContour& before = keys[k - 1];
    std::vector<ExpectedPoint> expected;
    for (const double place : places.back()) {
      const PlanePoint p = at(before.way.points, place);
      expected.push_back({p + motion_near(p, before), at(before.way.inward, place)});
    }
    const std::vector<std::size_t> found = match_in_order(expected, keys[k].way, turn_cost * spacing);
    places.emplace_back(found.begin(), found.end());
    fill_gaps(keys, spacing, places);
  }
  leave_out(keys, spacing, places);
  return places;
}

/// Returns how far behind a point of a contour a centre may lie, in lengths of `inward`: by the radius of the disc that touches the contour there and
/// elsewhere, or by the most.
double inset_at(const PlanePoint& p, const PlanePoint& inward, const EvenContour& way, double most,
                double slack) {
  double inset = most;
  for (const PlanePoint& other : way.points) {
    const PlanePoint to = other - p;
    const double ahead = dot(to, inward) - slack, square = squared_length(to);
    if (ahead > 0 && square < 2 * inset * ahead) inset = square / (2 * ahead);
  }
  return inset;
}

/// Lets no centre lie deeper than its neighbours' by more than a slope, so that the way round the centres is not much longer.
void smooth(std::vector<double>& inset, double slope) {
  const std::size_t count = inset.size();
  const auto limit = [&](std::size_t i, std::size_t by) {
    inset[i % count] = std::min(inset[i % count], inset[by % count] + slope);
  };
  for (std::size_t i = 0; i < 2 * count; ++i) limit(i + 1, i);
  for (std::size_t i = 2 * count; i-- > 0;) limit(i, i + 1);
}

std::vector<double> insets(const EvenContour& way, const std::vector<double>& places,
                           const AnimateOptions& options) {
  const double spacing = double{options.spacing};
  std::vector<double> inset;
  inset.reserve(places.size());
  for (const double place : places)
    inset.push_back(inset_at(at(way.points, place), at(way.inward, place), way, double{options.inset},
                             unevenness * spacing));
  smooth(inset, 0.5 * spacing);
  return inset;
}

/// Returns the largest distance of a stretch of a way from a centre.
double distance_of(const EvenContour& way, double from, double to, const PlanePoint& centre) {
  double most =
      std::max(squared_length(at(way.points, from) - centre), squared_length(at(way.points, to) - centre));
  for (double i = std::ceil(from); i < to; ++i)
    most = std::max(most, squared_length(at(way.points, i) - centre));
  return std::sqrt(most);
}

void add_overlaps(std::span<Disc> discs, double least) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    Disc &a = discs[i], &b = discs[(i + 1) % discs.size()];
    const double apart = length({double{a.x} - double{b.x}, double{a.y} - double{b.y}});
    const double missing = least - (double{a.radius} + double{b.radius} - apart);
    if (missing <= 0) continue;
    a.radius = static_cast<float>(double{a.radius} + 0.5 * missing);
    b.radius = static_cast<float>(double{b.radius} + 0.5 * missing);
  }
}

void append_discs(const EvenContour& way, const std::vector<double>& places, const AnimateOptions& options,
                  double step, std::vector<Disc>& discs) {
  const double spacing = double{options.spacing}, size = static_cast<double>(way.points.size());
  const std::size_t count = places.size();
  const std::vector<double> inset = insets(way, places, options);
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint wanted = at(way.points, places[i]) + inset[i] * at(way.inward, places[i]);
    const PlanePoint centre = {std::trunc(wanted.x / step) * step, std::trunc(wanted.y / step) * step};
    const double place = places[i] + size;  // positive, also after half a gap has been taken away
    const double radius = distance_of(way, place - gap(places, (i + count - 1) % count, way) / 2,
                                      place + gap(places, i, way) / 2, centre);
    discs.push_back({static_cast<float>(centre.x), static_cast<float>(centre.y),
                     static_cast<float>(radius + spare_radius * spacing)});
  }
  add_overlaps(std::span(discs).last(count), least_overlap * spacing);
}

}  // namespace

double step_of(double reach) {
  int exponent = 0;
  std::frexp(reach, &exponent);
  return std::ldexp(1.0, exponent - 15);
}

AnimatedChunk rings_along(std::span<const std::vector<KeyContour>> parts, const AnimateOptions& options) {
  constexpr std::size_t most_discs = 4096;
  AnimatedChunk chunk;
  std::vector<Places> places;
  double reach = 0;
  for (const std::vector<KeyContour>& keys : parts) {
    places.push_back(places_of_discs(keys, double{options.spacing}));
    chunk.disc_count += static_cast<std::uint32_t>(places.back()[0].size());
    chunk.ring_ends.push_back(chunk.disc_count);
    for (const KeyContour& key : keys)
      for (const PlanePoint& p : key.way.points) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  }
  if (chunk.disc_count > most_discs) throw std::length_error("animated discs: more than 4096");
  for (std::size_t k = 0; k < parts[0].size(); ++k) {
    chunk.times.push_back(parts[0][k].time);
    for (std::size_t i = 0; i < parts.size(); ++i)
      append_discs(parts[i][k].way, places[i][k], options, step_of(reach), chunk.keys);
  }
  return chunk;
}

}  // namespace bch::detail
