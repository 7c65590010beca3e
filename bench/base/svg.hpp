// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/shapes.hpp>

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

  /// Draws what an earlier group drew again, elsewhere.
  void use(std::string_view id, double right, double down);

  /// Defines a paint, url(#id), that makes balls of circles: from the class `id-lit` to the class `id-shade`.
  void define_ball(std::string_view id);
  void circle(Pixel centre, double radius, std::string_view classes = {});
  void line(Pixel from, Pixel to);
  void rectangle(Pixel corner, double width, double height, std::string_view classes);
  /// Draws a line with a mark at each end.
  void scale(double left, double right, double y);
  void text(Pixel at, std::string_view classes, std::string_view words);

  /// Begins a path of closed curves. Points that cannot be distinguished from their neighbours are left out.
  void begin_path();
  void add_closed_curve(std::span<const Pixel> points);
  void end_path();

  /// Returns the finished picture.
  std::string finish() &&;

 private:
  std::string out_;
};

/// Holds a transformation from a shape's own frame to the picture.
struct Placement {
  Pixel origin;
  double cosine = 1;
  double sine = 0;
  double scale = 1;  ///< pixels per metre

  Pixel operator()(Vec2 point) const;
};

/// Represents the least rectangle of the ground that holds discs, metres.
struct Bounds {
  double left = 1e30, right = -1e30, low = 1e30, high = -1e30;

  void add(const Disc& disc);
  /// Returns the scale, and the placement, by which it fills most of a panel of the picture.
  double scale(double side) const;
  Placement placement(Pixel corner, double side) const;
};

/// Represents a disc of the picture, or a sphere seen from above.
struct PixelDisc {
  Pixel centre;
  double radius = 0;
  double height = 0;  ///< of the centre, in pixels as well
};

PixelDisc placed(const Placement& placement, const Disc& disc);
PixelDisc placed(const Placement& placement, const Sphere& sphere);

/// Returns the discs of a cut in the picture.
std::vector<PixelDisc> placed_cut(const Placement& placement, const Hierarchy& hierarchy,
                                  std::uint32_t depth);

bool overlap(const PixelDisc& a, const PixelDisc& b);
/// Returns the discs that no other one covers, as seen from above.
std::vector<PixelDisc> visible(const std::vector<PixelDisc>& discs);

/// Returns the largest of 1, 2, 5, 10 ... of any decade that is at most so long: what a scale shows, metres.
double round_length(double most);

void draw_outline(Svg& svg, const Placement& placement, const Outline& outline);
void draw_discs(Svg& svg, const std::vector<PixelDisc>& discs);

}  // namespace bch::cli
