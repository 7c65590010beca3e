// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/frame_reader.hpp"
#include "layout/recordings/jupedsim.hpp"
#include "layout/recordings/ndjson.hpp"
#include "layout/recordings/pedestrian_archive.hpp"
#include "layout/recordings/row.hpp"
#include "layout/recordings/table.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::detail {
namespace trajectory {
namespace {

/// Returns the first bytes of a file.
/// Errors:  throws TrajectoryError on what is no file, or an empty one.
std::string beginning(const Places& places) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(places.file, none);
  // A pipe would wait for a writer.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    places.reject("is not a file");
  std::ifstream file(places.file, std::ios::binary);
  if (!file) places.reject(std::string("cannot be opened: ") + std::strerror(errno));
  std::string bytes(4096, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.bad()) places.reject(std::string("cannot be read: ") + std::strerror(errno));
  if (file.gcount() == 0) places.reject("is empty");
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_json(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{';
}

std::unique_ptr<RowSource> open_rows(const std::filesystem::path& file, const TrajectoryOptions& options) {
  const std::string bytes = beginning({file, false});
  if (bytes.starts_with(std::string_view("SQLite format 3\0", 16))) return open_jupedsim(file, options);
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return open_pedestrian_archive(file, options);
  if (is_json(bytes)) return open_ndjson(file, options);
  return open_table(file, options);
}

void check_options(const Places& places, const TrajectoryOptions& options) {
  if (options.fps) checked_fps(places, *options.fps, "the frame rate of --fps");
  if (options.unit && !(*options.unit > 0 && is_finite(*options.unit)))
    places.reject("the unit of --unit is " + shortest(*options.unit) + " m, not above 0");
}

}  // namespace
}  // namespace trajectory

std::unique_ptr<TrajectoryReader> open_columns(std::vector<ColumnView> columns, std::size_t rows,
                                               const TrajectoryOptions& options) {
  trajectory::check_options({trajectory::table_in_memory, false}, options);
  return std::make_unique<trajectory::FrameReader>(
      trajectory::open_column_table(std::move(columns), rows, options), options);
}

std::unique_ptr<TrajectoryReader> open_trajectory(const std::filesystem::path& file,
                                                  const TrajectoryOptions& options) {
  trajectory::check_options({file, false}, options);
  return std::make_unique<trajectory::FrameReader>(trajectory::open_rows(file, options), options);
}

}  // namespace bch::detail
