// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "bench/recordings/embedding.hpp"
#include "bench/recordings/kept_frames.hpp"
#include "bench/recordings/page_shapes.hpp"
#include "layout/base/base64.hpp"
#include "layout/base/random.hpp"
#include "tests/support/page_blocks.hpp"
#include "tests/support/test.hpp"

// What the page is made from: texts and numbers that are embedded, outlines with fewer corners, the series of overlaps.

namespace bch::cli {
namespace {

using Json = nlohmann::json;
using test::Blocks;

TEST(Base64, IsThatOfTheStandard) {
  const auto expect = [](const std::string& bytes, const std::string& text) {
    EXPECT_EQ(detail::to_base64(bytes), text);
    EXPECT_EQ(detail::from_base64(text), bytes);
  };
  const char* const parts_of_foobar[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size < 7; ++size)
    expect(std::string("foobar").substr(0, size), parts_of_foobar[size]);
  expect("\xfb\xff", "+/8=");
}

TEST(ScriptJson, HasNoMarkup) {
  const nlohmann::ordered_json json{{"<a>", "&amp; </script>"}, {"bytes", "\xff"}};
  const std::string text = script_json(json);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
  EXPECT_EQ(Json::parse(text)["<a>"], "&amp; </script>");
  EXPECT_EQ(Json::parse(text)["bytes"], "\xef\xbf\xbd");
}

TEST(Rounded, StaysInItsRange) {
  EXPECT_EQ(rounded<std::int16_t>(-0.5), -1);
  EXPECT_EQ(rounded<std::int16_t>(1e300), 32767);
  EXPECT_EQ(rounded<std::int16_t>(-40'000), -32768);
  EXPECT_EQ(rounded<std::uint16_t>(-3), 0);
  EXPECT_EQ(rounded<std::uint16_t>(65'534.6), 65'535);
  EXPECT_EQ(rounded<std::int32_t>(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(rounded<std::int32_t>(std::numeric_limits<double>::infinity()), 2147483647);
}

double distance_to(const std::vector<ShapePoint>& polygon, Vec2 point) {
  double least = std::numeric_limits<double>::infinity();
  const double x = 1000 * static_cast<double>(point.x), y = 1000 * static_cast<double>(point.y);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ShapePoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    const double along = length2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(x - a.x - along * dx, y - a.y - along * dy));
  }
  return least;
}

TEST(Simplified, StaysWithinItsTolerance) {
  detail::Random random(3);
  for (int contour = 0; contour < 50; ++contour) {
    std::vector<Vec2> points;
    const double lobes = 2 + random.below(5), swing = random.uniform(0.3);
    for (int i = 0; i < 400; ++i) {
      const double turn = 2 * std::numbers::pi * i / 400, radius = 0.4 + swing * std::sin(lobes * turn);
      points.push_back(
          {static_cast<float>(radius * std::cos(turn)), static_cast<float>(radius * std::sin(turn))});
    }
    const auto kept = simplified(points);
    EXPECT_LT(kept.size(), 200u);
    for (const Vec2 point : points) EXPECT_LE(distance_to(kept, point), outline_tolerance);
  }
}

TEST(Simplified, TakesWhatIsHardlyAContour) {
  EXPECT_TRUE(simplified({}).empty());
  EXPECT_EQ(simplified({{1, 2}}), (std::vector<ShapePoint>{{1000, 2000}}));
  EXPECT_EQ(simplified({{0, 0}, {0, 0}, {0, 0}}).size(), 1u);
  // A whisker goes there and back.
  EXPECT_EQ(simplified({{0, 0}, {0.5f, 0}, {1, 0}, {0.5f, 0}}), (std::vector<ShapePoint>{{0, 0}, {1000, 0}}));
}

TEST(OverlapSeries, KeepsTheMostOfEachStretch) {
  OverlapSeries series;
  const std::uint32_t frames = 3 * OverlapSeries::most_stretches;
  for (std::uint32_t i = 0; i < frames; ++i) series.add(i, i == 7001 ? 9 : 1, 20);
  const std::string html = series.blocks();
  const auto seconds = Blocks(html)("series-seconds"), overlapping = Blocks(html)("series-overlapping");
  ASSERT_EQ(seconds.size(), frames / 4);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    EXPECT_EQ(seconds[i], 4.0 * static_cast<double>(i));
    EXPECT_EQ(overlapping[i], i == 7001 / 4 ? 9 : 1);
  }
}

}  // namespace
}  // namespace bch::cli
