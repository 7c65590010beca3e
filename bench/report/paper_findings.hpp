// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "bench/report/experiment.hpp"

namespace bch::report {

/// Returns a section in HTML: each finding of the paper beside what we measured, reproduced or reversed, and
/// why. A finding whose tables are missing is left out.
std::string paper_findings(const std::function<bool(std::string_view table)>& has, const Results& results);

}  // namespace bch::report
