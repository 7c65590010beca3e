// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/footprints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <bch/obstacles.hpp>
#include <bch/shapes.hpp>

#include "kernel/obstacles/segments_by_number.hpp"
#include "layout/base/heading.hpp"
#include "layout/recordings/shown.hpp"

namespace bch::detail {
namespace {

/// Returns a footprint by its left half, from the back to the front.
PlanePolygons mirrored(std::vector<Vec2> left) {
  for (std::size_t i = left.size(); i-- > 0;) left.push_back({left[i].x, -left[i].y});
  return {left};
}

/// Kinds of a size of their own, with their users if they have any: sizes as they are usual.
const std::vector<Footprint>& things() {
  static const std::vector<Footprint> all{
      {"wheelchair",  // ISO 7176-5 allows 1.3 m by 0.7 m
       mirrored({{-0.6f, 0.3f}, {-0.45f, 0.35f}, {0.15f, 0.35f}, {0.3f, 0.22f}, {0.6f, 0.2f}})},
      {"bicycle",  // wheels, its rider and the handlebars
       mirrored({{-0.9f, 0.04f},
                 {-0.35f, 0.04f},
                 {-0.3f, 0.2f},
                 {0.1f, 0.22f},
                 {0.35f, 0.3f},
                 {0.5f, 0.3f},
                 {0.5f, 0.04f},
                 {0.9f, 0.04f}})},
      {"trolley", mirrored({{-0.5f, 0.3f}, {0.5f, 0.24f}})},
      {"robot", mirrored({{-0.35f, 0.22f}, {-0.3f, 0.27f}, {0.3f, 0.27f}, {0.35f, 0.22f}})}};
  return all;
}

/// Returns a regular polygon that holds the disc of radius 1, and that stretched by at most `radius` is nowhere farther from the stretched disc
/// than 1 mm.
PlanePolygons round_polygon(double radius) {
  constexpr double tolerance = 0.000'99;  // to spare for floats
  int corners = 8;
  while (radius * (1 / rotation(std::numbers::pi / corners).cosine - 1) > tolerance) ++corners;
  const double outer = (1 + 1e-6) / rotation(std::numbers::pi / corners).cosine;
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const Rotation turn = rotation(2 * std::numbers::pi * (i + 0.5) / corners - std::numbers::pi);
    points.push_back({static_cast<float>(outer * turn.cosine), static_cast<float>(outer * turn.sine)});
  }
  return {points};
}

void stretch(PlanePolygons& polygons, double along, double across) {
  for (std::vector<Vec2>& polygon : polygons)
    for (Vec2& point : polygon)
      point = {static_cast<float>(along * static_cast<double>(point.x)),
               static_cast<float>(across * static_cast<double>(point.y))};
}

/// The extent of polygons along an axis.
double extent(const PlanePolygons& polygons, float Vec2::*axis) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const std::vector<Vec2>& polygon : polygons)
    for (const Vec2 point : polygon) low = std::min(low, point.*axis), high = std::max(high, point.*axis);
  return static_cast<double>(high) - static_cast<double>(low);
}

/// Looks for a footprint of a size of its own.
const Footprint* find_thing(const std::string& kind, std::span<const Footprint> own) {
  for (const std::span<const Footprint> some : {own, std::span<const Footprint>(things())})
    for (const Footprint& footprint : some)
      if (footprint.name == kind) return &footprint;
  return nullptr;
}

}  // namespace

Footprint footprint_from_wkt(const std::string& name, std::string_view text) {
  const ObstacleSet read = obstacles_from_wkt(text);
  Footprint footprint{name, {}};
  for (const WorldSegment* segment : segments_by_number(read.view())) {
    if (read.view().is_area[segment->obstacle] == 0)
      throw std::invalid_argument("expected polygons, found a line");
    if (read.view().begins_polyline[segment->number] != 0) footprint.polygons.emplace_back();
    footprint.polygons.back().push_back({static_cast<float>(segment->ax), static_cast<float>(segment->ay)});
  }
  shape_from_polygons(footprint.polygons);  // which says what is wrong with them
  return footprint;
}

PlanePolygons footprint_of(const std::string& kind, double length, double width,
                           std::span<const Footprint> own) {
  if (const Footprint* const thing = find_thing(kind, own)) {
    PlanePolygons polygons = thing->polygons;
    stretch(polygons, length > 0 ? length / extent(polygons, &Vec2::x) : 1,
            width > 0 ? width / extent(polygons, &Vec2::y) : 1);
    return polygons;
  }
  const bool is_round = kind == "disc" || kind == "ellipse";
  if (!is_round && kind != "box") {
    std::string known = "disc, box, ellipse";
    for (const Footprint& thing : things()) known += ", " + thing.name;
    for (const Footprint& thing : own) known += ", " + trajectory::shown(thing.name);
    throw std::invalid_argument("body " + trajectory::shown(kind) + " is none of " + known +
                                "; --body adds others");
  }
  if (length == 0) length = width;
  if (width == 0) width = length;
  if (length == 0)
    throw std::invalid_argument("body " + trajectory::shown(kind) +
                                " has no size: a length, a width or a radius has to give it");
  PlanePolygons polygons = is_round ? round_polygon(std::max(length, width) / 2)
                                    : PlanePolygons{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  stretch(polygons, length / 2, width / 2);
  return polygons;
}

}  // namespace bch::detail
