// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/recordings/trajectory.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/program_run.hpp"

namespace bch::test {

/// A frame of a recording.
struct RecordedFrame {
  std::int64_t number = 0;
  std::vector<detail::TrackedPerson> people;
};

/// A recording that was read to its end.
struct ReadRecording {
  detail::TrajectoryInfo info;
  std::vector<RecordedFrame> frames;
};

/// Reads a recording, and expects what holds of every one: frames ascend, ids within them too, numbers are in range, and info() tells the
/// truth.
ReadRecording read_recording(const std::filesystem::path& file,
                             const detail::TrajectoryOptions& options = {});

/// A line for each person and frame: "frame id x y heading stature", with - for NaN.
std::string text_of(const ReadRecording& recording);
/// A line for each sentence on what was taken for granted, then for each note.
std::string assumptions_of(const ReadRecording& recording);

/// Returns the message of the TrajectoryError that reading throws, the folder left out; "accepted" where there is none.
std::string trajectory_complaint(const std::filesystem::path& file,
                                 const detail::TrajectoryOptions& options = {});

/// Makes a SQLite file by statements, in place of one that may be there.
void write_sqlite(const std::filesystem::path& file, const std::string& sql);

/// Changes a SQLite file so that the tree of a table that fits into a page, or of "sqlite_schema", has paths without number to that page.
void make_graph(const std::filesystem::path& file, const std::string& table);

}  // namespace bch::test
