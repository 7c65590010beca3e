// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_models.hpp"
#include "layout/body/model/model_bytes.hpp"
#include "tests/support/test.hpp"

// Models as bytes, models that come with the library, and models that are refused.

namespace bch {
namespace {

using detail::bytes_of;
using detail::model_from;

/// A model in which nothing is as usual: least radii, leaves of 8, centres and weights of all kinds of bits.
BodyModel odd_model() {
  BodyModel model = test::plain_model(default_male(), 400);
  for (std::size_t s = 0; s < model.sphere_count(); ++s)
    model.least_radius.push_back(1e-30f * static_cast<float>(s));
  model.influences[3].centre = {-0.0f, 1e-42f, -123456.7f};
  model.core[5] = 399;
  return model;
}

void expect_same(const BodyModel& a, const BodyModel& b) {
  EXPECT_EQ(a.character, b.character);
  EXPECT_EQ(a.influence_begin, b.influence_begin);
  ASSERT_EQ(a.influences.size(), b.influences.size());
  for (std::size_t i = 0; i < a.influences.size(); ++i) {
    EXPECT_EQ(a.influences[i].bone, b.influences[i].bone);
    EXPECT_EQ(a.influences[i].weight, b.influences[i].weight);
    EXPECT_EQ(a.influences[i].centre, b.influences[i].centre);
  }
  EXPECT_EQ(a.midpoints, b.midpoints);
  EXPECT_EQ(a.corner_begin, b.corner_begin);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.least_radius, b.least_radius);
  EXPECT_EQ(a.leaf_size, b.leaf_size);
  EXPECT_EQ(a.core, b.core);
}

TEST(ModelBytes, GiveTheSameModel) {
  const BodyModel model = odd_model();
  const std::string bytes = bytes_of(model);
  const BodyModel again = model_from(bytes, model.character);
  expect_same(again, model);
  EXPECT_EQ(bytes_of(again), bytes);
}

TEST(ModelBytes, HoldNumbersOfAllSizes) {
  BodyModel model;  // no valid one
  model.corners = {0, 0xffffffff, 0, 0x80000000, 1, 0x7fffffff, 127, 128, 1u << 28};
  model.midpoints = {{0xffffffff, 0}, {0, 0xffffffff}};
  expect_same(model_from(bytes_of(model), nullptr), model);
}

TEST(ModelBytes, AreRefusedWhereTheyEndEarlyOrLate) {
  const std::string bytes = bytes_of(test::plain_model(default_male(), 16));
  for (std::size_t size = 0; size < bytes.size(); size += size < 300 ? 1 : 97)
    EXPECT_THROW(model_from(std::string_view(bytes).substr(0, size), nullptr), std::invalid_argument) << size;
  EXPECT_TRUE(test::has(test::complaint([&] { model_from(bytes + '\0', nullptr); }), "found 1 more bytes"));
}

TEST(ModelBytes, PromiseNoMoreThanTheyHold) {
  const std::string start(1 + detail::core_spheres, '\0');  // leaf size and core
  EXPECT_TRUE(test::has(test::complaint([&] { model_from(start + "\xff\xff\xff\xff\x0f", nullptr); }),
                        "expected at least 4294967295 more bytes, found 0"));
  EXPECT_TRUE(
      test::has(test::complaint([&] { model_from("\xff\xff\xff\xff\x10", nullptr); }), "at most 32 bits"));
  EXPECT_TRUE(test::has(test::complaint([&] { model_from("\xff\xff\xff\xff\xff\xff", nullptr); }),
                        "at most 32 bits"));
}

TEST(ModelBytes, OfUsersHoldTheCharacterToo) {
  const BodyModel model = odd_model();
  const std::vector<std::byte> bytes = to_bytes(model);
  BodyModel again = body_model(bytes);
  EXPECT_EQ(to_bytes(again), bytes);
  EXPECT_EQ(again.character->name, "default male");
  EXPECT_EQ(again.character->vertices, model.character->vertices);
  EXPECT_EQ(again.character->clips.size(), model.character->clips.size());
  again.character = model.character;
  expect_same(again, model);
}

TEST(ModelBytes, OfUsersAreCheckedLikeModels) {
  std::vector<std::byte> bytes = to_bytes(test::plain_model(default_male(), 16));
  for (std::size_t left = 1; left < 30; ++left)
    EXPECT_THROW(body_model(std::span(bytes).first(bytes.size() - left)), std::invalid_argument) << left;
  bytes.back() = std::byte{1};  // a least radius is promised, and is not there
  EXPECT_TRUE(
      test::has(test::complaint([&] { body_model(bytes); }), "expected at least 1 more bytes, found 0"));
  EXPECT_TRUE(test::has(test::complaint([] { to_bytes(BodyModel{}); }), "expected a character, found none"));
  BodyModel odd = test::plain_model(default_male(), 16);
  odd.core[3] = 16;
  EXPECT_TRUE(test::has(test::complaint([&] { to_bytes(odd); }), "core spheres below 16, found 16"));
}

/// A square of two triangles encloses nothing.
TEST(MakeBody, TakesFlatSkins) {
  Character square;
  square.joints = {{"root", -1, {}}};
  square.bones = {{0, {}}};
  square.influence_begin = {0};
  for (const Vec3& corner : {Vec3{0, 0, 0}, {0.4f, 0, 0}, {0.4f, 0.4f, 0}, {0, 0.4f, 0}}) {
    square.vertices.push_back(corner);
    square.influences.push_back({0, 1});
    square.influence_begin.push_back(static_cast<std::uint32_t>(square.vertices.size()));
  }
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const bool draft : {false, true}) {
    const BodyModel model = make_body(square, {.spheres = 16, .draft = draft});
    EXPECT_NO_THROW(validate(model));
    EXPECT_GT(model.sphere_count(), 8u);
  }
}

