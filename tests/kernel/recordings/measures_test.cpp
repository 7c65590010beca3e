// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/measures.hpp"

#include <bch/pairs.hpp>

#include "kernel/recordings/check.hpp"
#include "kernel/recordings/walker_bodies.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/made_up_recording.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// Measures of people and pairs against their formulas, over all pairs of a frame and all frames before it.

namespace bch::detail {
namespace {

using test::add_crowd;
using test::MadeUp;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Calls a function with every frame of a recording and what is measured in it.
template <class Seen>
CheckSummary measured(MadeUp& recording, CheckOptions options, Seen seen) {
  recording.rewind();
  options.measures = true;
  return check(recording, options, seen);
}

struct Offset {
  double x, y, velocity_x, velocity_y;
  double distance() const { return std::sqrt(x * x + y * y); }
};

Offset offset(const Walker& from, const Walker& to) {
  return {to.x - from.x, to.y - from.y, to.velocity_x - from.velocity_x, to.velocity_y - from.velocity_y};
}

TEST(Measures, DiscsCollideWhenTheirCentresAreAsNearAsTheirRadii) {
  EXPECT_EQ(disc_collision(3, 0, -1, 0, 1), 2);
  EXPECT_EQ(disc_collision(3, 0, 1, 0, 1), infinite);
  EXPECT_EQ(disc_collision(3, 0, 0, 0, 1), infinite);
  EXPECT_EQ(disc_collision(3, 1.001, -1, 0, 1), infinite);
  EXPECT_EQ(disc_collision(3, 1, -1, 0, 1), 3);
  EXPECT_EQ(disc_collision(0.5, 0, 1, 0, 1), 0);
  test::Random random(7);
  int met = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = random.uniform(-4, 4), y = random.uniform(-4, 4), vx = random.uniform(-2, 2),
                 vy = random.uniform(-2, 2);
    const double time = disc_collision(x, y, vx, vy, 0.5);
    const auto gap = [&](double t) { return std::hypot(x + t * vx, y + t * vy) - 0.5; };
    for (double t = 0; t < std::min(time, 20.0); t += 0.01) ASSERT_GT(gap(t), -1e-12) << k;
    if (time == infinite || time == 0) continue;
    ASSERT_NEAR(gap(time), 0, 1e-12);
    ++met;
  }
  EXPECT_GT(met, 100);
}

/// The area of what is nearer to a person than to all others, and in the polygon around him, by rays.
double cell_by_rays(std::span<const CheckedPerson> people, std::size_t own) {
  constexpr int rays = 1200;
  constexpr double pi = std::numbers::pi;
  double area = 0;
  for (int k = 0; k < rays; ++k) {
    const double angle = 2 * pi * (k + 0.5) / rays, x = std::cos(angle), y = std::sin(angle);
    const double side = std::floor(angle / (pi / 6)) * pi / 6 + pi / 12;
    double length = 1.2 * std::cos(pi / 12) / std::cos(angle - side);
    for (const CheckedPerson& other : people) {
      const Offset to = offset(people[own].walker, other.walker);
      const double along = to.x * x + to.y * y;
      if (along > 0) length = std::min(length, (to.x * to.x + to.y * to.y) / 2 / along);
    }
    area += length * length * pi / rays;
  }
  return area;
}

TEST(Measures, OfDiscsAreTheirFormulas) {
  MadeUp recording(10);
  add_crowd(recording, 150, 2);
  std::size_t collisions = 0, overlaps = 0;
  measured(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    ASSERT_EQ(frame.measures.size(), frame.people.size());
    for (std::size_t i = 0; i < frame.people.size(); ++i) {
      const MeasuredPerson& told = frame.measures[i];
      double intrusion = 0, clearance = infinite, time = infinite;
      std::uint32_t intimate = 0, personal = 0;
      for (std::size_t j = 0; j < frame.people.size(); ++j) {
        if (j == i) continue;
        const Offset to = offset(frame.people[i].walker, frame.people[j].walker);
        time = std::min(time, disc_collision(to.x, to.y, to.velocity_x, to.velocity_y, 0.2));
        if (to.distance() > 2.4) continue;
        const double fraction = 0.6 / (to.distance() - 0.2);
        intrusion += to.distance() <= 0.2 ? infinite : fraction * fraction;
        clearance = std::min(clearance, to.distance() - 0.2);
        intimate += to.distance() <= 0.45, personal += to.distance() <= 1.2;
      }
      ASSERT_EQ(told.intimate, intimate);
      ASSERT_EQ(told.personal, personal);
      ASSERT_FLOAT_EQ(told.disc_clearance, static_cast<float>(clearance));
      ASSERT_FLOAT_EQ(told.disc_intrusion, static_cast<float>(intrusion));
      ASSERT_FLOAT_EQ(told.disc_time, static_cast<float>(time <= 5 ? time : infinite));
      ASSERT_NEAR(static_cast<double>(told.voronoi_density) * cell_by_rays(frame.people, i), 1, 2e-3);
      collisions += time > 0 && time <= 5, overlaps += time == 0;
    }
  });
  EXPECT_GT(collisions, 100u);
  EXPECT_GT(overlaps, 5u);
}

