// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/slab_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

constexpr double wanted_bend = 0.001;                                       ///< metres
constexpr double shortest_slab_window = 0.001, longest_slab_window = 0.02;  ///< seconds
/// What positions in float are off by, as a share of their size; see cover_check.cpp.
constexpr double rounding_share = 4e-6;

constexpr Heights nowhere = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

Heights united(const Heights& a, const Heights& b) {
  return {std::min(a.bottom, b.bottom), std::max(a.top, b.top)};
}

}  // namespace

SlabTriangles::SlabTriangles(const Character& character, std::uint32_t clip, double least_edge)
    : character_(character),
      clip_(clip),
      least_edge_(least_edge),
      bounds_(character, clip),
      skinner_(character) {}

/// Goes from window to window: each ends at the next key of a channel at the latest.
void SlabTriangles::look(float from, float to) {
  const std::vector<float>& keys = bounds_.key_times();
  interval_.assign(character_.vertices.size(), nowhere);
  for (float begin = from; begin < to;) {
    const auto next = std::upper_bound(keys.begin(), keys.end(), begin);
    const float limit = next == keys.end() ? to : std::min(to, *next);
    const double acceleration = bounds_.height_acceleration(begin), left = double{limit} - double{begin};
    const double even = std::sqrt(8 * wanted_bend / std::max(acceleration, 1e-9));
    const double parts = std::ceil(left / std::clamp(even, shortest_slab_window, longest_slab_window));
    const float after = static_cast<float>(double{begin} + left / parts);
    const float end = parts <= 1 || !(begin < after) ? limit : after;
    window_.assign(interval_.size(), nowhere);
    reach_ = 0;
    add(begin), add(end);
    const double seconds = double{end} - double{begin};
    widen(acceleration * seconds * seconds / 8 + rounding_share * reach_);
    begin = end;
  }
}

void SlabTriangles::add(float seconds) {
  const std::span<const Vec3> pose = skinner_.pose({clip_, seconds});
  for (std::size_t v = 0; v < pose.size(); ++v) {
    const auto& [x, y, z] = pose[v];
    window_[v] = united(window_[v], {z, z});
    reach_ = std::max({reach_, std::abs(double{x}), std::abs(double{y}), std::abs(double{z})});
  }
}

void SlabTriangles::widen(double room) {
  for (std::size_t v = 0; v < window_.size(); ++v)
    interval_[v] = united(interval_[v], {rounding::round_down(double{window_[v].bottom} - room),
                                         -rounding::round_down(-double{window_[v].top} - room)});
}

MovingMesh SlabTriangles::in(const Heights& slab) {
  interval_.resize(character_.vertices.size());
  bind_ = character_.vertices;
  MovingMesh mesh;
  for (const Triangle& triangle : character_.triangles) add_pieces(triangle, slab, mesh);
  return mesh;
}

Heights SlabTriangles::heights_of(const Triangle& triangle) const {
  const auto& [a, b, c] = triangle;
  return united(united(interval_[a], interval_[b]), interval_[c]);
}

void SlabTriangles::add_pieces(const Triangle& triangle, const Heights& slab, MovingMesh& mesh) {
  const Heights of = heights_of(triangle);
  if (of.top < slab.bottom || slab.top < of.bottom) return;
  const auto square = [&](std::size_t i) {
    const Vec3 &a = bind_[triangle[i]], &b = bind_[triangle[(i + 1) % 3]];
    const double x = double{a.x} - double{b.x}, y = double{a.y} - double{b.y}, z = double{a.z} - double{b.z};
    return x * x + y * y + z * z;
  };
  const std::size_t edge =
      square(0) > square(1) ? (square(0) > square(2) ? 0 : 2) : (square(1) > square(2) ? 1 : 2);
  const bool is_inside = slab.bottom <= of.bottom && of.top <= slab.top;
  if (is_inside || square(edge) <= least_edge_ * least_edge_) return mesh.triangles.push_back(triangle);
  const std::uint32_t from = triangle[edge], to = triangle[(edge + 1) % 3];
  const auto middle = static_cast<std::uint32_t>(bind_.size());
  mesh.middles.push_back({from, to});
  bind_.push_back(MovingMesh::middle(bind_[from], bind_[to]));
  interval_.push_back({interval_[from].bottom / 2 + interval_[to].bottom / 2,
                       interval_[from].top / 2 + interval_[to].top / 2});
  for (const std::size_t corner : {edge, (edge + 1) % 3}) {
    Triangle half = triangle;
    half[corner] = middle;
    add_pieces(half, slab, mesh);
  }
}

double SlabTriangles::most_rise(const Heights& slab) const {
  double most = 0;
  for (const auto& [bottom, top] : interval_)
    if ((bottom < slab.bottom && slab.bottom < top) || (bottom < slab.top && slab.top < top))
      most = std::max(most, double{top} - double{bottom});
  return most;
}

Heights SlabTriangles::heights() const {
  Heights all = nowhere;
  for (const Triangle& triangle : character_.triangles) all = united(all, heights_of(triangle));
  return all;
}

}  // namespace bch::detail
