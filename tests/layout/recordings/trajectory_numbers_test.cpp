// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <string>

#include "tests/support/recordings.hpp"
#include "tests/support/text_recordings.hpp"

// Recordings as text whose times are far from 0, whose numbers are closer to it than any double, or that are made to take long.

namespace bch {
namespace {

using detail::TrajectoryOptions;
using test::ReadRecording;
using test::text_of;
using test::Trajectories;

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
