// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/bch_run.hpp"
#include "tests/support/temporary_folder.hpp"

// `bch query`.

namespace bch::test {
namespace {

TEST(Cli, QueryAnswersInTheOrderOfThePairs) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", four_agents);
  const std::string pairs =
      folder.write("pairs.csv", "second,first\r\na,b\r\n\r\nc,a\r\n \"d,e\" ,a\r\na,a\r\n");
  const Ending run = bch({"query", shapes, agents, pairs}, as_metres);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "first,second,hit\nb,a,1\na,c,0\na,\"d,e\",0\na,a,1\n");
  EXPECT_EQ(run.err, "  note      " + shapes + ": y up -> z up, as the caller says\n" + "  note      " +
                         shapes + ": metres, as the caller says\n");
}

TEST(Cli, QueryGuardsIdsThatASpreadsheetWouldCompute) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  const std::string agents = folder.write("agents.csv",
                                          "id,shape,x,y,heading\n=1+1,0,0,0,0\n-5,0,0,0,0\n\"@a,b\",0,0,0,"
                                          "0\n-x,0,0,0,0\nb=,0,0,0,0\n-inf,0,9,9,0\n");
  const std::string pairs = folder.write("pairs.csv", "first,second\n=1+1,-5\n\"@a,b\",-x\nb=,-5\n-inf,-5\n");
  const Ending plain = bch({"query", shapes, agents, pairs}, as_metres);
  EXPECT_EQ(plain.out, "first,second,hit\n=1+1,-5,1\n\"@a,b\",-x,1\nb=,-5,1\n-inf,-5,0\n") << plain.err;
  const Ending guarded = bch({"query", shapes, agents, pairs, "--guard-ids"}, as_metres);
  EXPECT_EQ(guarded.out, "first,second,hit\n'=1+1,-5,1\n\"'@a,b\",'-x,1\nb=,-5,1\n'-inf,-5,0\n")
      << guarded.err;
}

TEST(Cli, QueryTakesALevelForEachAgent) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  const std::string pairs = folder.write("pairs.csv", "first,second\na,b\na,c\n");
  const std::string agents =
      folder.write("agents.csv", "id,shape,x,y,heading,level\na,0,0,0,0,0\nb,0,0,0.35,0,0\nc,0,0,0.35,0,1\n");
  const Ending run = bch({"query", shapes, agents, pairs, "--depths", "0,all"}, as_metres);
  EXPECT_EQ(run.out, "first,second,hit\na,b,1\na,c,1\n") << run.err;
  const std::string finest =
      folder.write("agents.csv", "id,shape,x,y,heading,level\na,0,0,0,0,1\nb,0,0,0.35,0,1\nc,0,0,0.35,0,1\n");
  EXPECT_EQ(bch({"query", shapes, finest, pairs, "--depths", "0,all"}, as_metres).out,
            "first,second,hit\na,b,0\na,c,0\n");
}

/// Agents on a crooked lattice, dense enough for many to collide.
std::string lattice(int side) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading\n";
  for (int i = 0; i < side * side; ++i)
    csv << "agent" << i << ",0," << 0.43 * (i % side) + 0.01 * (i % 7) << ',' << 0.41 * (i / side) << ','
        << 0.7 * i << '\n';
  return csv.str();
}

TEST(Cli, AllPairsEqualsExplicitPairs) {
  const TemporaryFolder folder;
  constexpr int side = 9;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", lattice(side));
  std::string every = "first,second\n";
  for (int a = 0; a < side * side; ++a)
    for (int b = a + 1; b < side * side; ++b)
      every += "agent" + std::to_string(a) + ",agent" + std::to_string(b) + "\n";
  const Ending each = bch({"query", shapes, agents, folder.write("pairs.csv", every)}, as_metres);
  const Ending all = bch({"query", shapes, agents, "--all-pairs"}, as_metres);
  ASSERT_EQ(each.code, 0) << each.err;
  ASSERT_EQ(all.code, 0) << all.err;
  std::string expected;
  std::istringstream rows(each.out);
  for (std::string row; std::getline(rows, row);)
    if (!row.ends_with(",0")) expected += row + "\n";
  EXPECT_EQ(all.out, expected);
  EXPECT_GT(lines(all.out), 20u);
}

/// So many agents at one place.
std::string spot(int count) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading\n";
  for (int i = 0; i < count; ++i) csv << i << ",0,1,1,0\n";
  return csv.str();
}

TEST(Cli, QueryLimitsAllPairs) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", spot(20'000));
  const Ending run = bch({"query", shapes, agents, "--all-pairs"}, as_metres);
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err,
            "bch: " + agents +
                ": more than 6000000 pairs of agents are near each other; --max-pairs raises the limit\n");
  const std::string few = folder.write("few.csv", spot(5));
  for (const Arguments& how : {Arguments{}, Arguments{"--what", "clearance", "--max-distance", "1"}}) {
    Arguments words{"query", shapes, few, "--all-pairs", "--max-pairs", "9"};
    words.insert(words.end(), how.begin(), how.end());
    EXPECT_EQ(bch(words, as_metres).code, 3);
    words[5] = "10";
    EXPECT_EQ(lines(bch(words, as_metres).out), 11u);
  }
  expect_failure(
      bch({"query", shapes, few, folder.write("pairs.csv", "first,second\n"), "--max-pairs", "9"}, as_metres),
      2, {"--max-pairs"});
}

