// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <vector>

namespace bch::cli {

struct ChartPoint {
  double x, y;
};

/// A line with a mark at every point.
struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
};

/// An axis of a chart. A logarithmic axis shows decades, and zeros at a place of their own beside the least
/// of them.
struct ChartAxis {
  std::string title;
  bool logarithmic = false;
  double low = 0, high = 1;  ///< of a logarithmic axis: positive, without the zeros
  bool zero = false;         ///< there are zeros on a logarithmic axis
};

struct ChartPanel {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series;  ///< at most four; the same ones in the same order in all panels
  double line = 0;                  ///< a level to mark on the y axis; 0: none
  std::string line_name;
};

/// Returns an axis from the low to the high of all values; with room above for a linear axis, which begins at
/// 0 unless values are negative.
ChartAxis axis_for(std::string title, bool logarithmic, std::span<const double> values);

/// Draws an SVG picture: panels beside each other under a title, with one legend.
std::string draw_chart(const std::string& title, std::span<const ChartPanel> panels);

}  // namespace bch::cli
