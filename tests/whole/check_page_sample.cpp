// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kernel/recordings/page/check_page.hpp"
#include "layout/base/random.hpp"
#include "layout/format/shape_set_view.hpp"

// Writes the page of a recording that it makes up and checks, for tests in a browser, and what the page should show as JSON: two
// groups walk through each other along a corridor with a pillar. Whoever has left it comes back as somebody else.
// Usage: check_page_sample PAGE.html EXPECTED.json [PEOPLE [FRAMES [PEOPLE_PER_100_M2 [MOST_BYTES]]]]

namespace bch::test {
namespace {

using Json = nlohmann::json;

constexpr double fps = 25;
/// The page's frames have other numbers than those that are checked.
constexpr std::int64_t first_frame = 500;
/// The recording's origin is far from that of the coordinates.
constexpr double origin_x = 1200, origin_y = -350;

struct Corridor {
  double length, width;
};

std::vector<std::vector<detail::PagePoint>> walls_of(const Corridor& corridor) {
  std::vector<std::vector<detail::PagePoint>> walls;
  for (const double y : {0.0, corridor.width})
    walls.push_back({{origin_x, origin_y + y}, {origin_x + corridor.length, origin_y + y}});
  const double x = origin_x + corridor.length / 2, y = origin_y + corridor.width / 2, half = 0.15;
  walls.push_back({{x - half, y}, {x, y - half}, {x + half, y}, {x, y + half}, {x - half, y}});
  return walls;
}

ObstacleSet obstacles_of(const std::vector<std::vector<detail::PagePoint>>& walls) {
  std::vector<double> x, y;
  std::vector<std::uint64_t> offsets{0};
  for (const auto& wall : walls) {
    for (const auto& point : wall) x.push_back(point.x), y.push_back(point.y);
    offsets.push_back(x.size());
  }
  return ObstacleSet({.x = x, .y = y, .polyline_offsets = offsets});
}

/// People walk in lanes, east and west by turns, nearly as fast as those before them, and sway.
std::string recording_of(const Corridor& corridor, std::uint32_t people, std::uint32_t frames) {
  std::string text = "# framerate: 25\n# id frame x/m y/m\n";
  const auto lanes = static_cast<std::uint32_t>(corridor.width / 0.95);
  for (std::uint32_t i = 0; i < people; ++i) {
    detail::Random random(29 + i);
    const std::uint32_t lane = i % lanes;
    const double start = (i / lanes + 0.5 + random.uniform(0.3)) * corridor.length * lanes / people,
                 middle = (lane + 0.5) * corridor.width / lanes, sway = random.uniform(0.2),
                 speed = 1.1 + 0.05 * (lane % 4) + random.uniform(0.2), phase = random.uniform(6.28);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      const double seconds = frame / fps, walked = start + speed * seconds,
                   laps = std::floor(walked / corridor.length), along = walked - laps * corridor.length;
      text += std::to_string(i + 1 + people * static_cast<std::uint32_t>(laps)) + " " +
              std::to_string(frame) + " " +
              std::to_string(origin_x + (lane % 2 == 0 ? along : corridor.length - along)) + " " +
              std::to_string(origin_y + middle + sway * std::sin(0.9 * seconds + phase)) + "\n";
    }
  }
  return text;
}

void write(const std::string& name, const std::string& text) {
  std::ofstream stream(name, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + name);
}

/// The page, and what is expected of it.
class Sample {
 public:
  Sample(const detail::PageFacts& facts, std::size_t max_bytes)
      : page_(
            facts, [this](std::uint32_t pose) { return shape(pose); }, max_bytes) {}

  void add(const detail::CheckedFrame& checked, const ShapeSet& shapes, bool with_outlines) {
    shapes_ = &shapes, first_pose_ = checked.people[0].pose - checked.people[0].shape;
    page_.add_frame({first_frame + checked.frame, checked.seconds, checked.people, checked.pairs});
    Json people = Json::array();
    for (const auto& [walker, shape, pose, density, overlaps, in_wall] : checked.people)
      people.push_back({walker.id, walker.x, walker.y, overlaps, in_wall});
    frames_.push_back(
        {{"frame", first_frame + checked.frame}, {"seconds", checked.seconds}, {"people", people}});
    if (!with_outlines) return;
    for (const detail::CheckedPerson& person : checked.people) outlines_.push_back(outline_of(person));
  }

