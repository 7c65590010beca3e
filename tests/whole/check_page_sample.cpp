// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <bch/bch.hpp>

#include "bench/base/disc_union_area.hpp"
#include "bench/recordings/check_page.hpp"
#include "layout/base/random.hpp"

// Writes the page of a recording that it makes up, for tests in a browser, and what the page should show as JSON: two
// groups walk through each other along a corridor with a pillar. Whoever has left it comes back as somebody else.
// Usage: check_page_sample PAGE.html EXPECTED.json [PEOPLE [FRAMES [PEOPLE_PER_100_M2 [MOST_BYTES [TITLE]]]]]

namespace bch::test {
namespace {

constexpr double fps = 25;
constexpr std::uint32_t phases = 24;
constexpr double stride = 1.05;  // seconds

struct Corridor {
  double length, width;
};

/// The recording's origin is far from that of the coordinates.
constexpr double origin_x = 1200, origin_y = -350;

std::vector<std::vector<cli::PagePoint>> walls_of(const Corridor& corridor) {
  std::vector<std::vector<cli::PagePoint>> walls;
  for (const double y : {0.0, corridor.width})
    walls.push_back({{origin_x, origin_y + y}, {origin_x + corridor.length, origin_y + y}});
  std::vector<cli::PagePoint> pillar;
  for (int i = 0; i <= 4; ++i) {
    const double turn = (i + 0.5) * std::numbers::pi / 2;
    pillar.push_back({origin_x + corridor.length / 2 + 0.6 * std::cos(turn),
                      origin_y + corridor.width / 2 + 0.6 * std::sin(turn)});
  }
  pillar.back() = pillar.front();
  walls.push_back(pillar);
  return walls;
}

ObstacleSet obstacles_of(const std::vector<std::vector<cli::PagePoint>>& walls) {
  std::vector<double> x, y;
  std::vector<std::uint64_t> offsets{0};
  for (const auto& wall : walls) {
    for (const auto& point : wall) {
      x.push_back(point.x);
      y.push_back(point.y);
    }
    offsets.push_back(x.size());
  }
  return ObstacleSet({.x = x, .y = y, .path_offsets = offsets});
}

/// Man and woman in the phases of their stride.
struct Poses {
  std::vector<Shape> shapes;
  std::vector<cli::PageShape> drawn;
};

Poses poses() {
  Poses all;
  const std::vector<std::pair<std::string, Character>> characters{{"man", default_male()},
                                                                  {"woman", default_female()}};
  for (const auto& character : characters) {
    PoseShaper shaper(character.second);
    for (std::uint32_t phase = 0; phase < phases; ++phase) {
      all.shapes.push_back(shaper.shape({0, static_cast<float>(stride * phase / phases)}));
      cli::PageShape& drawn = all.drawn.emplace_back();
      char part[16];
      std::snprintf(part, sizeof part, "%.2f", static_cast<double>(phase) / phases);
      drawn.name = character.first + ", walking, " + part + " of the stride";
      const Outline& outline = all.shapes.back().outline;
      for (std::size_t i = 0; i < outline.contours(); ++i)
        drawn.contours.emplace_back(outline.contour(i).begin(), outline.contour(i).end());
      drawn.discs = cli::discs_of(all.shapes.back().hierarchy, 3);
    }
  }
  return all;
}

struct Walker {
  double start, lane, sway, speed, phase;
  bool east;
};

/// They walk in lanes, east and west by turns, nearly as fast as those before them.
std::vector<Walker> walkers(std::uint32_t count, const Corridor& corridor) {
  detail::Random random(29);
  const auto lanes = static_cast<std::uint32_t>(corridor.width / 0.95);
  std::vector<Walker> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t lane = i % lanes, place = i / lanes;
    const double apart = corridor.length * lanes / count;
    all.push_back({(place + 0.5 + random.uniform(0.3)) * apart, (lane + 0.5) * corridor.width / lanes,
                   random.uniform(0.2), 1.1 + 0.05 * (lane % 4) + random.uniform(0.2),
                   random.uniform(2 * std::numbers::pi), lane % 2 == 0});
  }
  return all;
}

/// A crowd in the arrays that queries take, and ids.
struct Crowd {
  std::vector<std::int64_t> id;
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading, speed;

