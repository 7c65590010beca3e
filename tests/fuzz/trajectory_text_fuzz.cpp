// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Recordings as text, CSV and ndjson, of any bytes behind one that chooses options. What begins as SQLite or HDF5 is left to the targets
// of these.

#include <string>

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/recording_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  const std::uint32_t choice = bytes.below(256);
  detail::TrajectoryOptions options;
  if ((choice & 1) != 0) options.fps = 25;
  if ((choice & 2) != 0) options.unit = 0.01;
  if ((choice & 4) != 0)
    options.columns =
        (choice & 8) != 0 ? "frame,id,x,y" : "id,time [s],x/m,y/m,heading,z,character,clip,clip_time/ms";
  options.sort_memory = 0;
  const std::string text(bytes.rest().begin(), bytes.rest().end());
  if (text.starts_with("SQLite format 3") || text.starts_with("\x89HDF")) return 0;
  fuzz::check_recording(fuzz::MemoryFile(text).path(), options);
  return 0;
}
