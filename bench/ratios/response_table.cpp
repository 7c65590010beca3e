// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cstdio>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/response_contenders.hpp"

namespace bch::bench {

void print_response_ratios(Scene& scene, std::uint32_t runs) {
  const kernel::Implementation& best = kernel::best_implementation();
  const Workload& crowd = scene.workload("crowd");
  const auto pairs = static_cast<double>(crowd.pairs.size());
  fmt::print("response, crowd, {}: {} pairs\n", best.name, cli::grouped(crowd.pairs.size()));
  for (const TimedQuery& query : response_queries()) {
    std::vector<Contender> contenders = {kernel_contender(scene, crowd, disc_query, best),
                                         query.kernel(scene, crowd, best)};
    if (query.reference != nullptr) contenders.push_back(query.reference(scene, crowd));
    race(contenders, runs, 1);
    const double collide = contenders[0].nanoseconds, own = contenders[1].nanoseconds;
    fmt::print("  {:12}{:7.1f} ns over collide's {:.1f}: {:.2f} x", query.name, own / pairs, collide / pairs,
               own / collide);
    if (contenders.size() > 2)
      fmt::print("; brute force {:.0f} ns: {:.1f} x as long", contenders[2].nanoseconds / pairs,
                 contenders[2].nanoseconds / own);
    fmt::print("\n");
  }
  std::fflush(stdout);
}

}  // namespace bch::bench
