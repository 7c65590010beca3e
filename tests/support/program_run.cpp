// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/program_run.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

namespace bch::test {
namespace {

namespace fs = std::filesystem;

void redirect(int descriptor, const fs::path& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments,
                         const fs::path& out, const fs::path& err, std::size_t largest_file) {
  redirect(STDOUT_FILENO, out);
  redirect(STDERR_FILENO, err);
  // Test runners in the background may ignore it, which children inherit.
  signal(SIGINT, SIG_DFL);
  const rlimit size{largest_file, largest_file};
  if (largest_file > 0) setrlimit(RLIMIT_FSIZE, &size);
  // assimp leaks on malformed files, which a sanitized program would report in the midst of its own words.
  setenv("ASAN_OPTIONS", "detect_leaks=0", 0);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

/// Waits until a process ends. Returns its exit code, or minus the signal.
int end_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

Ending run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const Streams& streams) {
  const TemporaryFolder folder;
  const fs::path out = streams.out.empty() ? folder.file("out") : fs::path(streams.out);
  const fs::path err = folder.file("err");
  const pid_t child = fork();
  if (child == 0) become(program, arguments, out, err, streams.largest_file);
  if (streams.interrupt_after.count() > 0) {
    std::this_thread::sleep_for(streams.interrupt_after);
    kill(child, SIGINT);
  }
  const int code = end_of(child);
  return {code, streams.out.empty() ? read_text(out) : std::string(), read_text(err)};
}

int run_until(const std::function<bool()>& until, int number, const std::string& program,
              const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child == 0) {
    signal(number, SIG_DFL);  // test runners may ignore it, which children inherit
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    become(program, arguments, "/dev/null", "/dev/null", 0);
  }
  bool is_so = until();
  for (int tries = 0; tries < 60'000 && !is_so; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    is_so = until();
  }
  kill(child, number);
  const int code = end_of(child);
  if (!is_so) throw std::runtime_error("nothing was seen of " + program);
  return code;
}

}  // namespace bch::test
