// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <bch/baked.hpp>
#include <bch/query.hpp>
#include <bch/shape_set.hpp>

#include "tests/support/program_run.hpp"
#include "tests/support/query_what.hpp"

// bch query --what: each question from the command line.

namespace bch::test {
namespace {

TEST_F(QueryWhat, CollideIsTheDefault) {
  const Rows hits = rows("collide", "first,second,hit", {pairs});
  EXPECT_EQ(hits, (Rows{{"b", "a", "1"}, {"a", "c", "0"}, {"a", "d", "0"}}));
  const Ending plain =
      run_program(BCH_PROGRAM, {"query", shapes, agents, pairs, "--up", "y", "--scale", "1"});
  EXPECT_EQ(plain.out, run("collide", {pairs}).out);
}

TEST_F(QueryWhat, PenetrationSaysHowFarAndWhereTo) {
  const std::string header = "first,second,depth,x,y";
  const Rows best = rows("penetration", header, {pairs});
  ASSERT_EQ(best.size(), 3u);
  EXPECT_EQ(best[0][0], "b");
  EXPECT_NEAR(number(best[0][2]), 0.1, 0.025);  // and the discs' sizes
  EXPECT_GT(number(best[0][2]), 0.1);
  EXPECT_EQ(best[0][3], "1");
  EXPECT_EQ(best[0][4], "0");  // and not what rounding leaves of it
  EXPECT_EQ(best[1][2], "0");
  EXPECT_EQ(best[2][2], "0");
  const Rows up = rows("penetration", header, {pairs, "--direction", "0,2"});
  EXPECT_NEAR(number(up[0][2]), 0.3, 0.025);
  EXPECT_EQ(up[0][4], "1");
  const Rows left = rows("penetration", header, {pairs, "--direction", "-1,-0"});
  EXPECT_EQ(left[0][3], "-1");
  EXPECT_EQ(left[0][4], "0");
  const Rows along_x = rows("penetration", header, {pairs, "--directions", "2"});
  EXPECT_EQ(along_x[0][2], best[0][2]);
  EXPECT_GT(number(along_x[1][2]), 0.5);
}

TEST_F(QueryWhat, ContactsAreALineEach) {
  const std::string header = "first,second,first_disc,second_disc";
  const Rows all = rows("contacts", header, {pairs});
  EXPECT_GT(all.size(), 2u);
  EXPECT_EQ(std::set<std::vector<std::string>>(all.begin(), all.end()).size(), all.size());
  for (const auto& row : all) EXPECT_EQ(row[0] + row[1], "ba");
  // At the coarsest level there is one disc each.
  EXPECT_EQ(rows("contacts", header, {pairs, "--depths", "0"}),
            (Rows{{"b", "a", "0", "0"}, {"a", "c", "0", "0"}}));
}

TEST_F(QueryWhat, ClearanceSaysHowFarAndWhichWay) {
  const std::string header = "first,second,distance,x,y";
  const Rows all = rows("clearance", header, {pairs});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0][0], "b");
  EXPECT_EQ(all[0], (std::vector<std::string>{"b", "a", "0", "0", "0"}));
  const Rows deepest = rows("clearance", header, {pairs, "--overlap", "deepest"});
  EXPECT_LT(number(deepest[0][2]), 0);
  EXPECT_NEAR(std::hypot(number(deepest[0][3]), number(deepest[0][4])), 1, 1e-6);
  EXPECT_EQ((Rows{deepest[1], deepest[2]}), (Rows{all[1], all[2]}));
  EXPECT_LE(number(all[1][2]), 0.05);
  EXPECT_NEAR(number(all[1][2]), 0.05, 0.025);  // the discs' sizes
  EXPECT_NEAR(number(all[1][3]), 0, 0.4);
  EXPECT_NEAR(number(all[1][4]), 1, 0.1);
  EXPECT_NEAR(number(all[2][2]), 12.2, 0.1);
  EXPECT_NEAR(number(all[2][3]), 0.7, 0.03);
  const Rows near = rows("clearance", header, {pairs, "--max-distance", "0.5"});
  EXPECT_EQ(near, (Rows{all[0], all[1], {"a", "d", "inf", "0", "0"}}));
  const Rows touching = rows("clearance", header, {pairs, "--max-distance", "0"});
  EXPECT_EQ(touching, (Rows{all[0], {"a", "c", "inf", "0", "0"}, {"a", "d", "inf", "0", "0"}}));
  EXPECT_EQ(rows("clearance", header, {"--all-pairs"}).size(), 1u);
  const Rows within = rows("clearance", header, {"--all-pairs", "--max-distance", "0.5"});
  ASSERT_EQ(within.size(), 3u);  // d stands far off
  EXPECT_EQ(within[0][0] + within[0][1] + within[0][2], "ab" + all[0][2]);
  EXPECT_EQ(within[1], all[1]);
  EXPECT_EQ(within[2][0] + within[2][1], "bc");
  EXPECT_LE(number(within[2][2]), 0.5);
}

