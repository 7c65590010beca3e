// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bch::cli {

/// Represents a point of the picture: pixels, y down.
struct Pixel {
  double x = 0;
  double y = 0;
};

/// Represents an SVG picture under construction. Coordinates are written with one decimal.
class Svg {
 public:
  /// Begins a picture with a white ground, of the class `ground`, and its title, which screen readers and tooltips say as well. `css` says what
  /// classes look like, besides `title` and `caption`.
  Svg(double width, double height, std::string_view title, std::string_view css);

  /// Draws a group, which holds what draw() draws; no id if empty.
  template <class Draw>
  void group(std::string_view id, std::string_view classes, const Draw& draw) {
    open_group(id, classes);
    draw();
    close_group();
  }
  /// Opens a group, which holds everything until close_group().
  void open_group(std::string_view id, std::string_view classes = {});
  void close_group();
  /// Opens a group that shows nothing outside of the rectangle.
  void open_clipped_group(std::string_view id, Pixel corner, double width, double height);

  /// Defines a paint, url(#id), that makes balls of circles: from the class `id-lit` to the class `id-shade`.
  void define_ball(std::string_view id);
  void circle(Pixel centre, double radius, std::string_view classes = {});
  void line(Pixel from, Pixel to);
  void rectangle(Pixel corner, double width, double height, std::string_view classes);
  /// Draws a line with a mark at each end.
  void scale(double left, double right, double y);
  void text(Pixel at, std::string_view classes, std::string_view words);

  /// Begins a path of closed curves. Points that cannot be told apart from their neighbours are left out.
  void begin_path();
  void add_closed_curve(std::span<const Pixel> points);
  void end_path();

  /// Returns the finished picture.
  std::string finish() &&;

 private:
  std::string out_;
};

}  // namespace bch::cli
