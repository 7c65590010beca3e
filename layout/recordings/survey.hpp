// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_set>
#include <vector>

#include "layout/base/mixed_hash.hpp"
#include "layout/recordings/row.hpp"

// Private to the readers of recordings: what is learnt of all rows before frames are read.

namespace bch::detail::trajectory {

/// Counts different numbers, up to 2^20.
class IdCount {
 public:
  void add(std::int64_t id);
  /// Returns the number of ids; 0 where there were more.
  std::uint64_t count() const { return too_many_ ? 0 : count_; }

 private:
  std::vector<bool> small_;                          ///< from 0 on: whether there was that id
  std::unordered_set<std::int64_t, MixedHash> ids_;  ///< the others
  std::uint64_t count_ = 0;
  bool too_many_ = false;
};

/// Holds the steps from one key to the next that differs, of rows in order.
class StepCount {
 public:
  void add(std::int64_t step);
  bool empty() const { return counts_.empty(); }
  /// Returns the largest number that all steps are multiples of; 0 without steps.
  std::int64_t divisor() const { return divisor_; }
  /// Returns the step that occurs most often among the first 4096 different ones, the smallest of several; 0 without steps.
  std::int64_t max_common() const;

 private:
  std::map<std::int64_t, std::uint64_t> counts_;
  std::int64_t divisor_ = 0;
};

/// Holds what is counted of rows.
struct Survey {
  std::uint64_t rows = 0;
  std::int64_t first = 0, last = 0;  ///< keys
  IdCount ids;
  StepCount steps;  ///< as long as rows are in order

  void add(const Row& row);
};

/// Counts rows until one has a smaller key than the row before, and calls `check_cancelled`, which may throw, now and then.
/// Returns: whether none has.
bool survey_ordered(RowStream& rows, Survey& survey, const std::function<void()>& check_cancelled);

}  // namespace bch::detail::trajectory