/// Of so many pairs that they are answered and written piece by piece.
TEST(Cli, QueryAnswersMillionsOfPairs) {
  const TemporaryFolder folder;
  const Ending run =
      bch({"query", folder.write("box.obj", box), folder.write("agents.csv", spot(1500)), "--all-pairs"},
          as_metres);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(lines(run.out), 1u + 1500 * 1499 / 2);
  EXPECT_TRUE(run.out.starts_with("first,second,hit\n0,1,1\n0,2,1\n"));
  EXPECT_TRUE(run.out.ends_with("\n1497,1498,1\n1497,1499,1\n1498,1499,1\n"));
}

/// As spreadsheets write it, with the mark of its byte order.
std::string utf16(const std::string& ascii, bool big_endian) {
  std::string text = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) text += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return text;
}

TEST(Cli, BadAgentsNameFileLineAndValue) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  const std::string pairs = folder.write("pairs.csv", "first,second\n");
  const std::string header = "id,shape,x,y,heading\na,0,0,0,0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "agents.csv: is empty"},
      {"id,shape,x,y\na,0,0,0\n", "agents.csv:1: has no column 'heading'"},
      {"id,shape,x,y,heading,speed\n", "agents.csv:1: column 'speed'"},
      {"id,shape,x,x,y,heading\n", "agents.csv:1: column 'x' is there twice"},
      {"id,shape,x,y,heading\ra,0,0,0,0\r", "agents.csv:1: ends lines with CR alone"},
      {utf16(header, false), "agents.csv:1: is UTF-16, not UTF-8"},
      {utf16(header, true), "agents.csv:1: is UTF-16, not UTF-8"},
      {header + "b,0,1.0abc,0,0\n", "agents.csv:3: x '1.0abc'"},
      {header + "b,0,,0,0\n", "agents.csv:3: x ''"},
      {header + "b,0,nan,0,0\n", "agents.csv:3: x 'nan'"},
      {header + "b,0,0,-inf,0\n", "agents.csv:3: y '-inf'"},
      {header + "b,0,0,0,1e10\n", "agents.csv:3: heading '1e10'"},
      {header + "b,0,2e9,0,0\n", "agents.csv:3: x '2e9'"},
      {header + "b,0,1e999,0,0\n", "agents.csv:3: x '1e999'"},
      {header + "\nb,1,0,0,0\n", "agents.csv:4: shape '1'"},
      {header + "b,-1,0,0,0\n", "agents.csv:3: shape '-1'"},
      {header + "b,0.5,0,0,0\n", "agents.csv:3: shape '0.5'"},
      {header + "a,0,0,0,0\n", "agents.csv:3: id 'a' is there twice"},
      {header + ",0,0,0,0\n", "agents.csv:3: id ''"},
      {header + "b,0,0,0\n", "agents.csv:3: has fewer values"},
      {header + "b,0,0,0,0,0\n", "agents.csv:3: has more values"},
      {header + "\"b,0,0,0,0\n", "agents.csv:3: a quote is not closed"},
      {"id,shape,x,y,heading,level\na,0,0,0,0,4\n", "agents.csv:2: level '4'"},
      {"id,shape,x,y,heading,level\na,0,0,0,0,\n", "agents.csv:2: level ''"},
  };
  for (const auto& [text, words] : cases)
    expect_failure(bch({"query", shapes, folder.write("agents.csv", text), pairs}, as_metres), 3, {words});
  expect_failure(bch({"query", shapes, folder.file("none.csv"), pairs}, as_metres), 3, {"none.csv: "});
  expect_failure(bch({"query", shapes, folder.path().string(), pairs}, as_metres), 3,
                 {folder.path().string()});
}

TEST(Cli, BadPairsNameFileLineAndValue) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", four_agents);
  const std::pair<std::string, std::string> cases[] = {
      {"first\na\n", "pairs.csv:1: has no column 'second'"},
      {"first,second\na,nobody\n", "pairs.csv:2: second 'nobody'"},
      {"first,second\na,b\n,a\n", "pairs.csv:3: first ''"},
      {"first,second\na\n", "pairs.csv:2: has fewer"},
      {"a,b\na,b\n", "pairs.csv:1: "},
      {"first,second\ra,b\r", "pairs.csv:1: ends lines with CR alone"},
      {utf16("first,second\na,b\n", false), "pairs.csv:1: is UTF-16, not UTF-8"},
  };
  for (const auto& [text, words] : cases)
    expect_failure(bch({"query", shapes, agents, folder.write("pairs.csv", text)}, as_metres), 3, {words});
}

}  // namespace
}  // namespace bch::test
