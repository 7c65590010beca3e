// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <cstdint>

namespace bch::cli {

/// Sets how many threads work during this object's lifetime; 0: all.
class Threads {
 public:
  explicit Threads(std::uint32_t wanted)
      : count(wanted == 0 ? static_cast<unsigned>(tbb::info::default_concurrency()) : wanted),
        control_(tbb::global_control::max_allowed_parallelism, count) {}

  const unsigned count;

 private:
  tbb::global_control control_;
};

}  // namespace bch::cli
