// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "bench/base/placed_shape.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/animated_report.hpp"

namespace bch::cli {
namespace {

constexpr double margin = 20, gap = 16, head = 80, large = 452, fill = 0.94;
constexpr std::size_t times = 6;  ///< that small panels show
constexpr double small = (2 * large + gap - (times - 1) * gap) / times;
constexpr double width = 2 * margin + 2 * large + gap;
constexpr double label = 30, bars = 90, below = 36;
constexpr std::size_t most_key_colours = 5;

constexpr const char* css =
    R"(text { font-family: "DejaVu Sans", Verdana, Arial, sans-serif; fill: #1c2733 }
.title { font-size: 21px; font-weight: bold }
.caption { font-size: 14px; fill: #4a5866 }
.label { font-size: 14px; text-anchor: middle }
.tick { font-size: 12px; text-anchor: middle; fill: #4a5866 }
.panel { fill: #f7f9fa; stroke: #d3dae0 }
.outline { fill: #a9bccb; stroke: #3f566b; stroke-width: 1.1; stroke-linejoin: round }
.ring { fill: none; stroke: #1c2733; stroke-width: 1; stroke-dasharray: 4 2; stroke-linejoin: round }
.discs { fill: #d55e00; fill-opacity: .13; stroke: #a84300; stroke-width: .8 }
.cover { fill: #d55e00; stroke: none }
.ways { fill: none; stroke: #1c2733; stroke-opacity: .55; stroke-width: .8 }
.key0, .key1, .key2, .key3, .key4 { fill: none; stroke-width: 1.8; stroke-linejoin: round }
.key0 { stroke: #0072b2 } .key1 { stroke: #009e73 } .key2 { stroke: #d55e00 } .key3 { stroke: #cc79a7 } .key4 { stroke: #e69f00 }
.bar { fill: #cdd9e2; stroke: none }
.here { fill: #d55e00; stroke: none }
.keys { fill: none; stroke: #3f566b; stroke-width: 1 }
.now { fill: none; stroke: #1c2733; stroke-width: 2 }
)";

/// What panels show of the ground: all discs of chunks.
struct Frame {
  double x, y, extent;  ///< the middle, and how far it is from side to side, metres

  explicit Frame(std::span<const AnimatedChunk> chunks) {
    double left = 1e30, right = -1e30, low = 1e30, high = -1e30;
    for (const AnimatedChunk& chunk : chunks)
      for (const Disc& disc : chunk.keys) {
        const double at_x = static_cast<double>(disc.x), at_y = static_cast<double>(disc.y);
        const double r = static_cast<double>(disc.radius);
        left = std::min(left, at_x - r), right = std::max(right, at_x + r);
        low = std::min(low, at_y - r), high = std::max(high, at_y + r);
      }
    x = (left + right) / 2, y = (low + high) / 2, extent = std::max(right - left, high - low);
  }

  Placement placement(Pixel corner, double side) const {
    const double scale = fill * side / extent;
    return {{corner.x + side / 2 - scale * x, corner.y + side / 2 + scale * y}, 1, 0, scale};
  }
};

/// What is drawn.
struct Drawing {
  const AnimatedView& view;
  Svg& svg;
  const AnimatedShape shape;
  const AnimatedChunk& chunk;  ///< that of the view's time

  Drawing(const AnimatedView& what, Svg& on)
      : view(what), svg(on), shape(what.discs), chunk(chunk_at(what.discs, what.seconds)) {}
};

void draw_discs_at(const Drawing& drawing, const Placement& placement, double seconds) {
  std::vector<PixelDisc> discs;
  for (const Disc& disc : drawing.shape.discs(seconds)) discs.push_back(placed(placement, disc));
  draw_discs(drawing.svg, discs);
}

void draw_ring(const Drawing& drawing, const Placement& placement, double seconds, std::string_view classes) {
  const Outline rings = drawing.shape.shape(seconds).outline;
  if (rings.contours() == 0) return;
  drawing.svg.open_group({}, classes);
  draw_outline(drawing.svg, placement, rings);
  drawing.svg.close_group();
}

void draw_moment(const Drawing& drawing, Pixel corner) {
  Svg& svg = drawing.svg;
  const AnimatedChunk& chunk = drawing.chunk;
  const Placement placement = Frame({&chunk, 1}).placement(corner, large);
  svg.rectangle(corner, large, large, "panel");
  svg.open_group("moment");
  if (drawing.view.outline != nullptr) {
    svg.open_group({}, "outline");
    draw_outline(svg, placement, *drawing.view.outline);
    svg.close_group();
  }
  svg.open_group({}, "discs");
  draw_discs_at(drawing, placement, drawing.view.seconds);
  svg.close_group();
  draw_ring(drawing, placement, drawing.view.seconds, "ring");
  svg.close_group();
  svg.text({corner.x + large / 2, corner.y + large + 20}, "label",
           fmt::format("{:.3f} s: {}, {} (dashed){}", drawing.view.seconds, counted(chunk.disc_count, "disc"),
                       chunk.ring_ends.empty() ? "no ring" : counted(chunk.ring_ends.size(), "ring"),
                       drawing.view.outline != nullptr ? ", and the body" : ""));
}

/// The rings of the chunk at its keys, and the way of each centre between them.
void draw_ways(const Drawing& drawing, Pixel corner) {
  Svg& svg = drawing.svg;
  const AnimatedChunk& chunk = drawing.chunk;
  const Placement placement = Frame({&chunk, 1}).placement(corner, large);
  const AnimatedDiscs alone{{chunk}, false};
  const AnimatedShape shape(alone);
  svg.rectangle(corner, large, large, "panel");
  svg.open_group("ways");
  svg.open_group({}, "ways");
  const auto centre = [&](std::size_t key, std::size_t disc) {
    const Disc& at = chunk.keys[key * chunk.disc_count + disc];
    return placement(Vec2{at.x, at.y});
  };
  for (std::size_t key = 1; key < chunk.times.size(); ++key)
    for (std::size_t disc = 0; disc < chunk.disc_count; ++disc)
      svg.line(centre(key - 1, disc), centre(key, disc));
  svg.close_group();
  for (std::size_t key = 0; key < std::min(chunk.times.size(), most_key_colours); ++key) {
    svg.open_group({}, fmt::format("key{}", key));
    draw_outline(svg, placement, shape.shape(chunk.times[key]).outline);
    svg.close_group();
  }
  svg.close_group();
  svg.text({corner.x + large / 2, corner.y + large + 20}, "label",
           fmt::format("keys at {:.3f} s: rings, and ways of the discs", fmt::join(chunk.times, ", ")));
}

/// What the discs cover, at even times of the clip.
void draw_times(const Drawing& drawing, double top) {
  const double begin = drawing.shape.begin(), seconds = drawing.shape.end() - begin;
  for (std::size_t i = 0; i < times; ++i) {
    const double at = begin + seconds * (static_cast<double>(i) + 0.5) / times;
    const Pixel corner{margin + static_cast<double>(i) * (small + gap), top};
    const Placement placement = Frame(drawing.view.discs.chunks).placement(corner, small);
    drawing.svg.rectangle(corner, small, small, "panel");
    drawing.svg.open_group({}, "cover");
    draw_discs_at(drawing, placement, at);
    drawing.svg.close_group();
    draw_ring(drawing, placement, at, "cover");
    drawing.svg.text({corner.x + small / 2, corner.y + small + 20}, "label", fmt::format("{:.2f} s", at));
  }
}

/// A bar for each chunk, as high as it has discs, and its keys.
void draw_timeline(const Drawing& drawing, double top) {
  Svg& svg = drawing.svg;
  const double begin = drawing.shape.begin(), seconds = drawing.shape.end() - begin, bottom = top + bars;
  const double most = static_cast<double>(facts_of(drawing.view.discs).most);
  const auto at = [&](double time) { return margin + (time - begin) / seconds * (width - 2 * margin); };
  svg.open_group("timeline");
  for (const AnimatedChunk& chunk : drawing.view.discs.chunks) {
    const double high = bars * static_cast<double>(chunk.disc_count) / most;
    svg.rectangle({at(chunk.times.front()), bottom - high}, at(chunk.times.back()) - at(chunk.times.front()),
                  high, &chunk == &drawing.chunk ? "here" : "bar");
  }
  svg.open_group({}, "keys");
  for (const AnimatedChunk& chunk : drawing.view.discs.chunks)
    for (const double time : chunk.times) svg.line({at(time), bottom}, {at(time), bottom + 6});
  svg.close_group();
  svg.open_group({}, "now");
  svg.line({at(drawing.view.seconds), top - 6}, {at(drawing.view.seconds), bottom + 6});
  svg.close_group();
  for (std::size_t i = 0; i <= 4; ++i) {
    const double time = begin + seconds * static_cast<double>(i) / 4;
    const double inset = i == 0 ? 18 : i == 4 ? -18 : 0;
    svg.text({at(time) + inset, bottom + 22}, "tick", fmt::format("{:.2f} s", time));
  }
  svg.close_group();
}

}  // namespace

std::string draw_animated(const AnimatedView& view) {
  constexpr double second_row = head + large + label + 8, third_row = second_row + small + label + 14;
  const std::string title = fmt::format("{}, {} as moving discs", view.character, view.clip);
  Svg svg(width, third_row + bars + below, title, css);
  const Drawing drawing(view, svg);
  svg.text({margin, 38}, "title", title);
  svg.text({margin, 62}, "caption",
           text_of(facts_of(view.discs)) + ". At the bottom: how many discs each chunk has, and its keys.");
  draw_moment(drawing, {margin, head});
  draw_ways(drawing, {margin + large + gap, head});
  draw_times(drawing, second_row);
  draw_timeline(drawing, third_row);
  return std::move(svg).finish();
}

}  // namespace bch::cli
