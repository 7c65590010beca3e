// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {

/// Recordings that are given as text.
class Trajectories : public testing::Test {
 protected:
  TemporaryFolder folder;

  ReadRecording read(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    ReadRecording recording = read_recording(folder.write("f", text), options);
    expect_sound(recording);
    return recording;
  }
  std::string complaint(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    return trajectory_complaint(folder.write("f", text), options);
  }
};

}  // namespace bch::test
