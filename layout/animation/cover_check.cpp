// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/cover_check.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "layout/base/ring_edges.hpp"

namespace bch::detail {
namespace {

constexpr double longest_window = 0.004;  ///< seconds
/// What positions in float are off by, as a share of their size: of skinning (some ten operations deep), and of discs between keys.
constexpr double rounding = 4e-6;
// These are shares of the spacing.
constexpr double most_bend = 0.01;
constexpr double least_piece = 0.04;  ///< an edge of a piece that is not divided
constexpr double growth_spare =
    0.004;  ///< by which discs are enlarged more, so that the next window needs less

constexpr std::uint32_t no_disc = 0xffffffff;

double mix(double a, double b, double share) {
  return a + (b - a) * share;
}
PlanePoint centre_of(const Disc& disc) {
  return {double{disc.x}, double{disc.y}};
}
template <class Moving>
double overlap(const Moving& a, const Moving& b) {
  return std::min(a.radius_a + b.radius_a - length(a.centre.a - b.centre.a),
                  a.radius_b + b.radius_b - length(a.centre.b - b.centre.b));
}
/// Returns how far a disc and its boundary move in a window.
template <class Moving>
double way_of(const Moving& disc) {
  return length(disc.centre.b - disc.centre.a) + std::abs(disc.radius_b - disc.radius_a);
}

}  // namespace

CoverCheck::CoverCheck(const Character& character, std::uint32_t clip, double spacing)
    : character_(character), clip_(clip), spacing_(spacing), bounds_(character, clip), skinner_(character) {}

void CoverCheck::hold(AnimatedChunk& chunk) {
  last_holder_.assign(character_.triangles.size(), no_disc);
  for (std::size_t key = 0; key + 1 < chunk.times.size(); ++key) hold_between_keys(chunk, key);
}

void CoverCheck::pose(float seconds, std::vector<PlanePoint>& points) {
  points.clear();
  for (const Vec2& p : skinner_.ground_pose({clip_, seconds})) points.push_back(plane_point(p));
}

/// Goes from window to window: each ends at the next key of a channel at the latest, and is as long as the bounds allow.
void CoverCheck::hold_between_keys(AnimatedChunk& chunk, std::size_t key) {
  const std::vector<float>& motion_keys = bounds_.key_times();
  const auto end = static_cast<float>(chunk.times[key + 1]);
  auto from = static_cast<float>(chunk.times[key]);
  pose(from, pose_a_);
  while (from < end) {
    const auto next = std::upper_bound(motion_keys.begin(), motion_keys.end(), from);
    const float limit = next == motion_keys.end() ? end : std::min(end, *next);
    from = take_window(chunk, key, from, limit);
    hold_window(chunk, key);
    std::swap(pose_a_, pose_b_);
  }
}

/// Places vertices and discs at both ends of a window that is short enough.
/// Returns: its end.
float CoverCheck::take_window(const AnimatedChunk& chunk, std::size_t key, float from, float limit) {
  const double acceleration = bounds_.acceleration(from), left = double{limit} - double{from};
  const double even = std::sqrt(8 * most_bend * spacing_ / std::max(acceleration, 1e-9));
  for (double window = std::min({left, longest_window, even});; window /= 2) {
    const double parts = std::ceil(left / window);
    const float to = parts <= 1 ? limit : static_cast<float>(double{from} + left / parts);
    if (!(to > from)) throw std::invalid_argument("animated discs: vertices move too fast");
    const double seconds = double{to} - double{from};
    pose(to, pose_b_);
    bend_ = acceleration * seconds * seconds / 8 + rounding * reach();
    place_discs(chunk, key, double{from}, double{to});
    if (is_calm(chunk)) return to;
  }
}

double CoverCheck::reach() const {
  double reach = 0;
  for (const PlanePoint& p : pose_b_) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  return reach;
}

void CoverCheck::place_discs(const AnimatedChunk& chunk, std::size_t key, double from, double to) {
  const double begin = chunk.times[key], length = chunk.times[key + 1] - begin;
  const double share_a = (from - begin) / length, share_b = (to - begin) / length;
  discs_.clear();
  for (std::uint32_t i = 0; i < chunk.disc_count; ++i) {
    const Disc& first = chunk.keys[key * chunk.disc_count + i];
    const Disc& last = chunk.keys[(key + 1) * chunk.disc_count + i];
    const PlanePoint way = centre_of(last) - centre_of(first);
    discs_.push_back({{centre_of(first) + share_a * way, centre_of(first) + share_b * way},
                      mix(double{first.radius}, double{last.radius}, share_a),
                      mix(double{first.radius}, double{last.radius}, share_b)});
  }
}

/// Returns whether neighbours overlap by more than vertices and discs move relative to each other in a window: twice as much as in half
/// of it.
bool CoverCheck::is_calm(const AnimatedChunk& chunk) const {
  double square = 0;
  for (std::size_t v = 0; v < pose_a_.size(); ++v)
    square = std::max(square, squared_length(pose_b_[v] - pose_a_[v]));
  const double way = std::sqrt(square) + 4 * bend_;
  bool calm = true;
  for_each_ring_edge(chunk.ring_ends, [&](std::uint32_t i, std::uint32_t next) {
    const MovingDisc &one = discs_[i], &other = discs_[next];
    calm &= way + std::max(way_of(one), way_of(other)) <= overlap(one, other);
  });
  return calm;
}

void CoverCheck::hold_window(AnimatedChunk& chunk, std::size_t key) {
  const auto set = [&](WindingGrid& grid, PlanePoint Moving::*when) {
    corners_.clear();
    for (const MovingDisc& disc : discs_) corners_.push_back(disc.centre.*when);
    grid.set(corners_, chunk.ring_ends);
  };
  set(grid_a_, &Moving::a);
  set(grid_b_, &Moving::b);
  for (std::size_t t = 0; t < character_.triangles.size(); ++t) {
    Piece piece;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = character_.triangles[t][i];
      piece[i] = {pose_a_[vertex], pose_b_[vertex]};
    }
    std::uint32_t& last = last_holder_[t];
    if ((last < discs_.size() && holds(discs_[last], piece)) || inside_rings(piece)) continue;
    find_near(piece);
    last = hold_piece(piece, chunk, key);
  }
}

