// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

namespace bch::detail {

/// Requires that MPI was initialised so that other threads of the process may compute, TBB's: MPI_THREAD_FUNNELED at least.
/// Errors:  throws std::runtime_error with a line that says what there is.
void require_threads(int provided);

/// Keeps MPI from its initialisation to its end, for programs: one object, in main(). A program that ends without having come to
/// the end of its scope, by an error of one rank for instance, has to call abort().
class Session {
 public:
  /// Starts MPI.
  /// Errors:  throws std::runtime_error where MPI does not support the threads that the library needs.
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  MPI_Comm comm() const { return MPI_COMM_WORLD; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Ends all ranks with an exit code: others may wait for this one, and would for ever.
  [[noreturn]] void abort(int code) const;

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace bch::detail
