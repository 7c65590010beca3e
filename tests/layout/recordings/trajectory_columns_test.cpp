// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>

#include "tests/support/recordings.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/text_recordings.hpp"

// Recordings as text whose columns have no names, or not as many as rows have fields.

namespace bch {
namespace {

using detail::TrajectoryOptions;
using test::ReadRecording;
using test::text_of;
using test::Trajectories;

const TrajectoryOptions options{.fps = 25, .unit = 1};

/// Writes twelve frames of a few people who walk, with a line end behind each of `columns`: f frame, i id, x, y, h height, o 0, t time,
/// a heading, v speed.
std::string walkers(const std::string& columns, int people = 6, int step = 1, int frames = 12) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame)
    for (int id = 1; id <= people; ++id) {
      test::Random random(static_cast<std::uint64_t>(id));
      const double u = random.uniform(0, 1), v = random.uniform(0, 1),
                   x = random.uniform(0, 20) + 0.04 * u * frame, y = random.uniform(0, 20) + 0.04 * v * frame;
      for (const char column : columns) {
        const double value = column == 'f'   ? 780 + step * frame
                             : column == 'i' ? id
                             : column == 'x' ? x
                             : column == 'y' ? y
                             : column == 'h' ? 1.6 + 0.02 * id
                             : column == 't' ? 0.04 * frame
                             : column == 'a' ? -std::atan2(v, u)
                             : column == 'v' ? u
                                             : 0;
        text += std::to_string(value) + " ";
      }
      text.back() = '\n';
    }
  return text;
}

std::string first_assumption(const ReadRecording& recording) {
  return recording.info.assumptions.empty() ? "" : recording.info.assumptions.front();
}

TEST_F(Trajectories, WithoutNamesAreToldByTheWaysOfPeople) {
  const ReadRecording named = read("frame id x/m y/m z/m\n" + walkers("fixyh"), {.fps = 25});
  EXPECT_EQ(named.frames.size(), 12u);
  const std::string taken = "Columns are taken for ", unnamed = ", which the file does not name: line ";
  for (const std::string comment : {"", "# framerate: 25\n", "# people who walk\n"}) {
    const std::string number = comment.empty() ? "1" : "2";
    const ReadRecording frames = read(comment + walkers("fixyh"), options);
    EXPECT_EQ(text_of(frames), text_of(named)) << comment;
    EXPECT_EQ(first_assumption(frames).find(taken + "frame, id, x, y, z" + unnamed + number +
                                            " has frame 780, id 1, x "),
              0u)
        << first_assumption(frames);
    const ReadRecording ids = read(comment + walkers("ifxyh"), options);
    EXPECT_EQ(text_of(ids), text_of(named)) << comment;
    EXPECT_EQ(first_assumption(ids).find(taken + "id, frame, x, y, z" + unnamed + number +
                                         " has id 1, frame 780, x "),
              0u)
        << first_assumption(ids);
    EXPECT_EQ(text_of(read(comment + walkers("fixy"), options)),
              text_of(read("frame id x y\n" + walkers("fixy"), options)));
  }
  // One person alone, and frames that are not one after the other.
  EXPECT_EQ(text_of(read(walkers("ifxyh", 1, 1, 40), options)),
            text_of(read(walkers("fixyh", 1, 1, 40), options)));
  EXPECT_EQ(text_of(read(walkers("ifxyh", 6, 7), options)), text_of(read(walkers("fixyh", 6, 7), options)));
}

TEST_F(Trajectories, WithoutNamesAreAskedAboutWhereRowsDoNotTell) {
  const std::string asks = " columns without names: --columns has to name them in order, such as ";
  for (const std::string comment : {"", "# framerate: 25\n"})
    for (const char* const columns : {"fixoyvov", "fixyhv", "fixyhaaaaa", "fixoy", "fioxy", "fixya", "tixyh",
                                      "xyif", "fixyhoooooooooo"}) {
      const std::string message = complaint(comment + walkers(columns), options);
      EXPECT_NE(message.find(std::to_string(std::string(columns).size()) + asks), std::string::npos)
          << columns << ": " << message;
      EXPECT_NE(message.find("; the first rows are '"), std::string::npos) << message;
    }
  EXPECT_EQ(
      complaint("780 1 8.5 0 3.5 1.6 0 0.05\n786 1 8.75 0 3.6 1.6 0 0.05\n", options),
      "f:1: has 8 columns without names: --columns has to name them in order, such as id,frame,x,y or "
      "frame,id,x,skip,y; the first rows are '780 1 8.5 0 3.5 1.6 0 0.05' and '786 1 8.75 0 3.6 1.6 0 0.05'");
  // Stanford's drone.
  EXPECT_EQ(complaint("0 213 1038 241 1072 10000 0 1 1 \"Biker\"\n", options),
            "f:1: has 10 columns without names: --columns has to name them in order, such as id,frame,x,y or "
            "frame,id,x,skip,y; the first rows are '0 213 1038 241 1072 10000 0 1 1 \"Biker\"'");
  // A single frame, or one person who jumps?
  EXPECT_NE(complaint(walkers("fixyh", 10, 1, 1), options).find(asks), std::string::npos);
  EXPECT_NE(complaint(walkers("fixyh", 40, 1, 1), options).find(asks), std::string::npos);
  EXPECT_NE(complaint("1 1 1 2 1.7\n", options).find(asks), std::string::npos);
  EXPECT_EQ(text_of(read("780 1 8.5 0 3.5 1.6 0 0.05\n786 1 8.75 0 3.6 1.6 0 0.05\n",
                         {.fps = 15, .unit = 1, .columns = "frame,id,x,skip,y"})),
            "780 1 8.5 3.5 - -\n786 1 8.75 3.6 - -\n");
}

