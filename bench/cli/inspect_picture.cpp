// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "bench/base/svg.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/inspection.hpp"

namespace bch::cli {
namespace {

constexpr double panel = 210, label_height = 38, panel_gap = 14, panel_border = 20, panels_top = 80;

constexpr const char* panel_css = R"(.key { font-size: 14px }
.label { font-size: 14px; text-anchor: middle }
.middle { text-anchor: middle }
.panel { fill: #f7f9fa; stroke: #d3dae0 }
.outline { fill: #a9bccb; stroke: #3f566b; stroke-width: 1.1; stroke-linejoin: round }
.discs { fill: #d55e00; fill-opacity: .14; stroke: #a84300; stroke-width: .9 }
.scale { fill: none; stroke: #1c2733; stroke-width: 2 }
@media (prefers-color-scheme: dark) {
.ground { fill: #12161b } .panel { fill: #1d242b; stroke: #38424c } text, .caption { fill: #dde4ea }
.outline { fill: #5b7286; stroke: #b7c8d6 } .discs { fill: #ff9a4a; stroke: #ffae6b } .scale { stroke: #f2f5f8 }
}
)";

/// What all panels share.
struct Layout {
  std::size_t columns;
  Bounds bounds;  ///< of all discs
};

/// Five columns where that leaves fewer empty places than four.
std::size_t columns_for(std::size_t panels) {
  const auto empty = [panels](std::size_t columns) { return (columns - panels % columns) % columns; };
  return panels > 4 && empty(5) < empty(4) ? 5 : 4;
}

/// Deeper discs stick out of the root's, so the frame is that of all of them.
Layout lay_out(const ShapeFacts& facts) {
  Layout layout{columns_for(facts.depths.size()), {}};
  for (const Hierarchy::Node& node : facts.shape.hierarchy.nodes) layout.bounds.add(node.disc);
  return layout;
}

void draw_panel(Svg& svg, const Layout& layout, const ShapeFacts& facts, std::size_t index) {
  const DepthFacts& shown = facts.depths[index];
  const Pixel corner{panel_border + static_cast<double>(index % layout.columns) * (panel + panel_gap),
                     panels_top + static_cast<double>(index / layout.columns) * (panel + label_height)};
  const Placement placement = layout.bounds.placement(corner, panel);
  svg.rectangle(corner, panel, panel, "panel");
  svg.group(fmt::format("depth-{}", shown.depth), {}, [&] {
    svg.group({}, "outline", [&] { draw_outline(svg, placement, facts.shape.outline); });
    svg.group({}, "discs",
              [&] { draw_discs(svg, placed_cut(placement, facts.shape.hierarchy, shown.depth)); });
  });
  svg.text({corner.x + panel / 2, corner.y + panel + 20}, "label",
           fmt::format("depth {}: {} disc{}, {:.3f} m²", shown.depth, shown.discs,
                       shown.discs == 1 ? "" : "s", shown.area));
}

void draw_scale(Svg& svg, double right, double pixels_per_metre) {
  const double length = round_length(panel / 2.2 / pixels_per_metre),
               left = right - length * pixels_per_metre;
  const double y = 30;
  svg.group("scale", "scale", [&] { svg.scale(left, right, y); });
  svg.text({(left + right) / 2, y + 22}, "key middle", fmt::format("{:g} m", length));
}

}  // namespace

std::string draw_shape(const LoadedCharacter& character, const ShapeFacts& facts) {
  const Layout layout = lay_out(facts);
  const std::size_t panels = facts.depths.size(), rows = (panels + layout.columns - 1) / layout.columns;
  const std::size_t filled = std::min(panels, layout.columns);
  const double width = 2 * panel_border +
                       static_cast<double>(std::max<std::size_t>(filled, 3)) * (panel + panel_gap) -
                       panel_gap;
  const double height = panels_top + static_cast<double>(rows) * (panel + label_height) + 8;
  const std::string title = fmt::format("{}, {}", character.character.name, shape_title(character, facts));
  Svg svg(width, height, title, panel_css);
  svg.text({panel_border, 38}, "title", title);
  svg.text(
      {panel_border, 62}, "caption",
      fmt::format("Seen from above: outline of {:.3f} m², and the discs of its hierarchy cut at each depth.",
                  facts.outline_area));
  draw_scale(svg, width - panel_border, layout.bounds.scale(panel));
  for (std::size_t i = 0; i < panels; ++i) draw_panel(svg, layout, facts, i);
  return std::move(svg).finish();
}

namespace {

constexpr double border = 20, gap = 16, head = 80, large = 452;
constexpr double width = 2 * border + 2 * large + gap;
constexpr double label = 30;

constexpr const char* css =
    R"(.label { font-size: 13px; text-anchor: middle }
.panel { fill: #f7f9fa; stroke: #d3dae0 }
.outline { fill: #a9bccb; stroke: #3f566b; stroke-width: 1.1; stroke-linejoin: round }
.discs { fill: #d55e00; fill-opacity: .13; stroke: #a84300; stroke-width: .8 }
.ways { fill: none; stroke: #1c2733; stroke-opacity: .55; stroke-width: .8 }
)";

/// What is drawn.
struct Drawing {
  const AnimatedView& view;
  Svg& svg;
  const AnimatedShape shape;
  const AnimatedChunk& chunk;  ///< that of the time
  Bounds at_time;

  Drawing(const AnimatedView& what, Svg& on)
      : view(what), svg(on), shape(what.discs), chunk(chunk_at(what.discs, what.seconds)) {
    for (const Disc& disc : chunk.keys) at_time.add(disc);
  }
};

void draw_discs_at(Svg& svg, const AnimatedShape& shape, const Placement& placement, double seconds) {
  std::vector<PixelDisc> discs;
  for (const Disc& disc : shape.discs(seconds)) discs.push_back(placed(placement, disc));
  draw_discs(svg, discs);
}

void draw_pose(const Drawing& drawing, Pixel corner) {
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

/// The path of each centre from key to key of the chunk.
void draw_paths(const Drawing& drawing, Pixel corner) {
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

}  // namespace

std::string draw_animated(const AnimatedView& view) {
  const std::string title = fmt::format("{}, {} as moving spheres", view.character, view.clip);
  Svg svg(width, head + large + label + border, title, css);
  const Drawing drawing(view, svg);
  svg.text({border, 38}, "title", title);
  svg.text({border, 62}, "caption", text_of(facts_of(view.discs)) + ".");
  draw_pose(drawing, {border, head});
  draw_paths(drawing, {border + large + gap, head});
  return std::move(svg).finish();
}

}  // namespace bch::cli
