// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <charconv>

#include "layout/base/decimal.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

std::string complaint_about(const std::string& text) {
  const std::string of_floors = test::complaint([&] { obstacles_from_wkt(text, Polygons::walkable); });
  const std::string complaint = test::complaint([&] { obstacles_from_wkt(text); });
  EXPECT_EQ(complaint, of_floors);
  return complaint;
}

/// The obstacle of every segment.
std::vector<std::uint32_t> obstacles_of(const ObstacleSet& set) {
  std::vector<std::uint32_t> obstacles;
  for (std::uint32_t i = 0; i < set.segment_count(); ++i) obstacles.push_back(set.obstacle_of(i));
  return obstacles;
}

/// Returns whether a small disc at a place collides with an obstacle.
bool collides_at(const ObstacleSet& set, double x, double y) {
  const ShapeSet shapes(std::vector<Shape>{{{}, detail::fixed_cylinder(0.01f)}});
  test::Crowd crowd;
  crowd.add({0, x, y, 0, 0});
  std::uint8_t hit;
  collide(shapes, crowd.agents(), set, {&hit, 1});
  return hit != 0;
}

TEST(ReadWkt, TakesEveryKind) {
  const ObstacleSet set = obstacles_from_wkt(
      "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 3 1, 3 3, 1 3, 1 1))\n"
      "linestring (10 0,11 0.5 , 1.2e1 -0.5)\n"
      "MULTIPOLYGON (((20 0, 21 0, 21 1)), ((30 0, 31 0, 31 1, 30 0)))\n"
      "GEOMETRYCOLLECTION(MULTILINESTRING((40 0, 41 0),(40 1, 41 1)), GEOMETRYCOLLECTION EMPTY,\n"
      "  POLYGON ZM ((50 0 7 8, 51 0 7 8, 51 1 7 8, 50 0 7 8)), LINESTRING Z(60 0 5,61 0 5))\n"
      "POLYGON EMPTY\tLINESTRING M (70 +1 3, 71 1 3)");
  EXPECT_EQ(set.obstacle_count(), 9u);
  EXPECT_EQ(obstacles_of(set), (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 2,
                                                           2, 3, 3, 3, 4, 5, 6, 6, 6, 7, 8}));
  EXPECT_TRUE(collides_at(set, 0.5, 0.5));
  EXPECT_FALSE(collides_at(set, 2, 2));  // the hole
  EXPECT_TRUE(collides_at(set, 20.8, 0.4));
  EXPECT_TRUE(collides_at(set, 40.5, 1));
  EXPECT_FALSE(collides_at(set, 40.5, 0.5));
  EXPECT_TRUE(collides_at(set, 70.5, 1));
}

TEST(ReadWkt, TakesWhatProgramsWrite) {
  const ObstacleSet set = obstacles_from_wkt(
      "\xef\xbb\xbfSRID=4326;PolygonZ ((0 0 7, 4 0 7, 4 4 7, 0 0 7))\n"
      "srid = 31467 ; MultiLineStringZM ((10 0 7 8, 11 0 7 8), (20 0 7 8, 21 0 7 8))\n"
      "LINESTRINGM(30 0 7, 31 0 7)multipolygonz(((40 0 7, 41 0 7, 41 1 7)))\n"
      "GeometryCollectionZ (PolygonZM EMPTY, LineString Z (50 0 7, 51 0 7), LineString (60 0, 61 0))");
  EXPECT_EQ(obstacles_of(set), (std::vector<std::uint32_t>{0, 0, 0, 1, 2, 3, 4, 4, 4, 5, 6}));
  for (const double x : {3.5, 10.5, 20.5, 30.5, 40.5, 50.5, 60.5}) EXPECT_TRUE(collides_at(set, x, 0)) << x;
  EXPECT_EQ(obstacles_from_wkt("\xef\xbb\xbf").obstacle_count(), 0u);
}

TEST(ReadWkt, IgnoresCoordinatesBeyondTheSecond) {
  const ObstacleSet set = obstacles_from_wkt(
      "POLYGON Z((0 0 NaN, 4 0 nan, 4 4 -inf, 0 0 1e400))LINESTRING M(10 0 1e300, 11 0 2e9)"
      "SRID=25832;POLYGON((20 0 7, 24 0 7, 24 4 7, 20 0 7), (21 1 NaN, 22 1 7, 22 1.5 7))LINESTRING(30 0 1 "
      "2, 31 0 3 4)"
      "GEOMETRYCOLLECTION(LINESTRING(40 0, 41 0), LINESTRING(50 0 7, 51 0 7))");
  EXPECT_EQ(set.obstacle_count(), 6u);
  for (const double x : {3.5, 10.5, 20.5, 30.5, 40.5, 50.5}) EXPECT_TRUE(collides_at(set, x, 0)) << x;
}

