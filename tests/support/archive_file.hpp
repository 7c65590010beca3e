// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// A file of the Pedestrian Dynamics Data Archive or of JuPedSim, and ways in which it is none.
struct ArchiveFile {
  struct Row {
    std::int64_t id, frame;
    double x, y, z, ox = 0, oy = 0;
  };
  enum class Storage : std::uint8_t {
    contiguous,
    deflated,
    big_chunks,
    external_file,
    external_link,
    soft_link,
    scaled
  };

  std::vector<Row> rows{{1, 0, 1.5, 2, 1.76}, {2, 0, 3, 4, 0.5}, {1, 1, 1.75, 2, 1.76}};
  std::optional<double> fps = 25;
  std::optional<std::string> geometry = "POLYGON ((0 0, 1 0, 1 1, 0 0))";
  bool fixed_text = false;  ///< the geometry has a length, not an end
  bool fps_is_text = false;
  bool is_plane = false;  ///< two dimensions
  bool floats = false;    ///< of half the size
  bool x_is_integer = false;
  bool has_orientation = false;  ///< ox and oy, before all others
  bool ids_are_unsigned = false;
  std::uint64_t chunk = 2;  ///< rows, of those that are deflated
  std::optional<std::string> producer = std::nullopt;
  std::string name = "trajectory", z = "z";
  Storage storage = Storage::contiguous;

  void write(const std::filesystem::path& file) const;
};

}  // namespace bch::test
