// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/wkt_input.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "bench/base/exit_codes.hpp"
#include "bench/base/printable.hpp"

namespace bch::cli {

ObstacleSet read_obstacles(const std::string& name, Polygons polygons, std::pair<double, double> heights) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "re"), std::fclose);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", name, std::strerror(errno)));
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, file.get())) text.append(buffer, size);
  if (std::ferror(file.get()) != 0)
    throw InputError(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  try {
    return obstacles_from_wkt(text, polygons, heights.first, heights.second);
  } catch (const std::invalid_argument& error) {
    throw InputError(name + ": " + printable_line(error.what()));
  }
}

}  // namespace bch::cli