  void finish(const std::vector<detail::OverlapEvent>& events, const std::string& page,
              const std::string& expected) && {
    Json list = Json::array();
    for (const detail::OverlapEvent& event : events)
      list.push_back({{"first", event.first},
                      {"second", event.second},
                      {"lasts", static_cast<double>(event.to - event.from + 1) / fps},
                      {"worst", event.worst / fps},
                      {"depth", event.depth},
                      {"x", event.x},
                      {"y", event.y}});
    write(page, std::move(page_).finish(events));
    write(expected, Json{{"frames", frames_}, {"outlines", outlines_}, {"events", list}}.dump());
  }

 private:
  detail::PageShape shape(std::uint32_t pose) const {
    const detail::ShapeSetView& view = shapes_->view();
    const auto [begin, end] = view.shape_contours[pose - first_pose_];
    detail::PageShape drawn{"pedestrian", {}};
    for (std::uint32_t i = begin; i < end; ++i)
      drawn.contours.emplace_back(view.points + view.contours[i].begin, view.points + view.contours[i].end);
    return drawn;
  }

  /// The contours of a person, in the coordinates of the recording.
  Json outline_of(const detail::CheckedPerson& person) const {
    const double c = std::cos(person.walker.heading), s = std::sin(person.walker.heading);
    Json contours = Json::array();
    for (const auto& contour : shape(person.pose).contours) {
      Json points = Json::array();
      for (const auto& [px, py] : contour) {
        const double x = px, y = py;
        points.push_back({person.walker.x + c * x - s * y, person.walker.y + s * x + c * y});
      }
      contours.push_back(points);
    }
    return contours;
  }

  const ShapeSet* shapes_ = nullptr;
  std::uint32_t first_pose_ = 0;
  Json frames_ = Json::array(), outlines_ = Json::array();
  detail::CheckPage page_;
};

void write_sample(int argc, char** argv) {
  const auto number = [&](int i, std::uint32_t otherwise) {
    return i < argc ? static_cast<std::uint32_t>(std::stoul(argv[i])) : otherwise;
  };
  const std::uint32_t people = number(3, 60), frames = number(4, 200);
  const double width = std::sqrt(100.0 * people / number(5, 90) / 1.8);
  const Corridor corridor{1.8 * width, width};
  const auto walls = walls_of(corridor);
  Sample sample({"corridor <b>& pillar</b></script><script>throw 1</script>",
                 fps,
                 {{"<i>markup</i>", "</script><img src=x onerror=throw(2)>"}},
                 walls},
                number(6, detail::CheckPage::default_most_bytes));
  detail::CheckSummary summary;  // of few poses, so that the page is small
  if (frames > 0) {
    const std::string recording = argv[1] + std::string(".txt");
    write(recording, recording_of(corridor, people, frames));
    const ObstacleSet obstacles = obstacles_of(walls);
    summary = check(*detail::open_trajectory(recording, {}), {.walls = &obstacles, .coarse = 10},
                    [&](const detail::CheckedFrame& frame, const ShapeSet& shapes) {
                      sample.add(frame, shapes, frame.frame == frames / 2);
                    });
  }
  std::move(sample).finish(summary.events, argv[1], argv[2]);
}

}  // namespace
}  // namespace bch::test

int main(int argc, char** argv) try {
  if (argc < 3)
    throw std::runtime_error(
        "usage: check_page_sample PAGE.html EXPECTED.json [PEOPLE [FRAMES [PEOPLE_PER_100_M2 "
        "[MOST_BYTES]]]]");
  bch::test::write_sample(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "check_page_sample: %s\n", error.what());
  return 1;
}
