// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"
#include "tests/support/body_models.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Moving discs of clips: they hold the exact outline at any time, stay close to it, and are as animate() says.

namespace bch::test {
namespace {

// What moving discs cover at a time, and what they leave out.

bool contains(std::span<const Disc> cover, const Vec2& p) {
  return std::any_of(cover.begin(), cover.end(), [&](const Disc& disc) {
    const double x = double{p.x} - double{disc.x}, y = double{p.y} - double{disc.y};
    return std::sqrt(x * x + y * y) <= double{disc.radius};
  });
}

/// Returns the discs of a body at a time of the clip.
std::vector<Disc> cover_at(const AnimatedDiscs& animated, double seconds) {
  std::size_t c = 0, key = 0;
  while (animated.chunks[c].times.back() < seconds) ++c;
  const AnimatedChunk& chunk = animated.chunks[c];
  while (chunk.times[key + 1] < seconds) ++key;
  const double fraction = (seconds - chunk.times[key]) / (chunk.times[key + 1] - chunk.times[key]);
  const auto mix = [fraction](float a, float b) {
    return static_cast<float>(double{a} + (double{b} - double{a}) * fraction);
  };
  std::vector<Disc> cover;
  for (std::size_t i = 0; i < chunk.disc_count; ++i) {
    const Disc &a = chunk.keys[key * chunk.disc_count + i], &b = chunk.keys[(key + 1) * chunk.disc_count + i];
    cover.push_back({mix(a.x, b.x), mix(a.y, b.y), mix(a.radius, b.radius)});
  }
  return cover;
}

/// Counts the vertices and the points of the outline's segments, some millimetres apart, that a cover does not hold.
std::size_t left_out(std::span<const Disc> cover, std::span<const Vec2> vertices, const Outline& outline) {
  const auto out = [&](const Vec2& p) { return !contains(cover, p); };
  std::size_t count = static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), out));
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
      const float parts = std::ceil(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) / 0.004f);
      for (float part = 0; part < parts; ++part)
        count += out({a.x + (b.x - a.x) * (part / parts), a.y + (b.y - a.y) * (part / parts)});
    }
  }
  return count;
}

/// Returns the largest coordinate of a cover in a direction, less that of what it covers.
double excess_in(std::span<const Disc> cover, std::span<const Vec2> vertices, double x, double y) {
  double of_discs = -1e9, of_vertices = -1e9;
  for (const Disc& disc : cover)
    of_discs = std::max(of_discs, x * double{disc.x} + y * double{disc.y} + double{disc.radius});
  for (const Vec2& p : vertices) of_vertices = std::max(of_vertices, x * double{p.x} + y * double{p.y});
  return of_discs - of_vertices;
}

/// The character with the first part of its first clip, which is shorter with sanitizers.
Character with_short_clip(Character character, float seconds) {
  character.clips.resize(1);
  character.clips[0].seconds = seconds * static_cast<float>(samples(8)) / 8;
  return character;
}

void expect_as_said(const AnimatedDiscs& animated, float seconds) {
  ASSERT_FALSE(animated.chunks.empty());
  EXPECT_EQ(animated.chunks.front().times.front(), 0.0);
  EXPECT_EQ(animated.chunks.back().times.back(), double{seconds});
  double before = 0;
  for (const AnimatedChunk& chunk : animated.chunks) {
    EXPECT_EQ(chunk.times.front(), before);
    before = chunk.times.back();
    EXPECT_TRUE(std::is_sorted(chunk.times.begin(), chunk.times.end()));
    ASSERT_EQ(chunk.keys.size(), chunk.times.size() * chunk.disc_count);
    float max_extent = 0;
    for (const Disc& disc : chunk.keys)
      max_extent = std::max({max_extent, std::abs(disc.x), std::abs(disc.y)});
    for (const float z : chunk.z) max_extent = std::max(max_extent, std::abs(z));
    ASSERT_EQ(chunk.z.size(), chunk.keys.size());
    const double step = std::exp2(std::ceil(std::log2(double{max_extent})) - 15);
    for (const Disc& disc : chunk.keys)
      for (const float number : {disc.x, disc.y, disc.radius})
        EXPECT_EQ(std::remainder(double{number}, step), 0.0) << number;
    for (const float z : chunk.z) EXPECT_EQ(std::remainder(double{z}, step), 0.0) << z;
  }
}

