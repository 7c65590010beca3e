// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/failure.hpp"

#include <algorithm>
#include <cstring>
#include <new>

#include <bch/files.hpp>
#include <bch/version.hpp>

namespace bch::c_api {
namespace {

/// In no memory that could run out; a longer message loses its end.
thread_local char last_error[2048] = "";

bch_status remember(bch_status status, const char* message) noexcept {
  const std::size_t size = std::min(std::strlen(message), sizeof last_error - 1);
  // One line, whatever a path or a text has.
  std::replace_copy(message, message + size, last_error, '\n', ' ');
  last_error[size] = '\0';
  return status;
}

constexpr const char* names[] = {"BCH_OK",        "BCH_INVALID_ARGUMENT", "BCH_OUT_OF_RANGE",
                                 "BCH_TOO_LARGE", "BCH_NO_MEMORY",        "BCH_FILE_NOT_FOUND",
                                 "BCH_BAD_FILE",  "BCH_CANCELLED",        "BCH_INTERNAL"};

}  // namespace

bch_status status_of_exception(const std::exception_ptr& exception) noexcept {
  try {
    std::rethrow_exception(exception);
  } catch (const Failure& error) {
    return remember(error.status, error.what());
  } catch (const BakedFileError& error) {
    return remember(BCH_BAD_FILE, error.what());
  } catch (const std::bad_alloc&) {
    return remember(BCH_NO_MEMORY, "out of memory");
  } catch (const std::out_of_range& error) {
    return remember(BCH_OUT_OF_RANGE, error.what());
  } catch (const std::length_error& error) {
    return remember(BCH_TOO_LARGE, error.what());
  } catch (const std::logic_error& error) {  // invalid_argument and domain_error
    return remember(BCH_INVALID_ARGUMENT, error.what());
  } catch (const std::exception& error) {
    return remember(BCH_INTERNAL, error.what());
  } catch (...) {
    return remember(BCH_INTERNAL, "an unknown exception");
  }
}

}  // namespace bch::c_api

using namespace bch::c_api;

uint32_t bch_abi_version(void) {
  return BCH_ABI_VERSION;
}

const char* bch_version(void) {
  static_assert(BCH_VERSION_MAJOR < 10 && BCH_VERSION_MINOR < 100 && BCH_VERSION_PATCH < 100);
#define BCH_TEXT(number) #number
#define BCH_TEXT_OF(number) BCH_TEXT(number)
  return BCH_TEXT_OF(BCH_VERSION_MAJOR) "." BCH_TEXT_OF(BCH_VERSION_MINOR) "." BCH_TEXT_OF(BCH_VERSION_PATCH);
}

const char* bch_status_name(bch_status status) {
  return status >= 0 && status < static_cast<bch_status>(std::size(names)) ? names[status] : "unknown";
}

const char* bch_last_error(void) {
  return last_error;
}
