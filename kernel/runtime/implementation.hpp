// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace bch {
struct Contact;
struct CutDiscs;
struct Pair;
}  // namespace bch

namespace bch::kernel {

struct Arguments;
struct ClearanceArguments;
struct ContactTimeArguments;

/// The lowest agent of some, and the highest. Of none, the lowest is above the highest.
struct AgentRange {
  std::uint32_t low, high;
};

/// One compilation of the kernels.
struct Implementation {
  const char* name;  ///< "avx512", "avx2", "sse2" or "scalar"
  unsigned width;    ///< floats side by side
  bool (*supported)() noexcept;
  /// Whether agents begin .. end are valid, as collide() asks of them.
  bool (*check)(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Those that pairs begin .. end name.
  AgentRange (*named)(const Pair* pairs, std::size_t begin, std::size_t end) noexcept;
  /// Writes the codes of pairs begin .. end; see Arguments. Needs 256 KiB of stack and no other memory.
  void (*run)(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// The same of the first `count` pairs, one or more and at most a chunk, that nobody has looked at, nor at agents:
  /// false, and nothing is written, unless they are surely valid. For small batches, where looking first takes longer.
  bool (*run_if_valid)(const Arguments& arguments, std::uint32_t count) noexcept;
  /// How many contacts each of pairs begin .. end has, to counts[begin] .. counts[end].
  void (*count_contacts)(const Arguments& arguments, std::size_t begin, std::size_t end,
                         std::uint64_t* counts) noexcept;
  /// Those of pair i to contacts[offsets[i]] .. contacts[offsets[i + 1]].
  void (*fill_contacts)(const Arguments& arguments, std::size_t begin, std::size_t end,
                        const std::uint64_t* offsets, Contact* contacts) noexcept;
  /// The interval that discs take along each of so many axes: of c . axis - r the least, of c . axis + r the largest.
  void (*extents)(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                  float* low, float* high) noexcept;
  /// Writes the nearest discs of pairs begin .. end, with as much stack as run(); see ClearanceArguments.
  void (*clearance)(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Writes the times of contact of those pairs begin .. end that do not overlap now; see ContactTimeArguments.
  void (*contact_time)(const ContactTimeArguments& arguments, std::size_t begin, std::size_t end) noexcept;
};

/// All that were compiled, the best first; the last one runs everywhere.
std::span<const Implementation> implementations() noexcept;

/// The first that this processor and its operating system support. The environment variable BCH_ISA, read
/// once, may name another; throws std::invalid_argument if that one is unknown or not supported.
const Implementation& best_implementation();

/// Errors:  throws std::invalid_argument naming the known ones on an unknown name, or one this processor does
///          not run.
const Implementation& implementation(std::string_view name);

}  // namespace bch::kernel
