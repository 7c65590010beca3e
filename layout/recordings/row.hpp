// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "layout/recordings/shown.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: rows, in the order of a file.

namespace bch::detail::trajectory {

constexpr double largest_coordinate = 1e8;                     // metres
constexpr std::int64_t largest_frame = 1'000'000'000'000'000;  // also microseconds: 31 years
constexpr double microseconds = 1e6;                           // a second
constexpr double largest_time = 1e9,
                 largest_origin = 1e11;  // seconds, the second of the first time: 3000 years
constexpr double shortest_person = 1, tallest_person = 2.5;  // metres
constexpr double largest_fps = 10'000;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Represents a person at a time, as it stands in a file.
struct Row {
  std::int64_t key = 0;  ///< a frame's number, or microseconds
  std::int64_t id = 0;
  double x = 0, y = 0;  ///< metres
  float heading = unknown, stature = unknown, clip_seconds = unknown;
  std::uint32_t motion = TrackedPerson::no_motion;  ///< index into Recording::motions
  std::uint64_t number = 0;  ///< of its line or row in the file, from 1; in memory from 0
};

/// Names the rows of a file, for messages.
struct Places {
  std::filesystem::path file;
  bool has_lines = false;  ///< rows are lines of text

  /// Returns "line 12" or "row 12".
  std::string row(std::uint64_t number) const;
  /// Returns the file with that row, as messages begin.
  std::string at(std::uint64_t number) const;
  [[noreturn]] void reject(const std::string& reason) const;
  [[noreturn]] void reject(std::uint64_t number, const std::string& reason) const;
};

/// Selects how the keys of rows become times.
enum class Clock : std::uint8_t {
  frames,     ///< frames, of which the file says how many there are a second, or the caller has to
  times,      ///< microseconds
  row_steps,  ///< frames, of which the file says how many steps between a person's rows there are a second
};

/// Holds what a file says about all of its rows.
struct Recording {
  std::string format;
  std::string geometry;
  std::vector<std::string> assumptions, notes;
  Clock clock = Clock::frames;
  std::optional<double> rate;    ///< frames or steps a second
  std::optional<double> origin;  ///< seconds in the file at key 0, where that is not 0
  std::vector<NamedMotion> motions;
};

/// Holds rows in an order of their own.
class RowStream {
 public:
  RowStream() = default;
  RowStream(const RowStream&) = delete;
  RowStream& operator=(const RowStream&) = delete;
  virtual ~RowStream() = default;

  /// Fills the front of a span.
  /// Returns: how many rows were read; 0 at the end.
  virtual std::size_t read(std::span<Row> rows) = 0;
  /// Reads like read(), of which the keys and ids alone are wanted, and the rest may be left out unchecked.
  virtual std::size_t read_keys(std::span<Row> rows) { return read(rows); }
  /// Goes back before the first row.
  virtual void rewind() = 0;
};

/// Holds the rows of a file in the order of the file, checked one by one.
class RowSource : public RowStream {
 public:
  virtual const Places& places() const = 0;
  /// Says what holds for all rows; complete when all of them have been read.
  virtual Recording recording() const = 0;
};

/// Returns whether a number is a coordinate in metres.
inline bool is_coordinate(double metres) {
  return std::abs(metres) <= largest_coordinate;  // no NaN is
}

/// Returns what is wrong with a coordinate that is none.
std::string coordinate_fault(double metres);

/// Counts what a third coordinate is: a person's height, or something else.
class Heights {
 public:
  /// Returns the height, NaN where the number cannot be one.
  float take(double metres) {
    const bool fits = metres >= shortest_person && metres <= tallest_person;
    (fits ? any_ : any_other_) = true;
    return fits ? static_cast<float>(metres) : unknown;
  }
  /// Adds what was assumed.
  void describe(std::vector<std::string>& assumptions) const;

 private:
  bool any_ = false, any_other_ = false;
};

/// Returns the frames a second, checked; `what` says where the number is from.
double checked_fps(const Places& places, double fps, const std::string& what);

}  // namespace bch::detail::trajectory
