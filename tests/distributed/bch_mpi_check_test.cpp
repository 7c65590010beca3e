// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// `bch_mpi check`.

namespace bch {
namespace {

namespace fs = std::filesystem;
using test::Arguments;
using test::Ending;

/// People who walk up and down, so many that a part of a hundred frames takes a tenth of a second.
std::string walking_people() {
  std::ostringstream text;
  text << "# framerate: 10\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 1200; ++k)
    for (int id = 0; id < 12; ++id)
      text << id << " " << k << " " << 5 * std::sin(0.02 * k + id) << " " << 0.4 * id << " 1.75\n";
  return text.str();
}

/// Two people who walk through each other, and two who stand in each other.
std::string meeting_people() {
  std::ostringstream text;
  text << "# framerate: 10\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 30; ++k)
    text << 7 << " " << k << " " << -1.5 + 0.1 * k << " 0 1.8\n"
         << 5 << " " << k << " " << 1.5 - 0.1 * k << " 0.1 1.7\n"
         << 8 << " " << k << " 6 0 1.7\n"
         << 9 << " " << k << " 6.1 0 1.8\n";
  return text.str();
}

class BchMpiCheck : public testing::Test {
 protected:
  const std::string& recording() const { return recording_; }
  Arguments check(const std::string& ranks, const std::string& file, const Arguments& more = {}) const {
    Arguments all{"-n", ranks, BCH_MPI_PROGRAM, "check", file, "--into", parts, "--json", json};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static Ending run(Arguments arguments) {
    const Arguments as_root{"--allow-run-as-root", "--oversubscribe"};
    arguments.insert(arguments.begin(), as_root.begin(), as_root.end());
    return test::run_program(BCH_MPIRUN, arguments);
  }
  static void expect_one_line(const Ending& ending, int code, const std::string& line) {
    EXPECT_EQ(ending.code, code) << ending.err;
    const std::size_t at = ending.err.find("bch_mpi: ");
    EXPECT_EQ(ending.err.find("bch_mpi: " + line), at) << ending.err;
    EXPECT_EQ(ending.err.find("bch_mpi: ", at + 1), std::string::npos) << ending.err;
  }

  TemporaryFolder folder;
  const std::string recording_ = folder.write("people.txt", meeting_people());
  const std::string parts = folder.file("parts"), json = folder.file("check.json");
};

TEST_F(BchMpiCheck, WritesWhatOneProcessWrites) {
  const std::string expected_json = folder.file("expected.json");
  const Ending expected = test::bch({"check", recording(), "--json", expected_json});
  for (const char* const ranks : {"1", "3"}) {
    const Ending found = run(check(ranks, recording()));
    EXPECT_EQ(found.code, 0) << found.err;
    EXPECT_EQ(found.out, expected.out);
    EXPECT_EQ(test::read_text(json), test::read_text(expected_json));
  }
  // Parts that bch did need not be done again.
  for (const char* const part : {"1/5", "2/5", "3/5", "4/5"})
    EXPECT_EQ(test::bch({"check", recording(), "--part", part, "--into", parts}).code, 0);
  const auto before = fs::last_write_time(fs::path(parts) / "part-2-of-5.manifest.json");
  EXPECT_EQ(run(check("2", recording(), {"--parts", "5"})).out, expected.out);
  EXPECT_EQ(fs::last_write_time(fs::path(parts) / "part-2-of-5.manifest.json"), before);
  expect_one_line(run(check("2", recording(), {"--fail-above", "1"})), 1, recording());
}

TEST_F(BchMpiCheck, FaultsOfOneRankEndAllWithOneLineAndKeepParts) {
  Arguments both = check("1", recording());
  for (const std::string& word : check("1", folder.file("absent.txt"))) {
    if (word == "-n") both.emplace_back(":");
    both.push_back(word);
  }
  expect_one_line(run(both), 3, "rank 1: " + folder.file("absent.txt").string());
  EXPECT_TRUE(fs::exists(fs::path(parts) / "part-1-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(fs::path(parts) / "part-2-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(json));
  expect_one_line(run(check("2", recording(), {"--frames", "/dev/full"})), 3, "rank 0: /dev/full");
  EXPECT_FALSE(fs::exists(json));
  EXPECT_EQ(run(check("2", recording())).code, 0);
}

/// The commands of two ranks: of rank 1 a shell that runs `before`, and becomes it.
Arguments with_shell(const Arguments& command, const std::string& before) {
  Arguments both{"-n", "1"};
  both.insert(both.end(), command.begin() + 2, command.end());
  for (const char* const word : {":", "-n", "1", "sh", "-c"}) both.emplace_back(word);
  both.push_back(before + "\nexec \"$@\"");
  both.emplace_back("sh");
  both.insert(both.end(), command.begin() + 2, command.end());
  return both;
}

TEST_F(BchMpiCheck, AKilledRankEndsAllAndPartsAreNotDoneAgain) {
  const std::string file = folder.write("walking.txt", walking_people()),
                    expected_json = folder.file("one.json");
  const Arguments command = check("2", file, {"--parts", "12"});
  const std::string first_done = (fs::path(parts) / "part-2-of-12.manifest.json").string();
  const Ending killed =
      run(with_shell(command, "(until [ -e '" + first_done + "' ]; do sleep 0.01; done; kill -9 $$) &"));
  EXPECT_NE(killed.code, 0);
  EXPECT_NE(killed.err.find("rank 1"), std::string::npos) << killed.err;
  EXPECT_NE(killed.err.find("signal 9"), std::string::npos) << killed.err;
  EXPECT_EQ(killed.out, "");
  EXPECT_FALSE(fs::exists(json));

  std::map<fs::path, fs::file_time_type> done;
  for (const fs::directory_entry& entry : fs::directory_iterator(parts))
    if (entry.path().string().ends_with(".manifest.json")) done[entry.path()] = entry.last_write_time();
  EXPECT_GE(done.size(), 1u);
  EXPECT_LT(done.size(), 12u);
  const Ending resumed = run(command), expected = test::bch({"check", file, "--json", expected_json});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.out, expected.out);
  EXPECT_EQ(test::read_text(json), test::read_text(expected_json));
  for (const auto& [manifest, written] : done) EXPECT_EQ(fs::last_write_time(manifest), written) << manifest;
}

/// The one rank is signalled itself: mpirun may end others by SIGKILL before they have cleaned up.
TEST_F(BchMpiCheck, ASignalLeavesNoTemporaryFile) {
  const std::string file = folder.write("walking.txt", walking_people());
  const std::string writes = "ls -A '" + parts + "' 2>/dev/null | grep -q '^[.]bch'";
  Arguments command{
      "-n", "1", "sh", "-c", "(until " + writes + "; do sleep 0.01; done; kill -TERM $$) &\nexec \"$@\"",
      "sh"};
  const Arguments plain = check("1", file);
  command.insert(command.end(), plain.begin() + 2, plain.end());
  EXPECT_NE(run(command).code, 0);
  EXPECT_FALSE(fs::exists(json));
  ASSERT_TRUE(fs::exists(parts));
  EXPECT_TRUE(fs::is_empty(parts));
}

TEST_F(BchMpiCheck, AFullDiskOfOneRankEndsAllWithOneLine) {
  Arguments command = with_shell(check("2", recording()), "ulimit -f 0");
  command.insert(command.begin(), {"--mca", "btl", "self,tcp"});  // whose memory is not shared by a file
  expect_one_line(run(command), 3, "rank 1: " + (fs::path(parts) / "part-2-of-2").string());
  EXPECT_TRUE(fs::exists(fs::path(parts) / "part-1-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(fs::path(parts) / "part-2-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(json));
}

}  // namespace
}  // namespace bch
