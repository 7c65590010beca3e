// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/recordings.hpp"
#include "tests/support/test.hpp"
#include "tests/support/text_recordings.hpp"

// Recordings as text whose columns have no names, or not as many as rows have fields; whose times are far from 0, whose numbers are closer
// to it than any double, or that are made to take long.

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
    EXPECT_TRUE(test::has(first_assumption(frames),
                          taken + "frame, id, x, y, z" + unnamed + number + " has frame 780, id 1, x "));
    const ReadRecording ids = read(comment + walkers("ifxyh"), options);
    EXPECT_EQ(text_of(ids), text_of(named)) << comment;
    EXPECT_TRUE(test::has(first_assumption(ids),
                          taken + "id, frame, x, y, z" + unnamed + number + " has id 1, frame 780, x "));
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
      EXPECT_TRUE(test::has(message, std::to_string(std::string(columns).size()) + asks)) << columns;
      EXPECT_TRUE(test::has(message, "; the first rows are '"));
    }
  // A single frame, or one person who jumps?
  for (const std::string& text :
       {walkers("fixyh", 10, 1, 1), walkers("fixyh", 40, 1, 1), std::string("1 1 1 2 1.7\n")})
    EXPECT_TRUE(test::has(complaint(text, options), asks));
  EXPECT_EQ(text_of(read("780 1 8.5 0 3.5 1.6 0 0.05\n786 1 8.75 0 3.6 1.6 0 0.05\n",
                         {.fps = 15, .unit = 1, .columns = "frame,id,x,skip,y"})),
            "780 1 8.5 3.5 - -\n786 1 8.75 3.6 - -\n");
}

TEST_F(Trajectories, WithoutNamesNeedARateAndAUnit) {
  const std::string text = walkers("ifxyh");
  EXPECT_TRUE(test::has(complaint(text), "f: says no unit and no frame rate: "));
  EXPECT_TRUE(test::has(complaint(text, {.fps = 16}), "f: says no unit: "));
  EXPECT_TRUE(test::has(complaint(text, {.unit = 0.01}), "f: says no frame rate: "));
  const ReadRecording recording = read(text, {.fps = 16, .unit = 0.01});
  EXPECT_EQ(recording.info.format, "text without a header");
  EXPECT_EQ(recording.info.fps, 16);
  const std::string few = "1 43 79.5 774 183\n1 44 79 764 183\n";
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

  const std::string juelich = "1 0 1 2\n1 10 3 4\n2 0 5 6\n", unclear = "1 0 1 2\n1 1 3 4\n2 0 5 6\n";
  EXPECT_EQ(text_of(read(juelich, options)), "0 1 1 2 - -\n0 2 5 6 - -\n10 1 3 4 - -\n");
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
  EXPECT_TRUE(test::has(
      complaint("# frame_number pedestrian_ID pos_x pos_z pos_y v_x v_z v_y\n" + walkers("fixoyvov"),
                options),
      "f:2: has 8 columns without names: "));
}

TEST_F(Trajectories, OfTimesFarFromZeroCountFromTheEarliest) {
  const TrajectoryOptions atc{.unit = 0.001, .columns = "time,id,x,y,z,v,motion,heading"};
  const std::string rows[] = {"1351651211.642,7,41830,-16580,1703,900.1,0.02,-0.5\n",
                              "1351651211.675,7,41860,-16580,1703,900.1,0.02,-0.5\n",
                              "1351651211.741,8,41830,-14580,0,900.1,0.02,0\n"};
  const ReadRecording recording = read(rows[0] + rows[1] + rows[2], atc);
  const std::string expected =
      "0 7 41.83 -16.580000000000002 -0.5 1.703\n1 7 41.86 -16.580000000000002 -0.5 1.703\n"
      "3 8 41.83 -14.58 0 -\n";
  EXPECT_EQ(text_of(recording), expected);
  const std::string origin = "Times and frames count from the earliest time, 1351651211.642 s.";
  EXPECT_EQ(recording.info.assumptions[3], origin);
  const ReadRecording unordered = read(rows[2] + rows[1] + rows[0], atc);
  EXPECT_EQ(text_of(unordered), expected);
  EXPECT_EQ(unordered.info.assumptions, recording.info.assumptions);

  const std::string expected_here = "0 1 1 2 - -\n2 1 1 2 - -\n";
  for (const char* const text :
       {"id,time/ms,x/m,y/m\n1,1351651211642,1,2\n1,1351651212142,1,2\n",
        "id,time [us],x/m,y/m\n1,1351651211642000,1,2\n1,1351651212142000,1,2\n",
        "id,t,x/m,y/m\n1,-1e10,1,2\n1,-9999999999.5,1,2\n", "id,t,x/m,y/m\n1,2e9,1,2\n1,2000000000.5,1,2\n"})
    EXPECT_EQ(text_of(read(text, {.fps = 4})), expected_here) << text;
  // Nearer to 0, they are what they were.
  EXPECT_EQ(text_of(read("id,t,x/m,y/m\n1,999999999.5,1,2\n1,1000000000.5,1,2\n", {.fps = 2})),
            "1999999999 1 1 2 - -\n2000000001 1 1 2 - -\n");
}

TEST_F(Trajectories, MayHaveNumbersThatVanish) {
  EXPECT_EQ(text_of(read("id,frame,x/m,y/m,heading\n1,1e-400,-4e-999,2e-310,1e-5000\n", {.fps = 1})),
            "0 1 -0 2e-310 0 -\n");
  EXPECT_EQ(text_of(read("{\"track\": {\"f\": 0, \"p\": 1, \"x\": 1e-400, \"y\": 3}}", {.fps = 1})),
            "0 1 0 3 - -\n");
}

/// Brackets that nothing closes are looked for once, not by each of the 64 000 of a line.
TEST_F(Trajectories, MayHaveManyBracketsInComments) {
  std::string text;
  for (int line = 0; line < 40; ++line)
    text += "#" + std::string(32'000, '[') + std::string(32'000, '(') + "\n";
  EXPECT_EQ(text_of(read(text + "# framerate: 10\n# id frame x/m y/m\n1 0 1 2\n")), "0 1 1 2 - -\n");
}

/// Multiples of two numbers of buckets that libstdc++ takes. This takes a minute where ids are their own hashes.
TEST_F(Trajectories, MayHaveIdsThatWouldShareABucket) {
  std::string text = "id,frame,x/m,y/m\n";
  constexpr std::int64_t buckets = std::int64_t{85'229} * 172'933, people = 85'000;
  for (std::int64_t k = 0; k < people; ++k)
    text += std::to_string(k * buckets) + "," + std::to_string(k / 200) + ",1,2\n";
  EXPECT_EQ(read(text, {.fps = 10}).info.people, static_cast<std::uint64_t>(people));
}

}  // namespace
}  // namespace bch
