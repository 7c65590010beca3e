// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/base/svg.hpp"

namespace bch::cli {
namespace {

constexpr double width = 330, height = 250, left = 78, gap = 92, top = 92, bottom = 66, right = 24;

constexpr const char* css = R"(text { font-family: "DejaVu Sans", Verdana, Arial, sans-serif; fill: #1c2733 }
.title { font-size: 20px; font-weight: bold }
.panel-title { font-size: 14px; font-weight: bold }
.key { font-size: 14px }
.tick { font-size: 12px; fill: #4a5866 }
.middle { text-anchor: middle }
.end { text-anchor: end }
.frame { fill: #f7f9fa; stroke: #d3dae0 }
.grid path { stroke: #dfe5ea; stroke-width: 1 }
.level path { stroke: #1c2733; stroke-width: 1.2; stroke-dasharray: 5 4 }
.s0 path, .s1 path, .s2 path, .s3 path { fill: none; stroke-width: 1.8 }
.s0 path { stroke: #d55e00 } .s0 circle { fill: #d55e00 }
.s1 path { stroke: #0072b2 } .s1 circle { fill: #fff; stroke: #0072b2; stroke-width: 1.8 }
.s2 path { stroke: #009e73 } .s2 circle { fill: #009e73 }
.s3 path { stroke: #7a4fa3 } .s3 circle { fill: #fff; stroke: #7a4fa3; stroke-width: 1.8 }
)";

double nice_step(double span) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 4)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (span / (factor * power) <= 5) return factor * power;
  return 10 * power;
}

/// The places of values along an axis, 0 to 1.
class Scale {
 public:
  explicit Scale(const ChartAxis& axis) : axis_(axis) {
    if (!axis.logarithmic) return;
    begin_ = std::floor(std::log10(axis.low) + 1e-9);
    end_ = std::max(begin_ + 1, std::ceil(std::log10(axis.high) - 1e-9));
    if (axis.zero) zero_room_ = 0.08;
  }

  double operator()(double value) const {
    if (!axis_.logarithmic) return (value - axis_.low) / (axis_.high - axis_.low);
    if (!(value > 0)) return 0;
    return zero_room_ + (1 - zero_room_) * (std::log10(value) - begin_) / (end_ - begin_);
  }

  std::vector<double> ticks() const {
    std::vector<double> at;
    if (!axis_.logarithmic) {
      const double step = nice_step(axis_.high - axis_.low);
      for (double t = std::ceil(axis_.low / step - 1e-9); t * step <= axis_.high * (1 + 1e-9); ++t)
        at.push_back(t * step + 0.0);  // no minus zero
      return at;
    }
    if (axis_.zero) at.push_back(0);
    const double every = std::ceil((end_ - begin_) / 6);
    for (double exponent = begin_; exponent <= end_; exponent += every)
      at.push_back(std::pow(10.0, exponent));
    return at;
  }

 private:
  ChartAxis axis_;
  double begin_ = 0, end_ = 1, zero_room_ = 0;
};

std::string tick_text(double value) {
  return value != 0 && (std::abs(value) >= 1e4 || std::abs(value) < 1e-3) ? fmt::format("{:.3g}", value)
                                                                          : fmt::format("{:g}", value);
}

class PanelPainter {
 public:
  PanelPainter(Svg& svg, const ChartPanel& panel, double at)
      : svg_(svg), panel_(panel), at_(at), x_(panel.x), y_(panel.y) {}

  void paint() {
    svg_.rectangle({at_, top}, width, height, "frame");
    svg_.text({at_, top - 10}, "panel-title", panel_.title);
    paint_ticks();
    svg_.text({at_ + width / 2, top + height + 46}, "tick middle", panel_.x.title);
    if (panel_.line > 0) paint_line();
    for (std::size_t i = 0; i < panel_.series.size(); ++i) paint_series(panel_.series[i], i);
  }

 private:
  Pixel place(double x, double y) const { return {at_ + width * x_(x), top + height * (1 - y_(y))}; }

  void paint_ticks() {
    svg_.open_group("", "grid");
    for (const double y : y_.ticks()) {
      const double row = top + height * (1 - y_(y));
      svg_.line({at_, row}, {at_ + width, row});
    }
    for (const double x : x_.ticks()) {
      const double column = at_ + width * x_(x);
      svg_.line({column, top}, {column, top + height});
    }
    svg_.close_group();
    for (const double y : y_.ticks())
      svg_.text({at_ - 6, top + height * (1 - y_(y)) + 4}, "tick end", tick_text(y));
    for (const double x : x_.ticks())
      svg_.text({at_ + width * x_(x), top + height + 20}, "tick middle", tick_text(x));
  }

  void paint_line() {
    const double row = top + height * (1 - y_(panel_.line));
    svg_.open_group("", "level");
    svg_.line({at_, row}, {at_ + width, row});
    svg_.close_group();
    svg_.text({at_ + 6, row < top + 24 ? row + 16 : row - 6}, "tick", panel_.line_name);
  }

  void paint_series(const ChartSeries& series, std::size_t index) {
    svg_.open_group("", fmt::format("s{}", index));
    for (std::size_t i = 1; i < series.points.size(); ++i)
      svg_.line(place(series.points[i - 1].x, series.points[i - 1].y),
                place(series.points[i].x, series.points[i].y));
    // Later series are smaller, so that marks at one place all show.
    const double radius = std::max(2.0, 5.0 - static_cast<double>(index));
    for (const ChartPoint& point : series.points) svg_.circle(place(point.x, point.y), radius);
    svg_.close_group();
  }

  Svg& svg_;
  const ChartPanel& panel_;
  double at_;
  Scale x_, y_;
};

void paint_legend(Svg& svg, const std::vector<ChartSeries>& series) {
  double at = left;
  for (std::size_t i = 0; i < series.size(); ++i) {
    svg.open_group("", fmt::format("s{}", i));
    svg.line({at, 55}, {at + 26, 55});
    svg.circle({at + 13, 55}, std::max(2.0, 5.0 - static_cast<double>(i)));
    svg.close_group();
    svg.text({at + 34, 60}, "key", series[i].name);
    at += 60 + 8.6 * static_cast<double>(series[i].name.size());
  }
}

}  // namespace

ChartAxis axis_for(std::string title, bool logarithmic, std::span<const double> values) {
  ChartAxis axis{std::move(title), logarithmic, 0, 0, false};
  if (!logarithmic) {
    for (const double value : values)
      axis.low = std::min(axis.low, value), axis.high = std::max(axis.high, value);
    if (axis.high <= axis.low) axis.high = axis.low + 1;
    if (axis.low == 0) axis.high *= 1.05;
    return axis;
  }
  axis.low = HUGE_VAL;
  for (const double value : values) {
    axis.zero |= value <= 0;
    if (value > 0) axis.low = std::min(axis.low, value), axis.high = std::max(axis.high, value);
  }
  if (axis.high <= 0) axis.low = 0.1, axis.high = 1;
  return axis;
}

std::string draw_chart(const std::string& title, std::span<const ChartPanel> panels) {
  const auto count = static_cast<double>(panels.size());
  Svg svg(left + count * width + (count - 1) * gap + right, top + height + bottom, title, css);
  svg.text({left, 32}, "title", title);
  if (!panels.empty()) paint_legend(svg, panels.front().series);
  for (std::size_t i = 0; i < panels.size(); ++i)
    PanelPainter(svg, panels[i], left + static_cast<double>(i) * (width + gap)).paint();
  return std::move(svg).finish();
}

}  // namespace bch::cli
