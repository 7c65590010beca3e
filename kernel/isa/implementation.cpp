// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/implementation.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/time_of_impact_arguments.hpp"
#include "kernel/simd/arguments.hpp"

namespace bch::kernel {

bool check_scalar(const Arguments&, std::size_t, std::size_t) noexcept;
AgentRange named_scalar(const Pair*, std::size_t, std::size_t) noexcept;
void run_scalar(const Arguments&, std::size_t, std::size_t) noexcept;
bool run_if_valid_scalar(const Arguments&, std::uint32_t) noexcept;
void count_contacts_scalar(const Arguments&, std::size_t, std::size_t, std::uint64_t*) noexcept;
void fill_contacts_scalar(const Arguments&, std::size_t, std::size_t, const std::uint64_t*,
                          DiscPair*) noexcept;
void clearance_scalar(const ClearanceArguments&, std::size_t, std::size_t) noexcept;
void time_of_impact_scalar(const TimeOfImpactArguments&, std::size_t, std::size_t) noexcept;
void extents_scalar(const CutDiscs&, const float*, const float*, std::uint32_t, float*, float*) noexcept;
bool check_sse2(const Arguments&, std::size_t, std::size_t) noexcept;
AgentRange named_sse2(const Pair*, std::size_t, std::size_t) noexcept;
void run_sse2(const Arguments&, std::size_t, std::size_t) noexcept;
bool run_if_valid_sse2(const Arguments&, std::uint32_t) noexcept;
void count_contacts_sse2(const Arguments&, std::size_t, std::size_t, std::uint64_t*) noexcept;
void fill_contacts_sse2(const Arguments&, std::size_t, std::size_t, const std::uint64_t*, DiscPair*) noexcept;
void clearance_sse2(const ClearanceArguments&, std::size_t, std::size_t) noexcept;
void time_of_impact_sse2(const TimeOfImpactArguments&, std::size_t, std::size_t) noexcept;
void extents_sse2(const CutDiscs&, const float*, const float*, std::uint32_t, float*, float*) noexcept;
bool check_avx2(const Arguments&, std::size_t, std::size_t) noexcept;
AgentRange named_avx2(const Pair*, std::size_t, std::size_t) noexcept;
void run_avx2(const Arguments&, std::size_t, std::size_t) noexcept;
bool run_if_valid_avx2(const Arguments&, std::uint32_t) noexcept;
void count_contacts_avx2(const Arguments&, std::size_t, std::size_t, std::uint64_t*) noexcept;
void fill_contacts_avx2(const Arguments&, std::size_t, std::size_t, const std::uint64_t*, DiscPair*) noexcept;
void clearance_avx2(const ClearanceArguments&, std::size_t, std::size_t) noexcept;
void time_of_impact_avx2(const TimeOfImpactArguments&, std::size_t, std::size_t) noexcept;
void extents_avx2(const CutDiscs&, const float*, const float*, std::uint32_t, float*, float*) noexcept;
bool check_avx512(const Arguments&, std::size_t, std::size_t) noexcept;
AgentRange named_avx512(const Pair*, std::size_t, std::size_t) noexcept;
void run_avx512(const Arguments&, std::size_t, std::size_t) noexcept;
bool run_if_valid_avx512(const Arguments&, std::uint32_t) noexcept;
void count_contacts_avx512(const Arguments&, std::size_t, std::size_t, std::uint64_t*) noexcept;
void fill_contacts_avx512(const Arguments&, std::size_t, std::size_t, const std::uint64_t*,
                          DiscPair*) noexcept;
void clearance_avx512(const ClearanceArguments&, std::size_t, std::size_t) noexcept;
void time_of_impact_avx512(const TimeOfImpactArguments&, std::size_t, std::size_t) noexcept;
void extents_avx512(const CutDiscs&, const float*, const float*, std::uint32_t, float*, float*) noexcept;

namespace {

// The compiler's test asks the operating system too, whether it saves the wide registers; xsimd 8.1's does
// not.
constexpr Implementation table[] = {
    {"avx512", 16, []() noexcept { return __builtin_cpu_supports("avx512f") != 0; }, check_avx512,
     named_avx512, run_avx512, run_if_valid_avx512, count_contacts_avx512, fill_contacts_avx512,
     extents_avx512, clearance_avx512, time_of_impact_avx512},
    {"avx2", 8, []() noexcept { return __builtin_cpu_supports("avx2") != 0; }, check_avx2, named_avx2,
     run_avx2, run_if_valid_avx2, count_contacts_avx2, fill_contacts_avx2, extents_avx2, clearance_avx2,
     time_of_impact_avx2},
    {"sse2", 4, []() noexcept { return true; }, check_sse2, named_sse2, run_sse2, run_if_valid_sse2,
     count_contacts_sse2, fill_contacts_sse2, extents_sse2, clearance_sse2, time_of_impact_sse2},
    {"scalar", 1, []() noexcept { return true; }, check_scalar, named_scalar, run_scalar, run_if_valid_scalar,
     count_contacts_scalar, fill_contacts_scalar, extents_scalar, clearance_scalar, time_of_impact_scalar},
};

const Implementation& choose() {
  if (const char* name = std::getenv("BCH_ISA")) return implementation(name);
  return *std::find_if(std::begin(table), std::end(table),
                       [](const Implementation& row) { return row.supported(); });
}

}  // namespace

std::span<const Implementation> implementations() noexcept {
  return table;
}

const Implementation& best_implementation() {
  static const Implementation& best = choose();
  return best;
}

const Implementation& implementation(std::string_view name) {
  std::string known;
  for (const Implementation& row : table) {
    if (name != row.name) {
      known += known.empty() ? row.name : std::string(", ") + row.name;
      continue;
    }
    if (!row.supported())
      throw std::invalid_argument("this processor does not run the implementation '" + std::string(name) +
                                  "'");
    return row;
  }
  throw std::invalid_argument("no implementation '" + std::string(name) + "' (known: " + known + ")");
}

}  // namespace bch::kernel