TEST(Measures, OfALatticeHaveItsDensity) {
  MadeUp recording(1);
  for (int k = 0; k < 81; ++k) recording.walk(k, 0.5 * (k % 9), 0.5 * (k / 9), 0, 0, 1);
  recording.walk(100, 50, 0, 0, 0, 1);
  measured(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    EXPECT_FLOAT_EQ(frame.measures[40].voronoi_density, 4);
    EXPECT_FLOAT_EQ(frame.measures[81].voronoi_density, static_cast<float>(1 / (3 * 1.2 * 1.2)));
    EXPECT_EQ(frame.measures[81].disc_clearance, MeasuredPerson::infinite);
    EXPECT_EQ(frame.measures[81].disc_intrusion, 0);
  });
}

/// What is measured by bodies, from queries of all pairs of a frame.
struct OfBodies {
  std::vector<Pair> pairs;
  std::vector<std::uint8_t> hits;
  std::vector<float> clearance, time;

  OfBodies(const CheckedFrame& frame, const ShapeSet& shapes)
      : pairs(test::all_pairs(static_cast<std::uint32_t>(frame.people.size()))),
        hits(pairs.size()),
        clearance(pairs.size()),
        time(pairs.size()) {
    std::vector<std::uint32_t> shape;
    std::vector<double> x, y, heading, way_x, way_y;
    for (const CheckedPerson& person : frame.people) {
      shape.push_back(person.shape), heading.push_back(person.walker.heading);
      x.push_back(person.walker.x), y.push_back(person.walker.y);
    }
    for (const Pair pair : pairs) {
      const Offset to = offset(frame.people[pair.second].walker, frame.people[pair.first].walker);
      way_x.push_back(5 * to.velocity_x), way_y.push_back(5 * to.velocity_y);
    }
    const Agents agents{shape, x, y, heading};
    std::vector<Penetration> depths(pairs.size());
    collide(shapes, agents, pairs, hits);
    bch::clearance(shapes, agents, pairs, {clearance}, {.max_distance = 0.6, .leaves = Leaves::segments});
    penetration(shapes, agents, pairs, 32, depths);
    time_of_impact(shapes, agents, pairs, {way_x, way_y}, time);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (hits[k] != 0) clearance[k] = -depths[k].depth;
      time[k] = hits[k] != 0 ? 0 : 5 * time[k];
    }
  }
};

