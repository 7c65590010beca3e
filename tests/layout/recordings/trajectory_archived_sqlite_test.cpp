// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <sqlite3.h>
#include <unistd.h>

#include "tests/support/jupedsim_file.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/test.hpp"

// Recordings of JuPedSim as they lie in archives, or as somebody made them to do harm: what reading costs, and what it leaves.

namespace bch {
namespace {

namespace fs = std::filesystem;
using test::JuPedSimFile;

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
      all[entry.path().filename()] = std::hash<std::string>()(test::bytes_of(entry.path()));
    return all;
  }

  /// Reads what lies there, where it may be written and where not, and expects that nothing has changed.
  std::string complaint(const std::string& name = "f", const detail::TrajectoryOptions& options = {}) const {
    const auto before = contents();
    std::string first = test::trajectory_complaint(folder.file(name), options);
    EXPECT_EQ(contents(), before);
    {
      const ReadOnly held(folder.path());
      EXPECT_EQ(test::trajectory_complaint(folder.file(name), options), first);
    }
    EXPECT_EQ(contents(), before);
    return first;
  }
  std::uint64_t rows(const std::string& name = "f") const {
    EXPECT_EQ(complaint(name), "accepted");
    return test::read_recording(folder.file(name)).info.rows;
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
      test::write_sqlite(folder.file("f"), page + file.sql() + without_index + version + "')");
      EXPECT_EQ(complaint("f", with_fps), "accepted");
      test::make_graph(folder.file("f"), table);
      EXPECT_EQ(complaint("f", with_fps), too_many_steps) << page << table;
    }
}

TEST_F(ArchivedJuPedSimFiles, AreReadNoFurtherThanTheCallerLikes) {
  test::write_sqlite(folder.file("f"), JuPedSimFile().sql());
  int asked = 0;
  EXPECT_EQ(test::trajectory_complaint(folder.file("f"), {.go_on = [&] { return ++asked > 0; }}), "accepted");
  EXPECT_GT(asked, 0);
  EXPECT_EQ(test::trajectory_complaint(folder.file("f"), {.go_on = [] { return false; }}),
            "f: reading it was cancelled");
  // Within a query, too.
  test::make_graph(folder.file("f"), "frame_data");
  asked = 0;
  EXPECT_EQ(test::trajectory_complaint(folder.file("f"), {.go_on = [&] { return ++asked < 100; }}),
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
  EXPECT_EQ(test::read_recording(other.file("f")).info.rows, 4u);
  fs::copy_file(other.file("f"), folder.file("f"));
  EXPECT_EQ(rows(), 3u);
  fs::copy_file(other.file("f-wal"), folder.file("f-wal"));
  EXPECT_EQ(rows(), 4u);
  fs::create_symlink(folder.file("f"), other.file("link"));
  EXPECT_EQ(test::read_recording(other.file("link")).info.rows, 4u);
  writer.run(another_row + another_row);
  EXPECT_NE(test::trajectory_complaint(other.file("f")), "accepted");  // repeats a row, which it sees
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
}  // namespace bch
