// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/recordings.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "layout/base/shortest.hpp"

namespace bch::test {
namespace {

std::string number(float value) {
  return std::isnan(value) ? "-" : detail::shortest(value);
}

}  // namespace

ReadRecording read_recording(const std::filesystem::path& file, const detail::TrajectoryOptions& options) {
  const auto reader = detail::open_trajectory(file, options);
  ReadRecording recording{reader->info(), {}};
  for (RecordedFrame frame; reader->next(frame.number, frame.people);) recording.frames.push_back(frame);
  return recording;
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

std::string text_of(const ReadRecording& recording) {
  std::string text;
  for (const RecordedFrame& frame : recording.frames)
    for (const detail::TrackedPerson& person : frame.people)
      text += std::to_string(frame.number) + " " + std::to_string(person.id) + " " +
              detail::shortest(person.x) + " " + detail::shortest(person.y) + " " + number(person.heading) +
              " " + number(person.stature) + "\n";
  return text;
}

std::string trajectory_complaint(const std::filesystem::path& file,
                                 const detail::TrajectoryOptions& options) {
  try {
    read_recording(file, options);
  } catch (const detail::TrajectoryError& error) {
    const std::string message = error.what(), folder = file.parent_path().string() + "/";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(file.string())) << message;
    return message.substr(message.starts_with(folder) ? folder.size() : 0);
  }
  return "accepted";
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

}  // namespace bch::test
