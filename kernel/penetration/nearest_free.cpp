// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/body/body_hits.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/collide/answer.hpp"
#include "kernel/penetration/agent_discs.hpp"
#include "kernel/penetration/free_bodies.hpp"
#include "kernel/penetration/free_search.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/simd/segment_test.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch {

using namespace detail;

namespace {

/// Sound, in units of u S: collide() of the displaced agents accepts spheres that are up to 30 apart (sphere_error), discs up to 23
/// (query_error), and segments up to the margins of both shapes and (segment_place). Two that collide have |d| <= |a| + |b| + R and so |m| <=
/// 2 |a| + 2 |b| + R. A way is t = m + s <= 2 (|a| + r_A + |b| + r_B) <= 2.83 S, because |a|^2 + r_A^2 <= P_A^2. Products and their sums put m
/// and w off by 3 each, differences by 1 each, z by 1, so the distance by 7; rounding e to float turns A's way by 1.1 t and makes it shorter
/// by as much; m + s, its rounding and that of moved positions: 3 t. R^2 - h^2 is off by 3 u R^2, as if R were by 1.5 u.
///
/// Ends of segments are placed in float as well: arm, twice position, thrice sum; their middles and halves are off by 2, the part of a side by 3 of
/// its length, which is at most 2 P, and its sums by 4. Nothing of the strip is lost, because the place across is no farther off than the margin.
constexpr double way_error = 7 + (2 * 1.1 + 3) * 2.83;
constexpr double sphere_slack = 56 * rounding::unit_roundoff;
static_assert(rounding::terms::sphere_error >= rounding::terms::query_error);
static_assert(sphere_slack >= (rounding::terms::sphere_error + way_error + 1.5) * rounding::unit_roundoff);
constexpr double segment_slack = 80 * rounding::unit_roundoff;
static_assert(segment_slack >=
              (rounding::terms::segment_place + rounding::terms::arm + 2 * rounding::terms::position +
               3 * rounding::terms::sum + 2 + 3 * 2 + 4 + way_error) *
                  rounding::unit_roundoff);

/// Holds what the search of a pair needs, for one pair after the other.
struct Searches {
  FreeBody a, b;
  FreeSearch<FreeSpheres> spheres;
  FreeSearch<FreeSegments> segments;
  FreeBound bound;

  /// Begins with what was taken. Nodes are floats, too, and their products.
  template <class Search>
  Search& begin(Search& search, double margin, double reaches) {
    const double slack = margin + rounding::bound_margin * reaches;
    search.begin(a, b, rounding::round_up(margin), rounding::round_up(slack + margin));
    return search;
  }
};

constexpr auto unmoved = [](const auto& of_a) { return of_a; };

/// Holds a direction, and a place along it that the answer is not before.
struct Way {
  double x, y;       ///< in the world
  float to_x, to_y;  ///< in A's frame
  float place;
  bool is_end = false;  ///< the place is the answer
};

/// Holds a move, and where it ends, which is searched where somebody asks for it.
struct Answer {
  Penetration move{0, 1, 0};
  bool has_touch = false;
  Penetration::Touch touch{{0, 0, 0}, {0, 0, 0}};
};

Penetration::Touch in_world(const FreeTouch& touch, const Way& way) {
  const auto turned = [&](const FreeTouch::Vector& v) {
    const double along{v.along}, across{v.across};
    return Vec3{static_cast<float>(along * way.x + across * way.y),
                static_cast<float>(along * way.y - across * way.x), v.up};
  };
  return {turned(touch.point), turned(touch.normal)};
}

/// Finds the best way of a pair that collides, as seen from the agent with the lower index. The way that may be the shortest is followed by
/// a step, until it has ended. Along a direction of A's frame the answer is not before bound(x, y). Where A has left all intervals,
/// finish(search, way) says whether that is the answer, or goes on.
template <class Search, class Bound, class Finish>
void find_best_way(const SpaceFrame& frame, const Axes& axes, Search& search, const Bound& bound,
                   const Finish& finish, Answer& answer) {
  std::array<Way, max_directions> ways;
  const std::uint32_t count = 2 * axes.count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1, x = sign * axes.x[i / 2], y = sign * axes.y[i / 2];
    const SpacePoint e = frame.way(x, y, 0);
    const auto to_x = static_cast<float>(e.x), to_y = static_cast<float>(e.y);
    ways[i] = {x, y, to_x, to_y, bound(to_x, to_y)};
  }
  for (const Way* turned = nullptr;;) {
    Way& way = *std::min_element(ways.begin(), ways.begin() + count,
                                 [](const Way& left, const Way& right) { return left.place < right.place; });
    if (&way != turned) search.turn(way.to_x, way.to_y);
    turned = &way;
    if (way.is_end) {
      answer.move = {way.place, way.x, way.y};
      if (answer.has_touch) answer.touch = in_world(search.touch(way.place), way);
      return;
    }
    const float next = search.next(way.place);
    if (next == way.place) finish(search, way);
    way.place = std::max(way.place, next);
  }
}

