// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/stat.h>
#include <unistd.h>

#include <climits>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"
#include "bench/base/output_file.hpp"
#include "bench/characters/baking.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/test.hpp"

// What is written is whole or not there, whoever else writes into the same folder.

namespace bch::cli {
namespace {

namespace fs = std::filesystem;
using test::complaint;
using test::read_text;

unsigned permissions(const fs::path& file) {
  return static_cast<unsigned>(fs::status(file).permissions());
}

std::string error_of_writing(const fs::path& file) {
  return complaint<InputError>([&] { write_file(file, "new"); });
}

/// Acts as a user who is not root, to whom permissions apply, while this lives.
class OrdinaryUser {
 public:
  explicit OrdinaryUser(const TemporaryFolder& folder) {
    constexpr uid_t nobody = 65534;
    if (!was_root_) return;
    fs::permissions(folder.path(), fs::perms(0777));
    if (seteuid(nobody) != 0) throw std::runtime_error("cannot become another user");
  }
  ~OrdinaryUser() {
    if (was_root_ && seteuid(0) != 0) std::abort();
  }

 private:
  const bool was_root_ = geteuid() == 0;
};

/// As two processes of one number do, from two containers: here they are one process.
TEST(OutputFile, TwoWritersOfOneFileDoNotMeet) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  OutputFile first(file), second(file);
  first.write("first, long");
  second.write("second");
  second.commit();
  EXPECT_EQ(read_text(file), "second");
  first.write("er");
  first.commit();
  EXPECT_EQ(read_text(file), "first, longer");
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, WithoutCommitNothingChanges) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.json", "old");
  { OutputFile(file).write("new"); }
  EXPECT_EQ(read_text(file), "old");
  EXPECT_EQ(folder.files(), 1);
}

/// Whoever knows the process number cannot prepare the way: a link, a file, a folder.
TEST(OutputFile, WhatWasPlantedStaysAsItIs) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.csv"), planted = file + ".bch-" + std::to_string(getpid());
  const std::string victim = folder.write("victim", "precious");
  fs::create_symlink(victim, planted);
  write_file(file, "one");
  EXPECT_EQ(read_text(victim), "precious");
  EXPECT_TRUE(fs::is_symlink(planted));
  EXPECT_FALSE(fs::is_symlink(file));
  fs::remove(planted);
  folder.write(fs::path(planted).filename(), "somebody's");
  write_file(file, "two");
  EXPECT_EQ(read_text(planted), "somebody's");
  EXPECT_EQ(read_text(file), "two");
}

TEST(OutputFile, TemporaryNamesDoNotRepeat) {
  const TemporaryFolder folder;
  std::string before;
  for (int i = 0; i < 3; ++i) {
    const OutputFile output(folder.file("a.csv"));
    const std::string name = fs::directory_iterator(folder.path())->path();
    EXPECT_NE(name, before);
    before = name;
  }
}

TEST(OutputFile, PermissionsAreThoseOfTheReplacedFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.csv", "old");
  for (const unsigned mode : {0600u, 0640u, 0664u, 0755u}) {
    fs::permissions(file, fs::perms(mode));
    OutputFile output(file);
    for (const auto& entry : fs::directory_iterator(folder.path()))
      EXPECT_EQ(permissions(entry.path()) & ~mode, 0u) << entry.path();  // at no time more than in the end
    output.write("new");
    output.commit();
    EXPECT_EQ(permissions(file), mode);
    EXPECT_EQ(read_text(file), "new");
  }
}

TEST(OutputFile, PermissionsOfANewFileFollowTheMask) {
  const TemporaryFolder folder;
  for (const mode_t mask : {mode_t{022}, mode_t{027}, mode_t{077}}) {
    const mode_t before = umask(mask);
    const std::string file = folder.file(std::to_string(mask));
    write_file(file, "new");
    umask(before);
    EXPECT_EQ(permissions(file), 0666u & ~mask);
  }
}

TEST(OutputFile, LinksStayAndTheirTargetsAreReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("below"));
  const std::string target = folder.write("below/target.csv", "old"), link = folder.file("link.csv");
  fs::create_symlink("below/target.csv", link);
  fs::create_symlink("link.csv", folder.file("second.csv"));
  fs::permissions(target, fs::perms(0600));
  write_file(folder.file("second.csv"), "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_FALSE(fs::is_symlink(target));
  EXPECT_EQ(read_text(target), "new");
  EXPECT_EQ(permissions(target), 0600u);
  EXPECT_EQ(folder.files(), 3);
  fs::create_symlink("circle", folder.file("circle"));
  EXPECT_NE(error_of_writing(folder.file("circle")).find("Too many levels"), std::string::npos);
}

