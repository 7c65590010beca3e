// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace bch::report {
namespace {

void add_front(const Table& points, std::string_view error, std::string_view pairs, Table& out) {
  const std::string time = std::string(pairs) + " (ns/pair)";
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < points.rows().size(); ++i)
    if (points.number(i, "missed collisions (%)") == 0 && !std::isnan(points.number(i, error)))
      rows.push_back(i);
  // The slower of two that err alike comes later, and is not faster than all before.
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      return std::tuple(points.number(i, error), points.number(i, time), i);
    };
    return key(a) < key(b);
  });
  double fastest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : rows) {
    const double nanoseconds = points.number(i, time);
    if (!(nanoseconds < fastest)) continue;
    fastest = nanoseconds;
    out.add({pairs, points.text(i, error), points.text(i, time), points.text(i, "structure"),
             points.text(i, "depth"), points.text(i, "threshold (cm)"), points.text(i, "semantics")});
  }
}

}  // namespace

Table front(const Table& points, std::string_view error) {
  Table out({"pairs", std::string(error), "ns/pair", "structure", "depth", "threshold (cm)", "semantics"});
  for (const std::string_view pairs : {"crowd", "near miss"}) add_front(points, error, pairs, out);
  return out;
}

}  // namespace bch::report
