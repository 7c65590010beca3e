// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/recordings.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "layout/base/shortest.hpp"

namespace bch::test {
namespace {

std::string number(float value) {
  return std::isnan(value) ? "-" : detail::shortest(value);
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + size; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

void put(std::string& bytes, std::size_t at, std::size_t size, std::size_t value) {
  for (std::size_t i = at + size; i-- > at; value >>= 8) bytes[i] = static_cast<char>(value);
}

/// An inner page of a table's tree, whose children are all the same but for the first.
std::string inner_page(std::size_t size, std::size_t first, std::size_t other, std::size_t children) {
  std::string page(size, '\0');
  page[0] = 5;
  put(page, 3, 2, children);
  put(page, 8, 4, other);
  std::size_t cell = size;
  for (std::size_t i = 0; i < children; ++i) {
    cell -= 5;
    put(page, cell, 4, i == 0 ? first : other);
    page[cell + 4] = 1;  // a key
    put(page, 12 + 2 * i, 2, cell);
  }
  put(page, 5, 2, cell);
  return page;
}

/// Returns the page in which a table's tree begins.
std::size_t root_of(const std::filesystem::path& file, const std::string& table) {
  if (table == "sqlite_schema") return 1;
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  const std::string sql = "SELECT rootpage FROM sqlite_schema WHERE name='" + table + "'";
  sqlite3_stmt* row = nullptr;
  sqlite3_prepare_v2(database, sql.c_str(), -1, &row, nullptr);
  const bool found = sqlite3_step(row) == SQLITE_ROW;
  const int root = sqlite3_column_int(row, 0);
  sqlite3_finalize(row);
  sqlite3_close(database);
  if (!found) throw std::runtime_error("no table " + table);
  return static_cast<std::size_t>(root);
}

void expect_sound(const ReadRecording& recording) {
  const detail::TrajectoryInfo& info = recording.info;
  std::uint64_t rows = 0;
  std::set<std::int64_t> people;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const RecordedFrame& frame = recording.frames[i];
    EXPECT_TRUE(i == 0 || frame.number > recording.frames[i - 1].number);
    EXPECT_FALSE(frame.people.empty());
    EXPECT_TRUE(std::is_sorted(frame.people.begin(), frame.people.end(),
                               [](const auto& a, const auto& b) { return a.id <= b.id; }));
    for (const detail::TrackedPerson& person : frame.people) {
      EXPECT_LE(std::abs(person.x), 1e8);
      EXPECT_LE(std::abs(person.y), 1e8);
      EXPECT_TRUE(std::isnan(person.heading) || std::abs(person.heading) <= 1e9f);
      EXPECT_TRUE(std::isnan(person.stature) || (person.stature >= 1 && person.stature <= 2.5f));
      people.insert(person.id);
    }
    rows += frame.people.size();
  }
  ASSERT_FALSE(recording.frames.empty());
  EXPECT_EQ(info.rows, rows);
  EXPECT_EQ(info.people, people.size());
  EXPECT_EQ(info.first_frame, recording.frames.front().number);
  EXPECT_EQ(info.last_frame, recording.frames.back().number);
  EXPECT_TRUE(info.fps > 0 && info.fps <= 10'000);
  EXPECT_FALSE(info.format.empty());
}

}  // namespace

ReadRecording read_recording(const std::filesystem::path& file, const detail::TrajectoryOptions& options) {
  const auto reader = detail::open_trajectory(file, options);
  ReadRecording recording{reader->info(), {}};
  for (RecordedFrame frame; reader->next(frame.number, frame.people);) recording.frames.push_back(frame);
  expect_sound(recording);
  return recording;
}

std::string text_of(const ReadRecording& recording) {
  std::string text;
  for (const RecordedFrame& frame : recording.frames)
    for (const detail::TrackedPerson& person : frame.people)
      text += std::to_string(frame.number) + " " + std::to_string(person.id) + " " +
              detail::shortest(person.x) + " " + detail::shortest(person.y) + " " + number(person.heading) +
              " " + number(person.stature) + "\n";
  return text;
}

std::string assumptions_of(const ReadRecording& recording) {
  std::string all;
  for (const std::string& sentence : recording.info.assumptions) all += sentence + "\n";
  for (const std::string& sentence : recording.info.notes) all += sentence + "\n";
  return all;
}

std::string trajectory_complaint(const std::filesystem::path& file,
                                 const detail::TrajectoryOptions& options) {
  const std::string folder = file.parent_path().string() + "/",
                    message = complaint<detail::TrajectoryError>([&] { read_recording(file, options); });
  if (message == "accepted") return message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with(file.string())) << message;
  return message.substr(message.starts_with(folder) ? folder.size() : 0);
}

void write_sqlite(const std::filesystem::path& file, const std::string& sql) {
  std::filesystem::remove(file);
  std::string statements = "PRAGMA synchronous=OFF; PRAGMA journal_mode=OFF;";
  statements += sql;
  sqlite3* database = nullptr;
  const bool made = sqlite3_open(file.c_str(), &database) == SQLITE_OK &&
                    sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  const std::string reason = made ? "" : sqlite3_errmsg(database);
  sqlite3_close(database);
  if (!made) throw std::runtime_error(reason + ": " + sql);
}

void make_graph(const std::filesystem::path& file, const std::string& table) {
  std::string bytes = read_text(file);
  const std::size_t size = big_endian(bytes, 16, 2), root = root_of(file, table), head = root == 1 ? 100 : 0;
  const std::string old = bytes.substr((root - 1) * size, size);
  if (old[head] != 13) throw std::runtime_error(table + " has more than a page");
  std::string leaf = old;  // whose cells stay where they are, below a head at 0
  leaf.replace(0, 8, old, head, 8);
  const std::size_t cells = 2 * big_endian(old, head + 3, 2);
  leaf.replace(8, cells, old, head + 8, cells);
  bytes += leaf;
  const std::size_t first = bytes.size() / size;
  std::size_t below = first;
  for (int level = 0; level < 8; ++level) {
    bytes += inner_page(size, below, below, 60);
    below = bytes.size() / size;
  }
  const std::string top = inner_page(size, first, below, 1);
  bytes.replace((root - 1) * size + head, 12 + 2, top, 0, 12 + 2);
  bytes.replace(root * size - 5, 5, top, size - 5, 5);
  put(bytes, 28, 4, bytes.size() / size);
  put(bytes, 92, 4, big_endian(bytes, 24, 4));  // the number of pages is that of the last change
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace bch::test
