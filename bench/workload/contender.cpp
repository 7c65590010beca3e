// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/contender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "bench/workload/answer_checks.hpp"

namespace bch::bench {
namespace {

Contender contender(std::function<void()> call, const Hits& hits) {
  return {
      std::move(call), hits.size(), {{"hits", static_cast<double>(std::count(hits.begin(), hits.end(), 1))}}};
}

}  // namespace

void require_right(std::string_view name, const Workload& workload, const std::string& wrong) {
  if (!wrong.empty()) throw std::runtime_error(fmt::format("{} on {}: {}", name, workload.name, wrong));
}

bool has_kind(std::string_view kind) {
  const auto kinds = baselines::kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const baselines::Kind& row) { return row.name == kind; });
}

Contender kernel_contender(Scene& scene, const Workload& workload, const QueryOptions& query,
                           const Implementation& implementation) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, hits,
                     options = QueryOptions{query.semantics, &implementation, query.leaves}] {
    collide(set, workload.agents(), workload.pairs, *hits, options);
  };
  call();
  require_right(implementation.name, workload, wrong_kernel(scene, workload, query, *hits));
  return contender(call, *hits);
}

Contender structure_contender(Scene& scene, const Workload& workload, std::string_view kind) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&structure = scene.structure(kind), &workload, hits] {
    structure.query(workload.agents(), workload.pairs, *hits);
  };
  call();
  require_right(kind, workload, wrong_structure(scene, workload, baselines::kind(kind), *hits));
  return contender(call, *hits);
}

}  // namespace bch::bench
