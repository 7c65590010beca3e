// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/baked_bytes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test.hpp"

// Bodies that move by themselves, and poses of one's own, by the C interface: they and their answers are those of the C++ library.

namespace bch {
namespace {

using test::expect_ok;
using test::made;
using test::MotionCase;

using OwnedAnimated = test::Owned<bch_animated_shape, bch_animated_shape_free>;

/// Moving discs in arrays, as callers have them.
struct Arrays {
  std::vector<std::uint32_t> keys, discs;
  std::vector<double> times;
  std::vector<Disc> all;
  std::vector<float> z;
  bch_animated_arrays arrays = BCH_ANIMATED_ARRAYS_INIT;

  explicit Arrays(const AnimatedDiscs& of) {
    for (const AnimatedChunk& chunk : of.chunks) {
      keys.push_back(static_cast<std::uint32_t>(chunk.times.size()));
      discs.push_back(chunk.disc_count);
      times.insert(times.end(), chunk.times.begin(), chunk.times.end());
      all.insert(all.end(), chunk.keys.begin(), chunk.keys.end());
      z.insert(z.end(), chunk.z.begin(), chunk.z.end());
    }
    arrays.loops = of.loops;
    arrays.key_counts = keys.data(), arrays.disc_counts = discs.data();
    arrays.chunk_count = keys.size();
    arrays.times = times.data(), arrays.discs = reinterpret_cast<const bch_disc*>(all.data());
    arrays.z = z.empty() ? nullptr : z.data();
  }
  OwnedAnimated shape() const { return made<bch_animated_shape_free>(bch_animated_shape_create, &arrays); }
};

std::string discs_of(const bch_animated_shape* shape, double seconds) {
  return test::bytes(test::all_of<bch_disc>(
      [=](auto... to) { return bch_animated_shape_get_discs(shape, seconds, to...); }));
}
std::string spheres_of(const bch_animated_shape* shape, double seconds) {
  return test::bytes(test::all_of<bch_sphere>(
      [=](auto... to) { return bch_animated_shape_get_spheres(shape, seconds, to...); }));
}

void expect_body(const bch_animated_shape* shape, const AnimatedShape& expected) {
  bch_animated_shape_info info = BCH_ANIMATED_SHAPE_INFO_INIT;
  expect_ok(bch_animated_shape_get_info(shape, &info));
  EXPECT_EQ(info.loops != 0, expected.loops());
  EXPECT_EQ(info.begin, expected.begin());
  EXPECT_EQ(info.end, expected.end());
  EXPECT_EQ(info.bounding_radius, expected.bounding_radius());
  EXPECT_EQ(info.bytes, expected.bytes());
  EXPECT_GE(info.chunks, 1u);
  EXPECT_GE(info.keys, 2 * info.chunks);
  for (const double seconds : {-1.0, 0.2, expected.end(), 7.0}) {
    EXPECT_TRUE(discs_of(shape, seconds) == test::bytes(expected.discs(seconds))) << seconds;
    EXPECT_TRUE(spheres_of(shape, seconds) == test::bytes(expected.spheres(seconds))) << seconds;
  }
}

TEST(CApiMotions, BodiesAreTheirArrays) {
  test::Random random(3141);
  for (const AnimatedDiscs& discs :
       {test::loose_discs(random), test::swinging_body(random, 1), test::swinging_body(random, 2),
        test::in_space(random, test::swinging_body(random, 2), 1.5)})
    expect_body(Arrays(discs).shape().get(), AnimatedShape(discs));
}

TEST(CApiMotions, ClipsAreAnimated) {
  constexpr std::uint32_t clip = 40;
  const BodyModel model = default_body(default_pedestrian(Sex::female, 1.7), 64);
  const auto character = made<bch_character_free>(bch_character_pedestrian, BCH_PEDESTRIAN_FEMALE, 1.7, 0);
  const auto of = made<bch_body_model_free>(bch_body_model_default, character.get(), 64);
  bch_animate_options options = BCH_ANIMATE_OPTIONS_INIT;
  options.error = 0.01f;
  const auto animated = [&] {
    return made<bch_animated_shape_free>(bch_animated_shape_animate, of.get(), clip, &options);
  };
  AnimateOptions own{.error = 0.01f};
  expect_body(animated().get(), AnimatedShape(animate(model, clip, own)));
  for (const bool loops : {false, true}) {
    options.loops = loops, own.loops = loops;
    expect_body(animated().get(), AnimatedShape(animate(model, clip, own)));
  }
  bch_animated_shape* none = nullptr;
  EXPECT_EQ(bch_animated_shape_animate(of.get(), 9999, nullptr, &none), BCH_OUT_OF_RANGE);
  options.loops = 2;
  EXPECT_EQ(bch_animated_shape_animate(of.get(), clip, &options, &none), BCH_INVALID_ARGUMENT);
  options.loops = 1, options.error = 0;
  EXPECT_EQ(bch_animated_shape_animate(of.get(), clip, &options, &none), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(none, nullptr);
}

TEST(CApiMotions, SetsKeepThem) {
  const TemporaryFolder folder;
  const std::string file = folder.file("people.bch").string();
  const std::vector<BakedClip> clips = test::few_clips();
  const auto set = test::c_set(ShapeSet(test::few_shapes()));
  std::size_t count = 9;
  expect_ok(bch_shape_set_get_clip_count(set.get(), &count));
  EXPECT_EQ(count, 0u);
  expect_ok(bch_shape_set_add_clip(set.get(), Arrays(clips[0].discs).shape().get(), "man.glb", "walk"));
  expect_ok(bch_shape_set_add_clip(set.get(), Arrays(clips[1].discs).shape().get(), "own", nullptr));
  expect_ok(bch_shape_set_save(set.get(), file.c_str()));
  const BakedShapes baked = load_baked(file);
  ASSERT_EQ(baked.clips.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(baked.clips[i].discs, clips[i].discs);
  EXPECT_EQ(baked.clips[1].clip, ShapeOrigin::no_clip);
  const auto loaded = made<bch_shape_set_free>(bch_shape_set_load, file.c_str(), BCH_READ);
  expect_ok(bch_shape_set_get_clip_count(loaded.get(), &count));
  EXPECT_EQ(count, 2u);
  const std::string bytes = test::read_text(file);
  const auto of_bytes =
      made<bch_shape_set_free>(bch_shape_set_load_bytes, bytes.data(), bytes.size(), "people");
  expect_ok(bch_shape_set_get_clip_count(of_bytes.get(), &count));
  EXPECT_EQ(count, 2u);
  const char *character = nullptr, *clip = nullptr;
  const auto shape =
      made<bch_animated_shape_free>(bch_shape_set_get_clip, loaded.get(), 0, &character, &clip);
  EXPECT_STREQ(character, "man.glb");
  EXPECT_STREQ(clip, "walk");
  EXPECT_TRUE(discs_of(shape.get(), 2) == test::bytes(AnimatedShape(clips[0].discs).discs(2)));
  expect_ok(bch_shape_set_get_clip(loaded.get(), 1, &character, &clip, nullptr));
  EXPECT_STREQ(character, "own");
  EXPECT_EQ(clip, nullptr);
  EXPECT_EQ(bch_shape_set_get_clip(loaded.get(), 2, nullptr, nullptr, nullptr), BCH_OUT_OF_RANGE);
}

TEST(CApiMotions, ShapesAtATimeAreAdded) {
  test::Random random(3142);
  const AnimatedDiscs discs = test::swinging_body(random);
  const OwnedAnimated body = Arrays(discs).shape();
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_animated_shape(builder.get(), body.get(), 0.5));
  EXPECT_EQ(bch_shape_set_builder_add_animated_shape(builder.get(), body.get(), NAN), BCH_INVALID_ARGUMENT);
  const auto set = test::finished(builder);
  float radius = 0;
  expect_ok(bch_shape_set_get_radius(set.get(), 0, &radius));
  EXPECT_EQ(radius, ShapeSet({{AnimatedShape(discs).shape(0.5)}}).bounding_radius(0));
}

bch_motion c_motion(const MotionCase& of, const bch_animated_shape* shape) {
  static_assert(sizeof(bch_path_key) == sizeof(PathKey));
  return {shape, reinterpret_cast<const bch_path_key*>(of.path.data()), of.path.size(), of.clip_begin};
}

TEST(CApiMotions, TouchWhenTheyDo) {
  test::Random random(3143);
  std::vector<MotionCase> cases;
  std::vector<OwnedAnimated> shapes;
  for (int i = 0; i < 8; ++i) cases.push_back(test::random_motion(random));
  std::vector<bch_motion> motions;
  std::vector<Motion> own;
  for (const MotionCase& each : cases) {
    shapes.push_back(Arrays(each.discs).shape());
    motions.push_back(c_motion(each, shapes.back().get()));
    own.push_back(each.motion());
  }
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < cases.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j) pairs.push_back({i, j});
  std::vector<double> times(pairs.size()), expected(pairs.size());
  first_contact(own, pairs, {-1, 3}, expected, 0.01);
  expect_ok(bch_first_contact(motions.data(), motions.size(), test::c_pairs(pairs), pairs.size(), -1, 3, 0.01,
                              2, times.data()));
  EXPECT_EQ(times, expected);
  EXPECT_GT(std::count_if(times.begin(), times.end(), [](double t) { return t < 3; }), 2);
  double free = 0;
  expect_ok(bch_free_until(motions.data(), motions.data() + 1, motions.size() - 1, -1, 3, 0.01, &free));
  EXPECT_EQ(free, free_until(own[0], std::span(own).subspan(1), {-1, 3}, 0.01));
  constexpr const char* text = "POLYGON((0 0, 1 0, 1 1, 0 1))";
  const auto walls = made<bch_obstacles_free>(bch_obstacles_from_wkt, text, 0, -HUGE_VAL, HUGE_VAL);
  times.assign(own.size(), 0), expected.assign(own.size(), 0);
  first_contact(own, obstacles_from_wkt(text), {-1, 3}, expected, 0.01);
  expect_ok(
      bch_obstacles_first_contact(motions.data(), motions.size(), walls.get(), -1, 3, 0.01, 2, times.data()));
  EXPECT_EQ(times, expected);
  EXPECT_GT(std::count_if(times.begin(), times.end(), [](double t) { return t < 3; }), 0);
}

TEST(CApiMotions, NameWhatIsWrong) {
  const auto said = [](bch_status status) {
    EXPECT_EQ(status, BCH_INVALID_ARGUMENT);
    return std::string(bch_last_error());
  };
  const AnimatedDiscs disc = test::still_disc(0.2f);
  const OwnedAnimated shape = Arrays(disc).shape();
  bch_animated_shape* none = nullptr;
  Arrays bad(disc);
  bad.all[1].radius = -1;
  EXPECT_EQ(said(bch_animated_shape_create(&bad.arrays, &none)),
            "animated shape: chunk 0: disc 0 at key 1: expected a radius of at least 0 m about a finite "
            "centre, found -1 about (0, 0)");
  bad.arrays.times = nullptr;
  EXPECT_EQ(said(bch_animated_shape_create(&bad.arrays, &none)), "arrays->times is NULL");
  EXPECT_EQ(none, nullptr);
  const bch_path_key key = {0, 0, 0, 0, 0};
  bch_motion motions[] = {{shape.get(), &key, 1, 0}, {shape.get(), &key, 0, 0}};
  const bch_pair pair = {0, 1};
  double time = 77;
  EXPECT_EQ(said(bch_first_contact(motions, 2, &pair, 1, 0, 1, 0.005, 0, &time)),
            "first_contact: motion 1: expected a path of keys, found none");
  motions[1].shape = nullptr;
  EXPECT_EQ(said(bch_first_contact(motions, 2, &pair, 1, 0, 1, 0.005, 0, &time)), "motions[1].shape is NULL");
  EXPECT_EQ(said(bch_free_until(nullptr, motions, 1, 0, 1, 0.005, &time)), "motion is NULL");
  EXPECT_EQ(said(bch_free_until(motions, motions, 1, 1, 0, 0.005, &time)),
            "free_until: expected an interval within +-1e6 s, found 1 to 0");
  EXPECT_EQ(time, 77);
}

// ---- Poses of one's own: every way to give them has the bytes of the clip's.

constexpr std::uint32_t joints = 27;
constexpr std::size_t pose_count = 6;

class CApiPoses : public testing::Test {
 protected:
  const Character own = default_male();
  const test::OwnedCharacter man = test::c_person(BCH_MALE);
  std::vector<bch_pose> times = std::vector<bch_pose>(pose_count);

