// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Recordings of JuPedSim, of any bytes.

#include <string>

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/recording_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  const std::string bytes(data, data + size);
  if (!bytes.starts_with("SQLite format 3")) return 0;
  detail::TrajectoryOptions options;
  options.sort_memory = 0;
  static const fuzz::RewrittenFile file;
  file.write(bytes);
  fuzz::check_recording(file.path(), options);
  return 0;
}
