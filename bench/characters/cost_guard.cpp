// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/cost_guard.hpp"

#include <fmt/format.h>

#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/system.hpp"

namespace bch::cli {
namespace {

constexpr std::chrono::milliseconds check_interval{50};

std::string names_of(std::span<const LoadedCharacter> characters) {
  if (characters.size() == 1) return characters.front().source;
  return fmt::format("{} and {} more", characters.front().source, characters.size() - 1);
}

}  // namespace

CostGuard::CostGuard(const CostLimits& limits, std::span<const LoadedCharacter> characters,
                     std::size_t shapes)
    : files_(names_of(characters)),
      seconds_(limits.seconds_for(shapes)),
      memory_(limits.memory_for(shapes)),
      watcher_([this] { watch(); }) {}

CostGuard::~CostGuard() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_one();
  watcher_.join();
}

void CostGuard::watch() {
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, check_interval, [this] { return is_over_; })) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    if (taken.count() > seconds_)
      exit_now(exit_bad_input, fmt::format("{}: building and writing its shapes takes more than {:g} s; "
                                           "--max-seconds raises the limit",
                                           files_, seconds_));
    if (own_memory() > memory_)
      exit_now(exit_bad_input, fmt::format("{}: building and writing its shapes takes more than {:g} GiB of "
                                           "memory; --max-memory raises the limit",
                                           files_, memory_));
  }
}

}  // namespace bch::cli
