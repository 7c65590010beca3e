// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_scenes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/test.hpp"

// Models and bodies of spheres of the C interface are those of C++.

namespace bch {
namespace {

using test::bytes;
using test::expect_ok;
using test::made;

using OwnedModel = test::Owned<bch_body_model, bch_body_model_free>;
using OwnedBodies = test::Owned<bch_body_set, bch_body_set_free>;

/// Models of the man and the woman.
struct Models {
  OwnedModel man = model(BCH_MALE, 64), woman = model(BCH_FEMALE, 128);
  std::vector<const bch_body_model*> all{man.get(), woman.get()};

  static OwnedModel model(std::int32_t which, std::uint32_t spheres) {
    return made<bch_body_model_free>(bch_body_model_default, test::c_person(which).get(), spheres);
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
    const auto found = test::all_of<bch_sphere>(
        [&](auto... to) { return bch_body_set_get_spheres(bodies.get(), body, to...); });
    EXPECT_TRUE(bytes(found) == bytes(expected.spheres(body))) << body;
  }
}

TEST(CApiBodies, AreBakedOfModelsOfTheLibraryAndComeFromFilesAsTheyWere) {
  const TemporaryFolder folder;
  const std::string file = folder.file("people.bch").string();
  {
    const Models own;
    EXPECT_EQ(sphere_count(own.man.get()), 64u);
    expect_baked(own.all);
    expect_ok(bch_body_models_save(own.all.data(), own.all.size(), file.c_str()));
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
  auto found = test::all_of<bch_sphere>(
      [&](auto... to) { return bch_spheres_from_capsules(&capsule, 1, 0.01f, to...); });
  EXPECT_EQ(bytes(found), bytes(spheres_from_capsules({&same, 1}, 0.01f)));
  found = test::all_of<bch_sphere>(
      [&](auto... to) { return bch_spheres_from_polygons(corners, offsets, 1, &heights, 0.1f, to...); });
  EXPECT_EQ(bytes(found), bytes(spheres_from_polygons({&triangle, 1}, {0, 0.5f}, 0.1f)));
  const auto model = made<bch_body_model_free>(bch_body_model_from_spheres, found.data(), found.size());
  EXPECT_EQ(sphere_count(model.get()), found.size());

  std::size_t untouched = 7;
  EXPECT_EQ(
      bch_spheres_from_polygons(corners, offsets, 1, nullptr, 0.1f, found.data(), found.size(), &untouched),
      BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_spheres_from_capsules(&capsule, 1, -1, found.data(), found.size(), &untouched),
            BCH_INVALID_ARGUMENT);
  EXPECT_EQ(untouched, 7u);
}

constexpr const char* walls_text = "LINESTRING (0 1, 3 1) POLYGON ((2 0, 3 0, 3 1, 2 0))";

/// A crowd of bodies, in C and in C++.
struct CrowdOfBodies {
  test::Random random{5601};
  std::vector<std::vector<Sphere>> spheres{test::random_body(random, 40), test::random_body(random, 9)};
  BodySet set{spheres};
  test::BodyCrowd crowd = test::random_body_crowd(random, 30, 2, 3, 0.5);
  ObstacleSet walls = obstacles_from_wkt(walls_text, Polygons::solid, 0, 0.4);

  OwnedBodies c_set;
  const test::OwnedObstacles of_walls =
      made<bch_obstacles_free>(bch_obstacles_from_wkt, walls_text, 0, 0, 0.4);
  const test::OwnedCrowd of_crowd = made<bch_crowd_free>(bch_crowd_create, nullptr);
  bch_obstacles* const c_walls = of_walls.get();
  bch_crowd* const c_crowd = of_crowd.get();
  bch_agents agents = BCH_AGENTS_INIT;

  CrowdOfBodies() {
    std::vector<bch_sphere> all;
    std::vector<std::uint64_t> offsets{0};
    for (const auto& body : spheres) {
      for (const Sphere& s : body) all.push_back({s.x, s.y, s.z, s.radius});
      offsets.push_back(all.size());
    }
    c_set = made<bch_body_set_free>(bch_body_set_create, all.data(), offsets.data(), spheres.size());
    agents.shape = crowd.body.data(), agents.x = crowd.x.data(), agents.y = crowd.y.data();
    agents.heading = crowd.heading.data(), agents.z = crowd.z.data(), agents.count = crowd.body.size();
  }

  const bch_pair* pairs() const { return test::c_pairs(crowd.pairs); }
  std::size_t pair_count() const { return crowd.pairs.size(); }
};

/// Expects the bytes of C's values to be those of C++'s.
template <class C, class Cpp>
void expect_bytes(const C* found, std::size_t count, std::span<const Cpp> expected) {
  static_assert(sizeof(C) == sizeof(Cpp));
  ASSERT_GT(count, 0u);
  EXPECT_TRUE(bytes(std::span(found, count)) == bytes(expected));
}

TEST(CApiBodies, AnswerAboutPairsAsInCpp) {
  const CrowdOfBodies of;
  const Agents agents = of.crowd.agents();
  const std::size_t n = of.pair_count();
  std::vector<std::uint8_t> hits(n), expected_hits(n);
  expect_ok(bch_collide_bodies(of.c_set.get(), &of.agents, of.pairs(), n, nullptr, hits.data()));
  collide(of.set, agents, of.crowd.pairs, expected_hits);
  EXPECT_EQ(hits, expected_hits);
  const double near = 0.3;
  expect_ok(bch_within_bodies(of.c_set.get(), &of.agents, of.pairs(), n, &near, 1, nullptr, hits.data()));
  within(of.set, agents, of.crowd.pairs, {&near, 1}, expected_hits);
  EXPECT_EQ(hits, expected_hits);

  const std::vector<double> x(n, 0.3), y(n, -0.2), z(n, 0.1);
  std::vector<float> times(n), expected_times(n);
  expect_ok(bch_time_of_impact_bodies(of.c_set.get(), &of.agents, of.pairs(), n, x.data(), y.data(), z.data(),
                                      nullptr, times.data()));
  time_of_impact(of.set, agents, of.crowd.pairs, {x, y, z}, expected_times);
  EXPECT_EQ(times, expected_times);

  std::vector<bch_penetration_depth> depths(n);
  std::vector<Penetration> expected(n);
  expect_ok(bch_penetration_bodies(of.c_set.get(), &of.agents, of.pairs(), n, 16, nullptr, depths.data()));
  penetration(of.set, agents, of.crowd.pairs, 16, expected);
  const auto expect_depths = [&] {
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_EQ((Penetration{depths[i].depth, depths[i].x, depths[i].y}), expected[i]);
  };
  expect_depths();
  expect_ok(bch_nearest_free_bodies(of.c_set.get(), &of.agents, of.pairs(), n, 16, nullptr, depths.data()));
  std::vector<Penetration::Touch> expected_touches(n);
  nearest_free(of.set, agents, of.crowd.pairs, 16, expected, nullptr, expected_touches);
  expect_depths();
  std::vector<bch_touch> touches(n);
  expect_ok(bch_nearest_free_bodies_touches(of.c_set.get(), &of.agents, of.pairs(), n, 16, nullptr,
                                            depths.data(), touches.data()));
  expect_depths();
  expect_bytes(touches.data(), n, std::span<const Penetration::Touch>(expected_touches));
  const std::size_t people = agents.size();
  expected.resize(people), expected_touches.resize(people), depths.resize(people), touches.resize(people);
  nearest_free(of.set, agents, of.crowd.pairs, nullptr, 16, expected, nullptr, expected_touches);
  expect_ok(bch_nearest_free_of_all_bodies(of.c_set.get(), &of.agents, of.pairs(), n, nullptr, 16, nullptr,
                                           depths.data(), touches.data()));
  for (std::size_t i = 0; i < people; ++i)
    ASSERT_EQ((Penetration{depths[i].depth, depths[i].x, depths[i].y}), expected[i]);
  expect_bytes(touches.data(), people, std::span<const Penetration::Touch>(expected_touches));
  expected.resize(n), depths.resize(n);
  const std::vector<bch_vec2> along(n, {1, 2});
  expect_ok(bch_penetration_along_bodies(of.c_set.get(), &of.agents, of.pairs(), n, along.data(), nullptr,
                                         depths.data()));
  penetration_along(of.set, agents, of.crowd.pairs, std::vector<Vec2>(n, {1, 2}), expected);
  expect_depths();
}

TEST(CApiBodies, AnswerAboutCrowdsAsInCpp) {
  const CrowdOfBodies of;
  const Agents agents = of.crowd.agents();
  Crowd crowd;
  const Crowd::BodyContacts contacts = crowd.contacts(of.set, agents);
  bch_sphere_contact_rows rows;
  expect_ok(bch_crowd_body_contacts(of.c_crowd, of.c_set.get(), &of.agents, nullptr, nullptr, &rows));
  expect_bytes(rows.pairs, rows.rows, contacts.pairs.span());
  expect_bytes(rows.values, rows.offsets[rows.rows], contacts.contacts.values);
  const Rows<Crowd::SphereContact> of_pairs = crowd.contacts(of.set, agents, of.crowd.pairs);
  expect_ok(bch_crowd_body_contacts_of(of.c_crowd, of.c_set.get(), &of.agents, of.pairs(), of.pair_count(),
                                       nullptr, &rows));
  ASSERT_EQ(rows.rows, of.pair_count());
  expect_bytes(rows.offsets, rows.rows + 1, of_pairs.offsets);
  expect_bytes(rows.values, rows.offsets[rows.rows], of_pairs.values);

  const Crowd::Penetrations parted = crowd.penetrations(of.set, agents, 32);
  bch_crowd_penetration_view view;
  expect_ok(bch_crowd_body_penetrations(of.c_crowd, of.c_set.get(), &of.agents, 32, nullptr, nullptr, &view));
  expect_bytes(view.pairs, view.count, parted.pairs.span());
  for (std::size_t i = 0; i < view.count; ++i)
    EXPECT_EQ((Penetration{view.depths[i].depth, view.depths[i].x, view.depths[i].y}),
              parted.penetrations[i]);

  std::vector<double> mobility(of.agents.count, 1);
  mobility[0] = 0;
  bch_resolve_options options = BCH_RESOLVE_OPTIONS_INIT;
  options.directions = 8, options.gap = 0.01, options.mobility = mobility.data(),
  options.obstacles = of.c_walls;
  bch_resolved_view resolved;
  for (const std::uint32_t sweeps : {0u, 1u}) {
    options.sweeps = sweeps, options.largest_turn = 0.5 * sweeps;
    const Crowd::Resolved expected = crowd.resolve(of.set, agents,
                                                   {.directions = 8,
                                                    .sweeps = sweeps,
                                                    .gap = 0.01,
                                                    .largest_turn = options.largest_turn,
                                                    .mobility = mobility,
                                                    .obstacles = &of.walls});
    expect_ok(bch_crowd_body_resolve(of.c_crowd, of.c_set.get(), &of.agents, &options, nullptr, nullptr,
                                     &resolved));
    expect_bytes(resolved.x, resolved.count, expected.x);
    expect_bytes(resolved.y, resolved.count, expected.y);
    expect_bytes(resolved.left, resolved.left_count, expected.left.span());
    expect_bytes(resolved.agents_at_walls, resolved.agents_at_walls_count, expected.agents_at_walls);
    EXPECT_EQ(resolved.sweeps, expected.sweeps);
    EXPECT_EQ(resolved.turn == nullptr, sweeps == 0);
    if (resolved.turn != nullptr) expect_bytes(resolved.turn, resolved.count, expected.turn);
  }
}

TEST(CApiBodies, AnswerAboutObstaclesAsInCpp) {
  const CrowdOfBodies of;
  const Agents agents = of.crowd.agents();
  const std::size_t n = agents.size();
  std::vector<std::uint8_t> hits(n), expected_hits(n);
  expect_ok(bch_obstacles_collide_bodies(of.c_set.get(), &of.agents, of.c_walls, nullptr, hits.data()));
  collide(of.set, agents, of.walls, expected_hits);
  EXPECT_EQ(hits, expected_hits);
  EXPECT_EQ(std::set<std::uint8_t>(hits.begin(), hits.end()), (std::set<std::uint8_t>{0, 1}));
  const double near = 0.3;
  expect_ok(
      bch_obstacles_within_bodies(of.c_set.get(), &of.agents, of.c_walls, &near, 1, nullptr, hits.data()));
  within(of.set, agents, of.walls, {&near, 1}, expected_hits);
  EXPECT_EQ(hits, expected_hits);

  std::vector<float> distance(n), expected(n);
  std::vector<bch_nearest_space_points> points(n);
  std::vector<BodyClearanceAnswers::Points> expected_points(n);
  bch_body_clearance_out out = BCH_BODY_CLEARANCE_OUT_INIT;
  out.distance = distance.data(), out.points = points.data();
  expect_ok(bch_obstacles_clearance_bodies(of.c_set.get(), &of.agents, of.c_walls, nullptr, &out));
  clearance(of.set, agents, of.walls, BodyClearanceAnswers{.distance = expected, .points = expected_points});
  EXPECT_EQ(distance, expected);
  expect_bytes(points.data(), n, std::span<const BodyClearanceAnswers::Points>(expected_points));

  Crowd crowd;
  const Rows<std::uint32_t> touched = crowd.obstacles(of.set, agents, of.walls);
  bch_index_rows rows;
  expect_ok(bch_crowd_body_obstacles(of.c_crowd, of.c_set.get(), &of.agents, of.c_walls, nullptr, &rows));
  expect_bytes(rows.offsets, rows.rows + 1, touched.offsets);
  expect_bytes(rows.values, rows.offsets[rows.rows], touched.values);
}

TEST(CApiBodies, AreRefusedWithAReason) {
  bch_body_model* model = nullptr;
  const auto man = test::c_person(BCH_MALE);
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
