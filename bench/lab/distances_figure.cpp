// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include <bch/pairs.hpp>

#include "bench/lab/figures.hpp"

// What the queries of distances and depths answer for one pair, once apart and once colliding.

namespace bch::lab {
namespace {

using namespace cli;

constexpr Stand man_stand, apart_stand{0.84, -0.1, 9}, colliding_stand{0.55, -0.073, 9};
constexpr double panel_side = 310, margin = 20, gap_of_panels = 16, top_of_panels = 92;
constexpr std::uint32_t coarse = 0, fine = 1;  ///< levels

/// Holds what one query answers.
struct Length {
  double metres = 0;
  Vec2 first, second;       ///< the points between which it lies, in the world
  std::vector<Disc> discs;  ///< of both, in the world
};

/// Answers queries about the pair.
class PairQueries {
 public:
  PairQueries(const ShapeSet& set, const Stand& woman, std::uint32_t level)
      : set_(set),
        stands_{man_stand, woman},
        levels_{static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(level)} {
    for (unsigned i : {0u, 1u})
      x_[i] = stands_[i].x, y_[i] = stands_[i].y, headings_[i] = stands_[i].radians();
  }

  Length clearance(const ClearanceOptions& options) const {
    float distance = 0;
    DiscPair nearest;
    NearestPoints points;
    bch::clearance(set_, agents(), pair(), {{&distance, 1}, {}, {&nearest, 1}, {&points, 1}}, options);
    return {static_cast<double>(distance),
            Stand{x_[0], y_[0], 0}.in_world(points.first),
            Stand{x_[1], y_[1], 0}.in_world(points.second),
            {disc(0, nearest.first), disc(1, nearest.second)}};
  }

  Penetration penetration() const {
    Penetration result;
    bch::penetration(set_, agents(), pair(), 16, {&result, 1});
    return result;
  }

  Penetration nearest_free() const {
    Penetration result;
    bch::nearest_free(set_, agents(), pair(), 64, {&result, 1});
    return result;
  }

 private:
  Agents agents() const { return {shapes_, x_, y_, headings_, levels_}; }
  static std::span<const Pair> pair() {
    static constexpr Pair both{0, 1};
    return {&both, 1};
  }
  Disc disc(std::uint32_t person, std::uint32_t index) const {
    return stands_[person].place(set_.discs(person, levels_[person]).at(index));
  }

  const ShapeSet& set_;
  Stand stands_[2];
  std::uint32_t shapes_[2] = {0, 1};
  double x_[2], y_[2], headings_[2];
  std::uint8_t levels_[2];
};

/// Returns the distance of a point from a segment, metres.
double distance_from(Vec2 point, Vec2 a, Vec2 b) {
  const double ax = double{point.x} - double{a.x}, ay = double{point.y} - double{a.y},
               bx = double{b.x} - double{a.x}, by = double{b.y} - double{a.y};
  const double t = std::clamp((ax * bx + ay * by) / (bx * bx + by * by), 0.0, 1.0);
  return std::hypot(ax - t * bx, ay - t * by);
}

/// Returns the least distance of points of one outline from segments of the other.
double distance_from(const Outline& points, const Stand& of_points, const Outline& segments,
                     const Stand& of_segments) {
  double least = 1e30;
  for (std::size_t c = 0; c < segments.contours(); ++c) {
    const std::span<const Vec2> contour = segments.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = of_segments.in_world(contour[i]),
                 b = of_segments.in_world(contour[(i + 1) % contour.size()]);
      for (const Vec2 point : points.points)
        least = std::min(least, distance_from(of_points.in_world(point), a, b));
    }
  }
  return least;
}

/// Returns the distance of outlines that do not meet.
double outline_distance(std::span<const Shape> shapes, const Stand& woman) {
  return std::min(distance_from(shapes[0].outline, man_stand, shapes[1].outline, woman),
                  distance_from(shapes[1].outline, woman, shapes[0].outline, man_stand));
}

class DistancesFigure {
 public:
  DistancesFigure(Svg& svg, std::span<const Shape> shapes) : svg_(svg), shapes_(shapes) {}

  /// Draws the panel of an index, with the woman at a stand and what draw_lengths() draws over it.
  template <class Draw>
  void panel(unsigned index, const char* caption, const Stand& woman, const Bounds& bounds,
             const Draw& draw_lengths) {
    const Pixel corner{margin + index * (panel_side + gap_of_panels), top_of_panels};
    panel_ = Panel::of(corner, panel_side, bounds);
    row_ = {corner.x + 6, corner.y + panel_side + 52};
    svg_.text({corner.x + panel_side / 2, corner.y + panel_side + 26}, "label middle", caption);
    svg_.rectangle(corner, panel_side, panel_side, "panel");
    svg_.open_clipped_group(fmt::format("panel-{}", index), corner, panel_side, panel_side);
    svg_.group({}, "first",
               [&] { svg_.group(fmt::format("man-{}", index), {}, [&] { outline(man_stand, 0); }); });
    svg_.group({}, "second", [&] { outline(woman, 1); });
    draw_lengths();
    panel_.draw_scale(svg_);
    svg_.close_group();
  }