TEST(Measures, OfBodiesAreThoseOfQueriesOfAllPairs) {
  MadeUp recording(10);
  add_crowd(recording, 100, 4);
  std::size_t overlaps = 0, later = 0;
  measured(recording, {}, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
    const OfBodies all(frame, shapes);
    auto row = frame.measured_pairs.begin();
    std::vector<MeasuredPerson> people(frame.people.size());
    std::vector<double> intrusion(people.size());
    for (std::size_t k = 0; k < all.pairs.size(); ++k) {
      const auto [first, second] = all.pairs[k];
      const float clearance = all.clearance[k], touching = all.time[k];
      const Offset to = offset(frame.people[first].walker, frame.people[second].walker);
      // Nobody collides before the clearance is used up.
      const double earliest = clearance > 0 && std::isfinite(clearance)
                                  ? static_cast<double>(clearance) / std::hypot(to.velocity_x, to.velocity_y)
                                  : 0;
      const float time =
          earliest > 5 ? static_cast<float>(infinite) : std::max(touching, static_cast<float>(earliest));
      const double disc_time = disc_collision(to.x, to.y, to.velocity_x, to.velocity_y, 0.2);
      for (const std::uint32_t i : {first, second}) {
        people[i].clearance = std::min(people[i].clearance, clearance);
        people[i].time = std::min(people[i].time, time);
        intrusion[i] += clearance <= 0 ? infinite : std::pow(0.6 / static_cast<double>(clearance), 2);
      }
      if (std::isinf(touching) && disc_time > 5) continue;
      ASSERT_NE(row, frame.measured_pairs.end());
      ASSERT_EQ(row->first, frame.people[first].walker.id);
      ASSERT_EQ(row->second, frame.people[second].walker.id);
      ASSERT_EQ(row->clearance, clearance);
      ASSERT_FLOAT_EQ(row->time, time);
      ASSERT_FLOAT_EQ(row->distance, static_cast<float>(to.distance()));
      ASSERT_FLOAT_EQ(row->disc_clearance, static_cast<float>(to.distance() - 0.2));
      ASSERT_FLOAT_EQ(row->disc_time, static_cast<float>(disc_time <= 5 ? disc_time : infinite));
      overlaps += clearance<0, later += time> 0 && std::isfinite(time);
      ++row;
    }
    ASSERT_EQ(row, frame.measured_pairs.end());
    for (std::size_t i = 0; i < people.size(); ++i) {
      ASSERT_EQ(frame.measures[i].clearance, people[i].clearance);
      ASSERT_FLOAT_EQ(frame.measures[i].time, people[i].time);
      if (std::isinf(intrusion[i])) {
        ASSERT_EQ(frame.measures[i].intrusion, MeasuredPerson::infinite);
      } else {
        ASSERT_NEAR(static_cast<double>(frame.measures[i].intrusion), intrusion[i],
                    1e-4 + 1e-6 * intrusion[i]);
      }
    }
  });
  EXPECT_GT(overlaps, 20u);
  EXPECT_GT(later, 100u);
}

TEST(Measures, SpheresAreMeasuredInPlaceOfOutlines) {
  MadeUp recording(10);
  recording.walk(1, -1, 0, 1, 0, 11);
  recording.walk(2, 1, 0, -1, 0, 11);
  const std::vector<BodyModel> models = body_models({}, 64);
  CheckOptions options;
  options.bodies = models;
  measured(recording, options, [&](const CheckedFrame& frame, const ShapeSet&) {
    const double meeting = 1 - static_cast<double>(frame.frame) / 10;  // of the centres, seconds
    ASSERT_EQ(frame.measured_pairs.size(), 1u);
    const MeasuredPair& pair = frame.measured_pairs[0];
    EXPECT_NEAR(static_cast<double>(pair.disc_time), std::max(0.0, meeting - 0.1), 1e-5);
    EXPECT_LE(pair.time, pair.disc_time);
    EXPECT_GE(static_cast<double>(pair.time), meeting - 0.7);
    EXPECT_EQ(pair.time == 0, frame.people[0].overlaps);
    EXPECT_EQ(pair.clearance < 0, frame.people[0].overlaps);
    EXPECT_EQ(frame.measures[0].time, pair.time);
  });
}

TEST(Measures, AnEncroachmentEndsWhenTheOthersDiscLeaves) {
  MadeUp recording(10);
  recording.walk(1, -1, 0, 1, 0, 41);   // at the origin after 1 s
  recording.walk(2, 0, -3, 0, 1, 41);   // after 3 s
  recording.walk(3, 0, 30, 0, -1, 41);  // never near
  measured(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    EXPECT_EQ(frame.measures[0].encroachment, MeasuredPerson::infinite);
    EXPECT_EQ(frame.measures[2].encroachment, MeasuredPerson::infinite);
    const double y = frame.people[1].walker.y, now = frame.seconds;
    if (std::abs(y) < 0.2 - 1e-9) {
      EXPECT_NEAR(static_cast<double>(frame.measures[1].encroachment), now - 1 - std::sqrt(0.2 * 0.2 - y * y),
                  1e-5);
    } else if (std::abs(y) > 0.2 + 1e-9) {
      EXPECT_EQ(frame.measures[1].encroachment, MeasuredPerson::infinite);
    }
  });
}

