// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace bch::detail {

/// Reports a recording that cannot be read. The message is one line: the file, the row or line where there is one, the reason with
/// the value.
class TrajectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds the body that a row of a file names for its person, and the clip that it plays; one of the two may be empty. Both are where the
/// row is about a body that does not walk, whose kind is then named.
struct NamedMotion {
  std::string character, clip;
  std::string place;             ///< where it stands first, for messages: the file and the line
  std::string body = {};         ///< "box" for instance
  double length = 0, width = 0;  ///< of that, metres, in whole millimetres; 0 where the row does not say
};

/// Describes a person in a frame of a recording.
struct TrackedPerson {
  static constexpr std::uint32_t no_motion = 0xffff'ffff;

  std::int64_t id;
  double x, y;    ///< metres, within +-1e8
  float heading;  ///< radians, counter-clockwise from +x; NaN where the file does not say
  float stature;  ///< the person's height in metres, from 1 to 2.5; NaN where the file does not say
  std::uint32_t motion = no_motion;                              ///< index into TrajectoryInfo::motions
  float clip_seconds = std::numeric_limits<float>::quiet_NaN();  ///< of the motion's clip, likewise
  std::uint64_t row = 0;  ///< the number of his line or row in the file
};

/// Holds values that override those of the file, for open_trajectory().
struct TrajectoryOptions {
  std::optional<double> fps = {};           ///< frame numbers a second, instead of what the file says
  std::optional<double> unit = {};          ///< metres for a unit of the file, likewise
  std::optional<std::string> columns = {};  ///< of text and CSV: their names in order, as "frame,id,x,y"
  std::size_t sort_memory = std::size_t{32} << 20;  ///< bytes of rows that are sorted at a time
  /// Limits how long the process that reads HDF5 may say nothing.
  std::chrono::milliseconds patience{30'000};
  /// QueryName often while the file is opened and read, which ends with an error when it says no. Does not throw.
  std::function<bool()> go_on = {};
};

/// Refers to a column of a table in memory, with a value for each row.
struct ColumnView {
  enum class Type : std::uint8_t { float64, float32, int64, int32, text };

  std::string name;  ///< as in a header: "frame", "x/cm"
  const void* values =
      nullptr;  ///< of any alignment; texts are pointers to characters that end with NUL, or null where they are empty
  std::size_t stride = 0;  ///< bytes from a value to the next
  Type type = Type::float64;
};

/// Holds what a recording is, known before its first frame is read.
struct TrajectoryInfo {
  std::string format;    ///< such as "JuPedSim SQLite, version 2"
  double fps = 0;        ///< frame numbers a second: a frame's time is its number / fps
  std::string geometry;  ///< the walkable area as WKT, or empty
  std::vector<std::string>
      assumptions;  ///< a sentence each: what the file does not say, and what is taken for it
  std::vector<std::string>
      notes;  ///< a sentence each: columns that are not read, values that seem to be of another unit
  std::vector<NamedMotion>
      motions;  ///< all that rows name, in the order of the file; at most 4096, and 65 536 bodies
  std::uint64_t rows = 0;
  std::int64_t first_frame = 0, last_frame = 0;
  std::uint64_t people = 0;  ///< different ids; 0 where they are more than 2^20, which are not counted
};

/// Reads a recording frame by frame.
class TrajectoryReader {
 public:
  TrajectoryReader() = default;
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;
  virtual ~TrajectoryReader() = default;

  virtual const TrajectoryInfo& info() const = 0;

  /// Reads the people of the next frame that has any, by ascending id.
  /// Returns: whether there was one.
  /// Errors:  throws TrajectoryError.
  virtual bool next(std::int64_t& frame, std::vector<TrackedPerson>& people) = 0;

  /// Names the file and one of its rows, as messages begin.
  virtual std::string place_of(std::uint64_t row) const = 0;
};

/// Opens a recording, whose format is recognised by its content: JuPedSim's SQLite (versions 1 to 3), PeTrack's and Juelich's text,
/// HDF5 of the Pedestrian Dynamics Data Archive and of JuPedSim, Pathfinder's CSV, CSV with a header, TrajNet++'s ndjson, ETH/UCY columns.
/// The file is read once to its end, to learn what info() says, and again for the frames. It is not trusted.
/// Memory:  grows with the people of a frame and with options.sort_memory, not with the rows. Files whose frames are out of
///          order are sorted through a file without a name in the folder for temporary files, 56 bytes a row.
/// Errors:  throws TrajectoryError; also where fps or unit are needed and neither file nor options say them.
std::unique_ptr<TrajectoryReader> open_trajectory(const std::filesystem::path& file,
                                                  const TrajectoryOptions& options = {});

/// Opens a recording that is in memory: a table whose columns have the names that headers of CSV have. Rows are numbered from 0. Its frames are
/// those of the same table as CSV. The values are not copied, so they have to stay as they are as long as the reader lives.
/// Memory:  as above; rows out of order are sorted likewise.
/// Errors:  throws TrajectoryError as above; also where a column that is needed has no values, or the options name columns.
std::unique_ptr<TrajectoryReader> open_columns(std::vector<ColumnView> columns, std::size_t rows,
                                               const TrajectoryOptions& options = {});

}  // namespace bch::detail
