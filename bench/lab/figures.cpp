// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/lab/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <bch/poses.hpp>

namespace bch::lab {

// Blue and orange, which everybody can tell apart, for the two; black or white for what decides.
const std::string figure_css = R"(.caption { font-size: 17px }
.title { font-size: 24px }
.label { font-size: 20px; font-weight: bold }
.note { font-size: 17px }
.middle { text-anchor: middle }
.panel { fill: #f7f9fa; stroke: #d3dae0 }
.first { fill: #a9c7e0; stroke: #2c5a85; stroke-width: 1.1; stroke-linejoin: round }
.second { fill: #f2cfa8; fill-opacity: .8; stroke: #94520c; stroke-width: 1.1; stroke-linejoin: round }
.first-mark { fill: #0072b2; fill-opacity: .22; stroke: #00548a; stroke-width: 1.6 }
.second-mark { fill: #d55e00; fill-opacity: .22; stroke: #a84300; stroke-width: 1.6 }
.bare { fill: none; stroke-opacity: .5 }
.strong { fill-opacity: .7 }
.dashed { stroke-dasharray: 7 4; stroke-width: 2.4 }
.decides { fill: none; stroke: #111a22; stroke-width: 2.6; stroke-linecap: round }
.lower { fill: none; stroke: #008a64; stroke-width: 4; stroke-linecap: round }
.upper { fill: none; stroke: #a3387c; stroke-width: 2.6; stroke-linecap: round }
.ghost { stroke-width: 1.8; stroke-dasharray: 6 3 }
.scale { fill: none; stroke: #1c2733; stroke-width: 2 }
@media (prefers-color-scheme: dark) {
.ground { fill: #12161b } .panel { fill: #1d242b; stroke: #38424c } text, .caption { fill: #dde4ea }
.first { fill: #33536f; stroke: #9cc4e6 } .second { fill: #6b4a28; stroke: #f0bf8a }
.first-mark { fill: #4db1ee; stroke: #7cc7f5 } .second-mark { fill: #ff9a4a; stroke: #ffb67c }
.bare { fill: none } .decides, .scale { stroke: #f2f5f8 }
.lower { stroke: #2fd6a4 } .upper { stroke: #ef9bd0 }
}
)";

double Stand::radians() const {
  return std::numbers::pi / 16 * heading;
}

Vec2 Stand::in_world(Vec2 point) const {
  const double c = std::cos(radians()), s = std::sin(radians()), px = static_cast<double>(point.x),
               py = static_cast<double>(point.y);
  return {static_cast<float>(x + c * px - s * py), static_cast<float>(y + s * px + c * py)};
}

Disc Stand::place(const Disc& disc) const {
  const Vec2 centre = in_world(Vec2{disc.x, disc.y});
  return {centre.x, centre.y, disc.radius};
}

cli::Bounds bounds_of(std::span<const Shape> shapes, std::span<const Stand> stands) {
  cli::Bounds bounds;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (const Vec2 point : shapes[i].outline.points)
      bounds.add(stands[i].place(Disc{point.x, point.y, 0.02f}));
  return bounds;
}

std::vector<Shape> walking_pair() {
  const Character man = default_male(), woman = default_female();
  const auto walk = [](const Character& character, float seconds) {
    const auto clip = std::ranges::find(character.clips, "walk", &Clip::name) - character.clips.begin();
    return ShapeBuilder(character).shape({static_cast<std::uint32_t>(clip), seconds});
  };
  return {walk(man, 0.55f), walk(woman, 2.0f)};
}

cli::Placement Panel::person(const Stand& stand) const {
  return {(*this)(stand.in_world({})), std::cos(stand.radians()), std::sin(stand.radians()), world.scale};
}

void Panel::draw_scale(cli::Svg& svg) const {
  const double length = cli::round_length(side / 3.5 / world.scale), left = corner.x + 14,
               right = left + length * world.scale, y = corner.y + side - 14;
  svg.group({}, "scale", [&] { svg.scale(left, right, y); });
  svg.text({right + 9, y + 6}, "note", fmt::format("{:g} cm", 100 * length));
}

void Panel::draw_frame(cli::Svg& svg, const cli::Bounds& bounds) const {
  const double half = world.scale * std::max(bounds.right - bounds.left, bounds.high - bounds.low) / 2;
  const cli::Pixel middle = (*this)({static_cast<float>((bounds.left + bounds.right) / 2),
                                     static_cast<float>((bounds.low + bounds.high) / 2)});
  svg.group({}, "scale", [&] {
    svg.rectangle({middle.x - half, middle.y - half}, 2 * half, 2 * half, "frame");
  });
}

std::string centimetres(double metres) {
  return fmt::format("{:.1f} cm", 100 * metres);
}

}  // namespace bch::lab
