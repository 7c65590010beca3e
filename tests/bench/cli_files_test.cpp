// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "bench/base/csv_input.hpp"
#include "bench/base/text.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// Outputs never destroy inputs or each other, whatever their names are; and what is said of an input.

namespace bch::test {
namespace {

using namespace std::string_literals;
using cli::printable;
using cli::printable_line;

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

// ---- Text that comes from elsewhere: what a terminal gets to see of it, and values that are not what they look like.

/// A name that clears a screen, returns to the beginning of a line, and turns the direction of writing.
const std::string hostile =
    "a\x1b[2J\r\x7f\xc2\x9b"
    "5m\xe2\x80\xae\xe2\x81\xa6z";
const std::string shown = "a\\x1b[2J\\x0d\\x7f\\u009b5m\\u202e\\u2066z";

void expect_harmless(const std::string& text) {
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= ' ') << text;
  for (const std::string& part : {"\x7f"s, "\xc2\x9b"s, "\xe2\x80\xae"s, "\xe2\x81\xa6"s, "\xff"s})
    EXPECT_FALSE(has(text, part)) << text;
}

/// Text as a terminal may see it, and a line of it.
TEST(Printable, ShowsWhatDoesNoHarm) {
  expect_table(__FILE__, "printable.txt",
               [](const auto& fields) { return printable(fields[0]) + " / " + printable_line(fields[0]); });
  EXPECT_EQ(printable_line(hostile), shown);
  EXPECT_EQ(printable("a\0d"s), "a\\x00d");
}

/// The strip with a clip whose name is hostile.
std::string strip_with_hostile_clip() {
  const std::string name = R"(a\u001b[2J\r\u007f\u009b5m\u202e\u2066z)";
  return std::regex_replace(SkinnedStrip().text(), std::regex("\"walk\""), "\"" + name + "\"");
}

TEST(CliText, NamesOfClipsAreHarmless) {
  const TemporaryFolder folder;
  const std::string file = folder.write("strip.gltf", strip_with_hostile_clip());
  const std::string baked = folder.file("strip.bch");
  ASSERT_EQ(bch({"bake", file, "-o", baked, "--poses", "2"}).code, 0);
  for (const Ending& run : {bch({"inspect", file, "--poses", "2"}), bch({"inspect", file, "--shape", "0"}),
                            bch({"inspect", baked})}) {
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(has(run.out, "5m\\u202e")) << run.out;
    expect_harmless(run.out);
  }
}

/// A terminal that a program can write to.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no terminal");
    name_ = ptsname(master_);
    slave_ = open(name_.c_str(), O_RDWR | O_NOCTTY);  // else what was written is lost with the program
  }
  ~Terminal() {
    close(slave_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  const std::string& name() const { return name_; }
  std::string text() const {
    char bytes[4096];
    const ssize_t got = read(master_, bytes, sizeof bytes);
    return {bytes, static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
  }

 private:
  int master_, slave_;
  std::string name_;
};

/// Answers are data: programs get the ids as they are. A terminal gets text.
TEST(CliText, AnswersAreDataExceptOnATerminal) {
  const TemporaryFolder folder;
  const std::string id = "a\x1b[2J\xe2\x80\xae";
  const std::string shapes = folder.write("box.obj", box),
                    agents = folder.write("agents.csv", "id,shape,x,y,heading\n" + id + ",0,0,0,0\n"),
                    pairs = folder.write("pairs.csv", "first,second\n" + id + "," + id + "\n");
  const Arguments query{"query", shapes, agents, pairs};
  EXPECT_EQ(bch(query, as_metres).out, "first,second,hit\n" + id + "," + id + ",1\n");
  const Terminal terminal;
  EXPECT_EQ(bch(query, as_metres, {terminal.name(), {}}).code, 0);
  EXPECT_EQ(terminal.text(), "first,second,hit\r\na\\x1b[2J\\u202e,a\\x1b[2J\\u202e,1\r\n");
}

TEST(CliText, APictureOfANameThatIsNotUtf8IsWellFormed) {
  const TemporaryFolder folder;
  const std::string svg = folder.file("a.svg");
  const Ending run = bch({"inspect",
                          folder.write("m\xff\x1b"
                                       "an.obj",
                                       box),
                          "--shape", "0", "--svg", svg},
                         as_metres);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(has(read_text(svg), "m\\xff")) << read_text(svg).substr(0, 500);
  EXPECT_EQ(printable(read_text(svg)), read_text(svg));
}

TEST(CliText, TablesComeThroughPipes) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", four_agents);
  // In parts, each of them less than a line.
  const std::string script =
      "(printf 'first,se'; sleep 0.2; printf 'cond\\na,'; sleep 0.2; printf 'b\\n') | " +
      ("'" BCH_PROGRAM "' query '"s) + shapes + "' '" + agents + "' /dev/stdin --up y --scale 1";
  EXPECT_EQ(run_program("/bin/sh", {"-c", script}).out, "first,second,hit\na,b,1\n");
}

TEST(CliText, ValuesBeyondTheRangeOfADoubleAreNumbers) {
  EXPECT_EQ(cli::parse_number("1e-400"), 0.0);
  EXPECT_EQ(cli::parse_number("1e400x"), std::nullopt);
  EXPECT_GT(cli::parse_number("1e400"), 1e300);
  EXPECT_LT(cli::parse_number("-1e99999"), -1e300);
}

TEST(CliText, IdsKeepTheQuotesThatTheyNeed) {
  EXPECT_EQ(cli::csv_field("a b"), "a b");
  EXPECT_EQ(cli::csv_field(" a"), "\" a\"");
  EXPECT_EQ(cli::csv_field("a\t"), "\"a\t\"");
  EXPECT_EQ(cli::csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(cli::csv_field(""), "");
}

TEST(CliText, AFolderThatIsGoneIsNoFaultOfTheProgram) {
  const TemporaryFolder folder;
  for (const std::string command :
       {"crowd --json x.json --agents 5 --poses 1", "inspect default:male --json x",
        "bake default:male -o x.bch --poses 1", "inspect a.obj"}) {
    const std::string place = folder.file("gone");
    const std::string script = "mkdir '" + place + "' && cd '" + place + "' && rmdir '" + place +
                               "' && exec '" + BCH_PROGRAM + "' " + command;
    expect_failure(run_program("/bin/sh", {"-c", script}), 3, {});
  }
}

}  // namespace
}  // namespace bch::test