  void SetUp() override { expect_ok(bch_character_sample_poses(man.get(), pose_count, times.data())); }

  std::vector<double> rows(std::int32_t kind) const {
    std::vector<double> all(pose_count * joints * 12);
    for (std::size_t i = 0; i < pose_count; ++i)
      expect_ok(bch_character_get_transforms(man.get(), times[i], kind, &all[i * joints * 12]));
    return all;
  }
};

bch_pose_arrays arrays_of(std::int32_t kind, std::int32_t layout, const void* data, std::size_t of) {
  bch_pose_arrays arrays = BCH_POSE_ARRAYS_INIT;
  arrays.kind = kind, arrays.layout = layout, arrays.data = data, arrays.count = of;
  return arrays;
}

/// Maps of three rows as matrices, column by column.
template <class Number>
std::vector<Number> columns(const std::vector<double>& rows) {
  std::vector<Number> all;
  for (std::size_t map = 0; map < rows.size(); map += 12)
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = 0; row < 3; ++row)
        all.push_back(static_cast<Number>(rows[map + 4 * row + column]));
      all.push_back(column == 3);
    }
  return all;
}

/// Bytes of the discs of all shapes.
std::string discs_of(const bch_shape_set* set) {
  std::string all;
  for (std::uint32_t shape = 0; shape < pose_count; ++shape) all += test::bytes(test::discs_of(set, shape));
  return all;
}