TEST(ReadWkt, TakesNumbersThatVanishAsZero) {
  const std::string zeros(400, '0');
  const ObstacleSet set = obstacles_from_wkt(
      "LINESTRING(1e-400 -4E-999, 1 0)LINESTRING(2 0." + zeros + "1,3 -0." + zeros + "1e5)LINESTRING(0." +
      zeros + "4e401 0,4 1)LINESTRING(5e-" + std::string(400, '9') + " 0, 0 5)");
  EXPECT_EQ(set.segment_count(), 4u);
  EXPECT_TRUE(collides_at(set, 0, 0));
  EXPECT_TRUE(collides_at(set, 2.5, 0));
  EXPECT_TRUE(collides_at(set, 4, 0.5));
  EXPECT_EQ(complaint_about("LINESTRING(1" + zeros + "e-1 0, 1 1)"),
            "WKT: line 1, column 12: expected a number within +-1e9, found '10000000000000000000'");
}

TEST(ReadWkt, TakesPolygonsAsFloors) {
  const std::string text = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 3 1, 3 3, 1 3))";
  const ObstacleSet walls = obstacles_from_wkt(text, Polygons::walkable);
  EXPECT_EQ(walls.obstacle_count(), 2u);  // rings
  EXPECT_EQ(walls.segment_count(), 8u);
  EXPECT_FALSE(collides_at(walls, 0.5, 0.5));
  EXPECT_TRUE(collides_at(walls, 0, 2));
  EXPECT_TRUE(collides_at(walls, 1, 2));  // the side that closes the hole
  EXPECT_TRUE(collides_at(obstacles_from_wkt(text), 0.5, 0.5));
}

TEST(ReadWkt, LeavesOutWhatIsEmpty) {
  const std::string text =
      "POLYGON(EMPTY) LINESTRING EMPTY POLYGON(EMPTY, (0 0, 1 0, 1 1)) MULTIPOLYGON((EMPTY), EMPTY)";
  for (const Polygons polygons : {Polygons::solid, Polygons::walkable}) {
    const ObstacleSet set = obstacles_from_wkt(text, polygons);
    EXPECT_EQ(set.obstacle_count(), 1u);
    EXPECT_EQ(set.segment_count(), 3u);
  }
}

TEST(ReadWkt, NamesThePlaceOfAnError) {
  test::expect_table(__FILE__, "wkt_refusals.txt",
                     [](const auto& fields) { return complaint_about(fields[0]); });
  std::string deep;
  for (int i = 0; i < 101; ++i) deep += "GEOMETRYCOLLECTION(";
  EXPECT_EQ(complaint_about(deep),
            "WKT: line 1, column 1901: expected fewer collections in each other, found 'GEOMETRYCOLLECTION'");
  EXPECT_EQ(test::complaint([] { obstacles_from_wkt("", static_cast<Polygons>(2)); }),
            "obstacles: expected polygons of 0 (solid) or 1 (walkable), found 2");
}

/// Text that is cut anywhere is read or rejected, and so is one with a byte that is another.
TEST(ReadWkt, SurvivesDamage) {
  const std::string text =
      "POLYGON ZM((0 0 1 1, 4.5e0 0 1 1), (1 1 1 1)) GEOMETRYCOLLECTION(LINESTRING(1 2,-3 4), MULTIPOLYGON "
      "EMPTY)";
  for (std::size_t size = 0; size < text.size(); ++size) complaint_about(text.substr(0, size));
  test::Random random(2901);
  std::size_t accepted = 0;
  for (std::uint32_t i = 0; i < test::samples(20'000); ++i) {
    std::string damaged = text;
    for (std::uint32_t k = random.below(3) + 1; k > 0; --k)
      damaged[random.below(static_cast<std::uint32_t>(text.size()))] = static_cast<char>(random.below(256));
    accepted += complaint_about(damaged) == "accepted";
  }
  EXPECT_GT(accepted, 0u);
  EXPECT_LT(accepted, test::samples(10'000));
}

/// What stands in where the standard library cannot read floating point.
TEST(Decimals, AreReadAsTheStandardLibraryDoes) {
  std::istringstream list(
      "|-|.|-.|+1| 1|1.|.5|-.5e1|1e|1e+|1e-x|0x1p3|inf|-INF|Infinit|infinityx|nan|-nan|1e309|-1e999|1e-999|"
      "4e-320|1,5|1e5.5|1 2|--1|-+1|1.5E-3|00012.50|9007199254740993|e5");
  std::vector<std::string> texts;
  for (std::string text; std::getline(list, text, '|');) texts.push_back(text);
  ASSERT_EQ(texts.size(), 32u);
  test::Random random(5);
  for (int i = 0; i < 2'000; ++i) {
    std::string& text = texts.emplace_back();
    for (std::uint32_t k = 1 + random.below(12); k > 0; --k) text += "0123456789.-+eE"[random.below(15)];
  }
  for (const std::string& text : texts) {
    const char *const begin = text.data(), *const end = begin + text.size();
    double value = 7, expected = 7;
    const auto read = detail::decimal_from_chars(begin, end, value);
    auto standard = std::from_chars(begin, end, expected);
    if (standard.ec == std::errc::result_out_of_range &&
        read.ec == std::errc()) {  // no double is as close to 0
      EXPECT_EQ(std::abs(value), 0) << text;
      EXPECT_NE(text.find("-", 1), std::string::npos) << text;
      continue;
    }
    EXPECT_EQ(read.ec, standard.ec) << text;
    EXPECT_EQ(read.ptr, standard.ptr) << text;
    EXPECT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected))) << text;
    EXPECT_EQ(std::signbit(value), std::signbit(expected)) << text;
  }
}

}  // namespace
}  // namespace bch