/// Returns the points of a model where vertices are.
std::vector<Vec3> points_of(const BodyModel& model, std::span<const Vec3> vertices) {
  std::vector<Vec3> points(vertices.begin(), vertices.end());
  for (const auto& [from, to] : model.midpoints) {
    const Vec3 a = points[from], b = points[to];
    points.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
  }
  return points;
}

/// Returns how many corners of a model are outside of their spheres.
std::size_t corners_left_out(const BodyModel& model, std::span<const Vec3> vertices,
                             std::span<const Sphere> spheres) {
  const std::vector<Vec3> points = points_of(model, vertices);
  std::size_t count = 0;
  for (std::size_t s = 0; s < spheres.size(); ++s)
    for (std::uint32_t i = model.corner_begin[s]; i < model.corner_begin[s + 1]; ++i) {
      const Vec3& p = points[model.corners[i]];
      const Sphere& of = spheres[s];
      count += std::hypot(double{p.x} - double{of.x}, double{p.y} - double{of.y},
                          double{p.z} - double{of.z}) > double{of.radius};
    }
  return count;
}

/// Looks at random times. Half of them are in the first 16th of a clip, where they are close to each other. Discs stand out farther than
/// the spheres of the pose by hardly more than the error.
void expect_covered(const BodyModel& model, std::uint32_t times) {
  constexpr float error = 0.005f;
  constexpr double bend = 0.001;
  const Character& character = *model.character;
  const AnimatedDiscs animated = animate(model, 0, {.error = error});
  const float end = character.clips[0].seconds;
  expect_as_said(animated, end);
  detail::Skinner skinner(character);
  OutlineBuilder builder(character.triangles, character.vertices.size());
  BodyPoser poser(model);
  const AnimatedShape shape(animated);
  EXPECT_TRUE(shape.in_space());
  Outline outline;
  Random random(31);
  for (std::uint32_t i = 0; i < times; ++i) {
    const auto seconds = static_cast<float>(random.uniform(0, double{end} / (i % 2 == 0 ? 1 : 16)));
    const std::span<const Vec2> vertices = skinner.ground_pose({0, seconds});
    builder.build(vertices, outline);
    const std::vector<Vec3> in_space = pose_vertices(character, Pose(0, seconds));
    ASSERT_EQ(corners_left_out(model, in_space, shape.spheres(double{seconds})), 0u)
        << character.name << " at " << seconds << " s";
    const std::vector<Disc> cover = cover_at(animated, double{seconds});
    ASSERT_EQ(left_out(cover, vertices, outline), 0u) << character.name << " at " << seconds << " s";
    std::vector<Disc> posed;
    for (const Sphere& sphere : poser.spheres(Pose(0, seconds)))
      posed.push_back({sphere.x, sphere.y, sphere.radius});
    const double turn = random.uniform(0, 2 * std::numbers::pi), x = std::cos(turn), y = std::sin(turn);
    EXPECT_LT(excess_in(cover, vertices, x, y) - excess_in(posed, vertices, x, y), double{error} + bend)
        << character.name << " at " << seconds << " s";
  }
}

TEST(Animate, HoldsCharactersAtEveryTime) {
  const std::vector<Character> both = default_characters();  // one of them with sanitizers
  for (const Character& character : std::span(both).first(samples(2)))
    expect_covered(make_body(with_short_clip(character, 0.8f), {.spheres = 96, .draft = true}), samples(800));
}

TEST(Animate, HoldsRealCharacters) {
  const auto data = test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set";
  for (const Character& character : real_characters(*data))
    expect_covered(plain_model(with_short_clip(character, 0.12f), 96), samples(200));
}

