// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// A glTF file of any bytes: it becomes a valid character that can be posed, or is refused with an ImportError of one
// line.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <bch/import.hpp>

#include "layout/character/skinning.hpp"
#include "tests/fuzz/target.hpp"

namespace bch::fuzz {
namespace {

std::filesystem::path write(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("bch_fuzz_" + std::to_string(getpid()) + ".gltf");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

void check(const Character& character) {
  validate(character);
  detail::Skinner skinner(character);
  skinner.pose({});
  for (const PoseTime& time : sample_poses(character, 3)) {
    try {
      skinner.pose(time);
    } catch (const std::domain_error&) {  // a pose between those that the import tries
    }
  }
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  const std::filesystem::path file = fuzz::write(data, size);
  try {
    fuzz::check(import_character(file).character);
  } catch (const ImportError& error) {
    fuzz::require(std::string(error.what()).find('\n') == std::string::npos, "errors are one line");
  }
  std::filesystem::remove(file);
  return 0;
}
