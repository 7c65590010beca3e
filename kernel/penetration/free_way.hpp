// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_sources.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "layout/base/rounding.hpp"

namespace bch::detail {

/// Holds a direction, and a place along it that the answer is not before.
struct FreeWay {
  double x, y;       ///< in the world
  float to_x, to_y;  ///< in the agent's frame
  float place;
  bool is_end;  ///< the place is the answer
};

/// Holds some agents of others alone, which have moved, or the first of which moves.
class MovedAgents {
 public:
  void clear() {
    shape_.clear(), level_.clear(), x_.clear(), y_.clear(), z_.clear(), hx_.clear(), hy_.clear();
  }
  void add(const Agents& agents, std::uint32_t agent, double x = 0, double y = 0) {
    const Headings::Value heading = agents.heading[agent];
    are_directions_ = agents.heading.are_directions();
    shape_.push_back(agents.shape[agent]);
    x_.push_back(agents.x[agent] + x), y_.push_back(agents.y[agent] + y);
    hx_.push_back(heading.x), hy_.push_back(heading.y);
    if (!agents.level.empty()) level_.push_back(agents.level[agent]);
    if (!agents.z.empty()) z_.push_back(agents.z[agent]);
  }
  void move_to(double x, double y) { x_[0] = x, y_[0] = y; }
  std::size_t size() const { return shape_.size(); }
  Agents agents() const {
    Agents all{shape_, x_, y_, hx_};
    if (are_directions_) all.heading = Headings(hx_, hy_);
    all.level = level_, all.z = z_;
    return all;
  }

 private:
  bool are_directions_ = false;
  std::vector<std::uint32_t> shape_;
  std::vector<std::uint8_t> level_;
  std::vector<double> x_, y_, z_, hx_, hy_;
};

/// Is what a search knows of walls where there are none.
struct NoWalls {
  static void begin(std::uint32_t) {}
  static void know(float) {}
  static bool has_grown() { return false; }
  static void turn(float, float) {}
  static float next(float place) { return place; }
  static float after_gap(float place) { return place; }
  static bool are_hit(double, double) { return false; }
  static FreeTouch touch(float) { return {}; }
};

/// Finds the shortest way of an agent out of its neighbours and of walls, all at once: for one agent after the other, in memory of its own.
/// The first place in no interval of any of them is found as FreeKernel finds it for one. Neighbours that are too far away to matter are
/// left out until a way comes near them.
template <class Source, class Walls>
class FreeWaySearch {
 public:
  template <class... OfWalls>
  explicit FreeWaySearch(const Source& source, const OfWalls&... of_walls)
      : source_(source), walls_(of_walls...) {}

  /// Finds the best way of an agent. If it is open, somebody else has to test whether it ends inside another one.
  FreeWay find(std::uint32_t agent, std::span<const std::uint32_t> neighbours, const Axes& axes,
               bool is_open = false);
  /// Returns where the agent touches what it has left last, in the world's axes.
  Penetration::Touch touch(const FreeWay& way);

 private:
  struct Neighbour {
    std::uint32_t agent;
    float x, y, max_extents;  ///< where it is, in the agent's frame, and how near it matters
    bool is_begun;
    std::uint32_t turn;  ///< the last one that it knows
  };

  const Agents& agents() const { return source_.agents(); }
  void begin(std::uint32_t agent, std::span<const std::uint32_t> neighbours);
  std::optional<FreeWay> follow(const Axes& axes, bool is_open);
  bool is_near(const Neighbour& neighbour, float place) const {
    const float m = neighbour.x * x_ + neighbour.y * y_ - place, w = neighbour.x * y_ - neighbour.y * x_;
    return m * m + w * w <= neighbour.max_extents * neighbour.max_extents;
  }
  FreePair& begun(std::size_t k);
  /// Returns the search of a neighbour, which knows the direction.
  FreePair& turned(std::size_t k);
  /// Bounds a direction and the opposite one.
  void bound(float x, float y, float* places);
  void turn(float x, float y) { x_ = x, y_ = y, ++turn_, walls_.turn(x, y); }
  float next(float place);
  /// Who has left all intervals may be inside, and is until the next one begins.
  void finish(FreeWay& way);
  float leave_inside(const FreeWay& way);

