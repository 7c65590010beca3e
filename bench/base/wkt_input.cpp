// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/wkt_input.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {

std::string read_wkt(const std::string& name) {
  constexpr std::size_t max_of_a_pipe = std::size_t{256} << 20;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", name, std::strerror(errno)));
  std::error_code none;
  const bool ends = std::filesystem::is_regular_file(name, none);
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, file.get())) {
    text.append(buffer, size);
    if (std::memchr(buffer, '\0', size) != nullptr) return text;
    if (!ends && text.size() > max_of_a_pipe)
      throw InputError(name + ": is not a regular file, and has more than 256 MiB");
  }
  if (std::ferror(file.get()) != 0)
    throw InputError(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  return text;
}

ObstacleSet obstacles_of(const std::string& name, const std::string& text, Polygons polygons,
                         std::pair<double, double> heights) {
  try {
    return obstacles_from_wkt(text, polygons, heights.first, heights.second);
  } catch (const std::invalid_argument& error) {
    throw InputError(name + ": " + printable_line(error.what()));
  }
}

ObstacleSet read_obstacles(const std::string& name, Polygons polygons, std::pair<double, double> heights) {
  return obstacles_of(name, read_wkt(name), polygons, heights);
}

}  // namespace bch::cli
