// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: rows become frames.

namespace bch::detail::trajectory {

struct Survey;

/// Reads the rows of a file as frames: as they stand where they are in order, else sorted.
class FrameReader final : public TrajectoryReader {
 public:
  /// Takes a source of rows and reads it once.
  /// Errors:  throws TrajectoryError on what is wrong with any row alone, and without a frame rate.
  FrameReader(std::unique_ptr<RowSource> source, const TrajectoryOptions& options);

  const TrajectoryInfo& info() const override { return info_; }
  bool next(std::int64_t& frame, std::vector<TrackedPerson>& people) override;
  std::string place_of(std::uint64_t row) const override { return source_->places().at(row); }

 private:
  std::unique_ptr<RowSource> source_;
  std::unique_ptr<RowStream> sorted_;  ///< where the file is not in order
  TrajectoryInfo info_;
  bool has_times_ = false;       ///< keys are microseconds
  std::int64_t key_origin_ = 0;  ///< the key of frame 0
  std::vector<Row> batch_, frame_rows_;
  std::span<const Row> left_;  ///< of the batch
  std::uint64_t rows_read_ = 0;
  std::int64_t last_key_ = 0;

  RowStream& rows() { return sorted_ ? *sorted_ : static_cast<RowStream&>(*source_); }
  Survey survey(Clock clock, const TrajectoryOptions& options);
  void settle_origin(double origin, const Survey& survey);
  void settle_rate(const Recording& recording, const Survey& survey, const TrajectoryOptions& options);
  double rate_of_times(const Survey& survey);
  std::int64_t frame_of(std::int64_t key) const;
  bool fill();
  void gather(std::int64_t frame);
  void check_frame(std::int64_t frame) const;
};

}  // namespace bch::detail::trajectory
