// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "tests/support/c_api.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test.hpp"

// Models and bodies of spheres of the C interface are those of C++.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

using OwnedModel = test::Owned<bch_body_model, bch_body_model_free>;
using OwnedBodies = test::Owned<bch_body_set, bch_body_set_free>;

/// Models of the man and the woman.
struct Models {
  OwnedModel man = model(BCH_MALE, 64), woman = model(BCH_FEMALE, 128);
  std::vector<const bch_body_model*> all{man.get(), woman.get()};

  static OwnedModel model(std::int32_t which, std::uint32_t spheres) {
    const auto character = made<bch_character_free>(bch_character_default, which);
    return made<bch_body_model_free>(bch_body_model_default, character.get(), spheres);
  }
};

std::uint32_t sphere_count(const bch_body_model* model) {
  std::uint32_t count = 0;
  expect_ok(bch_body_model_get_sphere_count(model, &count));
  return count;
}

void expect_baked(const std::vector<const bch_body_model*>& models) {
  const auto bodies = made<bch_body_set_free>(bch_bake_bodies, models.data(), models.size(), 4u,
                                              static_cast<bch_work*>(nullptr));
  const std::vector<BodyModel> own{default_body(default_male(), 64), default_body(default_female(), 128)};
  const BodySet expected = bake(own, {.poses = 4});
  bch_body_set_info info = BCH_BODY_SET_INFO_INIT;
  expect_ok(bch_body_set_get_info(bodies.get(), &info));
  ASSERT_EQ(info.bodies, expected.body_count());
  for (std::uint32_t body = 0; body < info.bodies; ++body) {
    const std::vector<Sphere> spheres = expected.spheres(body);
    std::vector<bch_sphere> found(spheres.size());
    std::size_t count = 0;
    expect_ok(bch_body_set_get_spheres(bodies.get(), body, found.data(), found.size(), &count));
    ASSERT_EQ(count, spheres.size());
    EXPECT_EQ(std::memcmp(found.data(), spheres.data(), count * sizeof(Sphere)), 0) << body;
  }
}

TEST(CApiBodies, AreBakedOfModelsOfTheLibrary) {
  const Models models;
  EXPECT_EQ(sphere_count(models.man.get()), default_body(default_male(), 64).sphere_count());
  expect_baked(models.all);
}

TEST(CApiBodies, ComeFromFilesAsTheyWere) {
  const TemporaryFolder folder;
  const std::string file = folder.file("people.bch");
  {
    const Models models;
    expect_ok(bch_body_models_save(models.all.data(), models.all.size(), file.c_str()));
  }
  std::vector<OwnedModel> models;
  std::vector<const bch_body_model*> all;
  std::size_t count = 0;
  for (const std::size_t i : {0u, 1u}) {
    models.push_back(made<bch_body_model_free>(bch_body_model_load, file.c_str(), i, &count));
    all.push_back(models.back().get());
    EXPECT_EQ(count, 2u);
  }
  expect_baked(all);
  bch_body_model* none = models[0].get();
  expect_ok(bch_body_model_load(file.c_str(), 2, &count, &none));
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(count, 2u);
}

TEST(CApiBodies, OfCapsulesAndPolygonsAreThoseOfTheLibrary) {
  const bch_space_capsule capsule{{0, 0, 0.1f}, {0, 0.3f, 1}, 0.1f};
  const BodySet::Capsule same{{0, 0, 0.1f}, {0, 0.3f, 1}, 0.1f};
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {0, 1}};
  const std::vector<Vec2> triangle = {{0, 0}, {1, 0}, {0, 1}};
  const std::uint64_t offsets[] = {0, 3};
  const bch_heights heights{0, 0.5f};
  std::vector<bch_sphere> found(4096);
  std::size_t count = 0;
  const auto expect = [&](const std::vector<Sphere>& expected) {
    ASSERT_EQ(count, expected.size());
    EXPECT_EQ(std::memcmp(found.data(), expected.data(), count * sizeof(Sphere)), 0);
  };
  expect_ok(bch_spheres_from_capsules(&capsule, 1, 0.01f, found.data(), found.size(), &count));
  expect(spheres_from_capsules({&same, 1}, 0.01f));
  expect_ok(
      bch_spheres_from_polygons(corners, offsets, 1, &heights, 0.1f, found.data(), found.size(), &count));
  expect(spheres_from_polygons({&triangle, 1}, {0, 0.5f}, 0.1f));
  const auto model = made<bch_body_model_free>(bch_body_model_from_spheres, found.data(), count);
  EXPECT_EQ(sphere_count(model.get()), count);

  std::size_t untouched = 7;
  EXPECT_EQ(
      bch_spheres_from_polygons(corners, offsets, 1, nullptr, 0.1f, found.data(), found.size(), &untouched),
      BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_spheres_from_capsules(&capsule, 1, -1, found.data(), found.size(), &untouched),
            BCH_INVALID_ARGUMENT);
  EXPECT_EQ(untouched, 7u);
}

TEST(CApiBodies, AreRefusedWithAReason) {
  bch_body_model* model = nullptr;
  const auto man = made<bch_character_free>(bch_character_default, BCH_MALE);
  EXPECT_EQ(bch_body_model_default(man.get(), 65, &model), BCH_INVALID_ARGUMENT);
  EXPECT_TRUE(test::has(bch_last_error(), "expected 64, 128, 256 or 512 spheres, found 65"));
  std::size_t count = 0;
  EXPECT_EQ(bch_body_model_load("/nowhere.bch", 0, &count, &model), BCH_FILE_NOT_FOUND);
  EXPECT_EQ(model, nullptr);
  const Models models;
  bch_body_set* bodies = nullptr;
  bch_work work = BCH_WORK_INIT;
  work.progress = [](void*, std::size_t, std::size_t) { return 1; };
  EXPECT_EQ(bch_bake_bodies(models.all.data(), 2, 3, &work, &bodies), BCH_CANCELLED);
  const bch_body_model* const missing = nullptr;
  EXPECT_EQ(bch_bake_bodies(&missing, 1, 3, nullptr, &bodies), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bodies, nullptr);
}

}  // namespace
}  // namespace bch
