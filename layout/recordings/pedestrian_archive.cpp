// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/pedestrian_archive.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "layout/base/child_process.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/hdf5_recording.hpp"

// A child process reads the file and sends what it holds: a header, the geometry, the rows; or an error.

namespace bch::detail::trajectory {
namespace {

constexpr std::size_t max_geometry = std::size_t{1} << 24;
constexpr std::uint64_t max_compression = 1032;  // of deflate
constexpr std::size_t archive_rows = 4096;

enum Answer : std::uint64_t { is_recording = 1, is_error = 2 };

/// What the child says first.
struct Header {
  std::uint64_t answer = is_recording;
  std::uint64_t text = 0;  ///< bytes of the geometry, or of the error, that follow
  std::uint64_t rows = 0, bytes_a_row = 0;
  double fps = 0;
  std::uint64_t is_of_jupedsim = 0, ids_are_unsigned = 0;  ///< or 1
};

template <class Value>
std::span<const char> bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

void send_rows(const Hdf5Recording& file, std::uint64_t rows, int to) {
  std::vector<ArchiveRow> batch(archive_rows);
  for (std::uint64_t first = 0; first < rows;) {
    const std::size_t count = std::min<std::uint64_t>(archive_rows, rows - first);
    const std::span<ArchiveRow> part(batch.data(), count);
    file.read(first, part);
    write_or_exit(to, {reinterpret_cast<const char*>(part.data()), part.size_bytes()});
    first += count;
  }
}

/// The child's work. What is wrong with rows comes too late for a message: the parent sees that they end.
void send(const std::filesystem::path& path, int to) {
  Header header;
  bool begun = false;
  try {
    const Hdf5Recording file(path.string());
    const std::string geometry = file.geometry();
    header = {is_recording,
              geometry.size(),
              file.rows(),
              file.bytes_a_row(),
              file.fps(),
              std::uint64_t{file.is_of_jupedsim()},
              std::uint64_t{file.ids_are_unsigned()}};
    begun = true;
    write_or_exit(to, bytes_of(header));
    write_or_exit(to, geometry);
    send_rows(file, header.rows, to);
  } catch (const std::exception& problem) {
    if (begun) return;
    const std::string reason =
        dynamic_cast<const std::bad_alloc*>(&problem) != nullptr ? "needs too much memory" : problem.what();
    write_or_exit(to, bytes_of(Header{is_error, reason.size()}));
    write_or_exit(to, reason);
  }
}

class PedestrianArchive final : public RowSource {
 public:
  PedestrianArchive(const std::filesystem::path& file, const TrajectoryOptions& options)
      : places_{file, false},
        metres_(options.unit.value_or(1)),
        patience_(options.patience),
        go_on_(options.go_on) {
    begin();
    if (header_.fps != 0 && !options.fps) rate_ = checked_fps(places_, header_.fps, "the attribute 'fps'");
  }

  const Places& places() const override { return places_; }

  Recording recording() const override {
    Recording all;
    all.format =
        header_.is_of_jupedsim != 0 ? "JuPedSim HDF5" : "HDF5 of the Pedestrian Dynamics Data Archive";
    all.geometry = geometry_;
    if (geometry_.empty()) all.assumptions.emplace_back("There are no walls: the file has no geometry.");
    heights_.describe(all.assumptions);
    if (has_floors_) all.assumptions.emplace_back("z is the height of the floor, and is ignored.");
    all.rate = rate_;
    return all;
  }

  std::size_t read(std::span<Row> rows) override {
    const std::size_t count = static_cast<std::size_t>(
        std::min<std::uint64_t>({rows.size(), archive_rows, header_.rows - number_}));
    ArchiveRow batch[archive_rows];
    receive({reinterpret_cast<char*>(batch), count * sizeof(ArchiveRow)});
    for (std::size_t i = 0; i < count; ++i) rows[i] = row(batch[i]);
    return count;
  }

  void rewind() override {
    if (number_ > 0) begin();
  }

 private:
  Places places_;
  double metres_;
  std::chrono::milliseconds patience_;
  std::function<bool()> go_on_;
  std::optional<double> rate_;
  std::optional<ChildProcess> child_;
  Header header_;
  std::string geometry_;
  Heights heights_;
  bool has_floors_ = false;   ///< heights of floors other than 0
  std::uint64_t number_ = 0;  ///< of the row that was read last