  const Source& source_;
  Walls walls_;
  std::uint32_t agent_ = 0;
  std::vector<Neighbour> neighbours_;
  std::vector<std::unique_ptr<FreePair>> pairs_;
  float x_ = 1, y_ = 0;
  std::uint32_t turn_ = 0;
  MovedAgents moved_;
  std::vector<std::uint32_t> tested_;
  std::vector<Pair> tests_;
  std::vector<std::uint8_t> hits_;
};

/// What is known of walls shows in the last digits, because margins grow with the segments that are taken. How ways become longer depends on
/// the instruction set, up to where they end. So all ways begin anew when more segments are taken, and the answer is that of one set of them.
/// More are taken only where no shorter way is free, or where a way leaves an area, which is the same on all instruction sets.
template <class Source, class Walls>
FreeWay FreeWaySearch<Source, Walls>::find(std::uint32_t agent, std::span<const std::uint32_t> neighbours,
                                           const Axes& axes, bool is_open) {
  begin(agent, neighbours);
  for (;;)
    if (const std::optional<FreeWay> way = follow(axes, is_open)) return *way;
}

/// The way that may be the shortest is followed by a step, until it has ended. Returns: nothing if more of walls is known since.
template <class Source, class Walls>
std::optional<FreeWay> FreeWaySearch<Source, Walls>::follow(const Axes& axes, bool is_open) {
  const SpaceFrame frame(agents(), agent_, agent_);
  std::array<FreeWay, max_directions> ways;
  std::array<float, max_directions> places{};
  const std::uint32_t count = 2 * axes.count;
  for (std::uint32_t i = 0; i < count; i += 2) {
    const double x = axes.x[i / 2], y = axes.y[i / 2];
    const SpacePoint e = frame.way(x, y, 0);
    const auto to_x = static_cast<float>(e.x), to_y = static_cast<float>(e.y);
    bound(to_x, to_y, &places[i]);
    ways[i] = {x, y, to_x, to_y, places[i], false};
    ways[i + 1] = {-x, -y, -to_x, -to_y, places[i + 1], false};
  }
  for (std::uint32_t turned = count;;) {
    const auto least =
        static_cast<std::uint32_t>(std::min_element(places.begin(), places.begin() + count) - places.begin());
    FreeWay& way = ways[least];
    if (least != turned) turn(way.to_x, way.to_y);
    turned = least;
    if (way.is_end) return way;
    walls_.know(way.place);
    const float next = this->next(way.place);
    if (next == way.place) {
      way.is_end = is_open;
      if (!is_open) finish(way);
    }
    way.place = places[least] = std::max(way.place, next);
    if (walls_.has_grown()) return {};
  }
}

template <class Source, class Walls>
void FreeWaySearch<Source, Walls>::begin(std::uint32_t agent, std::span<const std::uint32_t> neighbours) {
  agent_ = agent;
  neighbours_.clear();
  for (const std::uint32_t other : neighbours) {
    if (!source_.may_meet({agent, other})) continue;
    const SpacePoint at =
        SpaceFrame(agents(), agent, other)
            .way(agents().x[other] - agents().x[agent], agents().y[other] - agents().y[agent], 0);
    // With room for the rounding of all of it.
    const double max_extents = 1.001 * (source_.max_extent(agent) + source_.max_extent(other)) +
                               0x1p-20 * (std::abs(at.x) + std::abs(at.y));
    neighbours_.push_back({other, static_cast<float>(at.x), static_cast<float>(at.y),
                           static_cast<float>(max_extents), false, 0});
  }
  while (pairs_.size() < neighbours_.size()) pairs_.push_back(std::make_unique<FreePair>());
  turn_ = 0;
  walls_.begin(agent);
}

template <class Source, class Walls>
FreePair& FreeWaySearch<Source, Walls>::begun(std::size_t k) {
  if (!neighbours_[k].is_begun) source_.begin(*pairs_[k], {agent_, neighbours_[k].agent});
  neighbours_[k].is_begun = true;
  return *pairs_[k];
}

template <class Source, class Walls>
FreePair& FreeWaySearch<Source, Walls>::turned(std::size_t k) {
  FreePair& pair = begun(k);
  if (neighbours_[k].turn != turn_) pair.turn(x_, y_);
  neighbours_[k].turn = turn_;
  return pair;
}

template <class Source, class Walls>
void FreeWaySearch<Source, Walls>::bound(float x, float y, float* places) {
  x_ = x, y_ = y;
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    if (!is_near(neighbours_[k], 0)) continue;
    float each[2];
    begun(k).bound(x, y, each);
    places[0] = std::max(places[0], each[0]), places[1] = std::max(places[1], each[1]);
  }
}

