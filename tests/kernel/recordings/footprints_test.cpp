// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/footprints.hpp"

#include "kernel/recordings/check.hpp"
#include "kernel/recordings/walker_bodies.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test.hpp"

// Bodies that do not walk.

namespace bch::detail {
namespace {

double extent_of(const PlanePolygons& polygons, float Vec2::*axis) {
  float most = 0;
  for (const auto& polygon : polygons)
    for (const Vec2 point : polygon) most = std::max(most, std::abs(point.*axis));
  return 2 * static_cast<double>(most);
}

std::string complaint(const std::string& kind, std::span<const Footprint> own = {}) {
  return test::complaint<std::invalid_argument>([&] { footprint_of(kind, 0, 0, own); });
}

TEST(Footprints, HoldEllipsesWithinAMillimetre) {
  for (const double length : {0.001, 0.5, 1.8, 20.0})
    for (const double width : {0.004, 0.5, 3.0}) {
      const PlanePolygons polygons = footprint_of("ellipse", length, width, {});
      ASSERT_EQ(polygons.size(), 1u);
      const auto& corners = polygons[0];
      const double a = length / 2, b = width / 2;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 from = corners[i], to = corners[(i + 1) % corners.size()];
        const double x = static_cast<double>(from.x), y = static_cast<double>(from.y);
        // Where the line from the middle to the corner leaves the ellipse, which is at least as far from the corner as the ellipse.
        const double fraction = std::hypot(x / a, y / b);
        EXPECT_GT(fraction, 1);
        EXPECT_LE(std::hypot(x, y) * (1 - 1 / fraction), 0.001) << length << " " << width;
        // No side cuts the ellipse: in the plane where it is a disc of radius 1, sides are outside of that.
        const double px = x / a, py = y / b, qx = static_cast<double>(to.x) / a,
                     qy = static_cast<double>(to.y) / b;
        EXPECT_GE(std::abs(px * qy - py * qx) / std::hypot(qx - px, qy - py), 1);
      }
    }
}

TEST(Footprints, HaveTheSizesOfTheirRows) {
  const Footprint own[] = {footprint_from_wkt("cart", "POLYGON((0 0, 2 0, 2 1, 0 1))"),
                           footprint_from_wkt("robot", "POLYGON((-1 -1, 1 -1, 1 1, -1 1))")};
  for (const char* const kind : {"disc", "box", "ellipse", "wheelchair", "bicycle", "trolley", "robot"}) {
    const PlanePolygons polygons = footprint_of(kind, 0.9, 0.4, own);
    EXPECT_NEAR(extent_of(polygons, &Vec2::x), 0.9, 0.002) << kind;
    EXPECT_NEAR(extent_of(polygons, &Vec2::y), 0.4, 0.002) << kind;
  }
  EXPECT_NEAR(extent_of(footprint_of("wheelchair", 0, 0.5, {}), &Vec2::x), 1.2, 1e-6);
  EXPECT_NEAR(extent_of(footprint_of("robot", 0, 0, {}), &Vec2::x), 0.7, 1e-6);
  EXPECT_NEAR(extent_of(footprint_of("robot", 0, 0, own), &Vec2::x), 2, 1e-6);  // its own
  EXPECT_NEAR(extent_of(footprint_of("box", 0, 0.3, {}), &Vec2::x), 0.3, 1e-6);
  const PlanePolygons cart = footprint_of("cart", 1, 0, own);  // about its position, which is a corner
  EXPECT_EQ(cart[0][2].x, 1);
  EXPECT_EQ(cart[0][2].y, 1);
}

TEST(Footprints, AreRefusedByOneLine) {
  const Footprint own[] = {footprint_from_wkt("cart", "POLYGON((0 0, 2 0, 2 1, 0 1))")};
  EXPECT_EQ(complaint("car", own),
            "body 'car' is none of disc, box, ellipse, wheelchair, bicycle, trolley, robot, 'cart'; --body "
            "adds others");
  EXPECT_EQ(complaint("disc"), "body 'disc' has no size: a length, a width or a radius has to give it");
  const auto wrong = [](const char* text) {
    return test::complaint<std::invalid_argument>([&] { footprint_from_wkt("cart", text); });
  };
  EXPECT_EQ(wrong("LINESTRING(0 0, 1 1)"), "expected polygons, found a line");
  EXPECT_NE(wrong("POLYGON((0 0, 1 1, 2 2))"), "");
  EXPECT_NE(wrong("GEOMETRYCOLLECTION EMPTY"), "");
  EXPECT_NE(wrong("POLYGON(0 0"), "");
}

/// A box beside a disc and a person, who are as far apart as the file says.
class Bodies : public testing::Test {
 protected:
  TemporaryFolder folder;

  CheckSummary check_of(const std::string& text, const CheckOptions& options = {}) const {
    const auto reader = open_trajectory(folder.write("f.csv", text), {.fps = 1});
    return check(*reader, options);
  }
};

TEST_F(Bodies, OverlapWhereTheirSizesSay) {
  const std::string header = "frame,id,x/m,y/m,heading,radius,length,width,body\n";
  // A disc of 0.3 m, and a box whose long side leads to it, 1 mm away or 1 mm in it.
  const auto events = [&](const char* box) { return check_of(header + "0,1,0,0,0,0.3,,,\n" + box).events; };
  EXPECT_EQ(events("0,2,1.302,0,0,,2,0.5,box\n").size(), 0u);
  EXPECT_EQ(events("0,2,1.302,0,0,,2,0.5,\n").size(), 0u);
  const auto deep = events("0,2,1.299,0,0,,2,0.5,box\n");
  ASSERT_EQ(deep.size(), 1u);
  EXPECT_EQ(deep[0].first, 1);
  EXPECT_EQ(events("0,2,1.299,0,1.5707963,,2,0.5,box\n").size(), 0u);  // it stands across
  EXPECT_EQ(events("0,2,0.549,0,1.5707963,,2,0.5,box\n").size(), 1u);
  EXPECT_EQ(events("0,2,0.7,0,0,,,,\n").size(), 0u);  // a person
  EXPECT_EQ(events("0,2,0.3,0,0,,,,\n").size(), 1u);
  EXPECT_EQ(events("0,2,0.3,0,0,,,,person\n").size(), 1u);
}

TEST_F(Bodies, AreOutlinesAlone) {
  const std::string text = "frame,id,x,y,body\n0,1,0,0,robot\n";
  const auto models = body_models({}, 64);
  CheckOptions options;
  options.bodies = models;
  const auto said = [&](const std::string& rows, const CheckOptions& how) {
    const std::string all = test::complaint<TrajectoryError>([&] { check_of(rows, how); });
    return all.substr(std::min(all.find("f.csv"), all.size()));
  };
  EXPECT_EQ(said(text, options),
            "f.csv:2: body 'robot' is an outline, which neither --bodies spheres nor a baked set takes");
  EXPECT_EQ(check_of(text).poses.size(), 1u);
  EXPECT_EQ(said("frame,id,x,y,body\n0,1,0,0,car\n", {}),
            "f.csv:2: body 'car' is none of disc, box, ellipse, wheelchair, bicycle, trolley, robot; --body "
            "adds others");
}

}  // namespace
}  // namespace bch::detail