  void begin() {
    number_ = 0;
    ChildLimits limits;
    limits.cpu_time = std::chrono::minutes(10);
    child_.emplace(limits, [file = places_.file](int to) { send(file, to); });
    char bytes[sizeof header_];
    receive(bytes);
    std::memcpy(&header_, bytes, sizeof header_);
    if (header_.text > max_geometry) places_.reject("malformed: HDF5 crashes on it");
    std::string text(header_.text, '\0');
    receive(text);
    if (header_.answer != is_recording) places_.reject(text);
    geometry_ = std::move(text);
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(places_.file, ignored);
    if (header_.rows / max_compression > size / std::max<std::uint64_t>(header_.bytes_a_row, 1) + 1)
      places_.reject("malformed: " + std::to_string(header_.rows) + " rows do not fit into it");
  }

  /// Waits until all bytes are there.
  void receive(std::span<char> bytes) {
    auto until = std::chrono::steady_clock::now() + patience_;
    while (!bytes.empty()) {
      const std::optional<std::size_t> got =
          child_->read(bytes, std::min<std::chrono::milliseconds>(patience_, std::chrono::seconds(1)));
      if (got == std::size_t{0}) reject_end();
      if (go_on_ && !go_on_()) places_.reject("reading it was cancelled");
      const auto now = std::chrono::steady_clock::now();
      if (got) {
        bytes = bytes.subspan(*got);
        until = now + patience_;
      } else if (now >= until) {
        places_.reject("HDF5 reads it for more than " + std::to_string(patience_.count()) +
                       " ms without an end");
      }
    }
  }

  /// Says why the child ended too early.
  [[noreturn]] void reject_end() {
    const int status = child_->wait();
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
      places_.reject("reading it takes more than 10 minutes");
    if (WIFSIGNALED(status) || WEXITSTATUS(status) != 0) places_.reject("malformed: HDF5 crashes on it");
    places_.reject(number_ + 1, "malformed or truncated: cannot be read by HDF5");
  }

  [[noreturn]] void reject(const char* name, double value, const std::string& reason) const {
    places_.reject(number_, std::string(name) + " " + shown(shortest(value)) + " " + reason);
  }

  double coordinate(const char* name, double value) const {
    const double metres = value * metres_;
    if (!is_coordinate(metres)) reject(name, value, coordinate_fault(metres));
    return metres;
  }

  /// (0, 0) and NaN say nothing.
  float heading(const ArchiveRow& from) const {
    if (is_infinite(from.ox)) reject("ox", from.ox, "is not finite");
    if (is_infinite(from.oy)) reject("oy", from.oy, "is not finite");
    if ((from.ox == 0 && from.oy == 0) || is_nan(from.ox) || is_nan(from.oy)) return unknown;
    return static_cast<float>(std::atan2(from.oy, from.ox));
  }

  /// Returns what z says of the person.
  float stature(double z) {
    if (is_infinite(z)) reject("z", z, "is not finite");
    if (header_.is_of_jupedsim != 0) has_floors_ |= std::abs(z) > 0;
    return header_.is_of_jupedsim != 0 || is_nan(z) ? unknown : heights_.take(z * metres_);
  }

  Row row(const ArchiveRow& from) {
    Row row;
    row.number = ++number_;
    row.key = from.frame;
    row.id = from.id;
    if (header_.ids_are_unsigned != 0 && from.id < 0)
      places_.reject(
          number_, "id " + shown(std::to_string(static_cast<std::uint64_t>(from.id))) + " is not below 2^63");
    if (row.key > largest_frame || row.key < -largest_frame)
      places_.reject(number_, "frame " + shown(std::to_string(row.key)) + " is not within +-1e15");
    row.x = coordinate("x", from.x);
    row.y = coordinate("y", from.y);
    row.heading = heading(from);
    row.stature = stature(from.z);
    return row;
  }
};

}  // namespace

std::unique_ptr<RowSource> open_pedestrian_archive(const std::filesystem::path& file,
                                                   const TrajectoryOptions& options) {
  return std::make_unique<PedestrianArchive>(file, options);
}

}  // namespace bch::detail::trajectory
