// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace bch::cli {
namespace {

constexpr std::chrono::milliseconds first_after{1000};
constexpr std::chrono::milliseconds again_after{100};
constexpr std::size_t bar_width = 32;

}  // namespace

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + first_after) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::advance() {
  const std::size_t done = ++done_;
  if (!terminal_) return;
  // A thread that finds another one drawing has better things to do than wait.
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock || Clock::now() < next_) return;
  draw(done);
  next_ = Clock::now() + again_after;
}

void Progress::draw(std::size_t done) {
  const std::size_t filled = total_ == 0 ? bar_width : done * bar_width / total_;
  fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {} of {}\033[K", what_, "", filled, "", bar_width - filled, done,
             total_);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace bch::cli
