// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <string>

#include "bench/base/output_file.hpp"
#include "kernel/check/check.hpp"

namespace bch::cli {

/// A table that is written line by line while a recording is checked; without a name it is none.
class StreamedTable {
 public:
  StreamedTable(const std::string& file, const char* columns);
  void add(const std::string& lines);
  void commit();
  explicit operator bool() const { return file_.has_value(); }

 private:
  std::optional<OutputFile> file_;
  std::string waiting_;
};

/// What is known of a checked recording besides the answers.
struct CheckedRecording {
  std::string file;
  detail::TrajectoryInfo info;
  std::uint32_t slabs;
  bool walls;
  std::string floor;  ///< to walk on, as well-known text, or empty
};

constexpr const char* frame_columns = "frame,seconds,people,density,overlapping,overlapping_pairs,in_walls\n";
constexpr const char* pair_columns = "frame,seconds,first,second,kind,depth,gap,x,y\n";
constexpr const char* event_columns = "first,second,kind,from,to,frames,worst,depth,x,y\n";

/// Returns the line of a frame, or of each of its pairs.
std::string frame_line(const detail::CheckedFrame& frame);
std::string pair_lines(const detail::CheckedFrame& frame);
/// Returns the line of an event.
std::string event_line(const detail::OverlapEvent& event, double fps);

/// Returns the summary for people.
std::string check_text(const CheckedRecording& recording, const detail::CheckSummary& summary);
/// Writes all of it for programs; without a name nothing. Events go to the file one by one, because there may be millions.
void write_check_json(const std::string& file, const CheckedRecording& recording,
                      const detail::CheckSummary& summary);

/// Returns the share of person-frames in overlap, in percent.
double percent_in_overlap(const detail::CheckSummary& summary);

}  // namespace bch::cli
