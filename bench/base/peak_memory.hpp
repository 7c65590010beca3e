// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::bench {

/// Measures how much more memory the process occupies at most, from here on, than it did here. Where the
/// system cannot reset the earlier peak, that peak counts: too much rather than too little.
class PeakMemory {
 public:
  PeakMemory();
  std::size_t bytes() const;

 private:
  std::size_t begin_;
};

}  // namespace bch::bench
