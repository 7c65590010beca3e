// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include "kernel/c_api/arguments.hpp"
#include "kernel/runtime/progress_report.hpp"

namespace bch::c_api {

/// Describes work of many parts: its threads, and what the caller hears of it.
class Work : public detail::ProgressReport {
 public:
  Work(const bch_work* given, std::size_t total)
      : Work(sized<bch_work>(given, BCH_WORK_INIT, "work"), total) {}

  std::uint32_t threads() const { return threads_; }

  /// Returns what C++ functions take for the caller's callback.
  static Function function_of(const bch_work& work) {
    if (work.progress == nullptr) return {};
    return [call = work.progress, user = work.user](std::size_t done, std::size_t total) {
      if (call(user, done, total) != 0) throw Failure(BCH_CANCELLED, "cancelled by the caller");
      return true;
    };
  }

 private:
  Work(const bch_work& work, std::size_t total)
      : ProgressReport(function_of(work), total), threads_(work.threads) {}

  const std::uint32_t threads_;
};

}  // namespace bch::c_api
