// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "baselines/exact_tests.hpp"
#include "kernel/recordings/character_library.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// `bch place`.

namespace bch::test {
namespace {

/// The people of a moment in the recording that is written.
struct Moment {
  std::vector<double> x, y, heading;
  std::vector<std::string> character;
  std::vector<float> clip_time;
};

std::map<std::string, Moment> moments_of(const std::string& csv) {
  std::map<std::string, Moment> moments;
  std::istringstream rows(csv);
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "id,time,x,y,stature,heading,character,clip,clip_time");
  while (std::getline(rows, row)) {
    std::vector<std::string> fields;
    std::istringstream stream(row);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    EXPECT_EQ(fields.at(7), "idle think");
    Moment& moment = moments[fields[1]];
    moment.x.push_back(std::stod(fields[2]));
    moment.y.push_back(std::stod(fields[3]));
    moment.heading.push_back(std::stod(fields[5]));
    moment.character.push_back(fields[6]);
    moment.clip_time.push_back(std::stof(fields[8]));
  }
  return moments;
}

/// Triangles of a skin where it stands, and the box that holds them.
struct Skin {
  std::vector<baselines::Triangle3> triangles;
  std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};

  void add(const baselines::Triangle3& triangle) {
    triangles.push_back(triangle);
    for (const auto& [x, y, z] : triangle) {
      const double at[] = {x, y, z};
      for (std::size_t axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], at[axis]), high[axis] = std::max(high[axis], at[axis]);
    }
  }

  /// Returns what may meet another skin.
  Skin near(const Skin& other) const {
    Skin some;
    for (const baselines::Triangle3& triangle : triangles) {
      Skin one;
      one.add(triangle);
      bool is_near = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        is_near = is_near && one.low[axis] <= other.high[axis] && other.low[axis] <= one.high[axis];
      if (is_near) some.add(triangle);
    }
    return some;
  }

  bool meets(const Skin& other) const {
    const Skin some = near(other), others = other.near(some);
    return std::ranges::any_of(some.triangles, [&](const baselines::Triangle3& s) {
      return std::ranges::any_of(
          others.triangles, [&](const baselines::Triangle3& t) { return baselines::triangles_meet(s, t); });
    });
  }
};

/// The characters, as people have them.
struct Bodies {
  std::map<std::string, Character> characters{
      {"default:male", detail::character_entry(default_male(), "").character},
      {"default:female", detail::character_entry(default_female(), "").character}};

  Skin skin_of(const Moment& moment, std::size_t i) const {
    const Character& character = characters.at(moment.character[i]);
    const auto clip = std::ranges::find(character.clips, "idle think", &Clip::name) - character.clips.begin();
    const std::vector<Vec3> posed =
        pose_vertices(character, Pose(static_cast<std::uint32_t>(clip), moment.clip_time[i]));
    const double c = std::cos(moment.heading[i]), s = std::sin(moment.heading[i]);
    const auto placed = [&](std::uint32_t vertex) {
      const double x = double{posed[vertex].x}, y = double{posed[vertex].y};
      return baselines::Point3{moment.x[i] + c * x - s * y, moment.y[i] + s * x + c * y,
                               double{posed[vertex].z}};
    };
    Skin skin;
    for (const auto& [a, b, d] : character.triangles) skin.add({placed(a), placed(b), placed(d)});
    return skin;
  }

  /// Counts who collides with whom by the skins of poses that are made for this very time.
  std::size_t collisions(const Moment& moment) const {
    std::vector<Skin> skins;
    for (std::size_t i = 0; i < moment.x.size(); ++i) skins.push_back(skin_of(moment, i));
    std::size_t count = 0;
    for (std::size_t i = 0; i < skins.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::hypot(moment.x[i] - moment.x[k], moment.y[i] - moment.y[k]) < 2.5)
          count += skins[i].meets(skins[k]);
    return count;
  }
};

class CliPlace : public testing::Test {
 protected:
  /// People who think while they go, as the built-in man if not said otherwise, in the recording `csv`.
  Ending place(const Arguments& more, const Arguments& who = {"--character", "default:male"}) const {
    Arguments words{"place", "--clip", "idle think", "--csv", csv};
    words.insert(words.end(), who.begin(), who.end());
    const Ending run = bch(words, more);
    EXPECT_EQ(run.code, 0) << run.err;
    return run;
  }
  std::map<std::string, Moment> moments() const { return moments_of(read_text(csv)); }

  const TemporaryFolder folder;
  const std::string csv = folder.file("placed.csv"), json = folder.file("placed.json");
};

TEST_F(CliPlace, NobodyTouchesAnybodyAtAnyTime) {
  place({"--speed", "1.2", "--seconds", "2", "--tries", "100", "--width", "6", "--depth", "5", "--fps", "20",
         "--json", json},
        {});
  const std::size_t bodies = read_json(json)["people"];
  EXPECT_EQ(read_json(json)["placed"].size(), bodies);
  EXPECT_GT(bodies, 4u);
  ASSERT_EQ(moments().size(), 41u);
  Bodies bodies_posed;
  std::size_t near = 0;
  for (const auto& [time, moment] : moments()) {
    ASSERT_EQ(moment.x.size(), bodies);
    EXPECT_EQ(bodies_posed.collisions(moment), 0u) << time << " s";
    for (std::size_t i = 1; i < bodies; ++i)
      near += std::hypot(moment.x[i] - moment.x[0], moment.y[i] - moment.y[0]) < 0.8;
  }
  EXPECT_GT(near, 0u) << "nobody is near anybody, so that nothing was tested";
}