template <class Source, class Walls>
float FreeWaySearch<Source, Walls>::next(float place) {
  for (std::size_t k = 0; k < neighbours_.size(); ++k)
    if (is_near(neighbours_[k], place)) place = turned(k).next(place);
  return walls_.next(place);
}

template <class Source, class Walls>
Penetration::Touch FreeWaySearch<Source, Walls>::touch(const FreeWay& way) {
  FreeTouch last = walls_.touch(way.place);
  for (std::size_t k = 0; k < neighbours_.size() && last.end != way.place; ++k) {
    if (!is_near(neighbours_[k], way.place)) continue;
    const FreeTouch each = turned(k).touch(way.place);
    if (each.end > last.end) last = each;
  }
  const auto in_world = [&](const FreeTouch::Vector& v) {
    const double along{v.along}, across{v.across};
    return Vec3{static_cast<float>(along * way.x + across * way.y),
                static_cast<float>(along * way.y - across * way.x), v.up};
  };
  return {in_world(last.point), in_world(last.normal)};
}

template <class Source, class Walls>
void FreeWaySearch<Source, Walls>::finish(FreeWay& way) {
  const double x = agents().x[agent_] + double{way.place} * way.x,
               y = agents().y[agent_] + double{way.place} * way.y;
  float after = way.place;
  if constexpr (!Source::is_in_space) {
    moved_.clear(), tested_.clear(), tests_.clear();
    moved_.add(agents(), agent_);
    for (std::uint32_t k = 0; k < neighbours_.size(); ++k) {
      if (!is_near(neighbours_[k], way.place)) continue;
      moved_.add(agents(), neighbours_[k].agent);
      tested_.push_back(k);
      tests_.push_back({0, static_cast<std::uint32_t>(moved_.size() - 1)});
    }
    moved_.move_to(x, y);
    after = leave_inside(way);
  }
  if (walls_.are_hit(x, y)) after = std::max(after, walls_.after_gap(way.place));
  way.is_end = after == way.place;
  way.place = after;
}

template <class Source, class Walls>
float FreeWaySearch<Source, Walls>::leave_inside(const FreeWay& way) {
  const Agents moved = moved_.agents();
  hits_.resize(tests_.size());
  source_.find_hits(moved, tests_, hits_.data());
  float after = way.place;
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    if (hits_[i] == 0) continue;
    const float out = turned(tested_[i]).after_gap(way.place);
    // Leaves of too many segments are discs: this way goes until a line separates the two.
    after =
        std::max(after, out > way.place
                            ? out
                            : rounding::round_up(double{way.place} +
                                                 double{source_.leave_all(moved, tests_[i], way.x, way.y)}));
  }
  return after;
}

}  // namespace bch::detail
