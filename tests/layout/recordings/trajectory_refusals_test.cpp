// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/support/text_recordings.hpp"

// What a recording as text, CSV or ndjson must not say, and the line that names it.

namespace bch {
namespace {

using detail::TrajectoryOptions;
using test::Trajectories;

TEST_F(Trajectories, NameNoMoreThanCanBe) {
  const std::string header = "frame,id,x/m,y/m,clip,clip_time\n";
  const TrajectoryOptions at_ten{.fps = 10};
  EXPECT_EQ(complaint(header + "0,1,0,0,walk,soon\n", at_ten), "f:2: clip_time 'soon' is not a number");
  EXPECT_EQ(complaint(header + "0,1,0,0,walk,1e7\n", at_ten), "f:2: clip_time '1e7' is not within +-1e6 s");
  EXPECT_EQ(complaint(header + "0,1,0,0," + std::string(256, 'a') + ",1\n", at_ten),
            "f:2: the name '" + std::string(40, 'a') + "...' has more than 255 bytes");
  EXPECT_EQ(complaint("frame,id,x,y,clip_time\n0,1,0,0,1\n", at_ten),
            "f:1: has no column called 'clip', whose time 'clip_time' is, only 'frame, id, x, y, clip_time'");
  std::string many = header;
  for (int k = 0; k <= 4096; ++k) many += std::to_string(k) + ",1,0,0,clip" + std::to_string(k) + ",\n";
  EXPECT_EQ(
      complaint(many, at_ten),
      "f:4098: character '' and clip 'clip4096' are beyond the 4096 different pairs that a file may name");
}

TEST_F(Trajectories, NameTheRowThatIsWrong) {
  const std::string petrack = "# framerate: 25\n# id frame x/m y/m z/m\n1 0 1 2 1.7\n";
  const std::pair<const char*, const char*> cases[] = {
      {"1 1 nan 2 1.7\n", "f:4: x 'nan' is not finite"},
      {"1 1 1 -inf 1.7\n", "f:4: y '-inf' is not finite"},
      {"1 1 1 2e400 1.7\n", "f:4: y '2e400' is not finite"},
      {"1 1 1e8 -1.1e8 1.7\n", "f:4: y '-1.1e8' is not within +-1e8 m"},
      {"\n# a comment\n1 1 1 2 inf\n", "f:6: z 'inf' is not finite"},
      {"1 1 1\n", "f:4: has 3 values, not 5: '1 1 1'"},
      {"1 1 1 2 1.", "accepted"},
      {"1 1 1 2\n", "f:4: has 4 values, not 5: '1 1 1 2'"},
      {"1.5 1 1 2 1.7\n", "f:4: id '1.5' is not a whole number"},
      {"1 one 1 2 1.7\n", "f:4: frame 'one' is not a whole number"},
      {"1 1 1 2,5 1.7\n", "f:4: y '2,5' is not a number"},
      {"1 1 \x1b[2J 2 1.7\n", "f:4: x ' [2J' is not a number"},
      {"1 2000000000000000 1 2 1.7\n", "f:4: frame '2000000000000000' is not within +-1e15"},
      {"1 -9223372036854775808 1 2 1.7\n", "f:4: frame '-9223372036854775808' is not within +-1e15"},
      {"9223372036854775807 1 1 2 1.7\n", "accepted"},
      {"9223372036854775808 1 1 2 1.7\n", "f:4: id '9223372036854775808' is not a whole number"},
      {"1 0 1 2 1.7\n", "f:4: repeats line 3, person 1 in frame 0"},
      {"2 0 1 2 1.7\n1 0 1 2.5 1.7\n",
       "f:5: person 1 is at two places in frame 0, here at (1, 2.5), by line 3 at (1, 2)"},
  };
  for (const auto& [row, message] : cases) EXPECT_EQ(complaint(petrack + row), message) << row;
  EXPECT_EQ(complaint(petrack + std::string("1 1 1 2\0 1.7\n", 13)), "f:4: has a NUL byte: is not text");
  EXPECT_EQ(complaint(petrack + std::string(70'000, '1')), "f:4: is longer than 65536 bytes");
  EXPECT_EQ(complaint(petrack + "1 1 " + std::string(200, '7') + " 2 1\n"),
            "f:4: x '" + std::string(40, '7') + "...' is not within +-1e8 m");
}

TEST_F(Trajectories, AreRefusedByOneLine) {
  const TrajectoryOptions rate{.fps = 10};
  EXPECT_EQ(complaint(""), "f: is empty");
  EXPECT_EQ(complaint("\n\n"), "f: has no rows");
  EXPECT_EQ(complaint("# framerate: 25\n"), "f: has no rows");
  EXPECT_EQ(complaint("id,frame,x,y\n", rate), "f: has no rows");
  EXPECT_EQ(complaint("\xff\xfe"
                      "1"),
            "f:1: is UTF-16, not UTF-8");
  EXPECT_EQ(complaint("Dear all\n", rate), "f:1: 'Dear all' is neither a row of numbers nor a header");
  EXPECT_EQ(complaint("id,frame,x\n1,2,3\n", rate), "f:1: has no column called 'y', only 'id, frame, x'");
  EXPECT_EQ(complaint("id,x,y\n1,2,3\n", rate),
            "f:1: has no column called 'frame', nor one called 'time', only 'id, x, y'");
  EXPECT_EQ(complaint("id,agent,frame,x,y\n1,2,3,4,5\n", rate),
            "f:1: has two columns for the same, the second is 'agent'");
  EXPECT_EQ(complaint("id,frame,x/ft,y/ft\n1,2,3,4\n", rate),
            "f:1: the unit 'ft' of column 'x' is not known: --unit has to give its metres");
  EXPECT_EQ(complaint("id,frame,x/m,y/cm\n1,2,3,4\n", rate), "f:1: x and y are of different units");
  EXPECT_EQ(complaint("id,time/h,x,y\n1,2,3,4\n", rate), "f:1: the unit 'h' of time is not known");
  EXPECT_EQ(complaint("id,frame,x,y\n1,2,3\n", rate), "f:2: has 3 values, not 4: '1,2,3'");
  EXPECT_EQ(complaint("id,frame,x,y\n1,2,3,4,5\n", rate),
            "f:2: has more values than the header has columns, the next is '5'");
  EXPECT_EQ(complaint("id,frame,x,y\n1,2,3,\"4\n", rate),
            "f:2: a quote is not closed, or something follows it");
  EXPECT_EQ(complaint("id,t,x,y\n1,0,3,4\n1,2e9,3,4\n", rate),
            "f:3: t '2e9' is not within +-1e9 s of the first time, 0");
  EXPECT_EQ(complaint("id,t,x,y\n1,2e9,3,4\n1,0,3,4\n", rate),
            "f:3: t '0' is not within +-1e9 s of the first time, 2e+09");
  EXPECT_EQ(
      complaint("id,t,x,y\n1,1351651211642,3,4\n", rate),
      "f:2: t '1351651211642' is not within +-1e11 s; the column's name may lack a unit, as in time/ms");
  EXPECT_EQ(complaint("id,t,x,y\n1,nan,3,4\n", rate), "f:2: t 'nan' is not finite");
  EXPECT_EQ(complaint("id,frame,x,y,heading\n1,2,3,4,2e9\n", rate), "f:2: heading '2e9' is not within +-1e9");
  EXPECT_EQ(complaint("id,t,x,y\n1,1,3,4\n1,1.01,3,5\n", rate),
            "f:3: person 1 is at two places in frame 10, here at (3, 5), by line 2 at (3, 4)");
  EXPECT_EQ(complaint("1,2,3,4\n", rate),
            "f:1: has 4 columns without names: --columns has to name them in order, such as id,frame,x,y or "
            "frame,id,x,skip,y; the first rows are '1 2 3 4'");
  EXPECT_EQ(complaint("1 2 3\n", rate), "f:1: has no column called 'y', only 'id, frame, x'");
  EXPECT_EQ(test::trajectory_complaint(folder.path()), folder.path().filename().string() + ": is not a file");
  EXPECT_EQ(test::trajectory_complaint(folder.file("none")),
            "none: cannot be opened: No such file or directory");
}

TEST_F(Trajectories, NeedARateAndAUnitThatMakeSense) {
  const std::string rows = "# id frame x/m y/m\n1 0 1 2\n";
  for (const char* const rate : {"0", "-5", "10001", "nan", "inf", "1e-400"})
    EXPECT_EQ(complaint("# framerate: " + std::string(rate) + " fps\n" + rows),
              "f:1: the frame rate '" + std::string(rate) + " fps' is not above 0 and at most 10000");
  EXPECT_EQ(complaint("# framerate: many\n" + rows), "f:1: the frame rate 'many' is not a number");
  EXPECT_EQ(complaint(rows), "f: says no frame rate: --fps has to give the frame numbers a second");
  EXPECT_EQ(complaint(rows, {.fps = 0}),
            "f: the frame rate of --fps is 0 frames a second, not above 0 and at most 10000");
  EXPECT_EQ(complaint(rows, {.fps = 25, .unit = 0}), "f: the unit of --unit is 0 m, not above 0");
}

TEST_F(Trajectories, OfTrajNetNameTheLineThatIsWrong) {
  const std::string first = "{\"scene\": {\"fps\": 2.5}}\n";
  const std::pair<const char*, const char*> cases[] = {
      {"{\"track\": {\"f\": 20, \"p\": 1, \"x\": 8.46, \"y\": -3.5}",
       "is not an object of JSON: '{\"track\": {\"f\": 20, \"p\": 1, \"x\": 8.46, \"...'"},
      {"{\"track\": {\"f\": 20, \"p\": 1}}", "has no 'x'"},
      {"{\"track\": {\"f\": 2.5, \"p\": 1, \"x\": 1, \"y\": 2}}", "f '2.5' is not a whole number"},
      {"{\"track\": {\"f\": 2e15, \"p\": 1, \"x\": 1, \"y\": 2}}", "f '2e15' is not within +-1e15"},
      {"{\"track\": {\"f\": 2, \"p\": 1, \"x\": NaN, \"y\": 2}}", "x 'NaN' is not finite"},
      {"{\"track\": {\"f\": 2, \"p\": 1, \"x\": [1], \"y\": 2}}", "x '[1]' is not a number"},
      {"{\"track\": {\"f\": 2, \"p\": 1, \"x\": 1e9, \"y\": 2}}", "x '1e9' is not within +-1e8 m"},
      {"{\"track\": []}", "is not an object of JSON: '{\"track\": []}'"},
      {"{\"truck\": {}}", "'truck' is neither a track nor a scene"},
      {"[]", "is not an object of JSON: '[]'"},
      {"{\"scene\": {\"fps\": 0}}", "fps '0' is not above 0 and at most 10000"},
      {"{\"scene\": {\"fps\": 3}}", "fps '3' differs from 2.5 of earlier scenes"},
      {"{\"scene\": {\"fps\": 2.5}} 1", "is not an object of JSON: '{\"scene\": {\"fps\": 2.5}} 1'"},
  };
  for (const auto& [line, message] : cases)
    EXPECT_EQ(complaint(first + line + "\n"), std::string("f:2: ") + message);
  EXPECT_EQ(complaint(first), "f: has no rows");
}

}  // namespace
}  // namespace bch
