// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <sqlite3.h>
#include <unistd.h>

#include "tests/support/recordings.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// Recordings of JuPedSim.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

/// What a file of JuPedSim is made of.
struct JuPedSimFile {
  std::string version = "2", fps = "25.0";
  std::string trajectory =
      "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y "
      "REAL NOT NULL, "
      "ori_x REAL NOT NULL, ori_y REAL NOT NULL);";
  std::string rows = "(0,1,1.5,2,0,1),(0,2,3,4,0,0),(1,1,1.75,2,-1,0)";
  std::string geometry =
      "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
      "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
      "INSERT INTO geometry VALUES(-7,'POLYGON ((0 0, 1 0, 1 1, 0 0))');"
      "INSERT INTO frame_data VALUES(0,-7),(1,-7);";

  /// Statements that make it.
  std::string sql() const {
    return "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
           "INSERT INTO metadata VALUES('version','" +
           version + "'),('fps','" + fps + "');" + trajectory + geometry +
           (rows.empty() ? "" : "INSERT INTO trajectory_data VALUES" + rows + ";") +
           "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);";
  }
};

/// A database that another program has open.
class OpenDatabase {
 public:
  OpenDatabase(const fs::path& file, const std::string& sql) {
    sqlite3* handle = nullptr;
    const int opened = sqlite3_open(file.c_str(), &handle);
    handle_.reset(handle);
    EXPECT_EQ(opened, SQLITE_OK);
    run(sql);
  }
  void run(const std::string& sql) const {
    EXPECT_EQ(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(handle_.get());
  }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

class JuPedSimFiles : public testing::Test {
 protected:
  TemporaryFolder folder;

  ReadRecording read(const JuPedSimFile& file) const {
    write_sqlite(folder.file("f"), file.sql());
    return read_recording(folder.file("f"));
  }
  std::string complaint(const std::string& sql) const {
    write_sqlite(folder.file("f"), sql);
    return trajectory_complaint(folder.file("f"));
  }
};

TEST_F(JuPedSimFiles, OfVersions1To3AreRead) {
  JuPedSimFile file;
  const ReadRecording second = read(file);
  EXPECT_EQ(second.info.format, "JuPedSim SQLite, version 2");
  EXPECT_EQ(second.info.fps, 25);
  EXPECT_EQ(second.info.geometry, "POLYGON ((0 0, 1 0, 1 1, 0 0))");
  EXPECT_TRUE(second.info.assumptions.empty());
  EXPECT_EQ(text_of(second), "0 1 1.5 2 1.5707964 -\n0 2 3 4 - -\n1 1 1.75 2 3.1415927 -\n");

  file.version = "3";
  file.trajectory =
      "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y "
      "REAL NOT NULL);";
  file.rows = "(1,1,1.5,2),(0,1,3,4)";
  const ReadRecording third = read(file);
  EXPECT_EQ(third.info.format, "JuPedSim SQLite, version 3");
  EXPECT_EQ(text_of(third), "0 1 3 4 - -\n1 1 1.5 2 - -\n");

  file = {};
  file.version = "1";
  file.geometry = "CREATE TABLE geometry(wkt TEXT NOT NULL); INSERT INTO geometry VALUES('POLYGON EMPTY');";
  EXPECT_EQ(read(file).info.geometry, "POLYGON EMPTY");
}

TEST_F(JuPedSimFiles, HaveTheGeometryOfTheirFirstFrame) {
  expect_table(__FILE__, "sqlite_geometries.txt", [&](const auto& fields) {
    JuPedSimFile file;
    file.geometry = fields[0];
    const ReadRecording recording = read(file);
    return recording.info.geometry + "\n" + assumptions_of(recording);
  });
}

TEST_F(JuPedSimFiles, AreRefusedByOneLine) {
  expect_table(__FILE__, "sqlite_refusals.txt", [&](const auto& fields) {
    const std::string &what = fields[0], &given = fields[1];
    JuPedSimFile file;
    if (what == "version") file.version = given;
    if (what == "fps") file.fps = given;
    if (what == "row") file.rows += "," + given;
    return complaint(what == "alone" ? given : file.sql() + (what == "further" ? given : ""));
  });
}

TEST_F(JuPedSimFiles, AreNotReadWhileLocked) {
  write_sqlite(folder.file("f"), JuPedSimFile().sql());
  {
    const OpenDatabase other(folder.file("f"), "BEGIN EXCLUSIVE");
    EXPECT_EQ(trajectory_complaint(folder.file("f")), "f: is locked by another program: database is locked");
  }
  EXPECT_EQ(trajectory_complaint(folder.file("f")), "accepted");
}

TEST_F(JuPedSimFiles, ThatAreDamagedAreReadOrRefused) {
  JuPedSimFile file;
  for (int frame = 2; frame < 300; ++frame)
    for (const char* const person : {"1", "2", "3"})
      file.rows.append(",(").append(std::to_string(frame)).append(",").append(person).append(",1.5,2,0,1)");
  write_sqlite(folder.file("f"), file.sql());
  const std::string bytes = read_text(folder.file("f"));
  ASSERT_GT(bytes.size(), 20'000u);
  const std::string whole = text_of(read_recording(folder.file("f")));
  for (std::size_t size = 16; size < bytes.size(); size += 997) {
    const std::filesystem::path part = folder.write("g", bytes.substr(0, size));
    if (trajectory_complaint(part) == "accepted") {  // what lacks is of the index
      EXPECT_EQ(text_of(read_recording(part)), whole) << size;
    }
  }
  Random random(1);
  std::uint32_t refused = 0;
  for (std::uint32_t i = 0; i < samples(1000); ++i) {
    std::string damaged = bytes;
    for (int flips = 0; flips < 4; ++flips)
      damaged[random.below(static_cast<std::uint32_t>(bytes.size()))] ^=
          static_cast<char>(1 << random.below(8));
    refused += trajectory_complaint(folder.write("g", damaged)) != "accepted";
  }
  EXPECT_GT(refused, 0u);
}

// ---- Recordings of JuPedSim as they lie in archives, or as somebody made them to do harm: what reading costs, and what it leaves.

/// Takes the right to write from the folder, and the right to write everywhere from who has that.
class ReadOnly {
 public:
  explicit ReadOnly(const fs::path& folder) : folder_(folder), is_root_(geteuid() == 0) {
    constexpr uid_t nobody = 65534;
    fs::permissions(folder_, fs::perms(0555));
    become(nobody);
  }
  ReadOnly(const ReadOnly&) = delete;
  ReadOnly& operator=(const ReadOnly&) = delete;
  ~ReadOnly() {
    become(0);
    fs::permissions(folder_, fs::perms(0755));
  }

 private:
  fs::path folder_;
  bool is_root_;

  void become(uid_t user) const {
    const int failed = is_root_ ? seteuid(user) : 0;
    EXPECT_EQ(failed, 0);
  }
};

class ArchivedJuPedSimFiles : public testing::Test {
 protected:
  TemporaryFolder folder;
  const std::string as_log = "PRAGMA journal_mode=WAL; PRAGMA wal_autocheckpoint=0;";
  const std::string another_row = "INSERT INTO trajectory_data VALUES(2,1,2,2,0,1);";

  /// Returns every file of the folder with a number that its bytes make.
  std::map<std::string, std::size_t> contents() const {
    std::map<std::string, std::size_t> all;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
      all[entry.path().filename()] = std::hash<std::string>()(read_text(entry.path()));
    return all;
  }

  /// Reads what lies there, where it may be written and where not, and expects that nothing has changed.
  std::string complaint(const std::string& name = "f", const detail::TrajectoryOptions& options = {}) const {
    const auto before = contents();
    std::string first = trajectory_complaint(folder.file(name), options);
    EXPECT_EQ(contents(), before);
    {
      const ReadOnly held(folder.path());
      EXPECT_EQ(trajectory_complaint(folder.file(name), options), first);
    }
    EXPECT_EQ(contents(), before);
    return first;
  }
  std::uint64_t rows(const std::string& name = "f") const {
    EXPECT_EQ(complaint(name), "accepted");
    return read_recording(folder.file(name)).info.rows;
  }
};

constexpr const char* too_many_steps =
    "f: is damaged: reading it takes more steps than files of its size can need";

TEST_F(ArchivedJuPedSimFiles, WhoseTreesAreGraphsAreRefusedSoon) {
  JuPedSimFile file;
  file.trajectory = "CREATE TABLE trajectory_data(note, frame, id, pos_x, pos_y);";
  file.rows = "(zeroblob(100000),0,1,1.5,2)";  // over many pages, all of which come before the numbers
  const detail::TrajectoryOptions with_fps{.fps = 25};  // which is looked for in the whole table
  // No index, which would find what there is at once; and a schema of one page.
  const std::string without_index =
      "DROP INDEX frame_id_idx; DROP TABLE metadata; CREATE TABLE metadata(key, value);"
      "INSERT INTO metadata VALUES('version','";
  const std::pair<const char*, const char*> cases[] = {{"metadata", "1"},
                                                       {"geometry", "1"},
                                                       {"frame_data", "2"},
                                                       {"trajectory_data", "2"},
                                                       {"sqlite_schema", "2"}};
  for (const char* const page : {"PRAGMA page_size=1024;", "PRAGMA page_size=4096;"})
    for (const auto& [table, version] : cases) {
      write_sqlite(folder.file("f"), page + file.sql() + without_index + version + "')");
      EXPECT_EQ(complaint("f", with_fps), "accepted");
      make_graph(folder.file("f"), table);
      EXPECT_EQ(complaint("f", with_fps), too_many_steps) << page << table;
    }
}

TEST_F(ArchivedJuPedSimFiles, AreReadNoFurtherThanTheCallerLikes) {
  write_sqlite(folder.file("f"), JuPedSimFile().sql());
  int asked = 0;
  EXPECT_EQ(trajectory_complaint(folder.file("f"), {.go_on = [&] { return ++asked > 0; }}), "accepted");
  EXPECT_GT(asked, 0);
  EXPECT_EQ(trajectory_complaint(folder.file("f"), {.go_on = [] { return false; }}),
            "f: reading it was cancelled");
  // Within a query, too.
  make_graph(folder.file("f"), "frame_data");
  asked = 0;
  EXPECT_EQ(trajectory_complaint(folder.file("f"), {.go_on = [&] { return ++asked < 100; }}),
            "f: reading it was cancelled");
  EXPECT_EQ(asked, 100);
}

TEST_F(ArchivedJuPedSimFiles, WithALogThatIsClosedLeaveNothingBeside) {
  { const OpenDatabase closed(folder.file("f"), as_log + JuPedSimFile().sql()); }
  ASSERT_EQ(contents().size(), 1u);
  EXPECT_EQ(rows(), 3u);
  folder.write("f-wal", "");
  EXPECT_EQ(rows(), 3u);
  fs::create_symlink("f", folder.file("link"));
  EXPECT_EQ(rows("link"), 3u);
  fs::rename(folder.file("f"), folder.file("50%3f?immutable=0#"));
  EXPECT_EQ(rows("50%3f?immutable=0#"), 3u);
}

TEST_F(ArchivedJuPedSimFiles, AreReadWithTheLogThatLiesBesideThem) {
  const TemporaryFolder other;
  const OpenDatabase writer(other.file("f"),
                            as_log + JuPedSimFile().sql() + "PRAGMA wal_checkpoint(TRUNCATE);" + another_row);
  EXPECT_EQ(read_recording(other.file("f")).info.rows, 4u);
  fs::copy_file(other.file("f"), folder.file("f"));
  EXPECT_EQ(rows(), 3u);
  fs::copy_file(other.file("f-wal"), folder.file("f-wal"));
  EXPECT_EQ(rows(), 4u);
  fs::create_symlink(folder.file("f"), other.file("link"));
  EXPECT_EQ(read_recording(other.file("link")).info.rows, 4u);
  writer.run(another_row + another_row);
  EXPECT_NE(trajectory_complaint(other.file("f")), "accepted");  // repeats a row, which it sees
}

TEST_F(ArchivedJuPedSimFiles, LeftInTheMiddleOfAChangeSayHowItIsTakenBack) {
  const TemporaryFolder other;
  OpenDatabase writer(other.file("f"), JuPedSimFile().sql());
  // More than fits into memory is written before the end.
  writer.run("PRAGMA cache_size=1; PRAGMA cache_spill=1; BEGIN;");
  for (int frame = 2; frame < 2000; ++frame)
    writer.run("INSERT INTO trajectory_data VALUES(" + std::to_string(frame) + ",1,2,2,0,1)");
  for (const char* const name : {"f", "f-journal"}) fs::copy_file(other.file(name), folder.file(name));
  EXPECT_EQ(
      complaint(),
      "f: holds a change that was never finished: the program sqlite3 takes it back when it opens a copy "
      "of the file and of its journal, 'f-journal'");
  { const OpenDatabase closed(folder.file("f"), "SELECT * FROM metadata"); }
  EXPECT_EQ(rows(), 3u);
}

}  // namespace
}  // namespace bch::test
