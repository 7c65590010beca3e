// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <bch/bodies.hpp>
#include <bch/motion.hpp>

#include "bench/lab/figures.hpp"
#include "kernel/motion/hull_separation.hpp"

// How a clip bounds a body over time, and which intervals of time a search for the first contact divides.

namespace bch::lab {
namespace {

using namespace cli;
using detail::AnimatedHulls;

constexpr double motion_width = 1002, plot_left = 130, plot_right = 962, plot_top = 92, plot_height = 280;
constexpr double rows_top = plot_top + plot_height + 88, row_pitch = 40, row_size = 28;
constexpr unsigned row_count = AnimatedHulls::level_count + 1;
constexpr double seconds_shown = 1.75, least_extent = 0.15, largest_extent = 0.66;
constexpr double speed = 1.4, tolerance = 0.002;  // metres per second, metres
constexpr std::uint32_t forwards = detail::hull_directions / 8;

/// Represents an interval of time that the search looked at.
struct Visit {
  unsigned row;  ///< level of the hulls, above those the intervals between keys
  double from, to;
  bool is_apart;
};

Pixel at(double seconds, double extent) {
  return {plot_left + (plot_right - plot_left) * seconds / seconds_shown,
          plot_top + plot_height * (largest_extent - extent) / (largest_extent - least_extent)};
}

/// Returns the spheres of a walking man, as discs.
AnimatedDiscs walking_man() {
  const Character man = default_male();
  const auto clip = std::ranges::find(man.clips, "walk", &Clip::name) - man.clips.begin();
  AnimatedDiscs discs = animate(default_body(man, 128), static_cast<std::uint32_t>(clip));
  for (AnimatedChunk& chunk : discs.chunks) chunk.z.clear();
  discs.heights = {};
  return discs;
}

/// Returns a woman who stands still, as discs.
AnimatedDiscs standing_woman() {
  BodyPoser poser(default_body(default_female(), 128));
  AnimatedChunk chunk{{0, 1}, 0, {}};
  for (int key = 0; key < 2; ++key)
    for (const Sphere& sphere : poser.spheres(PoseTime{}))
      chunk.keys.push_back({sphere.x, sphere.y, sphere.radius});
  chunk.disc_count = static_cast<std::uint32_t>(chunk.keys.size() / 2);
  return {{chunk}};
}

/// Searches for the first contact as ContactSearch does for bodies of discs, and lists its intervals.
class Search {
 public:
  Search(const detail::MotionFacts& a, const detail::MotionFacts& b) : a_(a), b_(b) {}

  /// Searches from one time to another, up to the interval of the contact.
  void run(double from, double to, double contact) {
    contact_ = contact;
    a_.path_end(from), b_.path_end(from);
    divide(from, to, AnimatedHulls::level_count);
  }
  const std::vector<Visit>& visits() const { return visits_; }

 private:
  /// Returns whether the contact is in the interval.
  bool divide(double from, double to, unsigned level) {
    for (double time = from; time < to;) {
      const double clip_end = std::min(a_.clip_end(time), b_.clip_end(time));
      const double until = level == 0 ? std::min(to, clip_end)
                                      : std::min({to, a_.hull_end(level - 1), b_.hull_end(level - 1)});
      const bool is_apart = level > 0 && are_apart(time, until, level - 1);
      visits_.push_back({AnimatedHulls::level_count - level, time, until, is_apart});
      if (is_apart && contact_ < until) throw std::logic_error("figure of motions: a contact is missed");
      if (level == 0 ? contact_ < until : !is_apart && divide(time, until, level - 1)) return true;
      time = until;
    }
    return false;
  }