/// Returns whether a disc holds a piece throughout the window.
bool CoverCheck::holds(const MovingDisc& disc, const Piece& piece) const {
  const double room_a = disc.radius_a - bend_, room_b = disc.radius_b - bend_;
  if (!(room_a >= 0 && room_b >= 0)) return false;
  for (const Moving& corner : piece)
    if (squared_length(corner.a - disc.centre.a) > room_a * room_a ||
        squared_length(corner.b - disc.centre.b) > room_b * room_b)
      return false;
  return true;
}

/// Returns whether rings go round a piece at both ends of the window, and do not meet it.
bool CoverCheck::inside_rings(const Piece& piece) const {
  const Moving &p = piece[0], &q = piece[1], &r = piece[2];
  return grid_a_.holds(lower(lower(p.a, q.a), r.a), upper(upper(p.a, q.a), r.a)) &&
         grid_b_.holds(lower(lower(p.b, q.b), r.b), upper(upper(p.b, q.b), r.b));
}

/// Finds the discs that may hold parts of a piece: whose boxes meet its box, at the window's beginning, or nearly so.
void CoverCheck::find_near(const Piece& piece) {
  const PlanePoint more = {spacing_, spacing_};
  const PlanePoint low = lower(lower(piece[0].a, piece[1].a), piece[2].a) - more;
  const PlanePoint high = upper(upper(piece[0].a, piece[1].a), piece[2].a) + more;
  near_.clear();
  for (std::uint32_t i = 0; i < discs_.size(); ++i) {
    const MovingDisc& disc = discs_[i];
    const double r = disc.radius_a;
    const PlanePoint& c = disc.centre.a;
    const bool apart = (c.x - r > high.x) | (c.x + r < low.x) | (c.y - r > high.y) | (c.y + r < low.y);
    if (!apart) near_.push_back(i);
  }
}

/// Returns a disc that holds the piece or a part of it, if there is one.
std::uint32_t CoverCheck::hold_piece(const Piece& piece, AnimatedChunk& chunk, std::size_t key) {
  for (const std::uint32_t i : near_)
    if (holds(discs_[i], piece)) return i;
  double longest = 0;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Moving &from = piece[i], &to = piece[(i + 1) % 3];
    const double square = std::max(squared_length(to.a - from.a), squared_length(to.b - from.b));
    if (square <= longest) continue;
    longest = square;
    edge = i;
  }
  if (std::sqrt(longest) <= least_piece * spacing_) return enlarge(piece, chunk, key);
  const Moving &from = piece[edge], &to = piece[(edge + 1) % 3];
  const Moving middle = {0.5 * (from.a + to.a), 0.5 * (from.b + to.b)};
  std::uint32_t holder = no_disc;
  for (const std::size_t corner : {edge, (edge + 1) % 3}) {
    Piece half = piece;
    half[corner] = middle;
    if (!inside_rings(half)) holder = hold_piece(half, chunk, key);
  }
  return holder;
}

/// Returns by how much a disc has to be larger to hold a piece throughout the window.
double CoverCheck::missing(const Piece& piece, const MovingDisc& disc) const {
  double a = 0, b = 0;
  for (const Moving& corner : piece) {
    a = std::max(a, squared_length(corner.a - disc.centre.a));
    b = std::max(b, squared_length(corner.b - disc.centre.b));
  }
  return std::max(std::sqrt(a) - disc.radius_a, std::sqrt(b) - disc.radius_b) + bend_;
}

/// Enlarges the disc that needs it least to hold a piece, at both keys around the window. What was held before still is: by discs
/// as large as they were, which are in the larger ones, and by the same rings.
std::uint32_t CoverCheck::enlarge(const Piece& piece, AnimatedChunk& chunk, std::size_t key) {
  std::uint32_t best = 0;
  double least = missing(piece, discs_[0]);
  for (std::uint32_t i = 1; i < discs_.size(); ++i)
    if (const double more = missing(piece, discs_[i]); more < least) {
      least = more;
      best = i;
    }
  const double more = least + growth_spare * spacing_;
  for (std::size_t k = key; k < key + 2; ++k) {
    float& radius = chunk.keys[k * chunk.disc_count + best].radius;
    radius = static_cast<float>(double{radius} + more);
  }
  discs_[best].radius_a += more;
  discs_[best].radius_b += more;
  if (std::find(near_.begin(), near_.end(), best) == near_.end()) near_.push_back(best);
  return best;
}

}  // namespace bch::detail
