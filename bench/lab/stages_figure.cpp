// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>

#include "bench/lab/stages.hpp"

namespace bch::lab {
namespace {

using namespace cli;
using detail::ShapeSetView;

constexpr double border = 20, side = 310, panel_gap = 16, panels_top = 92, row_height = side + 74;
constexpr double figure_width = 2 * border + 3 * side + 2 * panel_gap,
                 figure_height = panels_top + 2 * row_height;
constexpr const char* marks[2] = {"first-mark", "second-mark"};

Pixel corner(unsigned index) {
  return {border + index % 3 * (side + panel_gap), panels_top + index / 3 * row_height};
}

void draw_people(Svg& svg, const Panel& panel, std::span<const Shape> shapes) {
  for (unsigned person : {0u, 1u})
    svg.group({}, person == 0 ? "first" : "second",
              [&] { draw_outline(svg, panel.person(stands[person]), shapes[person].outline); });
}

void draw_area(Svg& svg, std::span<const Pixel> corners) {
  svg.begin_path();
  svg.add_closed_curve(corners);
  svg.end_path();
}

/// Draws a line across a direction, on both sides of a point.
void draw_across(Svg& svg, const Panel& panel, Vec2 at, Vec2 direction, double half) {
  const Vec2 across{-direction.y, direction.x};
  svg.line(panel(along(at, across, -half)), panel(along(at, across, half)));
}

std::string draw_profiles(Svg& svg, const Panel& panel, const ShapeSetView& view) {
  const std::array<Side, 2> sides = compared_profiles(view);
  const Vec2 a = sides[0].centre, b = sides[1].centre;
  const double length = distance(a, b);
  const auto part = static_cast<float>(1 / length);
  const Vec2 way{(b.x - a.x) * part, (b.y - a.y) * part};
  svg.group({}, "decides", [&] { svg.line(panel(a), panel(b)); });
  for (unsigned person : {0u, 1u}) {
    const auto& [centre, begin, end, inner, outer] = sides[person];
    std::vector<Pixel> wedge{panel(centre)};
    for (float t = 0; t <= 1; t += 0.125f) {
      const Vec2 d{begin.x + t * (end.x - begin.x), begin.y + t * (end.y - begin.y)};
      wedge.push_back(panel(along(centre, d, inner / distance({}, d))));
    }
    svg.group({}, marks[person], [&] {
      svg.group({}, "strong", [&] { draw_area(svg, wedge); });
      svg.group({}, "dashed",
                [&] { draw_across(svg, panel, along(centre, way, person == 0 ? outer : -outer), way, 0.3); });
    });
  }
  return fmt::format("inner {:.0f} < {:.0f} < outer {:.0f} cm", 100 * (sides[0].inner + sides[1].inner),
                     100 * length, 100 * (sides[0].outer + sides[1].outer));
}

std::string draw_supports(Svg& svg, const Panel& panel, const ShapeSetView& view) {
  const unsigned best = widest_direction(view);
  for (unsigned person : {0u, 1u}) {
    const Vec2 origin = stands[person].in_world({});
    std::vector<Pixel> polygon;
    for (unsigned k = 0; k < detail::support_directions; ++k) {
      // Where two supporting lines meet.
      const double s = support(view, person, k), next = support(view, person, (k + 1) % 32),
                   tangent = (next - s * std::cos(turn)) / std::sin(turn);
      const Vec2 d = direction_of(turn * k);
      polygon.push_back(panel(along(along(origin, d, s), {-d.y, d.x}, tangent)));
    }
    const unsigned towards = (best + 16 * person) % 32;
    const Vec2 d = direction_of(turn * towards);
    svg.group({}, marks[person], [&] {
      draw_area(svg, polygon);
      svg.group({}, "dashed",
                [&] { draw_across(svg, panel, along(origin, d, support(view, person, towards)), d, 0.9); });
    });
  }
  return fmt::format("overlap of {} or more", centimetres(-support_gap(view, best)));
}

void draw_world_discs(Svg& svg, const Panel& panel, unsigned person, std::span<const Disc> discs,
                      const std::string& more = "") {
  svg.group({}, marks[person] + more, [&] {
    for (const Disc& disc : discs) {
      const PixelDisc at = placed(panel.world, disc);
      svg.circle(at.centre, at.radius);
    }
  });
}

std::string draw_inscribed(Svg& svg, const Panel& panel, const ShapeSetView& view) {
  for (unsigned person : {0u, 1u}) draw_world_discs(svg, panel, person, inscribed(view, person));
  return fmt::format("gap of {} or more", centimetres(inscribed_gap(view)));
}

std::string draw_traversal(Svg& svg, const Panel& panel, const Traversal& traversal) {
  for (unsigned person : {0u, 1u}) draw_world_discs(svg, panel, person, traversal.top(person), " bare");
  for (unsigned person : {0u, 1u})
    for (const auto& level : traversal.overlapping[person]) {
      std::vector<Disc> discs;
      for (const std::uint32_t name : level) discs.push_back(traversal.disc(person, name, 0));
      draw_world_discs(svg, panel, person, discs);
    }
  return fmt::format("{} pairs of leaves overlap", traversal.leaves.size());
}

std::string draw_leaves(Svg& svg, const Panel& panel, const Traversal& traversal) {
  std::array<std::set<std::uint32_t>, 2> leaves;
  for (const auto& [a, b] : traversal.leaves) leaves[0].insert(a), leaves[1].insert(b);
  for (unsigned person : {0u, 1u}) {
    std::vector<Disc> discs;
    for (const std::uint32_t leaf : leaves[person]) discs.push_back(traversal.leaf(person, leaf));
    draw_world_discs(svg, panel, person, discs);
  }
  svg.group({}, "decides", [&] {
    for (const Vec2 point : crossings(traversal)) svg.circle(panel(point), 7);
  });
  return "segments cross: collision";
}

void draw_legend(Svg& svg) {
  const auto [left, top] = corner(5);
  double y = top + 14;
  const auto key = [&](const char* words, const auto& draw) {
    draw(Pixel{left + 34, y});
    svg.text({left + 78, y + 6}, "note", words);
    y += 42;
  };
  const auto in_group = [&](const char* classes, const auto& draw) {
    return [&svg, classes, draw](Pixel at) { svg.group({}, classes, [&] { draw(at); }); };
  };
  const auto box = [&](Pixel at) { svg.rectangle({at.x - 20, at.y - 11}, 40, 22, ""); };
  const auto line = [&](Pixel at) { svg.line({at.x - 24, at.y}, {at.x + 24, at.y}); };
  svg.group("legend", {}, [&] {
    key("man, walking", in_group("first", box));
    key("woman, walking", in_group("second", box));
    key("inner: surely inside", [&](Pixel at) {
      const Pixel wedge[] = {{at.x - 22, at.y + 4}, {at.x + 20, at.y - 11}, {at.x + 22, at.y + 11}};
      svg.group({}, "first-mark strong", [&] { draw_area(svg, wedge); });
    });
    key("bound: outer, support", in_group("first-mark dashed", line));
    key("line of centres", in_group("decides", line));
    const auto circle = [&](Pixel at) { svg.circle(at, 13); };
    key("disc", in_group("first-mark", circle));
    key("disc that overlaps none", in_group("first-mark bare", circle));
    key("segments cross", in_group("decides", [&](Pixel at) { svg.circle(at, 7); }));
  });
}

}  // namespace

std::string draw_stages() {
  const std::vector<Shape> shapes = walking_pair();
  const ShapeSet set(shapes);
  const ShapeSetView& view = set.view();
  const Traversal traversal(view);
  const Bounds all = bounds_of(shapes, stands);
  Bounds near;
  for (const Vec2 point : crossings(traversal)) near.add(Disc{point.x, point.y, 0.03f});

  const std::string title = "Stages of collide() on two people seen from above";
  Svg svg(figure_width, figure_height, title, figure_css);
  svg.text({border, 40}, "title", title);
  svg.text({border, 70}, "caption",
           "Stages 2 to 5 leave this pair undecided. Segments that cross decide it.");
  const auto draw = [&](unsigned index, const char* id, const char* caption, const Bounds& bounds,
                        const auto& draw_stage) {
    const Panel panel = Panel::of(corner(index), side, bounds);
    svg.rectangle(panel.corner, side, side, "panel");
    svg.open_clipped_group(id, panel.corner, side, side);
    const bool is_detail = &bounds == &near;
    if (index == 0 || is_detail)
      svg.group(is_detail ? "detail" : "pair", {}, [&] { draw_people(svg, panel, shapes); });
    else
      svg.use("pair", corner(index).x - corner(0).x, corner(index).y - corner(0).y);
    const std::string note = draw_stage(panel);
    panel.draw_scale(svg);
    svg.close_group();
    const double middle = panel.corner.x + side / 2, y = panel.corner.y + side;
    svg.text({middle, y + 26}, "label middle", caption);
    svg.text({middle, y + 50}, "note middle", note);
  };
  draw(0, "profiles", "2 Compare profiles", all,
       [&](const Panel& at) { return draw_profiles(svg, at, view); });
  draw(1, "supports", "3, 5 Reject by supports", all,
       [&](const Panel& at) { return draw_supports(svg, at, view); });
  draw(2, "inscribed", "4 Accept by inscribed discs", all,
       [&](const Panel& at) { return draw_inscribed(svg, at, view); });
  draw(3, "traversal", "6 Traverse the trees", all, [&](const Panel& at) {
    at.draw_frame(svg, near);
    return draw_traversal(svg, at, traversal);
  });
  draw(4, "leaves", "7 Decide the leaves", near,
       [&](const Panel& at) { return draw_leaves(svg, at, traversal); });
  draw_legend(svg);
  return std::move(svg).finish();
}

}  // namespace bch::lab
