// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include "bench/base/options.hpp"

namespace bch::cli {

Threads::Threads(std::uint32_t wanted)
    : count(wanted == 0 ? static_cast<unsigned>(tbb::info::default_concurrency()) : wanted),
      limit_(std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count)) {}

}  // namespace bch::cli
