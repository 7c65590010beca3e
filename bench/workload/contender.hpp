// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// Represents something to be timed, whose answers were compared.
struct Contender {
  std::function<void()> call;
  std::size_t items = 1;                        ///< of a call: pairs, agents or poses
  std::map<std::string, double> counters = {};  ///< what else is worth telling
};

/// Checks that nothing is wrong: throws std::runtime_error if `wrong` is not empty.
void require_right(std::string_view name, const Workload& workload, const std::string& wrong);

/// Returns whether this build has the kind.
bool has_kind(std::string_view kind);

}  // namespace bch::bench
