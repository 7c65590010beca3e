// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/agreement.hpp"

#include <new>
#include <sstream>
#include <string>

#include <bch/distributed_crowd.hpp>

namespace bch::detail {
namespace {

std::string message_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception of no known type";
  }
}

/// Sends the message of one rank to all.
std::string message_to_all(MPI_Comm comm, int from, std::string message) {
  int size = static_cast<int>(message.size());
  MPI_Bcast(&size, 1, MPI_INT, from, comm);
  message.resize(static_cast<std::size_t>(size));
  MPI_Bcast(message.data(), size, MPI_CHAR, from, comm);
  return message;
}

}  // namespace

void agree_on(MPI_Comm comm, const std::exception_ptr& failure) {
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  int failed = failure == nullptr ? size : rank;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, comm);
  if (failed == size) return;
  std::ostringstream message;
  if (failed == rank) message << "rank " << rank << ": " << message_of(failure);
  throw RankError(failed, message_to_all(comm, failed, message.str()));
}

void agree(MPI_Comm comm, const std::function<void()>& work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  agree_on(comm, failure);
}

}  // namespace bch::detail
