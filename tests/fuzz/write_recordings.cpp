// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/archive_file.hpp"
#include "tests/support/jupedsim_file.hpp"
#include "tests/support/recordings.hpp"

// Recordings to begin with, of the formats that take a library to write.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

void write_databases(const fs::path& folder) {
  fs::create_directories(folder);
  const std::string small_pages = "PRAGMA page_size=512;";
  JuPedSimFile file;
  for (int row = 0; row < 30; ++row)
    file.rows += ",(" + std::to_string(2 + row / 3) + "," + std::to_string(row % 3) + ",1,2,0,1)";
  write_sqlite(folder / "seed0", small_pages + file.sql());
  file.version = "3";
  file.trajectory = "CREATE TABLE trajectory_data(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL);";
  file.rows = "(1,1,1.5,2),(0,1,3,4)";
  write_sqlite(folder / "seed1", small_pages + file.sql());
  file.version = "1";
  file.geometry = "CREATE TABLE geometry(wkt TEXT NOT NULL); INSERT INTO geometry VALUES('POLYGON EMPTY');";
  write_sqlite(folder / "seed2", small_pages + file.sql());
  // Trees that are graphs.
  file = {};
  const std::string without_index = "DROP INDEX frame_id_idx;";
  const char* const tables[] = {"frame_data", "trajectory_data", "sqlite_schema"};
  for (int i = 0; i < 3; ++i) {
    const fs::path seed = folder / ("seed" + std::to_string(3 + i));
    write_sqlite(seed, "PRAGMA page_size=1024;" + file.sql() + without_index);
    make_graph(seed, tables[i]);
  }
}

void write_archives(const fs::path& folder) {
  fs::create_directories(folder);
  ArchiveFile file;
  file.write(folder / "seed0");
  file.storage = ArchiveFile::Storage::deflated;
  file.floats = true;
  file.write(folder / "seed1");
  file.storage = ArchiveFile::Storage::contiguous;
  file.fixed_text = true;
  file.write(folder / "seed2");
  file = {};
  file.has_orientation = file.ids_are_unsigned = true;
  file.producer = "JuPedSim";
  file.write(folder / "seed3");
}

}  // namespace
}  // namespace bch::test

int main(int argc, char** argv) {
  using namespace bch::test;
  if (argc != 2) return std::puts("usage: write_recordings FOLDER"), 2;
  write_databases(fs::path(argv[1]) / "trajectory_sqlite");
  write_archives(fs::path(argv[1]) / "trajectory_hdf5");
}
