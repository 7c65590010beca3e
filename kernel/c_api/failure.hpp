// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <exception>
#include <stdexcept>
#include <string>

#include <bch/bch.h>

namespace bch::c_api {

/// Reports what a function of the C interface fails with.
class Failure : public std::runtime_error {
 public:
  Failure(bch_status what, const std::string& message) : std::runtime_error(message), status(what) {}
  const bch_status status;
};

/// Remembers the message of an exception for bch_last_error(). Allocates nothing. The exception is an argument, because the library of files
/// may have a C++ library of its own, which knows another one as the present exception.
/// Returns: its status.
bch_status status_of_exception(const std::exception_ptr& exception) noexcept;

/// Runs the body of a function: its exceptions become statuses.
template <class Body>
bch_status guarded(Body body) noexcept {
  try {
    body();
    return BCH_OK;
  } catch (...) {
    return status_of_exception(std::current_exception());
  }
}

}  // namespace bch::c_api