TEST(DefaultBodies, AreModelsOfTheirCharacters) {
  for (const Character& character : {default_male(), default_female()})
    for (const std::uint32_t spheres : {64u, 128u, 256u, 512u}) {
      const BodyModel model = default_body(character, spheres);
      validate(model);
      EXPECT_LE(model.sphere_count(), spheres);
      EXPECT_GE(model.sphere_count(), spheres - spheres / 10);
      EXPECT_EQ(model.character->clips.size(), character.clips.size());
    }
  EXPECT_NE(bytes_of(default_body(default_male())), bytes_of(default_body(default_female())));
  EXPECT_EQ(bytes_of(default_body(default_male())), bytes_of(default_body(default_male(), 256)));
}

TEST(DefaultBodies, AreThoseOfPedestriansToo) {
  const BodyModel girl = default_body(default_pedestrian(Sex::female, 1.2, 0.3), 128);
  validate(girl);
  EXPECT_EQ(bytes_of(girl), bytes_of(default_body(default_female(), 128)));
}

TEST(DefaultBodies, AreRefusedToOthers) {
  EXPECT_TRUE(test::has(test::complaint([] { default_body(default_bulky_male()); }),
                        "those of 'default bulky male', whose model make_body() makes"));
  EXPECT_TRUE(test::has(test::complaint([] { default_body(default_male(), 100); }),
                        "expected 64, 128, 256 or 512 spheres, found 100"));
  const auto changes = std::to_array<void (*)(Character&)>({
      [](Character& c) { c.vertices.back().z += 1e-6f; },
      [](Character& c) { std::swap(c.triangles[0], c.triangles[1]); },
      [](Character& c) { c.bones.front().inverse_bind.rows[0][3] += 1e-6f; },
      [](Character& c) { c.joints.back().rest.rows[2][3] += 1e-6f; },
      [](Character& c) { c.influences.front().bone ^= 1u; },
  });
  for (const auto change : changes) {
    Character other = default_male();
    change(other);
    EXPECT_TRUE(test::has(test::complaint([&] { default_body(other); }), "make_body()"));
  }
}

/// A triangle whose edges at its first corner are halved towards that corner, again and again: which of both is halved next can be chosen
/// each time, and no choice leads to an end, because no sphere has the first corner.
TEST(BodyModels, AreRefusedSoonWhateverTheirCuts) {
  Character character;
  character.joints.emplace_back();
  character.bones.emplace_back();
  character.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  character.influence_begin = {0, 1, 2, 3};
  character.influences.assign(3, {0, 1});
  character.triangles = {{0, 1, 2}};
  BodyModel model;
  model.character = std::make_shared<Character>(character);
  model.influence_begin = {0, 1};
  model.influences = {{0, 1, {}}};
  model.corners = {1, 2};
  model.corner_begin = {0, 2};
  EXPECT_TRUE(test::has(test::complaint([&] { validate(model); }), "triangle 0 outside"));
  for (std::uint32_t point = 1; point < 60; ++point) {
    model.midpoints.push_back({0, point});
    model.corners.push_back(point + 2);
    ++model.corner_begin[1];
  }
  EXPECT_TRUE(test::has(test::complaint([&] { validate(model); }), "order is found soon"));
}

}  // namespace
}  // namespace bch
