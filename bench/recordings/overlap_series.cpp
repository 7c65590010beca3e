// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/overlap_series.hpp"

#include <algorithm>

#include "bench/recordings/embedding.hpp"

namespace bch::cli {

void OverlapSeries::add(double seconds, std::uint32_t overlapping, std::uint32_t people) {
  if (!seconds_.empty() && in_last_ < length_) {
    ++in_last_;
    overlapping_.back() = std::max(overlapping_.back(), overlapping);
    people_.back() = std::max(people_.back(), people);
    return;
  }
  if (seconds_.size() == most_stretches) {
    for (std::size_t i = 0; i < most_stretches / 2; ++i) {
      seconds_[i] = seconds_[2 * i];
      overlapping_[i] = std::max(overlapping_[2 * i], overlapping_[2 * i + 1]);
      people_[i] = std::max(people_[2 * i], people_[2 * i + 1]);
    }
    for (auto* const column : {&overlapping_, &people_}) column->resize(most_stretches / 2);
    seconds_.resize(most_stretches / 2);
    length_ *= 2;
  }
  in_last_ = 1;
  seconds_.push_back(seconds);
  overlapping_.push_back(overlapping);
  people_.push_back(people);
}

std::string OverlapSeries::blocks() const {
  return number_block("series-seconds", seconds_) + number_block("series-overlapping", overlapping_) +
         number_block("series-people", people_);
}

}  // namespace bch::cli