/// A body of bars, each 0.4 m times 0.06 m, on joints of their own that turn from and to an angle about x and back, once a second.
struct Bar {
  float x, from, to;
};
Character bars(const std::vector<Bar>& of) {
  Character body;
  body.name = "bars";
  body.joints = {{"root", -1, {}}};
  body.root_joint = 0;
  body.influence_begin = {0};
  body.clips = {{"swing", 1, {}}};
  for (const Bar& bar : of) {
    const auto first = static_cast<std::uint32_t>(body.vertices.size());
    const auto joint = static_cast<std::uint32_t>(body.joints.size());
    body.bones.push_back({joint, {}});
    for (const Vec3& corner : {Vec3{0, -0.03f, 0}, {0.4f, -0.03f, 0}, {0.4f, 0.03f, 0}, {0, 0.03f, 0}}) {
      body.vertices.push_back(corner);
      body.influences.push_back({joint - 1, 1});
      body.influence_begin.push_back(static_cast<std::uint32_t>(body.influences.size()));
    }
    body.triangles.push_back({first, first + 1, first + 2});
    body.triangles.push_back({first, first + 2, first + 3});
    Joint arm = {"arm " + std::to_string(joint), 0, {}};
    arm.rest.rows[0][3] = bar.x;
    body.joints.push_back(arm);
    const auto turned = [](float angle) {
      return Quaternion{0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    };
    Channel channel;
    channel.joint = joint;
    channel.rotations = {{0, turned(bar.from)}, {0.5f, turned(bar.to)}, {1, turned(bar.from)}};
    body.clips[0].channels.push_back(channel);
  }
  validate(body);
  return body;
}

BodyModel model_of(const Character& body) {
  return plain_model(body, 8);
}

TEST(Animate, FollowsArcsBetweenDistantKeys) {
  expect_covered(model_of(bars({{0, 0, 2}})), samples(4000));
}

TEST(Animate, HoldsPartsThatComeOutFromUnderOthersAndPartsApart) {
  expect_covered(model_of(bars({{0, 0, 0}, {0, 0, 1.5f}, {0, 0, -1}})), samples(2000));
  expect_covered(model_of(bars({{0.1f, 0, 1}, {-0.9f, 0, 1}})), samples(1000));
}

TEST(Animate, KnowsLoops) {
  Character body = bars({{0, 0, 1}});
  EXPECT_TRUE(animate(model_of(body), 0).loops);
  body.clips[0].seconds = 0.75f;
  EXPECT_FALSE(animate(model_of(body), 0).loops);
  // A clip whose ends differ, played over and over: at its end the body jumps to where it begins.
  const AnimatedDiscs forced = animate(model_of(body), 0, {.loops = true});
  const AnimatedShape jumping(forced);
  EXPECT_TRUE(jumping.loops());
  EXPECT_EQ(jumping.discs(0.75), jumping.discs(0));
  EXPECT_EQ(jumping.discs(0.75 + 0.25), jumping.discs(0.25));
  EXPECT_NE(jumping.discs(std::nextafter(0.75, 0.0)), jumping.discs(0));
  body.clips[0].seconds = 1;
  EXPECT_FALSE(animate(model_of(body), 0, {.loops = false}).loops);
  body.clips[0].seconds = 1e-7f;  // at whose end it is where it was
  EXPECT_NO_THROW(validate(animate(model_of(body), 0)));
}

TEST(Animate, FollowsItsError) {
  const BodyModel body = model_of(bars({{0, 0, 2}}));
  const auto keys = [&](float error) {
    std::size_t count = 0;
    for (const AnimatedChunk& chunk : animate(body, 0, {.error = error}).chunks) count += chunk.times.size();
    return count;
  };
  EXPECT_LT(keys(0.05f), keys(0.005f));
  EXPECT_LT(keys(0.005f), keys(0.0005f));
}

TEST(Animate, RefusesWhatItCannotHold) {
  const Character body = bars({{0, 0, 1}});
  const auto message = [](const Character& of, std::uint32_t clip = 0, const AnimateOptions& options = {}) {
    return complaint([&] { animate(model_of(of), clip, options); });
  };
  EXPECT_EQ(message(body, 1), "character 'bars': no clip 1");
  EXPECT_EQ(message(body, 0, {.error = -1}), "animate: expected an error above 0 m, found -1 m");
  const std::string uneven = "character 'bars': clip 'swing' has channels that are not linear between keys";
  Character other = body;
  other.clips[0].channels[0].rotation_curve.interpolation = Interpolation::step;
  EXPECT_EQ(message(other), uneven);
  other = body;
  other.clips[0].channels[0].rotations[1].time = 0;
  EXPECT_EQ(message(other), uneven);
  other = body;
  other.root_joint = -1;
  EXPECT_EQ(message(other), "character 'bars': an animated shape needs a root joint");
  other = body;
  other.clips[0].seconds = 0;
  EXPECT_EQ(message(other), "character 'bars': clip 'swing' takes no time");
}

}  // namespace
}  // namespace bch::test
