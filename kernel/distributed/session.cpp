// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/session.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace bch::detail {
namespace {

const char* name_of(int provided) {
  return provided == MPI_THREAD_SINGLE ? "MPI_THREAD_SINGLE" : "a level of threads that is not known";
}

}  // namespace

void require_threads(int provided) {
  if (provided >= MPI_THREAD_FUNNELED) return;
  throw std::runtime_error(std::string("MPI provides ") + name_of(provided) +
                           ", and MPI_THREAD_FUNNELED is needed: threads of TBB compute beside it");
}

Session::Session(int& argc, char**& argv) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  require_threads(provided);
  MPI_Comm_rank(comm(), &rank_);
  MPI_Comm_size(comm(), &size_);
}

Session::~Session() {
  MPI_Finalize();
}

void Session::abort(int code) const {
  MPI_Abort(comm(), code);
  std::abort();  // not reached
}

}  // namespace bch::detail
