// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "bench/base/placed_shape.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/inspection.hpp"

namespace bch::cli {
namespace {

constexpr double border = 20, gap = 16, head = 80, large = 452;
constexpr std::size_t times = 6;  ///< that small panels show
constexpr double small = (2 * large + gap - (times - 1) * gap) / times;
constexpr double width = 2 * border + 2 * large + gap;
constexpr double label = 30, row = large + label + 8, bars = 90, tick = 6, below = 36;

constexpr const char* css =
    R"(.label { font-size: 13px; text-anchor: middle }
.tick { font-size: 12px; text-anchor: middle; fill: #4a5866 }
.panel { fill: #f7f9fa; stroke: #d3dae0 }
.outline { fill: #a9bccb; stroke: #3f566b; stroke-width: 1.1; stroke-linejoin: round }
.discs { fill: #d55e00; fill-opacity: .13; stroke: #a84300; stroke-width: .8 }
.cover { fill: #d55e00; stroke: none }
.ways { fill: none; stroke: #1c2733; stroke-opacity: .55; stroke-width: .8 }
.bar { fill: #cdd9e2; stroke: none }
.here { fill: #d55e00; stroke: none }
.keys { fill: none; stroke: #3f566b; stroke-width: 1 }
.now { fill: none; stroke: #1c2733; stroke-width: 2 }
)";

/// What is drawn.
struct Drawing {
  const AnimatedView& view;
  Svg& svg;
  const AnimatedShape shape;
  const AnimatedChunk& chunk;  ///< that of the time
  Bounds at_time, at_all_times;

  Drawing(const AnimatedView& what, Svg& on)
      : view(what), svg(on), shape(what.discs), chunk(chunk_at(what.discs, what.seconds)) {
    for (const Disc& disc : chunk.keys) at_time.add(disc);
    for (const AnimatedChunk& each : what.discs.chunks)
      for (const Disc& disc : each.keys) at_all_times.add(disc);
  }
};

void draw_discs_at(Svg& svg, const AnimatedShape& shape, const Placement& placement, double seconds) {
  std::vector<PixelDisc> discs;
  for (const Disc& disc : shape.discs(seconds)) discs.push_back(placed(placement, disc));
  draw_discs(svg, discs);
}

void draw_moment(const Drawing& drawing, Pixel corner) {
  Svg& svg = drawing.svg;
  const double seconds = drawing.view.seconds;
  const Placement placement = drawing.at_time.placement(corner, large);
  svg.rectangle(corner, large, large, "panel");
  if (drawing.view.outline != nullptr)
    svg.group({}, "outline", [&] { draw_outline(svg, placement, *drawing.view.outline); });
  svg.group({}, "discs", [&] { draw_discs_at(svg, drawing.shape, placement, seconds); });
  svg.text({corner.x + large / 2, corner.y + large + 20}, "label",
           fmt::format("{:.3f} s: {}{}", seconds, counted(drawing.chunk.disc_count, "disc"),
                       drawing.view.outline != nullptr ? " on the body" : ""));
}

/// The way of each centre from key to key of the chunk.
void draw_ways(const Drawing& drawing, Pixel corner) {
  Svg& svg = drawing.svg;
  const AnimatedChunk& chunk = drawing.chunk;
  const Placement placement = drawing.at_time.placement(corner, large);
  svg.rectangle(corner, large, large, "panel");
  svg.open_group({}, "ways");
  const auto centre = [&](std::size_t key, std::size_t disc) {
    const Disc& at = chunk.keys[key * chunk.disc_count + disc];
    return placement(Vec2{at.x, at.y});
  };
  for (std::size_t key = 1; key < chunk.times.size(); ++key)
    for (std::size_t disc = 0; disc < chunk.disc_count; ++disc)
      svg.line(centre(key - 1, disc), centre(key, disc));
  svg.close_group();
  svg.text({corner.x + large / 2, corner.y + large + 20}, "label",
           fmt::format("keys at {:.3f} s: the ways of the discs", fmt::join(chunk.times, ", ")));
}

/// What the discs cover, at even times of the clip.
void draw_times(const Drawing& drawing, double top) {
  const double begin = drawing.shape.begin(), seconds = drawing.shape.end() - begin;
  for (std::size_t i = 0; i < times; ++i) {
    const double at = begin + seconds * (static_cast<double>(i) + 0.5) / times;
    const Pixel corner{border + static_cast<double>(i) * (small + gap), top};
    const Placement placement = drawing.at_all_times.placement(corner, small);
    drawing.svg.rectangle(corner, small, small, "panel");
    drawing.svg.group({}, "cover", [&] { draw_discs_at(drawing.svg, drawing.shape, placement, at); });
    drawing.svg.text({corner.x + small / 2, corner.y + small + 20}, "label", fmt::format("{:.2f} s", at));
  }
}

/// A bar for each chunk, as high as it has discs, and its keys.
void draw_chunks(const Drawing& drawing, double scale, double bottom, double high) {
  Svg& svg = drawing.svg;
  const double most = static_cast<double>(facts_of(drawing.view.discs).most);
  const auto at = [&](double time) { return border + (time - drawing.shape.begin()) * scale; };
  for (const AnimatedChunk& chunk : drawing.view.discs.chunks) {
    const double tall = high * static_cast<double>(chunk.disc_count) / most, left = at(chunk.times.front());
    svg.rectangle({left, bottom - tall}, at(chunk.times.back()) - left, tall,
                  &chunk == &drawing.chunk ? "here" : "bar");
  }
  svg.group({}, "keys", [&] {
    for (const AnimatedChunk& chunk : drawing.view.discs.chunks)
      for (const double time : chunk.times) svg.line({at(time), bottom}, {at(time), bottom + tick});
  });
}

/// The chunks along the time.
void draw_timeline(const Drawing& drawing, double top) {
  Svg& svg = drawing.svg;
  const double begin = drawing.shape.begin(), seconds = drawing.shape.end() - begin;
  const double scale = (width - 2 * border) / seconds, now = border + (drawing.view.seconds - begin) * scale;
  svg.open_group("timeline");
  draw_chunks(drawing, scale, top + bars, bars - tick - 2);
  svg.group({}, "now", [&] { svg.line({now, top - 6}, {now, top + bars + tick}); });
  for (std::size_t i = 0; i <= 4; ++i) {
    const double time = begin + seconds * static_cast<double>(i) / 4;
    const double inset = i == 0 ? 18 : i == 4 ? -18 : 0;
    svg.text({border + (time - begin) * scale + inset, top + bars + 22}, "tick",
             fmt::format("{:.2f} s", time));
  }
  svg.close_group();
}

}  // namespace

std::string draw_animated(const AnimatedView& view) {
  const double second = head + row, third = second + small + label + 14;
  const std::string title = fmt::format("{}, {} as moving discs", view.character, view.clip);
  Svg svg(width, third + bars + below, title, css);
  const Drawing drawing(view, svg);
  svg.text({border, 38}, "title", title);
  svg.text({border, 62}, "caption",
           text_of(facts_of(view.discs)) + ". At the bottom: how many discs each chunk has, and its keys.");
  draw_moment(drawing, {border, head});
  draw_ways(drawing, {border + large + gap, head});
  draw_times(drawing, second);
  draw_timeline(drawing, third);
  return std::move(svg).finish();
}

}  // namespace bch::cli
