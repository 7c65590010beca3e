// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

// Private to the readers of recordings: a recording in HDF5, as the library finds it. The only user of HDF5, whose library
// crashes on some malformed files.

namespace bch::detail::trajectory {

/// Represents a row of the dataset.
struct ArchiveRow {
  std::int64_t id, frame;  ///< of an unsigned type the id holds the bits
  double x, y, z;
  double ox, oy;  ///< where the person faces; 0 where the file does not say
};

/// Represents a file of the Pedestrian Dynamics Data Archive, or of JuPedSim: a dataset "trajectory" of (id, frame, x, y, z), in any order
/// and with others, such as JuPedSim's (ox, oy), with an attribute "fps"; and an attribute "wkt_geometry" of the file.
/// Errors:  all functions throw std::runtime_error with the reason, but on files that crash or exhaust the process.
class Hdf5Recording {
 public:
  explicit Hdf5Recording(const std::string& file);
  ~Hdf5Recording();
  Hdf5Recording(const Hdf5Recording&) = delete;
  Hdf5Recording& operator=(const Hdf5Recording&) = delete;

  std::uint64_t rows() const;
  std::uint64_t bytes_a_row() const;  ///< in the file
  bool is_of_jupedsim() const;        ///< whose z is the floor's
  bool ids_are_unsigned() const;
  double fps() const;  ///< 0 where the file does not say
  std::string geometry() const;

  /// Reads rows from the first'th on; all of them have to be there.
  void read(std::uint64_t first, std::span<ArchiveRow> rows) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace bch::detail::trajectory
