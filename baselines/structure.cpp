// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/structure.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "baselines/kind_rows.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"

namespace bch::baselines {
namespace {

constexpr Kind own_kinds[] = {
    {"reference", "cylinders over the outline, depth first", Truth::none, true, true, build_reference},
    {"reference_segments", "the same with exact leaves, and outlines inside others", Truth::none, true, true,
     build_reference_segments},
    {"paper_descent", "the same, whose hits nothing verifies", Truth::none, true, true, build_paper_descent},
    {"single", "one cylinder a pose", Truth::none, true, false, build_single},
    {"fixed", "one cylinder for all poses", Truth::none, false, false, build_fixed},
    {"bch_projected", "cylinders over the triangles seen from above", Truth::projection, false, true,
     build_bch_projected},
    {"obb_full", "oriented boxes over the triangles", Truth::mesh, false, true, build_obb_full},
    {"obb_contour", "oriented boxes over the outline", Truth::outline, true, true, build_obb_contour},
    {"obb_contour_2d", "oriented rectangles over the outline", Truth::outline, true, true,
     build_obb_contour_2d},
    {"obb_projected", "oriented boxes over the triangles seen from above", Truth::projection, false, true,
     build_obb_projected},
};

template <class... Parts>
[[noreturn]] void reject(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

bool in_range(double value, double limit) {
  return std::abs(value) <= limit;  // false for NaN
}

void validate_agent(const Agents& agents, std::uint32_t agent, std::uint32_t shapes, std::size_t pair) {
  if (agent >= agents.size()) reject("pair ", pair, ": agent ", agent, " of ", agents.size());
  if (agents.shape[agent] >= shapes)
    reject("pair ", pair, ": agent ", agent, ": shape ", agents.shape[agent], " of ", shapes);
  if (!in_range(agents.x[agent], detail::rounding::largest_position) ||
      !in_range(agents.y[agent], detail::rounding::largest_position))
    reject("pair ", pair, ": agent ", agent, ": position (", agents.x[agent], ", ", agents.y[agent], ")");
  const auto [x, y, is_direction] = agents.heading[agent];
  if (is_direction ? !detail::is_unit(x, y) : !in_range(x, detail::rounding::largest_heading))
    reject("pair ", pair, ": agent ", agent, ": heading ", x);
  if (!agents.z.empty() && !in_range(agents.z[agent], detail::rounding::largest_position))
    reject("pair ", pair, ": agent ", agent, ": height ", agents.z[agent]);
}

}  // namespace

void Structure::query(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
                      std::uint32_t max_depth) const {
  if (agents.x.size() != agents.size() || agents.y.size() != agents.size() ||
      agents.heading.size() != agents.size())
    reject("agents: ", agents.size(), " shapes but ", agents.x.size(), ", ", agents.y.size(), " and ",
           agents.heading.size(), " values of x, y and heading");
  if (!agents.z.empty() && agents.z.size() != agents.size())
    reject("agents: ", agents.size(), " shapes but ", agents.z.size(), " values of z");
  if (hits.size() != pairs.size()) reject(pairs.size(), " pairs but room for ", hits.size(), " hits");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    validate_agent(agents, pairs[i].first, shape_count(), i);
    validate_agent(agents, pairs[i].second, shape_count(), i);
  }
  answer(agents, pairs, hits, max_depth);
}

std::span<const Kind> kinds() {
  static const std::vector<Kind> all = [] {
    std::vector<Kind> rows(std::begin(own_kinds), std::end(own_kinds));
    const auto peers = fcl_kinds();
    rows.insert(rows.end(), peers.begin(), peers.end());
    return rows;
  }();
  return all;
}

const Kind& kind(std::string_view name) {
  const auto all = kinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Kind& row) { return row.name == name; });
  if (found != all.end()) return *found;
  std::string known;
  for (const Kind& row : all) known += (known.empty() ? "" : ", ") + std::string(row.name);
  throw std::invalid_argument("no structure '" + std::string(name) + "' (known: " + known + ")");
}

}  // namespace bch::baselines