  bool are_apart(double from, double to, unsigned level) const {
    const PathKey a = a_.pose(from), b = b_.pose(from), a_end = a_.pose(to), b_end = b_.pose(to);
    const detail::PlanePoint between{b.x - a.x, b.y - a.y}, at_end{b_end.x - a_end.x, b_end.y - a_end.y},
        relative = at_end - between;
    const double nearest = std::clamp(-dot(between, relative) / squared_length(relative), 0.0, 1.0);
    const detail::PlanePoint line = between + nearest * relative;
    return detail::SeparatingLine{
        {a_, level, a, a_end, line}, {b_, level, b, b_end, -1 * line}, dot(between, line), dot(at_end, line)}
        .separates(a_.hull(level).extents, b_.hull(level).extents);
  }

  detail::MovingBody a_, b_;
  double contact_ = 0;
  std::vector<Visit> visits_;
};

void draw_curve(Svg& svg, const char* classes, std::span<const Pixel> points) {
  svg.group({}, classes, [&] {
    for (std::size_t i = 1; i < points.size(); ++i) svg.line(points[i - 1], points[i]);
  });
}

/// Draws how far the man's discs extend forwards, and the bounds of his hulls.
void draw_extents(Svg& svg, const AnimatedShape& man) {
  constexpr std::pair<const char*, unsigned> bounds[] = {
      {"upper", 3}, {"first-mark bare bound", 1}, {"lower", 0}};
  const AnimatedHulls& hulls = man.tree().hulls;
  for (const auto& [classes, level] : bounds)
    svg.group({}, classes, [&] {
      for (double cycle = 0; cycle < seconds_shown; cycle += man.end() - man.begin())
        for (const detail::HullInterval& hull : hulls.levels[level]) {
          const auto [from, to] = hull.extents[forwards];
          svg.line(at(cycle + hull.begin, hulls.step * from), at(cycle + hull.end, hulls.step * to));
        }
    });
  std::vector<Pixel> points;
  for (double time = 0; time <= seconds_shown; time += 0.01) {
    float extent = 0;
    for (const Disc& disc : man.discs(time)) extent = std::max(extent, disc.x + disc.radius);
    points.push_back(at(time, double{extent}));
  }
  draw_curve(svg, "decides", points);
}

/// Draws the times and extents of the plot, and what its lines are.
void draw_axes(Svg& svg) {
  svg.group({}, "grid", [&] {
    for (int decimetres = 2; decimetres <= 6; ++decimetres)
      svg.line(at(0, decimetres / 10.0), at(seconds_shown, decimetres / 10.0));
  });
  for (int decimetres = 2; decimetres <= 6; ++decimetres) {
    const Pixel end = at(0, decimetres / 10.0);
    svg.text({end.x - 10, end.y + 6}, "note end", fmt::format("{} cm", 10 * decimetres));
  }
  const double ground = rows_top + row_count * row_pitch;
  for (int quarters = 0; quarters * 0.25 <= seconds_shown; ++quarters) {
    const double x = at(quarters * 0.25, 0).x;
    svg.group({}, "scale", [&] { svg.line({x, ground}, {x, ground + 7}); });
    svg.text({x, ground + 28}, "note middle", fmt::format("{:g} s", quarters * 0.25));
  }
  svg.group({}, "scale", [&] { svg.line({plot_left, ground}, {plot_right, ground}); });
  constexpr std::pair<const char*, const char*> lines[] = {{"decides", "discs of the man"},
                                                           {"lower", "bound over 1 chunk"},
                                                           {"first-mark bare bound", "2 chunks"},
                                                           {"upper", "8 chunks"}};
  double x = plot_left;
  for (const auto& [classes, words] : lines) {
    const double y = plot_top + plot_height + 30;
    svg.group({}, classes, [&] { svg.line({x, y - 6}, {x + 30, y - 6}); });
    svg.text({x + 38, y}, "note", words);
    x += std::string_view(words).size() > 9 ? 250 : 160;
  }
}

/// Draws the intervals of a search, a row for each length, and the contact across all.
void draw_visits(Svg& svg, std::span<const Visit> visits, double contact) {
  constexpr std::array<const char*, row_count> lengths = {"8 chunks", "4 chunks", "2 chunks", "1 chunk",
                                                          "keys"};
  for (unsigned row = 0; row < row_count; ++row) {
    const double y = rows_top + row * row_pitch;
    svg.text({plot_left - 10, y + 21}, "note end", lengths[row]);
    for (const Visit& visit : visits) {
      if (visit.row != row) continue;
      const double left = at(visit.from, 0).x, right = at(visit.to, 0).x;
      svg.rectangle({left, y}, right - left, row_size, visit.is_apart ? "apart" : "divided");
    }
  }
  svg.text({plot_left + 4, rows_top + 20}, "note", "too far apart to touch");
  const double x = at(contact, 0).x;
  svg.group({}, "decides dashed", [&] {
    svg.line({x, plot_top}, {x, plot_top + plot_height});
    svg.line({x, rows_top - 12}, {x, rows_top + row_count * row_pitch});
  });
}

void draw_key(Svg& svg) {
  const double y = rows_top + row_count * row_pitch + 46;
  svg.rectangle({plot_left, y}, row_size, row_size, "apart");
  svg.text({plot_left + 38, y + 20}, "note", "a line separates them");
  svg.rectangle({plot_left + 258, y}, row_size, row_size, "divided");
  svg.text({plot_left + 296, y + 20}, "note", "none: divided; at last, roots between keys");
  svg.group({}, "decides dashed", [&] { svg.line({plot_left + 708, y + 14}, {plot_left + 738, y + 14}); });
  svg.text({plot_left + 746, y + 20}, "note", "first contact");
}

const std::string motion_css = R"(.end { text-anchor: end }
.grid { fill: none; stroke: #d3dae0; stroke-width: 1 }
.bound { stroke-width: 3; stroke-opacity: 1 }
.apart { fill: #008a64; fill-opacity: .3; stroke: #fff; stroke-width: 1.2 }
.divided { fill: #d55e00; fill-opacity: .75; stroke: #fff; stroke-width: 1.2 }
@media (prefers-color-scheme: dark) {
.grid { stroke: #38424c } .apart { fill: #2fd6a4; stroke: #12161b } .divided { fill: #ff9a4a; stroke: #12161b }
}
)";

}  // namespace

std::string draw_motion() {
  const AnimatedShape man(walking_man()), woman(standing_woman());
  constexpr double beside = 0.55;
  const PathKey path[] = {{0, 0, 0, 0}, {10, 10 * speed, 0, 0}}, place[] = {{0, 2.3, beside, 4}};
  const Motion motions[] = {{&man, path}, {&woman, place, -1}};
  constexpr Pair both{0, 1};
  double contact = 0;
  first_contact(motions, {&both, 1}, {0, 10}, {&contact, 1}, tolerance);
  const double reach = man.bounding_radius() + woman.bounding_radius(),
               within = (place[0].x - std::sqrt(reach * reach - beside * beside)) / speed;
  Search search{detail::MotionFacts(motions[0]), detail::MotionFacts(motions[1])};
  search.run(within, seconds_shown, contact);

  const std::string title = "Time tree of a motion: a man walks by a woman who stands";
  Svg svg(motion_width, rows_top + row_count * row_pitch + 92, title, figure_css + motion_css);
  svg.text({20, 40}, "title", title);
  svg.text({20, 70}, "caption",
           fmt::format("Above: how far the man extends forwards, and linear bounds. Below: the {} intervals "
                       "of time that are searched.",
                       search.visits().size()));
  draw_axes(svg);
  svg.open_clipped_group("extents", {plot_left, plot_top}, plot_right - plot_left, plot_height);
  draw_extents(svg, man);
  svg.close_group();
  draw_visits(svg, search.visits(), contact);
  draw_key(svg);
  return std::move(svg).finish();
}

}  // namespace bch::lab
