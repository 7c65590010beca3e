// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/survey.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace bch::detail::trajectory {

void IdCount::add(std::int64_t id) {
  constexpr std::size_t most = std::size_t{1} << 20;
  if (too_many_) return;
  if (id >= 0 && id < static_cast<std::int64_t>(most)) {
    const auto place = static_cast<std::size_t>(id);
    if (place >= small_.size()) small_.resize(std::max(place + 1, 2 * small_.size()));
    if (small_[place]) return;
    small_[place] = true;
    ++count_;
  } else {
    count_ += ids_.insert(id).second;
  }
  if (count_ <= most) return;
  too_many_ = true;
  ids_ = {}, small_ = {};
}

void StepCount::add(std::int64_t step) {
  constexpr std::size_t most = 4096;
  divisor_ = std::gcd(divisor_, step);
  if (counts_.size() < most || counts_.contains(step)) ++counts_[step];
}

std::int64_t StepCount::max_common() const {
  const auto common = std::max_element(counts_.begin(), counts_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return common == counts_.end() ? 0 : common->first;
}

void Survey::add(const Row& row) {
  if (rows > 0 && row.key > last) steps.add(row.key - last);
  first = rows == 0 ? row.key : std::min(first, row.key);
  last = rows == 0 ? row.key : std::max(last, row.key);
  ids.add(row.id);
  ++rows;
}

bool survey_ordered(RowStream& rows, Survey& survey, const std::function<void()>& check_cancelled) {
  std::vector<Row> batch(4096);
  while (const std::size_t count = rows.read_keys(batch)) {
    check_cancelled();
    for (std::size_t i = 0; i < count; ++i) {
      if (survey.rows > 0 && batch[i].key < survey.last) return false;
      survey.add(batch[i]);
    }
  }
  return true;
}

}  // namespace bch::detail::trajectory