  void length(const char* classes, const Length& of) {
    svg_.group({}, classes, [&] { svg_.line(panel_(of.first), panel_(of.second)); });
  }
  void discs(const Length& of) {
    for (unsigned i : {0u, 1u})
      svg_.group({}, i == 0 ? "first-mark" : "second-mark", [&] {
        const PixelDisc at = placed(panel_.world, of.discs[i]);
        svg_.circle(at.centre, at.radius);
      });
  }
  /// Draws where the man is after a move.
  void move(const char* classes, const char* man, const Penetration& by) {
    const double x = panel_.world.scale * double{by.depth} * by.x,
                 y = -panel_.world.scale * double{by.depth} * by.y;
    svg_.group({}, fmt::format("{} ghost", classes), [&] { svg_.use(man, x, y); });
    const Pixel middle = panel_(man_stand.in_world({}));
    svg_.group({}, classes, [&] { svg_.line(middle, {middle.x + x, middle.y + y}); });
  }
  void frame(const Bounds& bounds) { panel_.draw_frame(svg_, bounds); }
  /// Writes a line below the panel.
  void row(const char* classes, const std::string& words) {
    rows_.push_back({classes, words, row_}), row_.y += 27;
  }
  void write_rows() {
    for (const auto& [classes, words, at] : rows_) {
      svg_.group({}, classes, [&] { svg_.line({at.x, at.y - 6}, {at.x + 26, at.y - 6}); });
      svg_.text({at.x + 36, at.y}, "note", words);
    }
  }

 private:
  struct Row {
    const char* classes;
    std::string words;
    Pixel at;
  };

  void outline(const Stand& stand, unsigned person) {
    draw_outline(svg_, panel_.person(stand), shapes_[person].outline);
  }

  Svg& svg_;
  std::span<const Shape> shapes_;
  Panel panel_;
  Pixel row_;
  std::vector<Row> rows_;
};

}  // namespace

std::string draw_distances() {
  const std::vector<Shape> shapes = walking_pair();
  const ShapeSet set(shapes, {{4, all_depths}});
  const Stand apart_stands[] = {man_stand, apart_stand};
  const PairQueries apart(set, apart_stand, fine), colliding(set, colliding_stand, fine);
  ClearanceOptions of_segments, of_deepest;
  of_segments.leaves = Leaves::segments, of_deepest.overlap = Overlap::deepest;
  const Length coarse_discs = PairQueries(set, apart_stand, coarse).clearance({}),
               leaf_discs = apart.clearance({}), segments = apart.clearance(of_segments),
               deepest = colliding.clearance(of_deepest);
  const Penetration free = colliding.nearest_free(), separate = colliding.penetration();
  const double outlines = outline_distance(shapes, apart_stand);
  const Stand separate_stands[] = {
      {double{separate.depth} * separate.x, double{separate.depth} * separate.y, 0}, colliding_stand};

  const std::string title = "How distances of two people bound each other";
  Svg svg(2 * margin + 3 * panel_side + 2 * gap_of_panels, top_of_panels + panel_side + 124, title,
          figure_css);
  svg.text({margin, 40}, "title", title);
  svg.text({margin, 70}, "caption",
           "Man blue, woman orange, from above. Green: lower bounds. Black or white: outlines. Purple: upper "
           "bound.");
  DistancesFigure figure(svg, shapes);
  Bounds detail;
  for (const Length& of : {leaf_discs, segments})
    for (const Vec2 point : {of.first, of.second}) detail.add({point.x, point.y, 0.035f});
  figure.panel(0, "Apart: clearance()", apart_stand, bounds_of(shapes, apart_stands), [&] {
    figure.discs(coarse_discs);
    figure.length("lower", coarse_discs);
    figure.length("decides", segments);
    figure.frame(detail);
    figure.row("lower", fmt::format("discs at depth 4: {}", centimetres(coarse_discs.metres)));
    figure.row("decides", fmt::format("distance of outlines: {}", centimetres(outlines)));
  });
  figure.panel(1, "Leaves in detail", apart_stand, detail, [&] {
    figure.discs(leaf_discs);
    figure.length("lower", leaf_discs);
    figure.length("decides", segments);
    figure.row("lower", fmt::format("discs of leaves: {}", centimetres(leaf_discs.metres)));
    figure.row("decides", fmt::format("segments of leaves: {}", centimetres(segments.metres)));
    figure.row("decides", fmt::format("outlines: {:.1f} µm more", 1e6 * (outlines - segments.metres)));
  });
  figure.panel(2, "Colliding: moves of the man", colliding_stand, bounds_of(shapes, separate_stands), [&] {
    figure.move("upper", "man-2", separate);
    figure.move("decides", "man-2", free);
    figure.length("lower", deepest);
    figure.row("lower", fmt::format("deepest discs: {}", centimetres(-deepest.metres)));
    figure.row("decides", fmt::format("nearest_free(): {}", centimetres(double{free.depth})));
    figure.row("upper", fmt::format("penetration(): {}", centimetres(double{separate.depth})));
  });
  figure.write_rows();
  return std::move(svg).finish();
}

}  // namespace bch::lab