  Agents agents() const { return {shape, x, y, heading}; }
};

Crowd crowd_at(const std::vector<Walker>& walkers, const Corridor& corridor, double seconds) {
  Crowd crowd;
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const Walker& w = walkers[i];
    const double walked = w.start + w.speed * seconds, laps = std::floor(walked / corridor.length);
    const double along = walked - laps * corridor.length, swing = 0.9 * seconds + w.phase;
    const double across = 0.9 * w.sway * std::cos(swing);
    crowd.id.push_back(static_cast<std::int64_t>(i + 1 + walkers.size() * static_cast<std::size_t>(laps)));
    crowd.x.push_back(origin_x + (w.east ? along : corridor.length - along));
    crowd.y.push_back(origin_y + w.lane + w.sway * std::sin(swing));
    crowd.heading.push_back(std::atan2(across, w.east ? w.speed : -w.speed));
    crowd.speed.push_back(std::hypot(across, w.speed));
    const double stride_part = seconds * w.speed / 1.35 / stride + w.phase;
    crowd.shape.push_back((w.phase > 3 ? phases : 0) +
                          static_cast<std::uint32_t>(stride_part * phases) % phases);
  }
  return crowd;
}

/// A pair of ids, or an id and nothing for a wall.
using Key = std::pair<std::int64_t, std::int64_t>;
constexpr std::int64_t wall_key = -1;

/// What people do in each other, from frame to frame.
class Events {
 public:
  void add(const detail::CheckedPair& pair, double x, double y) {
    const Key key{pair.first, pair.is_wall ? wall_key : pair.second};
    const double frame = static_cast<double>(pair.frame);
    seen_.insert(key);
    const auto [open, is_new] =
        open_.try_emplace(key, detail::OverlapEvent{pair.first, pair.second, pair.is_wall, pair.frame,
                                                    pair.frame, frame, 0, pair.depth, x, y});
    detail::OverlapEvent& event = open->second;
    event.to = pair.frame;
    ++event.frames;
    if (pair.depth <= event.depth) return;
    event.depth = pair.depth;
    event.worst = frame;
    event.x = x, event.y = y;
  }
  void end_frame() {
    for (auto open = open_.begin(); open != open_.end();) {
      const bool is_over = !seen_.contains(open->first);
      if (is_over) done_.push_back(open->second);
      open = is_over ? open_.erase(open) : std::next(open);
    }
    seen_.clear();
  }
  const std::vector<detail::OverlapEvent>& done() const { return done_; }

 private:
  std::map<Key, detail::OverlapEvent> open_;
  std::set<Key> seen_;
  std::vector<detail::OverlapEvent> done_;
};

/// A frame that has been checked.
struct Checked {
  std::vector<detail::CheckedPerson> people;
  std::vector<detail::CheckedPair> pairs;
};

class Recording {
 public:
  Recording(std::uint32_t people, const Corridor& corridor)
      : corridor_(corridor), walkers_(walkers(people, corridor)), poses_(poses()), set_(poses_.shapes) {}

  cli::PageShape drawn(std::uint32_t shape) const { return poses_.drawn.at(shape); }
  const Events& events() const { return events_; }

  Checked frame(std::int64_t number) {
    const Crowd crowd = crowd_at(walkers_, corridor_, static_cast<double>(number) / fps);
    const CrowdCollisions hits = collider_.collide_all(set_, crowd.agents(), obstacles_);
    Checked checked;
    for (std::uint32_t i = 0; i < crowd.id.size(); ++i) {
      detail::CheckedPerson& person = checked.people.emplace_back();
      person.walker.id = crowd.id[i], person.shape = person.pose = crowd.shape[i];
      person.walker.x = crowd.x[i], person.walker.y = crowd.y[i];
      person.walker.heading = crowd.heading[i], person.walker.speed = crowd.speed[i];
      person.overlaps = !hits.agents[i].empty(), person.in_wall = !hits.obstacles[i].empty();
      if (person.in_wall) add(number, {crowd.id[i], wall_key}, 0.01f, crowd.x[i], crowd.y[i], checked);
    }
    add_pairs(crowd, hits.agents, number, checked);
    events_.end_frame();
    return checked;
  }

 private:
  void add(std::int64_t number, Key who, float depth, double x, double y, Checked& checked) {
    detail::CheckedPair& pair = checked.pairs.emplace_back();
    pair.frame = number, pair.first = who.first, pair.second = who.second;
    pair.is_wall = who.second == wall_key, pair.overlap = true, pair.depth = depth;
    events_.add(pair, x, y);
  }

  void add_pairs(const Crowd& crowd, const Rows<std::uint32_t>& rows, std::int64_t number, Checked& checked) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < crowd.id.size(); ++i)
      for (const std::uint32_t j : rows[i])
        if (i < j) pairs.push_back({i, j});
    std::vector<Penetration> depths(pairs.size());
    penetration(set_, crowd.agents(), pairs, 16, depths);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [i, j] = pairs[k];
      add(number, {crowd.id[i], crowd.id[j]}, depths[k].depth, (crowd.x[i] + crowd.x[j]) / 2,
          (crowd.y[i] + crowd.y[j]) / 2, checked);
    }
  }

  Corridor corridor_;
  std::vector<Walker> walkers_;
  Poses poses_;
  ShapeSet set_;
  ObstacleSet obstacles_ = obstacles_of(walls_of(corridor_));
  CrowdCollider collider_;
  Events events_;
};