TEST_F(CApiPoses, HaveTheBitsOfTheClipInEveryWay) {
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), man.get(), times.data(), pose_count, nullptr));
  const auto by_clip = test::finished(builder);
  const std::string expected = discs_of(by_clip.get());

  const std::vector<double> local = rows(BCH_JOINTS_IN_PARENTS), world = rows(BCH_JOINTS_IN_WORLD);
  const std::vector<double> local_columns = columns<double>(local);
  std::vector<double> padded;  // rows of 4x4 matrices
  for (std::size_t i = 0; i < world.size(); ++i) {
    padded.push_back(world[i]);
    if (i % 12 == 11) padded.insert(padded.end(), {0, 0, 0, 1});
  }
  std::vector<bch_vec3> vertices(pose_count * own.vertices.size());
  for (std::size_t i = 0; i < pose_count; ++i)
    expect_ok(bch_character_get_vertices(man.get(), times[i], &vertices[i * own.vertices.size()]));
  // A bone's matrix is its joint's transform moved by the joint's position at rest, which none turns.
  std::vector<double> bones = world, origins;
  for (std::size_t i = 0; i < pose_count; ++i) {
    double* const pose = &bones[i * joints * 12];
    const double x = pose[3], y = pose[7];
    for (std::size_t bone = 0; bone < joints; ++bone) {
      double* const map = pose + 12 * bone;
      map[3] -= x, map[7] -= y;
      const Affine3& bind = own.bones[bone].inverse_bind;
      for (std::size_t row = 0; row < 3; ++row) {
        const auto at = [&](int axis) { return static_cast<double>(bind.rows[axis][3]); };
        map[4 * row + 3] =
            map[4 * row] * at(0) + map[4 * row + 1] * at(1) + map[4 * row + 2] * at(2) + map[4 * row + 3];
      }
    }
    origins.insert(origins.end(), {0, 0});
  }
  const std::vector<float> matrices = columns<float>(bones);
  std::vector<bch_pose_arrays> ways = {
      arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_ROWS, local.data(), joints),
      arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_COLUMNS, local_columns.data(), joints),
      arrays_of(BCH_JOINTS_IN_WORLD, BCH_DOUBLE_ROWS, world.data(), joints),
      arrays_of(BCH_JOINTS_IN_WORLD, BCH_DOUBLE_ROWS, padded.data(), joints),
      arrays_of(BCH_BONE_MATRICES, BCH_FLOAT_COLUMNS, matrices.data(), joints),
      arrays_of(BCH_BONE_MATRICES, BCH_DOUBLE_ROWS, bones.data(), joints),
      arrays_of(BCH_POSED_VERTICES, BCH_FLOAT_ROWS, vertices.data(), own.vertices.size()),
  };
  ways[3].stride = 16;
  ways[5].origins = origins.data();
  for (const bch_pose_arrays& way : ways) {
    SCOPED_TRACE(&way - ways.data());
    expect_ok(bch_shape_set_builder_add_pose_arrays(builder.get(), man.get(), &way, pose_count, nullptr));
    const auto by_arrays = test::finished(builder);
    EXPECT_TRUE(discs_of(by_arrays.get()) == expected);
    bch_shape_origin origin;
    expect_ok(bch_shape_set_get_origin(by_arrays.get(), 2, &origin));
    EXPECT_STREQ(origin.character, "default:male");
    EXPECT_EQ(origin.clip, nullptr);

    const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, by_clip.get());
    const bch_shape_set* lent = nullptr;
    expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &lent));
    const std::uint32_t turned[] = {5, 4, 3, 2, 1, 0}, straight[] = {0, 1, 2, 3, 4, 5};
    expect_ok(bch_dynamic_shape_set_replace_pose_arrays(dynamic.get(), man.get(), turned, &way, pose_count,
                                                        0.01f, nullptr));
    EXPECT_FALSE(discs_of(lent) == expected);
    expect_ok(bch_dynamic_shape_set_replace_pose_arrays(dynamic.get(), man.get(), straight, &way, pose_count,
                                                        0.01f, nullptr));
    EXPECT_TRUE(discs_of(lent) == expected);

    const auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, man.get(), nullptr);
    for (std::size_t i = 0; i < pose_count; ++i) {
      expect_ok(bch_shape_builder_make_from_arrays(shape_builder.get(), &way, i));
      expect_ok(bch_shape_set_builder_add_shape(builder.get(), shape_builder.get()));
    }
    EXPECT_TRUE(discs_of(test::finished(builder).get()) == expected);
  }
}

