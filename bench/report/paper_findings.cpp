// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/paper_findings.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"

namespace bch::report {
namespace {

double query(const Results& results, std::string_view structure, std::string_view column,
             std::string_view pairs = "paper500") {
  return results("query_time").number({{"structure", structure}, {"pairs", pairs}}, column);
}

double query_ns(const Results& results, std::string_view structure) {
  return query(results, structure, "ns/pair");
}

double colliding_tests(const Results& results, std::string_view structure) {
  return query(results, structure, "node tests a pair", "colliding");
}

double missed(const Results& results, std::string_view structure) {
  return 100 - query(results, structure, "hits (%)", "colliding");
}

double distance(const Results& results, std::string_view structure) {
  return results("distance").number({{"structure", structure}}, "mean (cm)");
}

double depth_ns(const Results& results, std::string_view depth) {
  return results("depth").number({{"structure", "BCH outline"}, {"depth", depth}}, "colliding (ns/pair)");
}

std::string_view critical_depth(const Results& results) {
  const Table& table = results("depth_critical");
  return table.text(table.row({{"structure", kernel_name}}), "critical depth");
}

/// How many times as long a colliding pair takes of the finest mesh as of the coarsest.
double growth(const Results& results, std::string_view structure) {
  const Table& table = results("mesh_detail");
  const auto of = [&](std::size_t row) {
    return table.number({{"triangles", table.text(row, "triangles")}, {"structure", structure}},
                        "colliding (ns/pair)");
  };
  return of(table.rows().size() - 1) / of(0);
}

/// A finding of the paper, and whether our numbers say the same.
struct Finding {
  std::string_view name;
  bool (*is_reproduced)(const Results& results);
};
constexpr Finding findings[] = {
    {"outline queries",
     [](const Results& r) {
       return std::min(query_ns(r, "OBB outline"), query_ns(r, "OBB projected")) > query_ns(r, "BCH outline");
     }},
    {"tests",
     [](const Results& r) { return colliding_tests(r, "BCH outline") > colliding_tests(r, "OBB outline"); }},
    {"projected queries",
     [](const Results& r) { return query_ns(r, "BCH projected") / query_ns(r, "OBB projected") > 2; }},
    {"repeated",
     [](const Results& r) {
       return query_ns(r, "BCH outline") > query(r, "BCH outline", "ns/pair", "paper500_cached");
     }},
    {"fixed radii", [](const Results& r) { return missed(r, "fixed cylinder 0.25 m") > 0; }},
    {"centroid",
     [](const Results& r) {
       const double ratio = query_ns(r, "BCH outline") / query_ns(r, "BCH outline by centre");
       return ratio > 0.9 && ratio < 1.1;
     }},
    {"construction order",
     [](const Results& r) {
       return build_us(r, "OBB projected") < build_us(r, "OBB outline") + stage_us(r, "outline");
     }},
    {"interactive", [](const Results& r) { return stage_us(r, "all") > 1e6 / 60 / 100; }},
    {"detection",
     [](const Results& r) {
       return distance(r, "single cylinder") > distance(r, "BCH outline") &&
              distance(r, "BCH outline") > distance(r, "OBB outline");
     }},
    {"critical depth",
     [](const Results& r) {
       const std::string_view depth = critical_depth(r);
       return depth == "8" || depth == "9" || depth == "10";
     }},
    {"limited depth", [](const Results& r) { return depth_ns(r, "all") / depth_ns(r, "3") > 1.2; }},
    {"detail", [](const Results& r) { return growth(r, "OBB full mesh") > growth(r, kernel_name); }},
};

std::string verdict(const Results& results, std::string_view name) {
  for (const Finding& finding : findings)
    if (finding.name == name)
      return finding.is_reproduced(results) ? "<b>Reproduced.</b>" : "<b>Reversed.</b>";
  throw std::logic_error("the paper has no finding " + std::string(name));
}

}  // namespace

std::span<const Computed> paper_findings() {
  static constexpr Computed all[] = {
      {"verdict", verdict}, {"missed by", [](const Results& results, std::string_view radius) {
                               return brief(missed(results, "fixed cylinder " + std::string(radius)));
                             }}};
  return all;
}

}  // namespace bch::report
