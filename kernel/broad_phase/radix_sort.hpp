// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {

/// Sorts fewer than 2^32 values by an unsigned key, stably, by least significant digits first. Keeps its
/// memory for the next call.
/// Threads: runs in the caller's TBB arena.
template <class Value>
class RadixSort {
 public:
  /// Sorts values by their keys, which are below 2^bits. May swap the vector's memory with its own.
  template <class Key>
  void sort(std::vector<Value>& values, unsigned bits, Key key) {
    const unsigned passes = (bits + max_digit_bits - 1) / max_digit_bits;
    sorted_.resize(values.size());
    for (unsigned pass = 0, shift = 0; pass < passes; ++pass) {
      const unsigned digit_bits = (bits - shift) / (passes - pass);
      const std::size_t digits = std::size_t{1} << digit_bits;
      move_by_digit(values, digits, [=](const Value& value) {
        return static_cast<std::size_t>(key(value) >> shift) & (digits - 1);
      });
      values.swap(sorted_);
      shift += digit_bits;
    }
  }

 private:
  static constexpr unsigned max_digit_bits = 11;  ///< so the positions of a block fit in a first-level cache
  static constexpr std::size_t least_block = 2048, max_blocks = 64;

  /// Counts the digits in each block of values, then moves the values to the positions that these counts
  /// determine.
  template <class Digit>
  void move_by_digit(const std::vector<Value>& values, std::size_t digits, Digit digit) {
    const std::size_t size = values.size();
    const std::size_t blocks = std::clamp<std::size_t>(size / least_block, 1, max_blocks);
    places_.assign(blocks * digits, 0);
    const auto each_block = [&](auto visit) {
      for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block) {
          std::uint32_t* const places = places_.data() + block * digits;
          const std::size_t end = size * (block + 1) / blocks;
          for (std::size_t i = size * block / blocks; i < end; ++i)
            visit(values[i], places[digit(values[i])]);
        }
      });
    };
    each_block([](const Value&, std::uint32_t& count) { ++count; });
    std::uint32_t next = 0;
    for (std::size_t d = 0; d < digits; ++d)
      for (std::size_t block = 0; block < blocks; ++block)
        next += std::exchange(places_[block * digits + d], next);
    each_block([this](const Value& value, std::uint32_t& place) { sorted_[place++] = value; });
  }

  std::vector<Value> sorted_;
  std::vector<std::uint32_t> places_;  ///< by block and digit
};

}  // namespace bch::detail