TEST_F(CApiPoses, CanBeReadAndBlended) {
  std::uint32_t joint = 99;
  expect_ok(bch_character_find_joint(man.get(), "left ankle", &joint));
  const char* name = nullptr;
  std::int32_t parent = 0;
  expect_ok(bch_character_get_joint(man.get(), joint, &name, &parent));
  EXPECT_STREQ(name, "left ankle");
  EXPECT_EQ(parent, own.joints[joint].parent);
  EXPECT_EQ(bch_character_find_joint(man.get(), "tail", &joint), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_character_get_joint(man.get(), joints, &name, nullptr), BCH_OUT_OF_RANGE);

  const float weights[] = {1, 2};
  std::vector<double> mean(joints * 12);
  expect_ok(bch_character_blend(man.get(), times.data(), weights, 2, mean.data()));
  const WeightedPose poses[] = {{{times[0].clip, times[0].seconds}, 1},
                                {{times[1].clip, times[1].seconds}, 2}};
  const std::vector<Affine3d> expected = blend(own, poses);
  for (std::size_t i = 0; i < mean.size(); ++i) ASSERT_EQ(mean[i], expected[i / 12].rows[i % 12 / 4][i % 4]);
  EXPECT_EQ(bch_character_blend(man.get(), times.data(), weights, 0, mean.data()), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_character_get_transforms(man.get(), {99, 0}, BCH_JOINTS_IN_WORLD, mean.data()),
            BCH_OUT_OF_RANGE);
  EXPECT_EQ(bch_character_get_transforms(man.get(), times[0], BCH_BONE_MATRICES, mean.data()),
            BCH_INVALID_ARGUMENT);
}