TEST_F(QueryWhat, ClearanceOfSegmentsIsThatOfOutlines) {
  const std::string header = "first,second,distance,x,y", more = ",first_x,first_y,second_x,second_y";
  const Rows discs = rows("clearance", header, {pairs}),
             exact = rows("clearance", header, {pairs, "--leaves", "segments"});
  EXPECT_EQ(exact[0], discs[0]);
  for (const std::size_t i : {1, 2}) {
    EXPECT_GT(number(exact[i][2]), number(discs[i][2]));
    EXPECT_LT(number(exact[i][2]), number(discs[i][2]) + 0.03);
  }
  EXPECT_NEAR(number(exact[1][2]), 0.05, 1e-5);
  EXPECT_EQ(
      rows("clearance", header, {"--all-pairs", "--max-distance", "0.05", "--leaves", "segments"}).size(),
      3u);
  const Rows with_points = rows("clearance", header + more, {pairs, "--leaves", "segments", "--points"});
  ASSERT_EQ(with_points.size(), 3u);
  const std::vector<std::string>& of_c = with_points[1];
  EXPECT_EQ((std::vector<std::string>(of_c.begin(), of_c.begin() + 5)), exact[1]);
  EXPECT_NEAR(number(of_c[6]) + number(of_c[2]), number(of_c[8]) + 0.35, 1e-4);
  EXPECT_EQ((std::vector<std::string>(with_points[0].begin() + 5, with_points[0].end())),
            (std::vector<std::string>{"0", "0", "0", "0"}));
}

TEST_F(QueryWhat, TimeOfImpactSaysWhenTheyTouch) {
  const Rows all = rows("time-of-impact", "first,second,time", {pairs});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0], (std::vector<std::string>{"b", "a", "0"}));
  EXPECT_LE(number(all[1][2]), 0.25);
  EXPECT_NEAR(number(all[1][2]), 0.25, 0.125);  // the discs' sizes
  EXPECT_EQ(all[2], (std::vector<std::string>{"a", "d", "inf"}));
}

TEST_F(QueryWhat, WaysAreCheckedLikeTheRest) {
  const std::string header = "id,shape,x,y,heading,dx,dy\n";
  const std::pair<std::string, std::string> cases[] = {
      {"id,shape,x,y,heading\na,0,0,0,0\n", "ways.csv:1: has no column 'dx'"},
      {"id,shape,x,y,heading,dx\na,0,0,0,0,1\n", "ways.csv:1: has no column 'dy'"},
      {header + "a,0,0,0,0,1\n", "ways.csv:2: has fewer values"},
      {header + "a,0,0,0,0,1,\n", "ways.csv:2: dy ''"},
      {header + "a,0,0,0,0,nan,0\n", "ways.csv:2: dx 'nan'"},
      {header + "a,0,0,0,0,1,1\nb,0,0,0,0,0,-6e8\n", "ways.csv:3: dy '-6e8'"},
  };
  for (const auto& [text, words] : cases) {
    const std::string file = folder.write("ways.csv", text);
    const Ending ending =
        run_program(BCH_PROGRAM, {"query", shapes, file, pairs, "--what", "time-of-impact"});
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_EQ(ending.out, "");
    EXPECT_NE(ending.err.find(words), std::string::npos) << ending.err;
  }
  const std::string half = folder.write("ways.csv", cases[1].first);
  EXPECT_EQ(run_program(BCH_PROGRAM, {"query", shapes, half, pairs}).code, 3);
}

TEST_F(QueryWhat, AllPairsAreThoseThatCollide) {
  EXPECT_EQ(rows("collide", "first,second,hit", {"--all-pairs"}), (Rows{{"a", "b", "1"}}));
  const Rows ways = rows("penetration", "first,second,depth,x,y", {"--all-pairs"});
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0][1], "b");
  EXPECT_EQ(ways[0][3], "-1");
  EXPECT_FALSE(rows("contacts", "first,second,first_disc,second_disc", {"--all-pairs"}).empty());
}

TEST_F(QueryWhat, WithinSaysWhoIsAsNear) {
  const std::string header = "first,second,hit";
  EXPECT_EQ(rows("within", header, {pairs, "--max-distance", "0.1"}),
            (Rows{{"b", "a", "1"}, {"a", "c", "1"}, {"a", "d", "0"}}));
  EXPECT_EQ(rows("within", header, {pairs, "--max-distance", "0"}), rows("collide", header, {pairs}));
  EXPECT_EQ(rows("within", header, {"--all-pairs", "--max-distance", "0.5", "--semantics", "solid"}).size(),
            3u);
}