TEST(Measures, EncroachmentsAreThoseOfAllEarlierWays) {
  MadeUp recording(5);
  add_crowd(recording, 80, 25);
  std::vector<std::vector<Walker>> frames;
  std::size_t found = 0;
  measured(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    std::vector<Walker>& people = frames.emplace_back();
    for (const CheckedPerson& person : frame.people) people.push_back(person.walker);
    for (std::size_t i = 0; i < people.size(); ++i) {
      double least = infinite;
      for (std::size_t k = 0; k < frames.size(); ++k)
        for (std::size_t j = 0; j < people.size(); ++j) {
          const Walker &to = frames[k][j], &from = frames[k > 0 ? k - 1 : 0][j];
          for (int part = 0; part <= 100 && j != i; ++part) {
            const double back = part / 100.0, x = to.x + back * (from.x - to.x) - people[i].x,
                         y = to.y + back * (from.y - to.y) - people[i].y;
            if (x * x + y * y <= 0.04)
              least = std::min(least, (static_cast<double>(frames.size() - 1 - k) + back) / 5);
          }
        }
      const double told = static_cast<double>(frame.measures[i].encroachment);
      if (least <= 5) {
        ASSERT_LE(told, least + 1e-6);
        ASSERT_GE(told, least - 0.2 - 1e-6);  // a way may graze a disc between two samples
        found += told > least - 0.003;
      } else if (std::isfinite(told)) {
        ASSERT_GE(told, 0);
      }
    }
  });
  EXPECT_GT(found, 400u);
}

TEST(Measures, DiscsCollideHalfwayBetweenTwoFrames) {
  MadeUp recording(1);
  recording.walk(1, -0.5, 0, 1, 0, 2);
  recording.walk(2, 0, -0.5, 0, 1, 2);
  recording.walk(3, 0.5, 0.3, 0, 0, 2);
  recording.walk(4, 9, 0, 1, 0, 2);
  const CheckSummary summary = measured(recording, {}, [](const CheckedFrame& frame, const ShapeSet&) {
    EXPECT_EQ(frame.measures[0].disc_collides, frame.frame == 0);
    EXPECT_EQ(frame.measures[1].disc_collides, frame.frame == 0);
    EXPECT_FALSE(frame.measures[2].disc_collides);
  });
  EXPECT_EQ(summary.disc_colliding, 2u);
  EXPECT_EQ(summary.colliding, 3u);
}

std::string text_of_measures(MadeUp& recording, const CheckOptions& options) {
  std::ostringstream text;
  text.precision(9);
  const CheckSummary summary = measured(recording, options, [&](const CheckedFrame& frame, const ShapeSet&) {
    for (const MeasuredPerson& person : frame.measures)
      text << person.voronoi_density << " " << person.clearance << " " << person.disc_clearance << " "
           << person.time << " " << person.disc_time << " " << person.intrusion << " "
           << person.disc_intrusion << " " << person.encroachment << " " << person.collides << "\n";
    for (const MeasuredPair& pair : frame.measured_pairs)
      text << pair.first << " " << pair.second << " " << pair.clearance << " " << pair.time << "\n";
  });
  text << summary.colliding << " " << summary.disc_colliding;
  return text.str();
}

TEST(Measures, AreTheSameForAnyNumberOfThreadsAndFramesAtOnce) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(60)));
  CheckOptions options;
  const std::string expected = text_of_measures(recording, options);
  EXPECT_GT(expected.size(), 10'000u);
  for (const std::size_t at_once : {std::size_t{1}, std::size_t{500}, std::size_t{1'000'000}})
    for (const unsigned threads : {1u, 2u}) {
      options.people_at_once = at_once;
      test::on_threads(threads, [&] {
        EXPECT_TRUE(text_of_measures(recording, options) == expected) << at_once << " " << threads;
      });
    }
}

/// Measures change nothing else.
TEST(Measures, LeaveTheCheckAsItIs) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(40)));
  const auto pairs_of = [&](bool measures) {
    std::ostringstream text;
    recording.rewind();
    CheckOptions options;
    options.max_distance = 0.2, options.measures = measures;
    check(recording, options, [&](const CheckedFrame& frame, const ShapeSet&) {
      EXPECT_EQ(frame.measures.empty(), !measures);
      for (const CheckedPair& pair : frame.pairs)
        text << pair.first << " " << pair.second << " " << pair.depth << " " << pair.gap << " "
             << pair.passing << "\n";
    });
    return text.str();
  };
  EXPECT_EQ(pairs_of(true), pairs_of(false));
}

}  // namespace
}  // namespace bch::detail