/// Returns the answer of a pair as seen from the agent with the higher index, which moves in place of the other.
Answer from_b(const Agents& agents, std::uint32_t a, std::uint32_t b, const Answer& from_a) {
  const auto& [depth, x, y] = from_a.move;
  Answer answer = from_a;
  answer.move = {depth, -x, -y};
  if (depth == 0) return answer;
  Vec3 &point = answer.touch.point, &normal = answer.touch.normal;
  const double z = agents.z.empty() ? 0 : agents.z[a] - agents.z[b];
  point.x = static_cast<float>(double{point.x} + (agents.x[a] - agents.x[b] + double{depth} * x));
  point.y = static_cast<float>(double{point.y} + (agents.y[a] - agents.y[b] + double{depth} * y));
  point.z = static_cast<float>(double{point.z} + z);
  normal = {-normal.x, -normal.y, -normal.z};
  return answer;
}

constexpr std::size_t pairs_at_once = 64;

/// Answers pairs: find(pairs, hits) tells which collide, and best(searches, a, b, answer) finds the way of one that does, a < b. Searches
/// need memory, so answers are written once all have ended.
template <class Find, class Best>
void answer_pairs(const Agents& agents, std::span<const Pair> pairs, std::span<Penetration> out,
                  std::span<Penetration::Touch> to_touches, const Find& find, const Best& best) {
  std::vector<Penetration> ways(pairs.size());
  std::vector<Penetration::Touch> touches(to_touches.size());
  Spares<Searches> spares;
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    const auto searches = spares.borrow([] { return Searches(); });
    std::uint8_t hits[pairs_at_once];
    find(pairs.subspan(begin, size), hits);
    for (std::size_t k = 0; k < size; ++k) {
      const auto [first, second] = pairs[begin + k];
      const auto [a, b] = std::minmax(first, second);
      Answer answer;
      answer.has_touch = !touches.empty();
      if (hits[k] != 0) best(*searches, a, b, answer);
      if (second < first) answer = from_b(agents, a, b, answer);
      ways[begin + k] = answer.move;
      if (answer.has_touch) touches[begin + k] = answer.touch;
    }
  });
  std::copy(ways.begin(), ways.end(), out.begin());
  std::copy(touches.begin(), touches.end(), to_touches.begin());
}

void check_sizes(std::span<const Pair> pairs, std::span<Penetration> out,
                 std::span<Penetration::Touch> touches) {
  check_size({"nearest_free", "pair", pairs.size()}, out.size(), "answers");
  if (!touches.empty()) check_size({"nearest_free", "pair", pairs.size()}, touches.size(), "touches");
}

/// Holds the agents of a pair of shapes alone, the first of which moves.
class MovedPair {
 public:
  MovedPair(const Agents& agents, std::uint32_t a, std::uint32_t b)
      : has_level_(!agents.level.empty()),
        has_z_(!agents.z.empty()),
        are_directions_(agents.heading.are_directions()) {
    const std::uint32_t both[] = {a, b};
    for (std::size_t i = 0; i < 2; ++i) {
      const Headings::Value heading = agents.heading[both[i]];
      shape_[i] = agents.shape[both[i]], x_[i] = agents.x[both[i]], y_[i] = agents.y[both[i]];
      heading_x_[i] = heading.x, heading_y_[i] = heading.y;
      if (has_level_) level_[i] = agents.level[both[i]];
      if (has_z_) z_[i] = agents.z[both[i]];
    }
  }

  void move(double x, double y) { x_[0] += x, y_[0] += y; }
  Agents agents() const {
    Agents both{shape_, x_, y_, heading_x_};
    if (are_directions_) both.heading = Headings(heading_x_, heading_y_);
    if (has_level_) both.level = level_;
    if (has_z_) both.z = z_;
    return both;
  }

 private:
  bool has_level_, has_z_, are_directions_;
  std::array<std::uint32_t, 2> shape_;
  std::array<double, 2> x_, y_, heading_x_, heading_y_, z_;
  std::array<std::uint8_t, 2> level_;
};

/// Searches the ways of pairs of shapes. All that it refers to has to outlive it.
class OutlineWays {
 public:
  OutlineWays(const ShapeSet& shapes, const Agents& agents, const Axes& axes,
              const Implementation& implementation, bool exact)
      : shapes_(shapes),
        view_(shapes.view()),
        agents_(agents),
        axes_(axes),
        implementation_(implementation),
        exact_(exact) {}

  /// Finds which pairs of agents collide, on the caller's thread.
  void find_hits(const Agents& agents, std::span<const Pair> pairs, std::uint8_t* hits) const {
    Arguments arguments = arguments_for(view_, agents, pairs);
    arguments.states = hits;
    arguments.exact_leaves = exact_;
    answer(implementation_, arguments, 0, pairs.size());
  }

