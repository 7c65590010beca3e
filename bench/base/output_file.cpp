// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <random>

#include "bench/base/output.hpp"

namespace bch::cli {

namespace fs = std::filesystem;

bool is_replaced(const std::string& file) {
  std::error_code error;
  const fs::file_status there = fs::status(file, error);
  if (there.type() == fs::file_type::none) reject_output(file, error.value());
  if (fs::is_directory(there)) reject_output(file, EISDIR);
  return !fs::exists(there) || fs::is_regular_file(there);
}

std::string OutputFile::unforeseeable_name() {
  std::random_device random;
  return fmt::format(".bch-{:08x}{:08x}", random(), random());
}

void OutputFile::check(bool good) const {
  if (!good) reject_output(user_name_, errno);
}

void OutputFile::write(std::string_view bytes) {
  write_all(file_.number, bytes, user_name_);
}

}  // namespace bch::cli
