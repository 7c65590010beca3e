// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "bench/workload/motions.hpp"

namespace bch::bench {

/// Tells when the outlines of the pairs of a scene first meet, beside their first contacts. Outlines are looked at a thousand times a
/// second, each that of a pose made for the very time, and meet where they cross or one holds a part of the other, by exact tests.
struct OutlineContacts {
  std::uint64_t compared = 0;  ///< pairs of outlines, whose circles overlap
  std::size_t meeting = 0;     ///< pairs of motions whose outlines meet
  std::size_t late = 0;        ///< those of them whose first contact is behind that
  double latest = 0;           ///< by how much at most, seconds
  double ahead = 0;            ///< how long it is before that otherwise, in the mean, seconds
};

/// Looks at each pair until its outlines meet, on all threads. Keeps an outline for each millisecond of the clips meanwhile.
OutlineContacts outline_contacts(const MotionScene& scene);

}  // namespace bch::bench