TEST(OutputFile, TheLongestNames) {
  const TemporaryFolder folder;
  std::string longest(NAME_MAX - 4, 'a');
  longest += ".csv";
  const std::string file = folder.file(longest);
  write_file(file, "new");
  EXPECT_EQ(read_text(file), "new");
  const std::string longer = folder.file(std::string(NAME_MAX + 1, 'a'));
  EXPECT_EQ(error_of_writing(longer), longer + ": cannot be written: File name too long");
  EXPECT_EQ(folder.files(), 1);
  // A path of PATH_MAX - 1 bytes, which leaves no room for a longer name beside it.
  fs::path deep = folder.path();
  while (deep.native().size() + 202 < PATH_MAX - 2) deep /= std::string(200, 'd');
  fs::create_directories(deep);
  deep /= std::string(PATH_MAX - 2 - deep.native().size(), 'f');
  ASSERT_EQ(deep.native().size(), std::size_t{PATH_MAX - 1});
  write_file(deep, "deep");
  EXPECT_EQ(read_text(deep), "deep");
}

TEST(OutputFile, MissingPermissionsAreNamed) {
  const TemporaryFolder folder;
  const OrdinaryUser user(folder);
  const std::string closed = folder.file("closed"), file = folder.write("a.csv", "old");
  fs::create_directory(closed);
  fs::permissions(closed, fs::perms(0555));
  EXPECT_EQ(error_of_writing(closed + "/a.csv"),
            closed + "/a.csv: cannot be written: folder " + closed + ": Permission denied");
  fs::permissions(closed, fs::perms(0));
  EXPECT_EQ(error_of_writing(closed + "/a.csv"), closed + "/a.csv: cannot be written: Permission denied");
  fs::permissions(closed, fs::perms(0755));
  fs::permissions(file, fs::perms(0444));  // nobody is to change it, by another way neither
  EXPECT_EQ(error_of_writing(file), file + ": cannot be written: Permission denied");
  EXPECT_EQ(read_text(file), "old");
  EXPECT_EQ(error_of_writing(closed), closed + ": cannot be written: Is a directory");
}

TEST(OutputFile, AFolderThatIsGoneIsNamed) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::create_directory(folder.file("gone"));
  fs::current_path(folder.file("gone"));
  fs::remove(folder.file("gone"));
  const std::string error = error_of_writing("a.csv");
  const std::string early = complaint<InputError>([&] { require_outputs({{"--csv", "a.csv"}}, {}); });
  fs::current_path(before);
  EXPECT_EQ(error, "a.csv: cannot be written: folder .: No such file or directory");
  EXPECT_EQ(early, error);
}

// ---- Batches of poses: their files, tasks that throw in the midst.

/// A man whose clip "vanish" ends in a point, which has no outline.
LoadedCharacter vanishing_man() {
  LoadedCharacter man{"man.glb", default_male(), {}};
  Clip clip{"vanish", 1, {{}}};
  clip.channels[0].scales = {{0, {1, 1, 1}}, {1, {0, 0, 0}}};
  man.character.clips = {clip};
  validate(man.character);
  return man;
}

std::vector<PoseId> sources(std::size_t count, std::size_t bad) {
  std::vector<PoseId> list(count, PoseId{0, {0, 0.25f}});
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
    EXPECT_EQ(read_text(file), image(baked));
    EXPECT_EQ(image(baked),
              image({bake_shapes(characters, poses, 0.01, plan), origins_of(characters, poses, 0.01)}));
  }
}

TEST_P(Baking, FilesOfATaskThatThrowsAreAsTheyWere) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.bch", "old");
  expect_vanished([&] { bake_file(file, characters, sources(600, 599), 0.01, {}); });
  EXPECT_EQ(read_text(file), "old");
  EXPECT_EQ(folder.files(), 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, Baking, testing::Values(1, 2, 4), testing::PrintToStringParamName());

}  // namespace
}  // namespace bch::cli
