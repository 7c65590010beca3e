// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/scene.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::bench {
namespace {

Contender contender_of(std::function<void()> call, const Hits& hits, const std::string& wrong) {
  if (!wrong.empty()) throw std::runtime_error(wrong);
  const auto count = static_cast<double>(std::count(hits.begin(), hits.end(), 1));
  return {std::move(call), hits.size(), {{"hits", count}}};
}

Contender structure_contender(Scene& scene, const Workload& workload, const baselines::Kind& kind) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&structure = scene.structure(kind.name), &workload, hits] {
    structure.query(workload.agents(), workload.pairs, *hits);
  };
  call();
  return contender_of(call, *hits, wrong_structure(scene, workload, kind, *hits));
}

void add_kernel(Scene& scene, std::string_view name, const detail::AllOptions& query) {
  add_for_threads(fmt::format("collide/{}/{}/{}", name, name_of(query.leaves), query.implementation->name),
                  [&scene, name, query] {
                    const Workload& workload = scene.workload(name);
                    return collide_contender(
                        scene.set(), workload.agents(), workload.pairs, query,
                        [&](const Hits& hits) { return wrong_kernel(scene, workload, query.leaves, hits); });
                  });
}

}  // namespace

Contender collide_contender(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                            const detail::AllOptions& query,
                            const std::function<std::string(const Hits&)>& wrong) {
  const auto hits = std::make_shared<Hits>(pairs.size());
  const auto call = [&set, agents, pairs, query, hits] { collide(set, agents, pairs, *hits, query); };
  call();
  return contender_of(call, *hits, wrong(*hits));
}

Contender collide_contender(const ShapeSet& set, std::span<const Shape> shapes, const Workload& workload) {
  return collide_contender(set, workload.agents(), workload.pairs, disc_query, [&](const Hits& hits) {
    return wrong_answers({shapes, {}, Leaves::discs}, workload.agents(), workload.pairs, hits);
  });
}

std::vector<const Implementation*> supported_implementations() {
  std::vector<const Implementation*> supported;
  for (const Implementation& implementation : implementations())
    if (implementation.supported()) supported.push_back(&implementation);
  return supported;
}

void add_collide(Scene& scene) {
  for (const std::string_view name : workload_names()) {
    for (const Implementation* implementation : supported_implementations())
      for (const Leaves leaves : {Leaves::discs, Leaves::segments})
        add_kernel(scene, name, {implementation, leaves});
    for (const baselines::Kind& kind : baselines::kinds())
      add(fmt::format("collide/{}/{}", name, kind.name),
          [&scene, name, &kind] { return structure_contender(scene, scene.workload(name), kind); });
  }
}

}  // namespace bch::bench