/// A wall through the middle, and a room's worth of furniture.
TEST_F(CliPlace, NobodyTouchesWalls) {
  const std::string walls = folder.write("walls.wkt", "LINESTRING(2 -1, 2 4) POLYGON((3 0, 4 0, 4 4, 3 4))");
  place({"--seconds", "1", "--speed", "0.5", "--tries", "150", "--width", "4", "--depth", "3", "--fps", "5",
         "--obstacles", walls});
  std::size_t left = 0, right = 0;
  for (const auto& [time, moment] : moments())
    for (const double x : moment.x) {
      EXPECT_TRUE(x < 1.9 || (x > 2.1 && x < 2.9)) << x << " m at " << time << " s";
      ++(x < 2 ? left : right);
    }
  EXPECT_GT(left, 0u);
  EXPECT_GT(right, 0u);
}

/// The clip takes 6 s. Who moves for less does not come to its end; who moves for longer begins it again, and touches nobody then.
TEST_F(CliPlace, NobodyStopsWhileHeMovesOn) {
  constexpr double fps = 10;
  for (const double seconds : {4.0, 8.0}) {
    place({"--speed", "0.3", "--tries", "50", "--width", "4", "--depth", "4", "--fps", std::to_string(fps),
           "--seconds", std::to_string(seconds)});
    Bodies bodies;
    std::vector<float> before;
    std::size_t begun_again = 0;
    ASSERT_EQ(moments().size(), static_cast<std::size_t>(seconds * fps) + 1);
    for (const auto& [time, moment] : moments()) {
      for (std::size_t i = 0; i < before.size(); ++i) {
        const bool again = moment.clip_time.at(i) < before[i];
        EXPECT_NEAR(double{moment.clip_time[i]} + (again ? 6 : 0), double{before[i]} + 1 / fps, 1e-5)
            << time << " s";
        begun_again += again;
      }
      before = moment.clip_time;
      EXPECT_EQ(bodies.collisions(moment), 0u) << time << " s";
    }
    EXPECT_GT(before.size(), 3u);
    EXPECT_TRUE(seconds < 6 ? begun_again == 0 : begun_again >= before.size()) << begun_again;
  }
}

/// The last frame is at 0.29 s, though 0.29 * 100 is below 29; and a clip that is named twice is built once.
TEST_F(CliPlace, WritesTheLastFrameAndTakesEachClipOnce) {
  const Ending run = place({"--clip", "idle think", "--seconds", "0.29", "--fps", "100", "--tries", "3"});
  EXPECT_EQ(moments().size(), 30u);
  EXPECT_EQ(moments().rbegin()->first, "0.290000");
  EXPECT_NE(run.out.find("for 1 clip\n"), std::string::npos) << run.out;
}

/// The first two meet at (1, 0). The third comes to their ways when they have gone on, and the fourth stands.
TEST_F(CliPlace, TakesGivenPathsAtTheirOwnTimes) {
  std::string rows = "id,time,x,y,heading\n4,7,6,6,1.5\n";
  for (int k = 0; k <= 4; ++k) {
    const double time = 0.5 * k;
    rows += fmt::format("1,{},{},0,0\n2,{},1,{},\n3,{},1,{},\n", time, time, 3 + time, 1 - time, 10 + time,
                        4 - 1.85 * time);
  }
  place({"--paths", folder.write("paths.csv", rows), "--seconds", "2", "--fps", "2", "--json", json});
  const auto report = read_json(json);
  EXPECT_EQ(report["width"], 6);
  EXPECT_EQ(report["depth"], 7);
  EXPECT_EQ(report["candidates"], 4);
  EXPECT_EQ(report["people"], 3);
  std::size_t rows_of_third = 0, rows_of_fourth = 0;
  std::istringstream placed(read_text(csv));
  for (std::string row; std::getline(placed, row);) {
    double time = 0, x = 0, y = 0, stature = 0, heading = 0;
    int id = 0;
    if (std::sscanf(row.c_str(), "%d,%lf,%lf,%lf,%lf,%lf", &id, &time, &x, &y, &stature, &heading) != 6)
      continue;
    if (id == 3) {
      EXPECT_NEAR(x, 1, 1e-6);
      EXPECT_NEAR(y, 4 - 1.85 * time, 1e-6);
      EXPECT_NEAR(heading, -std::numbers::pi / 2, 1e-6);
      ++rows_of_third;
    } else if (id == 4) {
      EXPECT_EQ(row.find(",6.000000,6.000000,"), 10u) << row;
      EXPECT_NEAR(heading, 1.5, 1e-6);
      ++rows_of_fourth;
    }
  }
  EXPECT_EQ(rows_of_third, 5u);
  EXPECT_EQ(rows_of_fourth, 5u);
}

TEST_F(CliPlace, GivesTheSamePeopleForASeed) {
  const auto people = [&](const std::string& seed) {
    place({"--seconds", "1", "--tries", "5", "--fps", "1", "--seed", seed});
    return read_text(csv);
  };
  const std::string once = people("7");
  EXPECT_EQ(once, people("7"));
  EXPECT_NE(once, people("8"));
}

}  // namespace
}  // namespace bch::test
