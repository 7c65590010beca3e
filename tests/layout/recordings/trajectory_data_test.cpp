// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/test.hpp"

// Real recordings, found through the environment variable BCH_TEST_DATA; what they hold is written in the
// SOURCES.md beside them.

namespace bch {
namespace {

using detail::TrajectoryOptions;

/// What is known of a file.
struct Expected {
  const char* file;
  const char* format;
  double fps;
  std::uint64_t rows, people;
  TrajectoryOptions options = {};
};

class TrajectoryData : public testing::TestWithParam<Expected> {};

TEST_P(TrajectoryData, IsRead) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const Expected& expected = GetParam();
  const test::ReadRecording recording =
      test::read_recording(*data / "trajectories" / expected.file, expected.options);
  test::expect_sound(recording);
  EXPECT_EQ(recording.info.format, expected.format);
  EXPECT_EQ(recording.info.fps, expected.fps);
  EXPECT_EQ(recording.info.rows, expected.rows);
  EXPECT_EQ(recording.info.people, expected.people);
  for (const test::RecordedFrame& frame : recording.frames)
    for (const detail::TrackedPerson& person : frame.people)
      ASSERT_LT(std::max(std::abs(person.x), std::abs(person.y)), 60) << "metres are that far";
}

INSTANTIATE_TEST_SUITE_P(
    Files, TrajectoryData,
    testing::Values(Expected{"juelich_bottleneck_040_c_56_h.txt", "PeTrack text", 25, 63'110, 75},
                    Expected{"juelich_unidirectional_uo-050-180-180.txt",
                             "text without a header",
                             16,
                             9'712,
                             61,
                             {.fps = 16, .unit = 0.01}},
                    Expected{"single_file_n56_cam1.csv", "CSV", 25, 2'391, 53, {.fps = 25}},
                    Expected{"jpscore_corner_traj.txt", "PeTrack text", 16, 18'704, 137},
                    Expected{"jupedsim_v2_demo.sqlite", "JuPedSim SQLite, version 2", 25, 8'083, 30},
                    Expected{"jupedsim_v1.sqlite", "JuPedSim SQLite, version 1", 25, 65'482, 75},
                    Expected{"pathfinder.csv", "Pathfinder CSV", 40, 12'120, 150}),
    [](const auto& parameter) {
      std::string name;
      for (const char c : std::string(parameter.param.file))
        name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

}  // namespace
}  // namespace bch
