// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/check_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kernel/recordings/page/embedding.hpp"
#include "kernel/recordings/page/kept_frames.hpp"
#include "kernel/recordings/page/page_shapes.hpp"
#include "layout/base/base64.hpp"
#include "layout/base/random.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/page_blocks.hpp"
#include "tests/support/test.hpp"

// What a page holds is what was put in, whatever it is, and it is no larger than asked.

namespace bch::detail {
namespace {

using Json = nlohmann::json;

using test::Blocks, test::count_of;

PageShape square(std::uint32_t shape) {
  return {fmt::format("shape {}", shape),
          {{{0.2f, 0.2f}, {-0.2f, 0.2f}, {-0.2f, -0.2f}, {0.2f, -0.2f}}},
          {{0.01f, -0.02f, 0.25f}}};
}

/// A frame that owns what it shows.
struct Frame {
  std::int64_t number;
  double seconds;
  std::vector<CheckedPerson> people;
  std::vector<CheckedPair> pairs;

  CheckedFrame view() const { return {number, seconds, people, pairs}; }
};

CheckedPair overlap(std::int64_t first, std::int64_t second, bool is_wall) {
  CheckedPair pair{};
  pair.first = first, pair.second = second, pair.is_wall = is_wall, pair.overlap = true;
  return pair;
}

Frame random_frame(detail::Random& random, std::int64_t number, std::uint32_t people, double side) {
  Frame frame{number, static_cast<double>(number) / 25, {}, {}};
  for (std::uint32_t i = 0; i < people; ++i) {
    CheckedPerson& person = frame.people.emplace_back();
    person.walker.id = 1000 - 3 * static_cast<std::int64_t>(i), person.pose = 7 * random.below(5);
    person.walker.x = -4000 + random.uniform(side), person.walker.y = 9000 + random.uniform(side);
    person.walker.heading = random.uniform(40) - 20, person.walker.speed = random.uniform(3);
    person.overlaps = random.below(4) == 0, person.in_wall = random.below(5) == 0;
  }
  for (std::uint32_t i = 0; i + 1 < people; i += 4)
    frame.pairs.push_back(overlap(frame.people[i].walker.id, frame.people[i + 1].walker.id, i % 3 == 0));
  frame.pairs.push_back({});  // who are near each other and do not overlap: not of the page
  return frame;
}

std::vector<Frame> random_frames(std::uint32_t count, std::uint32_t people, double side) {
  detail::Random random(5);
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < count; ++i)
    frames.push_back(random_frame(random, 100 + i, people + i % 3, side));
  return frames;
}

std::string page_of(const std::vector<Frame>& frames, std::size_t max_bytes = CheckPage::default_most_bytes,
                    const std::vector<OverlapEvent>& events = {},
                    PageFacts facts = {.title = "title", .fps = 25}) {
  CheckPage page(std::move(facts), square, max_bytes);
  for (const Frame& frame : frames) page.add_frame(frame.view());
  return std::move(page).finish(events);
}

/// Compares a row of the page with the person.
void expect_person(const CheckedPerson& person, const Json& meta, const std::map<std::string, double>& row) {
  EXPECT_EQ(meta["ids"][static_cast<std::size_t>(row.at("who"))], person.walker.id);
  EXPECT_EQ(meta["shapes"][static_cast<std::size_t>(row.at("shape"))], fmt::format("shape {}", person.pose));
  EXPECT_NEAR(meta["corner"][0].get<double>() + row.at("x") / 1000, person.walker.x, 0.00051);
  EXPECT_NEAR(meta["corner"][1].get<double>() + row.at("y") / 1000, person.walker.y, 0.00051);
  EXPECT_NEAR(row.at("speed") / 1000, person.walker.speed, 0.00051);
  EXPECT_EQ(row.at("marks"), (person.overlaps ? 1 : 0) + (person.in_wall ? 2 : 0));
  const double turned = std::remainder(row.at("heading") * std::numbers::pi / 32768 - person.walker.heading,
                                       2 * std::numbers::pi);
  EXPECT_LT(std::abs(turned), 1e-4);
}

/// Compares the pairs of a frame, the first of which is number `first` of the page. Returns how many these are.
std::size_t expect_overlaps(const Blocks& blocks, const Json& meta, std::size_t first, const Frame& frame) {
  const auto pairs = blocks("overlaps");
  const double wall = blocks.type("overlaps") == "u16" ? 65535 : 4294967295;
  std::size_t next = first;
  for (const CheckedPair& pair : frame.pairs) {
    if (!pair.overlap) continue;
    EXPECT_EQ(meta["ids"][static_cast<std::size_t>(pairs[2 * next])], pair.first);
    const double second = pairs[2 * next + 1];
    EXPECT_EQ(second == wall, pair.is_wall);
    if (!pair.is_wall) {
      EXPECT_EQ(meta["ids"][static_cast<std::size_t>(second)], pair.second);
    }
    ++next;
  }
  return next - first;
}

/// Compares all of a page with the frames, of which it kept one of every `step`.
void expect_frames(const std::string& html, const std::vector<Frame>& frames, std::size_t step) {
  const Blocks blocks(html);
  const Json meta = blocks.meta();
  std::map<std::string, std::vector<double>> columns;
  for (const char* const name : {"who", "shape", "x", "y", "heading", "speed", "marks"})
    columns[name] = blocks(name);
  const auto begin = blocks("people-begin"), overlaps_begin = blocks("overlaps-begin"),
             seconds = blocks("seconds"), frame_numbers = blocks("frame");
  ASSERT_EQ(seconds.size(), (frames.size() + step - 1) / step);
  ASSERT_EQ(begin.size(), seconds.size() + 1);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Frame& frame = frames[i * step];
    EXPECT_EQ(seconds[i], frame.seconds);
    EXPECT_EQ(frame_numbers[i], static_cast<double>(frame.number));
    ASSERT_EQ(begin[i + 1] - begin[i], static_cast<double>(frame.people.size()));
    for (std::size_t p = 0; p < frame.people.size(); ++p) {
      std::map<std::string, double> row;
      for (const auto& column : columns)
        row[column.first] = column.second.at(static_cast<std::size_t>(begin[i]) + p);
      expect_person(frame.people[p], meta, row);
    }
    ASSERT_EQ(overlaps_begin[i + 1] - overlaps_begin[i],
              expect_overlaps(blocks, meta, static_cast<std::size_t>(overlaps_begin[i]), frame));
  }
}

