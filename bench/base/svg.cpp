// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/svg.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace bch::cli
