// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>

#include <bch/distributed_crowd.hpp>

#include "kernel/distributed/session.hpp"

// A simulator of which rank 1 fails in the third step: by an exception of its own, of which the library knows nothing, or by SIGKILL. The
// others are in update() then, and wait for it. Or one that initialises MPI for no threads.

namespace {

using namespace bch;

void step(DistributedCrowd& crowd, bool fails, const std::string& how) {
  if (fails && how == "kill") std::raise(SIGKILL);
  if (fails) throw std::runtime_error("the simulator has a fault");
  crowd.update();
  crowd.collide_all();
}

int without_threads() {
  int provided, code = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SINGLE, &provided);
  try {
    DistributedCrowd(MPI_COMM_WORLD, ShapeSet(std::vector<Shape>{}), {});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "failing_rank: %s\n", error.what());
    code = 7;
  }
  MPI_Finalize();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  if (argv[1] == std::string("without_threads")) return without_threads();
  const detail::Session session(argc, argv);
  const std::vector<Disc> discs{{0, 0, 0.3f}};
  const ShapeSet set(std::vector<Shape>{shape_from_discs(discs)});
  try {
    DistributedCrowd crowd(session.comm(), set, {});
    for (int i = 0; i < 5; ++i) step(crowd, session.rank() == 1 && i == 2, argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "failing_rank: rank %d: %s\n", session.rank(), error.what());
    session.abort(7);
  }
  return 0;
}