/// Also places far apart.
TEST(CheckPage, HoldsWhatWasPutIn) {
  for (const double side : {40.0, 20'000.0}) {
    const auto frames = random_frames(20, 30, side);
    const std::string html = page_of(frames);
    expect_frames(html, frames, 1);
    EXPECT_EQ(Blocks(html).type("x"), side == 40 ? "u16" : "u32");
    EXPECT_EQ(Blocks(html).type("who"), "u16");
    EXPECT_EQ(Blocks(html).meta()["frames"], 20);
  }
}

TEST(CheckPage, HoldsMorePeopleThanSixteenBitsCount) {
  const auto frames = random_frames(1, 66'000, 60);
  const std::string html = page_of(frames);
  EXPECT_EQ(Blocks(html).type("who"), "u32");
  EXPECT_EQ(Blocks(html).type("overlaps"), "u32");
  const auto who = Blocks(html)("who");
  EXPECT_EQ(Blocks(html).meta()["ids"][static_cast<std::size_t>(who.back())],
            frames[0].people.back().walker.id);
  EXPECT_EQ(Blocks(html)("overlaps")[1], 4294967295);
}

TEST(CheckPage, IsNoLargerThanAsked) {
  const auto frames = random_frames(300, 40, 30);
  const std::size_t whole = page_of(frames).size();
  for (const std::size_t most : {whole, whole * 3 / 4, whole / 2, whole / 3}) {
    const std::string html = page_of(frames, most);
    EXPECT_LE(html.size(), most);
    EXPECT_GT(html.size(), most / 3);
    const auto step = Blocks(html).meta()["step"].get<std::size_t>();
    EXPECT_EQ(step & (step - 1), 0u);
    expect_frames(html, frames, step);
    EXPECT_EQ(html, page_of(frames, most));
  }
}

TEST(CheckPage, ThinsWhileFramesCome) {
  const auto frames = random_frames(400, 40, 30);
  CheckPage page({.title = "title"}, square, 100'000);
  std::uint64_t step = 1;
  for (const Frame& frame : frames) {
    page.add_frame(frame.view());
    EXPECT_TRUE(page.step() == step || page.step() == 2 * step);
    step = page.step();
  }
  EXPECT_GE(step, 4u);
}

TEST(CheckPage, KeepsOneFrameThatIsTooLarge) {
  const auto frames = random_frames(5, 2000, 30);
  const std::string html = page_of(frames, 1000);
  EXPECT_EQ(Blocks(html)("frame"), std::vector<double>{100});
}

TEST(CheckPage, ForgetsPeopleOfDroppedFrames) {
  std::vector<Frame> frames = random_frames(1000, 10, 30);
  std::int64_t id = 0;
  for (Frame& frame : frames) {
    for (CheckedPerson& person : frame.people) person.walker.id = ++id;
    frame.pairs = {overlap(id, id - 1, false)};
  }
  const std::string html = page_of(frames, 250'000);
  EXPECT_LE(html.size(), 250'000u);
  const auto step = Blocks(html).meta()["step"].get<std::size_t>();
  EXPECT_GT(step, 1u);
  expect_frames(html, frames, step);
  EXPECT_EQ(Blocks(html).meta()["ids"].size(), Blocks(html)("who").size());
}

TEST(CheckPage, TimelineTellsOfFramesThatAreDropped) {
  std::vector<Frame> frames = random_frames(101, 40, 30);
  for (Frame& frame : frames)
    for (CheckedPerson& person : frame.people) person.overlaps = person.in_wall = false;
  frames[37].people[0].overlaps = frames[37].people[1].in_wall = true;
  const std::string html = page_of(frames, 110'000);
  EXPECT_GT(Blocks(html).meta()["step"], 1);
  const auto overlapping = Blocks(html)("series-overlapping");
  EXPECT_EQ(overlapping[37], 2);
  EXPECT_EQ(std::ranges::count(overlapping, 0.0), 100);
}

TEST(CheckPage, AsksForEachShapeOnce) {
  std::vector<std::uint32_t> asked;
  CheckPage page({.title = "title"}, [&](std::uint32_t shape) {
    asked.push_back(shape);
    return square(shape);
  });
  for (const Frame& frame : random_frames(10, 20, 30)) page.add_frame(frame.view());
  EXPECT_EQ(std::set<std::uint32_t>(asked.begin(), asked.end()), (std::set<std::uint32_t>{0, 7, 14, 21, 28}));
  EXPECT_EQ(asked.size(), 5u);
}

TEST(CheckPage, MayBeEmpty) {
  for (const std::vector<Frame>& frames : {std::vector<Frame>{}, std::vector<Frame>{{1, 0.0, {}, {}}}}) {
    const std::string html = page_of(frames);
    EXPECT_EQ(Blocks(html)("seconds").size(), frames.size());
    EXPECT_EQ(Blocks(html)("x").size(), 0u);
  }
}

TEST(CheckPage, NothingFromOutsideBecomesMarkup) {
  const std::string evil = "</script></title><script>alert(1)</script><!--{{script}}\"'&\xff\xe2\x80\xae\n";
  const auto frames = random_frames(2, 3, 10);
  const auto make = [&](const std::string& text) {
    CheckPage page({.title = text, .fps = 25, .facts = {{text, text}}}, [&](std::uint32_t shape) {
      PageShape drawn = square(shape);
      drawn.name = text;
      return drawn;
    });
    for (const Frame& frame : frames) page.add_frame(frame.view());
    return std::move(page).finish({});
  };
  const std::string html = make(evil), plain = make("plain");
  for (const char* const mark : {"<script", "</script", "<title", "</title", "<!--", "\r"})
    EXPECT_EQ(count_of(html, mark), count_of(plain, mark)) << mark;
  EXPECT_EQ(count_of(html, "alert(1)"),
            count_of(html, "alert(1)&lt;/script") + count_of(html, "alert(1)\\u003c/script"));
  EXPECT_NE(html.find("&lt;script&gt;alert(1)"), std::string::npos);
  const std::string shown = Blocks(html).meta()["facts"][0][1];
  EXPECT_EQ(shown.substr(0, 24), evil.substr(0, 24));
  EXPECT_NE(shown.find("\\u202e"), std::string::npos);
}

TEST(CheckPage, ListsTheDeepestEvents) {
  std::vector<OverlapEvent> events;
  for (std::size_t i = 0; i < CheckPage::max_events + 100; ++i)
    events.push_back({static_cast<std::int64_t>(i), -1, i % 2 == 0, 25, 50, 37.5, 26,
                      static_cast<float>(i * 7919 % 10'007), 3, 4});
  const Json meta = Blocks(page_of({}, CheckPage::default_most_bytes, events)).meta();
  EXPECT_EQ(meta["allEvents"], events.size());
  ASSERT_EQ(meta["events"].size(), CheckPage::max_events);
  std::vector<float> depths;
  for (const OverlapEvent& event : events) depths.push_back(event.depth);
  std::ranges::sort(depths);
  std::int64_t before = -1;
  for (const Json& row : meta["events"]) {
    EXPECT_EQ((std::vector<double>{row[2], row[3], row[4]}), (std::vector<double>{1, 2, 1.5}));
    EXPECT_GE(row[5].get<float>(), depths[100]);
    EXPECT_LT(before, row[0].get<std::int64_t>());
    before = row[0];
    EXPECT_EQ(row[1].is_null(), before % 2 == 0);
  }
}

TEST(CheckPage, HoldsIdsThatJavaScriptCannotCount) {
  Frame frame{1, 0, std::vector<CheckedPerson>(2), {}};
  frame.people[0].walker.id = std::numeric_limits<std::int64_t>::max();
  frame.people[1].walker.id = std::int64_t{1} << 53;
  const Json ids = Blocks(page_of({frame})).meta()["ids"];
  EXPECT_EQ(ids[0], "9223372036854775807");
  EXPECT_EQ(ids[1], std::int64_t{1} << 53);
}

TEST(CheckPage, HoldsWallsAndShapes) {
  const auto frames = random_frames(1, 10, 30);
  const std::string html =
      page_of(frames, CheckPage::default_most_bytes, {},
              {.title = "title", .walls = {{{-4000, 9000}, {-3990.5, 9000}}, {{-4001, 8999.25}}}});
  const Blocks blocks(html);
  EXPECT_EQ(blocks("walls-begin"), (std::vector<double>{0, 2, 3}));
  const auto walls = blocks("walls");
  EXPECT_NEAR(blocks.meta()["corner"][0].get<double>() + walls[2] / 1000, -3990.5, 0.001);
  EXPECT_NEAR(blocks.meta()["corner"][1].get<double>() + walls[5] / 1000, 8999.25, 0.001);
  const auto points = blocks("points");
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 8),
            (std::vector<double>{200, 200, -200, 200, -200, -200, 200, -200}));
  const auto discs = blocks("discs");
  EXPECT_EQ(std::vector<double>(discs.begin(), discs.begin() + 3), (std::vector<double>{10, -20, 250}));
}

// ---- What a page is made from: texts and numbers that are embedded, outlines with fewer corners, the series of overlaps.

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
  const std::uint32_t frames = 3 * OverlapSeries::max_stretches;
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
}  // namespace bch::detail