TEST_F(CApiPoses, AreRejectedWhereTheyDoNotFit) {
  const auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, man.get(), nullptr);
  const std::vector<double> local = rows(BCH_JOINTS_IN_PARENTS);
  const auto expect_rejected = [&](auto change, const std::string& message) {
    bch_pose_arrays arrays = arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_ROWS, local.data(), joints);
    change(arrays);
    EXPECT_EQ(bch_shape_builder_make_from_arrays(shape_builder.get(), &arrays, 1), BCH_INVALID_ARGUMENT);
    EXPECT_EQ(bch_last_error(), message);
  };
  expect_rejected([](auto& a) { a.count = 26; }, "poses[1]: shape: expected 27 joint transforms, found 26");
  expect_rejected([](auto& a) { a.kind = 4; }, "poses->kind is 4; expected 0 to 3");
  expect_rejected([](auto& a) { a.layout = -1; }, "poses->layout is -1; expected 0 to 3");
  expect_rejected([](auto& a) { a.stride = 11; }, "poses->stride is 11");
  expect_rejected([](auto& a) { a.kind = BCH_POSED_VERTICES; }, "poses->layout is 2");
  expect_rejected([](auto& a) { a.data = nullptr; }, "poses->data is NULL");
  expect_rejected([](auto& a) { a.count = SIZE_MAX / 8; }, "poses->count is " + std::to_string(SIZE_MAX / 8));
  expect_rejected([](auto& a) { a.origins = static_cast<const double*>(a.data); },
                  "poses->origins is not NULL, and there are no bone matrices");
}

}  // namespace
}  // namespace bch
