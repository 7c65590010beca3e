// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/baking.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "bench/base/exit_codes.hpp"
#include "layout/baked/file_bytes.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/test.hpp"

// Batches of poses: their files, tasks that throw in the midst.

namespace bch::cli {
namespace {

/// A man whose clip "vanish" ends in a point, which has no outline.
LoadedCharacter vanishing_man() {
  LoadedCharacter man{"man.glb", default_male(), {}};
  Clip clip{"vanish", 1, {{}}};
  clip.channels[0].scales = {{0, {1, 1, 1}}, {1, {0, 0, 0}}};
  man.character.clips = {clip};
  validate(man.character);
  return man;
}

std::vector<ShapeSource> sources(std::size_t count, std::size_t bad) {
  std::vector<ShapeSource> list(count, ShapeSource{0, {0, 0.25f}});
  if (bad < count) list[bad].at.seconds = 1;
  return list;
}

class Baking : public testing::TestWithParam<int> {
 protected:
  const tbb::global_control allow{tbb::global_control::max_allowed_parallelism, 4};
  tbb::task_arena arena{GetParam()};
  const std::vector<LoadedCharacter> characters{vanishing_man()};

  template <class Call>
  void expect_vanished(Call call) {
    try {
      arena.execute(call);
      ADD_FAILURE() << "baked a point";
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("man.glb: vanish at 1 s: ")) << error.what();
    }
  }
};

TEST_P(Baking, ATaskThatThrowsEndsTheBatchAndNothingElse) {
  for (const std::size_t bad : {0u, 1u, 150u, 299u}) {
    expect_vanished([&] { bake_shapes(characters, sources(300, bad), 0.01, {}); });
    expect_vanished([&] { build_shapes(characters, sources(300, bad), 0.01); });
  }
  const ShapeSet set = arena.execute([&] { return bake_shapes(characters, sources(300, 300), 0.01, {}); });
  EXPECT_EQ(set.shape_count(), 300u);
}

TEST(BakingOfRoots, AreThoseOfTheOutlines) {
  const std::vector<LoadedCharacter> characters{{"default:female", default_female(), {}}};
  const auto poses = list_shapes(characters, 20);
  const ShapeSet roots = bake_shapes(characters, poses, 0.01, {.depths = {0}});
  const ShapeSet all = bake_shapes(characters, poses, 0.01, {.depths = {0, all_depths}});
  ASSERT_EQ(roots.shape_count(), all.shape_count());
  for (std::uint32_t shape = 0; shape < roots.shape_count(); ++shape) {
    const detail::Root &one = roots.view().roots[shape], &other = all.view().roots[2 * shape];
    EXPECT_TRUE(one.x == other.x && one.y == other.y && one.radius == other.radius) << shape;
  }
}

std::string content(const std::string& file) {
  const detail::FileBytes read = detail::read_file(file);
  return {reinterpret_cast<const char*>(read.bytes.data()), read.bytes.size()};
}

std::string image(const BakedShapes& baked) {
  return test::BakedBytes(baked.set, baked.origins).text();
}

TEST_P(Baking, FilesHoldTheirImages) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  const auto poses = sources(600, 600);
  for (const ShapeSetPlan& plan :
       {ShapeSetPlan{}, ShapeSetPlan{.depths = {0, 3, all_depths}, .outlines = true},
        ShapeSetPlan{.depths = {0}}}) {
    const BakedShapes baked = arena.execute([&] { return bake_file(file, characters, poses, 0.01, plan); });
    EXPECT_EQ(content(file), image(baked));
    EXPECT_EQ(image(baked),
              image({bake_shapes(characters, poses, 0.01, plan), origins_of(characters, poses, 0.01)}));
  }
}

TEST_P(Baking, FilesOfATaskThatThrowsAreAsTheyWere) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.bch", "old");
  expect_vanished([&] { bake_file(file, characters, sources(600, 599), 0.01, {}); });
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, Baking, testing::Values(1, 2, 4), testing::PrintToStringParamName());

}  // namespace
}  // namespace bch::cli