TEST_F(Trajectories, WithoutNamesNeedARateAndAUnit) {
  const std::string text = walkers("ifxyh");
  EXPECT_EQ(complaint(text),
            "f: says no unit and no frame rate: --unit has to give its metres, such as 0.01 for cm, and "
            "--fps the frame numbers "
            "a second");
  EXPECT_EQ(complaint(text, {.fps = 16}),
            "f: says no unit: --unit has to give its metres, such as 0.01 for cm");
  EXPECT_EQ(complaint(text, {.unit = 0.01}),
            "f: says no frame rate: --fps has to give the frame numbers a second");
  const ReadRecording recording = read(text, {.fps = 16, .unit = 0.01});
  EXPECT_EQ(recording.info.format, "text without a header");
  EXPECT_EQ(recording.info.fps, 16);
  const std::string few = "1 43 79.5 774 183\n1 44 79 764 183\n";
  EXPECT_EQ(complaint(few, {.fps = 16}), complaint(text, {.fps = 16}));
  EXPECT_EQ(complaint(few, {.unit = 0.01}), complaint(text, {.unit = 0.01}));
  EXPECT_EQ(text_of(read(few, {.fps = 16, .unit = 0.01})),
            "43 1 0.795 7.74 - 1.83\n44 1 0.79 7.640000000000001 - 1.83\n");
}

TEST_F(Trajectories, OfFourColumnsAreToldBySteps) {
  const TrajectoryOptions rate{.fps = 25};
  const ReadRecording eth = read("780.0\t1.0\t8.46\t3.59\n790.0\t1.0\t9.57\t3.79\n790.0\t2.0\t9\t3\n", rate);
  EXPECT_EQ(text_of(eth), "780 1 8.46 3.59 - -\n790 1 9.57 3.79 - -\n790 2 9 3 - -\n");
  EXPECT_EQ(eth.info.format, "ETH/UCY columns");
  EXPECT_EQ(eth.info.assumptions,
            (std::vector<std::string>{
                "Columns are taken for frame, id, x, y, which the file does not name: line 1 has "
                "frame 780, id 1, x 8.46, y 3.59; line 2 has frame 790, id 1, x 9.57, y 3.79.",
                "Coordinates are in metres; the file does not say their unit."}));
  EXPECT_EQ(complaint("780 1 8.46 3.59\n790 2 9.57 3.79\n"),
            "f: says no frame rate: --fps has to give the frame numbers a second");

  const std::string juelich = "1 0 1 2\n1 10 3 4\n2 0 5 6\n", unclear = "1 0 1 2\n1 1 3 4\n2 0 5 6\n";
  EXPECT_EQ(text_of(read(juelich, options)), "0 1 1 2 - -\n0 2 5 6 - -\n10 1 3 4 - -\n");
  EXPECT_EQ(complaint(unclear, rate),
            "f:1: has 4 columns without names: --columns has to name them in order, such as id,frame,x,y or "
            "frame,id,x,y; the first rows are '1 0 1 2' and '1 1 3 4'");
  EXPECT_EQ(text_of(read(unclear, {.fps = 25, .columns = "frame,id,x,y"})),
            "1 0 1 2 - -\n1 1 3 4 - -\n2 0 5 6 - -\n");
  EXPECT_EQ(text_of(read(unclear, {.fps = 25, .unit = 1, .columns = "id,frame,x,y"})),
            "0 1 1 2 - -\n0 2 5 6 - -\n1 1 3 4 - -\n");
}

TEST_F(Trajectories, MayHaveOtherNumbersOfNamesThanOfColumns) {
  const std::string row = "1 1 0 2 3\n";
  for (const char* const header :
       {"# framerate: 5\n# id frame x/m y/m\n", "# framerate: 5\nid frame x/m y/m\n"}) {
    const ReadRecording recording = read(header + row);
    EXPECT_EQ(text_of(recording), "1 1 0 2 - -\n");
    EXPECT_EQ(
        first_assumption(recording),
        "Line 2 names 4 columns and rows have 5, which are taken in that order: line 3 has id 1, frame 1, x "
        "0, y 2.");
  }
  EXPECT_EQ(read("# framerate: 5\nid frame x/m y/m\n# a comment\n1 1 0 2\n").info.assumptions.size(), 0u);
  // Where columns are given, x tells whether there is a header.
  EXPECT_EQ(
      text_of(read("Biker,1,0,2,3\nBiker,1,1,2,3\n", {.fps = 5, .unit = 1, .columns = "label,id,frame,x,y"})),
      "0 1 2 3 - -\n1 1 2 3 - -\n");
  EXPECT_EQ(
      text_of(read("a,b,c,d,e\nBiker,1,1,2,3\n", {.fps = 5, .unit = 1, .columns = "label,id,frame,x,y"})),
      "1 1 2 3 - -\n");
  EXPECT_EQ(text_of(read("# framerate: 5\n# Columns: frame, id, x/m, y/m, z/m\n" + row)), "1 1 0 2 - -\n");
  EXPECT_EQ(
      complaint("# frame_number pedestrian_ID pos_x pos_z pos_y v_x v_z v_y\n" + walkers("fixoyvov"), options)
          .find("f:2: has 8 columns without names: "),
      0u);
}

}  // namespace
}  // namespace bch
