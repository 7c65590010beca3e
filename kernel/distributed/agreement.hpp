// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <exception>
#include <functional>

namespace bch::detail {

/// Runs work() on every rank of a communicator and waits for all. Where one throws, all throw RankError with the message of the
/// lowest rank that did. The work must not talk to other ranks: they might have failed.
void agree(MPI_Comm comm, const std::function<void()>& work);

/// Throws RankError on all ranks where `failure` is set on one; one call of MPI where there is none.
void agree_on(MPI_Comm comm, const std::exception_ptr& failure);

}  // namespace bch::detail
