// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Recordings of the Pedestrian Dynamics Data Archive, of any bytes. The library itself crashes, and never ends, on some files, which is
// seen to be an error.

#include <pthread.h>

#include <chrono>
#include <string>
#ifdef BCH_SANITIZED
#include <sanitizer/common_interface_defs.h>
#endif

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/recording_checks.hpp"

namespace {

/// Keeps the child from writing down an input that the library crashes on: it is for the parent to see.
void forget_fuzzer() {
#ifdef BCH_SANITIZED
  __sanitizer_set_death_callback(nullptr);
#endif
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  const std::string bytes(data, data + size);
  if (!bytes.starts_with("\x89HDF")) return 0;
  detail::TrajectoryOptions options;
  options.sort_memory = 0;
  options.patience = std::chrono::milliseconds(500);
  static const fuzz::RewrittenFile file;
  static const int told = pthread_atfork(nullptr, nullptr, forget_fuzzer);
  fuzz::require(told == 0, "a fork can be prepared");
  file.write(bytes);
  fuzz::check_recording(file.path(), options);
  return 0;
}
