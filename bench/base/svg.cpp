// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/base/disc_union_area.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

/// Pixels; nearer points of a curve look like one.
constexpr double visible_step = 0.45;

constexpr const char* common_css =
    R"(text { font-family: "DejaVu Sans", Verdana, Arial, sans-serif; fill: #1c2733 }
.title { font-size: 21px; font-weight: bold }
.caption { font-size: 14px; fill: #4a5866 }
)";

/// One decimal, none where it is zero.
std::string number(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

template <class... Values>
void append(std::string& out, const char* format, const Values&... values) {
  out += fmt::vformat(format, fmt::make_format_args(values...));
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title, std::string_view css) {
  append(out_,
         "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
         "role=\"img\">\n<title>{2}</title>\n<style>\n{3}{4}</style>\n"
         "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\" class=\"ground\"/>\n",
         number(width), number(height), escaped(title), common_css, css);
}

void Svg::open_group(std::string_view id, std::string_view classes) {
  out_ += "<g";
  if (!id.empty()) append(out_, " id=\"{}\"", id);
  if (!classes.empty()) append(out_, " class=\"{}\"", classes);
  out_ += ">\n";
}

void Svg::close_group() {
  out_ += "</g>\n";
}

void Svg::open_clipped_group(std::string_view id, Pixel corner, double width, double height) {
  append(out_,
         "<clipPath id=\"{0}-clip\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
         "<g id=\"{0}\" clip-path=\"url(#{0}-clip)\">\n",
         id, number(corner.x), number(corner.y), number(width), number(height));
}

void Svg::use(std::string_view id, double right, double down) {
  append(out_, "<use href=\"#{}\" x=\"{}\" y=\"{}\"/>\n", id, number(right), number(down));
}

void Svg::define_ball(std::string_view id) {
  append(out_,
         "<radialGradient id=\"{0}\" cx=\"35%\" cy=\"30%\" r=\"75%\"><stop class=\"{0}-lit\"/>"
         "<stop offset=\"1\" class=\"{0}-shade\"/></radialGradient>\n",
         id);
}

void Svg::circle(Pixel centre, double radius, std::string_view classes) {
  append(out_, "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"", number(centre.x), number(centre.y), number(radius));
  if (!classes.empty()) append(out_, " class=\"{}\"", classes);
  out_ += "/>\n";
}

void Svg::line(Pixel from, Pixel to) {
  append(out_, "<path d=\"M{} {} {} {}\"/>\n", number(from.x), number(from.y), number(to.x), number(to.y));
}

void Svg::scale(double left, double right, double y) {
  line({left, y}, {right, y});
  line({left, y - 5}, {left, y + 5});
  line({right, y - 5}, {right, y + 5});
}

void Svg::rectangle(Pixel corner, double width, double height, std::string_view classes) {
  append(out_, "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"{}\"/>\n", number(corner.x),
         number(corner.y), number(width), number(height), classes);
}

void Svg::text(Pixel at, std::string_view classes, std::string_view words) {
  append(out_, "<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", number(at.x), number(at.y), classes,
         escaped(words));
}

void Svg::begin_path() {
  out_ += "<path d=\"";
}

void Svg::add_closed_curve(std::span<const Pixel> points) {
  if (points.empty()) return;
  Pixel last = points.front();
  append(out_, "M{} {}", number(last.x), number(last.y));
  for (const Pixel point : points.subspan(1)) {
    if (std::hypot(point.x - last.x, point.y - last.y) < visible_step) continue;
    last = point;
    append(out_, " {} {}", number(point.x), number(point.y));
  }
  out_ += "Z";
}

void Svg::end_path() {
  out_ += "\"/>\n";
}

std::string Svg::finish() && {
  return std::move(out_ += "</svg>\n");
}

Pixel Placement::operator()(Vec2 point) const {
  const double x = static_cast<double>(point.x), y = static_cast<double>(point.y);
  // The picture's y axis points down.
  return {origin.x + scale * (cosine * x - sine * y), origin.y - scale * (sine * x + cosine * y)};
}

void Bounds::add(const Disc& disc) {
  const double x = static_cast<double>(disc.x), y = static_cast<double>(disc.y);
  const double r = static_cast<double>(disc.radius);
  left = std::min(left, x - r), right = std::max(right, x + r);
  low = std::min(low, y - r), high = std::max(high, y + r);
}

double Bounds::scale(double side) const {
  return 0.94 * side / std::max(right - left, high - low);
}

Placement Bounds::placement(Pixel corner, double side) const {
  const double s = scale(side);
  return {
      {corner.x + side / 2 - s * (left + right) / 2, corner.y + side / 2 + s * (low + high) / 2}, 1, 0, s};
}

PixelDisc placed(const Placement& placement, const Sphere& sphere) {
  return {placement(Vec2{sphere.x, sphere.y}), placement.scale * static_cast<double>(sphere.radius),
          placement.scale * static_cast<double>(sphere.z)};
}

PixelDisc placed(const Placement& placement, const Disc& disc) {
  return placed(placement, Sphere{disc.x, disc.y, 0, disc.radius});
}

std::vector<PixelDisc> placed_cut(const Placement& placement, const Hierarchy& hierarchy,
                                  std::uint32_t depth) {
  std::vector<PixelDisc> discs;
  for (const Disc& disc : discs_of(hierarchy, depth)) discs.push_back(placed(placement, disc));
  return discs;
}

bool overlap(const PixelDisc& a, const PixelDisc& b) {
  const double x = a.centre.x - b.centre.x, y = a.centre.y - b.centre.y, z = a.height - b.height,
               r = a.radius + b.radius;
  return x * x + y * y + z * z <= r * r;
}

std::vector<PixelDisc> visible(const std::vector<PixelDisc>& discs) {
  const auto covers = [](const PixelDisc& a, const PixelDisc& b) {
    const double x = a.centre.x - b.centre.x, y = a.centre.y - b.centre.y, more = a.radius - b.radius;
    return more > 0 && x * x + y * y <= more * more;
  };
  std::vector<PixelDisc> seen;
  for (const PixelDisc& disc : discs)
    if (std::none_of(discs.begin(), discs.end(), [&](const PixelDisc& other) { return covers(other, disc); }))
      seen.push_back(disc);
  return seen;
}

double round_length(double most) {
  double length = 1e-6;
  for (double decade = 1e-6; decade < 1e7; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade <= most) length = step * decade;
  return length;
}

void draw_outline(Svg& svg, const Placement& placement, const Outline& outline) {
  svg.begin_path();
  std::vector<Pixel> points;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    points.clear();
    for (const Vec2 point : outline.contour(c)) points.push_back(placement(point));
    svg.add_closed_curve(points);
  }
  svg.end_path();
}

void draw_discs(Svg& svg, const std::vector<PixelDisc>& discs) {
  for (const PixelDisc& disc : discs) svg.circle(disc.centre, disc.radius);
}

}  // namespace bch::cli
