// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bch_run.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/test.hpp"

// Outputs never destroy inputs or each other, whatever their names are; and what is said of an input.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

class CliFiles : public testing::Test {
 protected:
  CliFiles() {
    fs::create_hard_link(model, folder.file("hard.json"));
    fs::create_symlink("model.obj", folder.file("soft.json"));
    fs::create_symlink(folder.path(), folder.file("here"));
  }

  std::string file(const std::string& name) const { return folder.file(name); }

  /// Refuses `output` because it is `input`, and leaves the input as it was.
  void expect_refused(const Arguments& arguments, const std::string& option, const std::string& output,
                      const std::string& input) {
    const std::string before = read_text(input);
    expect_failure(bch(arguments, {option, output}), 2, {option + ": " + output, input + ", an input"});
    EXPECT_EQ(read_text(input), before) << output;
  }

  const TemporaryFolder folder;
  const std::string model = folder.write("model.obj", box);
  const std::string agents = folder.write("agents.csv", four_agents);
};

TEST_F(CliFiles, OutputsAreNoInputs) {
  const std::string clips = folder.write("walk.bvh", "none");
  for (const std::string& same :
       {model, file("hard.json"), file("soft.json"), file("here/model.obj"), file("./here/soft.json")}) {
    expect_refused({"inspect", model}, "--json", same, model);
    expect_refused({"inspect", model, "--shape", "0"}, "--svg", same, model);
    for (const char* option : {"--json", "--csv", "--svg"})
      expect_refused({"crowd", "--character", "default:male", "--character", model}, option, same, model);
  }
  expect_refused({"inspect", model, "--clips", clips}, "--json", clips, clips);
  expect_refused({"crowd", "--character", model, "--clips", clips}, "--csv", clips, clips);
}

TEST_F(CliFiles, BakedFilesAreInputsToo) {
  const std::string baked = file("p.bch");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", baked}).code, 0);
  fs::create_hard_link(baked, file("q.bch"));
  expect_refused({"inspect", baked}, "--json", baked, baked);
  for (const char* option : {"--json", "--csv"})
    expect_refused({"crowd", "--character", baked}, option, file("q.bch"), baked);
  fs::create_symlink(model, file("model.bch"));
  expect_refused({"bake", model}, "--output", file("model.bch"), model);
}

/// The buffer of a glTF file: which ones it names is not known before it is read.
TEST_F(CliFiles, BuffersBesideAModelAreInputs) {
  const std::string buffer = folder.write("model.bin", "vertices");
  const TemporaryFolder elsewhere;
  fs::create_symlink(buffer, elsewhere.file("a.json"));
  for (const std::string& same : {buffer, file("here/model.bin"), std::string(elsewhere.file("a.json"))})
    expect_failure(bch({"inspect", model, "--json", same}), 2, {"--json: " + same, "beside " + model});
  EXPECT_EQ(read_text(buffer), "vertices");
  elsewhere.write("b.bin", "old");
  for (const std::string& other : {file("new.bin"), std::string(elsewhere.file("b.bin"))}) {
    EXPECT_EQ(bch({"inspect", model, "--json", other}, as_metres).code, 0);
    EXPECT_TRUE(read_text(other).starts_with("{"));
  }
}

TEST_F(CliFiles, NoTwoOutputsAreOneFile) {
  folder.write("a.json", "old");
  fs::create_symlink("a.json", file("link.csv"));
  const std::pair<const char*, const char*> same[] = {
      {"a.json", "link.csv"}, {"a.json", "here/a.json"}, {"new.json", "here/new.json"}};
  for (const auto& [json, csv] : same) {
    const Arguments outputs{"--json", file(json), "--csv", file(csv)};
    expect_failure(bch({"crowd", "--poses", "1"}, outputs), 2, {"--json and --csv: " + file(csv)});
    EXPECT_EQ(read_text(file("a.json")), "old");
    EXPECT_FALSE(fs::exists(file("new.json")));
  }
  const Ending different =
      bch({"crowd", "--poses", "1", "--agents", "9", "--json", file("b"), "--csv", file("here/c")});
  EXPECT_EQ(different.code, 0) << different.err;
}

/// Whatever a command makes of a character, it says once what it took for granted of the file.
TEST(Cli, EveryCommandPrintsTheNotesOfAnImport) {
  const TemporaryFolder folder;
  SkinnedStrip walker;  // whose lower end swings under the upper one, as a leg does
  walker.joints = {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  walker.turns = {0, 0, -0.25f, 0.97f, 0, 0, 0, 1, 0, 0, 0.25f, 0.97f};
  const std::string strip = folder.write("strip.gltf", walker.text()), note = strip + ": y up -> z up\n";
  const std::string agents = folder.write("agents.csv", "id,shape,x,y,heading\na,0,0,0,0\nb,0,9,9,0\n");
  const std::string pairs = folder.write("pairs.csv", "first,second\na,b\n");
  const std::string walk = folder.write("walk.csv", "id,time,x,y\n1,0,0,0\n1,0.5,0.6,0\n1,1,1.2,0\n");
  const Ending query = bch({"query", strip, agents, pairs, "--poses", "1"});
  EXPECT_EQ(query.out, "first,second,hit\na,b,0\n");
  EXPECT_NE(query.err.find(note), std::string::npos) << query.err;
  for (const Arguments& arguments :
       {Arguments{"bake", strip, strip, "--poses", "1", "-o", folder.file("strips.bch")},
        Arguments{"crowd", "--character", strip, "--character", strip, "--poses", "1", "--agents", "50"},
        Arguments{"check", walk, "--unit", "m", "--character", strip, "--character", strip},
        Arguments{"place", "--character", strip, "--seconds", "1", "--tries", "2"}}) {
    const Ending run = bch(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    const std::size_t first = run.out.find(note);
    EXPECT_NE(first, std::string::npos) << run.out;
    EXPECT_EQ(run.out.find(note, first + 1), std::string::npos) << run.out;
  }
}

}  // namespace
}  // namespace bch::test