nlohmann::json expected_frame(const detail::CheckedFrame& frame) {
  nlohmann::json people = nlohmann::json::array();
  for (const detail::CheckedPerson& person : frame.people)
    people.push_back({person.walker.id, person.walker.x, person.walker.y, person.overlaps, person.in_wall});
  return {{"frame", frame.frame}, {"seconds", frame.seconds}, {"people", people}};
}

/// The contours of everybody in a frame, in the coordinates of the recording.
nlohmann::json expected_outlines(const Recording& recording, const detail::CheckedFrame& frame) {
  nlohmann::json all = nlohmann::json::array();
  for (const detail::CheckedPerson& person : frame.people) {
    const double heading = person.walker.heading;
    const double cosine = std::cos(heading), sine = std::sin(heading);
    nlohmann::json contours = nlohmann::json::array();
    for (const auto& contour : recording.drawn(person.pose).contours) {
      nlohmann::json points = nlohmann::json::array();
      for (const Vec2 point : contour) {
        const auto x = static_cast<double>(point.x), y = static_cast<double>(point.y);
        points.push_back({person.walker.x + cosine * x - sine * y, person.walker.y + sine * x + cosine * y});
      }
      contours.push_back(points);
    }
    all.push_back(contours);
  }
  return all;
}

nlohmann::json expected_events(const std::vector<detail::OverlapEvent>& events) {
  nlohmann::json list = nlohmann::json::array();
  for (const detail::OverlapEvent& event : events)
    list.push_back(
        {{"first", event.first},
         {"second", event.second},
         {"wall", event.is_wall},
         {"lasts", static_cast<double>(event.to - event.from + 1) / fps},  // every frame stands for its time
         {"worst", event.worst / fps},
         {"depth", event.depth},
         {"x", event.x},
         {"y", event.y}});
  return list;
}

cli::PageFacts facts_of(const Corridor& corridor, std::uint32_t people, const std::string& title) {
  return {title,
          fps,
          {{"file", "corridor.txt"},
           {"people at a time", std::to_string(people)},
           {"bodies", "built-in man and woman, walking"},
           {"depth of the cut", "all"},
           {"headings", "as recorded"},
           {"<i>markup</i>", "</script><img src=x onerror=throw(2)>"}},
          walls_of(corridor)};
}

void write(const char* name, const std::string& text) {
  std::ofstream stream(name, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error(std::string("cannot write ") + name);
}

/// The arguments from the third on, where they are given.
std::uint32_t number(int argc, char** argv, int i, std::uint32_t otherwise) {
  return i < argc ? static_cast<std::uint32_t>(std::stoul(argv[i])) : otherwise;
}

void write_sample(int argc, char** argv) {
  const std::uint32_t people = number(argc, argv, 3, 60), count = number(argc, argv, 4, 200);
  const double area = 100.0 * people / number(argc, argv, 5, 90), width = std::sqrt(area / 1.8);
  const Corridor corridor{1.8 * width, width};
  Recording recording(people, corridor);
  cli::CheckPage page(
      facts_of(corridor, people,
               argc > 7 ? argv[7] : "corridor <b>& pillar</b></script><script>throw 1</script>"),
      [&](std::uint32_t shape) { return recording.drawn(shape); },
      number(argc, argv, 6, cli::CheckPage::default_most_bytes));
  nlohmann::json frames = nlohmann::json::array(), outlines;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Checked checked = recording.frame(i);
    const detail::CheckedFrame frame{500 + i, i / fps, checked.people, checked.pairs};
    page.add_frame(frame);
    if (people <= 100) frames.push_back(expected_frame(frame));
    if (people <= 100 && i == count / 2) outlines = expected_outlines(recording, frame);
  }
  const auto& events = recording.events().done();
  write(argv[1], std::move(page).finish(events));
  write(
      argv[2],
      nlohmann::json{{"frames", frames}, {"outlines", outlines}, {"events", expected_events(events)}}.dump());
}

}  // namespace
}  // namespace bch::test

int main(int argc, char** argv) try {
  if (argc < 3)
    throw std::runtime_error(
        "usage: check_page_sample PAGE.html EXPECTED.json [PEOPLE [FRAMES [PEOPLE_PER_100_M2 [MOST_BYTES "
        "[TITLE]]]]]");
  bch::test::write_sample(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "check_page_sample: %s\n", error.what());
  return 1;
}
