// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/base/output.hpp"
#include "bench/base/output_file.hpp"
#include "kernel/recordings/check.hpp"

namespace bch::cli {

/// Writes a table line by line while a recording is checked; without a name, it writes nothing.
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

/// Holds what is known of a checked recording besides the answers.
struct CheckedRecording {
  std::string file;
  detail::TrajectoryInfo info;
  std::uint32_t slabs, depth;
  Leaves leaves;
  std::uint32_t characters;  ///< of one's own; 0: built-in pedestrians
  bool baked;                ///< those are of a baked set
  bool walls;
  std::string floor;  ///< to walk on, as well-known text, or empty
};

constexpr const char* frame_columns = "frame,seconds,people,density,overlapping,overlapping_pairs,in_walls\n";
constexpr const char* pair_columns = "frame,seconds,first,second,kind,depth,gap,x,y\n";
constexpr const char* event_columns = "first,second,kind,from,to,frames,worst,depth,x,y\n";

/// Names the files that the answers of a check go to; an empty name is none.
struct CheckOutputs {
  std::string events, frames, pairs, json;
  double fail_above = 100;  ///< percent of person-seconds

  std::vector<OutputOption> files() const;
};

/// Represents the tables of a check.
struct CheckTables {
  StreamedTable frames, pairs, events;
  std::string json;

  explicit CheckTables(const CheckOutputs& outputs);
  void add(const detail::CheckedFrame& frame);
  /// Writes what is told of the whole, and gives all files their names.
  void finish(const CheckedRecording& recording, const detail::CheckSummary& summary);
};

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

/// Returns what the bodies are, in a few words.
std::string bodies_text(const CheckedRecording& recording);

/// Returns the share of person-frames in overlap, in percent.
double percent_in_overlap(const detail::CheckSummary& summary);

/// Writes the summary to standard output.
/// Errors:  throws CheckFailed where more person-seconds are in overlap than outputs.fail_above.
void tell(const CheckedRecording& recording, const detail::CheckSummary& summary,
          const CheckOutputs& outputs);

}  // namespace bch::cli
