// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/progress.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>

#include "bench/base/system.hpp"

namespace bch::cli {
namespace {

constexpr std::chrono::milliseconds first_after{1000};
constexpr std::chrono::milliseconds again_after{100};
constexpr std::size_t bar_width = 32;

std::string time_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {} s", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(is_terminal(standard_error)),
      next_(begin_ + first_after) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::show() {
  if (terminal_) draw(0);
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
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {} of {}", what_, "", filled, "", bar_width - filled, done,
             total_);
  if (done > 0) {
    const double rate = static_cast<double>(done) / seconds;
    fmt::print(stderr, ", {:.3g}/s, {} left", rate, time_text(static_cast<double>(total_ - done) / rate));
  }
  std::fputs("\033[K", stderr);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace bch::cli
