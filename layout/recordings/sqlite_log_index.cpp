// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/sqlite_log_index.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bch::detail::trajectory {
namespace {

/// The functions of a database's file, of which those for memory that processes share are replaced.
struct IndexInMemory : sqlite3_io_methods {
  mutable std::vector<std::unique_ptr<std::uint64_t[]>> parts;

  explicit IndexInMemory(const sqlite3_io_methods& methods) : sqlite3_io_methods(methods) {
    xShmMap = map;
    xShmLock = [](sqlite3_file*, int, int, int) { return SQLITE_OK; };
    xShmBarrier = [](sqlite3_file*) {};
    xShmUnmap = [](sqlite3_file* file, int) {
      parts_of(file).clear();
      return SQLITE_OK;
    };
  }

  static std::vector<std::unique_ptr<std::uint64_t[]>>& parts_of(sqlite3_file* file) {
    return static_cast<const IndexInMemory*>(file->pMethods)->parts;
  }

  /// Makes a part of zeros where there is none yet and SQLite asks for it.
  static int map(sqlite3_file* file, int number, int size, int extend, void volatile** to) {
    auto& parts = parts_of(file);
    const auto index = static_cast<std::size_t>(number);
    const std::size_t words = static_cast<std::size_t>(size) / sizeof(std::uint64_t);
    if (extend != 0)
      while (parts.size() <= index) parts.push_back(std::make_unique<std::uint64_t[]>(words));
    *to = index < parts.size() ? parts[index].get() : nullptr;
    return SQLITE_OK;
  }
};

}  // namespace

std::shared_ptr<void> keep_log_index_in_memory(sqlite3* database) {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(database, "main", SQLITE_FCNTL_FILE_POINTER, &file);
  auto index = std::make_shared<IndexInMemory>(*file->pMethods);
  file->pMethods = index.get();
  return index;
}

}  // namespace bch::detail::trajectory
