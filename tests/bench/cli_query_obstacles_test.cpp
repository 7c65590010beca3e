// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/program_run.hpp"
#include "tests/support/query_what.hpp"

// bch query --obstacles: the questions about walls in place of pairs.

namespace bch::test {
namespace {

TEST_F(QueryWhat, ObstaclesInPlaceOfPairs) {
  // b stands in a pillar, c on the wall that a walks to, 0.05 m before it; d is alone.
  const std::string walls = folder.write(
      "walls.wkt", "POLYGON((0.6 -0.1, 0.8 -0.1, 0.8 0.1, 0.6 0.1, 0.6 -0.1))\nLINESTRING(-1 0.2, 0 0.2)\n");
  const Arguments against{"--obstacles", walls};
  EXPECT_EQ(rows("collide", "id,hit", against), (Rows{{"a", "0"}, {"b", "1"}, {"c", "1"}, {"d", "0"}}));
  const Rows apart = rows("clearance", "id,distance,x,y", against);
  ASSERT_EQ(apart.size(), 4u);
  EXPECT_NEAR(number(apart[0][1]), 0.05, 0.02);
  EXPECT_NEAR(number(apart[0][3]), 1, 1e-6);
  EXPECT_EQ(apart[1], (std::vector<std::string>{"b", "0", "0", "0"}));
  EXPECT_EQ(rows("within", "id,hit", {"--obstacles", walls, "--max-distance", "0.06"}),
            (Rows{{"a", "1"}, {"b", "1"}, {"c", "1"}, {"d", "0"}}));
  // From outlines, a's distance is the one that the scene gives; from discs it is less.
  const Rows outlines = rows("clearance", "id,distance,x,y", {"--obstacles", walls, "--leaves", "segments"});
  EXPECT_NEAR(number(outlines[0][1]), 0.05, 1e-5);
  EXPECT_GT(number(outlines[0][1]), number(apart[0][1]));
  EXPECT_EQ(outlines[1], apart[1]);
  const double between = 0.5 * (number(outlines[0][1]) + number(apart[0][1]));
  for (const char* leaves : {"discs", "segments"})
    EXPECT_EQ(
        rows("within", "id,hit",
             {"--obstacles", walls, "--max-distance", std::to_string(between), "--leaves", leaves})[0][1],
        std::string(leaves) == "discs" ? "1" : "0");
  const Rows times = rows("time-of-impact", "id,time", against);
  EXPECT_NEAR(number(times[0][1]), 0.05 / 0.15, 0.15);
  EXPECT_EQ(times[1][1], "0");
  EXPECT_EQ(times[3][1], "inf");
  const Rows ways = rows("penetration", "id,depth,x,y", against);
  EXPECT_EQ(ways[0], (std::vector<std::string>{"a", "0", "0", "0"}));
  EXPECT_NEAR(number(ways[1][1]), 0.05, 0.02);
  EXPECT_EQ(ways[1][2], "-1");
  EXPECT_EQ(ways[1][3], "0");
  // On a floor the pillar's border is a wall.
  EXPECT_EQ(rows("collide", "id,hit", {"--obstacles", walls, "--walkable"}),
            (Rows{{"a", "0"}, {"b", "1"}, {"c", "1"}, {"d", "0"}}));
}

TEST_F(QueryWhat, ObstaclesWithHeights) {
  const std::string walls = folder.write("walls.wkt", "LINESTRING(-1 0, 1 0)");
  const auto hits = [&](const std::string& heights) {
    const Rows all = rows("collide", "id,hit", {"--obstacles", walls, "--obstacle-heights=" + heights});
    return all.empty() ? "" : all.front()[1];
  };
  EXPECT_EQ(hits("0,2"), "1");
  EXPECT_EQ(hits("1.7,9"), "1");
  EXPECT_EQ(hits("1.9,9"), "0");
  EXPECT_EQ(hits("-inf,-1"), "0");
  EXPECT_EQ(hits("-inf,inf"), "1");
  // In slabs, too, and where agents stand somewhere else.
  EXPECT_EQ(rows("clearance", "id,distance,x,y",
                 {"--obstacles", walls, "--obstacle-heights", "1.9,3", "--slices", "1"})
                .front()[1],
            "inf");
  const std::string high = folder.write("high.csv", "id,shape,x,y,heading,z\na,0,0,0,0,1\nb,0,0,0,0,4\n");
  const Ending ending = run_program(BCH_PROGRAM, {"query", shapes, high, "--up", "y", "--scale", "1",
                                                  "--obstacles", walls, "--obstacle-heights", "2,3"});
  EXPECT_EQ(ending.out, "id,hit\na,1\nb,0\n") << ending.err;
}

TEST_F(QueryWhat, ObstaclesThatAreNone) {
  const std::string bad = folder.write("bad.wkt", "LINESTRING(0 0,\n 1)");
  const Ending ending = run("collide", {"--obstacles", bad});
  EXPECT_EQ(ending.code, 3);
  EXPECT_EQ(ending.err, "bch: " + bad + ": WKT: line 2, column 3: expected a number, found ')'\n");
  EXPECT_EQ(run("collide", {"--obstacles", (folder.path() / "absent.wkt").string()}).code, 3);
  expect_usage_error({"--obstacles", bad}, "name one of them");
  expect_usage_error({"--walkable"}, "belongs to --obstacles");
  expect_usage_error({"--obstacle-heights", "0,1"}, "belongs to --obstacles");
  for (const char* heights : {"2", "2,1", "0,nan", ",", "low,high"}) {
    const Ending wrong = run("collide", {"--obstacles", bad, "--obstacle-heights", heights});
    EXPECT_EQ(wrong.code, 2) << heights;
    EXPECT_NE(wrong.err.find("--obstacle-heights"), std::string::npos) << wrong.err;
  }
  EXPECT_EQ(run("contacts", {"--obstacles", bad}).code, 2);
  EXPECT_EQ(run("penetration", {"--obstacles", bad, "--directions", "4"}).code, 2);
  EXPECT_EQ(run("collide", {}).code, 2);
}

}  // namespace
}  // namespace bch::test