TEST_F(QueryWhat, AllPairsWithinADistanceHoldThoseThatNest) {
  const auto square = [](float half) {
    const std::vector<std::vector<Vec2>> rings = {
        {{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
    return shape_from_polygons(rings);
  };
  const std::string nest = (folder.path() / "nest.bch").string();
  save_baked(nest, ShapeSet(std::vector<Shape>{square(1), square(0.1f)}));
  const std::string inside = folder.write("inside.csv", "id,shape,x,y,heading\na,0,0,0,0\nb,1,0.1,0,0\n");
  const std::string one = folder.write("one.csv", "first,second\na,b\n");
  for (const char* semantics : {"solid", "boundary"}) {
    const auto ask = [&](const std::string& pairs_of) {
      const Ending ending = run_program(BCH_PROGRAM, {"query", nest, inside, pairs_of, "--what", "within",
                                                      "--max-distance", "0.3", "--semantics", semantics});
      EXPECT_EQ(ending.code, 0) << ending.err;
      return ending.out;
    };
    const std::string header = "first,second,hit\n";
    const bool nested = std::string(semantics) == "solid";
    EXPECT_EQ(ask(one), header + (nested ? "a,b,1\n" : "a,b,0\n"));
    EXPECT_EQ(ask("--all-pairs"), header + (nested ? "a,b,1\n" : ""));
  }
}

TEST_F(QueryWhat, EveryKernelWritesTheSame) {
  for (const char* what : {"collide", "clearance", "time-of-impact", "contacts", "penetration"})
    for (const Implementation& row : implementations())
      if (row.supported()) {
        EXPECT_EQ(run(what, {pairs, "--isa", row.name}).out, run(what, {pairs}).out) << what;
      }
}

TEST_F(QueryWhat, WrongWordsGiveTwo) {
  const std::pair<Arguments, const char*> cases[] = {
      {{"--what", "depth"}, "depth"},
      {{"--what", "separation"}, "penetration"},
      {{"--what", "contact-time"}, "time-of-impact"},
      {{"--what", "clearance", "--leaves", "discs", "--overlap", "deepest"}, "--leaves"},
      {{"--what", "penetration", "--leaves", "discs"}, "--leaves"},
      {{"--what", "within", "--max-distance", "1", "--points"}, "--points"},
      {{"--what", "contacts", "--directions", "4"}, "--directions"},
      {{"--direction", "1,0"}, "--direction"},
      {{"--what", "clearance", "--semantics", "solid"}, "--semantics"},
      {{"--what", "contacts", "--semantics", "boundary"}, "--semantics"},
      {{"--max-distance", "1"}, "--max-distance"},
      {{"--what", "within"}, "--max-distance"},
      {{"--what", "within", "--max-distance", "1", "--leaves", "discs"}, "--leaves"},
      {{"--what", "clearance", "--max-distance", "-1"}, "--max-distance"},
      {{"--what", "collide", "--overlap", "zero"}, "--overlap"},
      {{"--what", "clearance", "--overlap", "least"}, "--overlap"},
      {{"--what", "clearance", "--max-distance", "nan"}, "--max-distance"},
      {{"--what", "penetration", "--directions", "0"}, "--directions"},
      {{"--what", "penetration", "--directions", "5"}, "5"},
      {{"--what", "penetration", "--directions", "300"}, "300"},
      {{"--what", "penetration", "--directions", "4", "--direction", "1,0"}, "--directions"},
      {{"--what", "penetration", "--direction", "0,0"}, "0,0"},
      {{"--what", "penetration", "--direction", "1"}, "--direction"},
      {{"--what", "penetration", "--direction", "1,nan"}, "nan"},
      {{"--what", "penetration", "--direction", "1,2,3"}, "1,2,3"},
  };
  for (const auto& [more, word] : cases) expect_usage_error(more, word);
  const Ending all = run("time-of-impact", {"--all-pairs"});
  EXPECT_EQ(all.code, 2);
  EXPECT_NE(all.err.find("--all-pairs"), std::string::npos) << all.err;
  const Ending within = run("clearance", {"--all-pairs", "--max-distance", "1", "--semantics", "solid"});
  EXPECT_EQ(within.code, 2);
  EXPECT_NE(within.err.find("--semantics: --max-distance"), std::string::npos) << within.err;
}

TEST_F(QueryWhat, HelpNamesEveryColumn) {
  const Ending help = run_program(BCH_PROGRAM, {"query", "--help"});
  for (const char* columns : {"first,second,hit", "first,second,distance,x,y", "first,second,time",
                              "first,second,first_disc,second_disc", "first,second,depth,x,y", "[,dx,dy]",
                              "first_x,first_y,second_x,second_y", "[segments; clearance, within: discs]",
                              "contacts cannot be asked", "MULTILINESTRING"})
    EXPECT_NE(help.out.find(columns), std::string::npos) << columns;
  std::istringstream lines(help.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

}  // namespace
}  // namespace bch::test