  void best(Searches& searches, std::uint32_t a, std::uint32_t b, Answer& answer) const {
    const SpaceFrame frame(agents_, a, b);
    const AgentDiscs of_a(view_, agents_, a), of_b(view_, agents_, b);
    const double reaches = double{of_a.reach} + double{of_b.reach};
    // Where discs inside the outlines overlap, the two collide.
    const bool have_inside = take(searches, frame, [&](bool is_a, const auto& placed, FreeBody& body) {
      add_inscribed(view_, agents_.shape[is_a ? a : b], placed, body);
    });
    searches.bound.clear();
    if (have_inside)
      for (const FreeElement& in_a : searches.a.elements)
        for (const FreeElement& in_b : searches.b.elements) searches.bound.add(in_a, in_b);
    const auto bound = [&](float x, float y) { return searches.bound.place(x, y); };
    const auto finish = [&](const auto& search, Way& way) { this->finish(a, b, search, way); };
    if (!has_segments(a) || !has_segments(b)) {
      take(searches, frame, [&](bool is_a, const auto& placed, FreeBody& body) {
        add_discs(is_a ? of_a.discs : of_b.discs, placed, body);
      });
      auto& search = searches.begin(searches.spheres, sphere_slack * reaches, reaches);
      return find_best_way(frame, axes_, search, bound, finish, answer);
    }
    take(searches, frame, [&](bool is_a, const auto& placed, FreeBody& body) {
      add_segments(view_, agents_.shape[is_a ? a : b], placed, body);
    });
    const double margin = segment_margin<BaseLanes>(view_, agents_.shape[a], agents_.shape[b]);
    auto& search = searches.begin(searches.segments, margin + segment_slack * reaches, reaches);
    find_best_way(frame, axes_, search, bound, finish, answer);
  }

 private:
  bool has_segments(std::uint32_t agent) const {
    return exact_ && view_.trees[agents_.root(agent, view_.level_count)].segments != no_segments;
  }

  /// Takes both bodies, by add(is_a, placed, body). Returns: whether either has something.
  template <class Add>
  static bool take(Searches& searches, const SpaceFrame& frame, const Add& add) {
    searches.a.elements.clear(), searches.b.elements.clear();
    add(true, unmoved, searches.a);
    add(
        false, [&](const Sphere& each) { return frame.placed(each); }, searches.b);
    if (searches.a.elements.empty() || searches.b.elements.empty()) return false;
    bound_leaves(searches.a), bound_leaves(searches.b);
    return true;
  }

  /// Who has left all segments may be inside, and is until the next ones meet.
  template <class Search>
  void finish(std::uint32_t a, std::uint32_t b, const Search& search, Way& way) const {
    MovedPair pair(agents_, a, b);
    pair.move(double{way.place} * way.x, double{way.place} * way.y);
    constexpr Pair both{0, 1};
    std::uint8_t hit;
    find_hits(pair.agents(), {&both, 1}, &hit);
    const float after = hit == 0 ? way.place : search.after_gap(way.place);
    way.is_end = after == way.place;
    way.place = after;
    if (!way.is_end || hit == 0) return;
    // Leaves of too many segments are discs: this way goes until a line separates the two.
    const Vec2 along{static_cast<float>(way.x), static_cast<float>(way.y)};
    Penetration rest;
    penetration_along(shapes_, pair.agents(), {&both, 1}, {&along, 1}, {&rest, 1}, &implementation_);
    way.place = rounding::round_up(double{way.place} + double{rest.depth});
  }

  const ShapeSet& shapes_;
  const ShapeSetView& view_;
  const Agents& agents_;
  const Axes& axes_;
  const Implementation& implementation_;
  bool exact_;
};

}  // namespace

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const Implementation& implementation = chosen(wanted, "nearest_free");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  const auto best = [&](Searches& searches, std::uint32_t a, std::uint32_t b, Answer& answer) {
    const float *const of_a = view.record(agents.shape[a]), *const of_b = view.record(agents.shape[b]);
    const SpaceFrame frame(agents, a, b);
    take_record(of_a, unmoved, searches.a);
    take_record(
        of_b, [&](const auto& each) { return frame.placed(each); }, searches.b);
    const double reaches = double{header_of(of_a).reach} + double{header_of(of_b).reach};
    auto& search = searches.begin(searches.spheres, sphere_slack * reaches, reaches);
    searches.bound.clear();
    search.sample(searches.bound);
    find_best_way(
        frame, axes, search, [&](float x, float y) { return searches.bound.place(x, y); },
        [](const auto&, Way& way) { way.is_end = true; }, answer);
  };
  answer_pairs(
      agents, pairs, out, touches,
      [&](std::span<const Pair> some, std::uint8_t* hits) {
        find_hits(implementation, view, agents, some, hits);
      },
      best);
}

void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const CollideOptions& options,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const bool exact = exact_leaves(shapes, options.leaves, "nearest_free");
  const Implementation& implementation = chosen(options.implementation, "nearest_free");
  require_valid(implementation, shapes.view(), agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  const OutlineWays ways(shapes, agents, axes, implementation, exact);
  answer_pairs(
      agents, pairs, out, touches,
      [&](std::span<const Pair> some, std::uint8_t* hits) { ways.find_hits(agents, some, hits); },
      [&](Searches& searches, std::uint32_t a, std::uint32_t b, Answer& answer) {
        ways.best(searches, a, b, answer);
      });
}

}  // namespace bch
