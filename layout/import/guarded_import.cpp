// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/guarded_import.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "layout/base/shortest.hpp"
#include "layout/import/character_bytes.hpp"

namespace bch::detail {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// How the child's words begin.
enum Answer : char { character = 'c', import_error = 'e', no_memory = 'm' };

void limit(decltype(RLIMIT_CPU) resource, rlim_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

#ifndef BCH_SANITIZED  // whose shadow memory alone is larger than any limit
/// Bytes of address space of this process: what it shares with its parent after a fork, the parent's shapes included.
std::size_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}
#endif

void set_limits(const ImportLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);  // it has nothing to write
  // The parent counts the time; this is for a child whose parent is stopped.
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.time.count() / 1000 + 1));
#ifndef BCH_SANITIZED
  limit(RLIMIT_AS, address_space() + limits.memory);
#endif
}

std::string answer(const std::function<ImportedCharacter()>& read) {
  try {
    return char{character} + to_bytes(read());
  } catch (const std::bad_alloc&) {
    return {char{no_memory}};
  } catch (const std::exception& error) {
    const std::string_view reason = error.what();
    const bool memory = reason.find("needs more memory") != std::string_view::npos;
    return memory ? std::string{char{no_memory}} : char{import_error} + std::string(reason);
  }
}

/// Gives signals their default effect again, for a child that has none of what its parent's handlers need. Those that
/// terminals send to both are for the parent.
void forget_signals() {
  for (int number = 1; number <= SIGRTMAX; ++number)
    if (number != SIGKILL && number != SIGSTOP) signal(number, SIG_DFL);
  for (const int number : {SIGINT, SIGHUP, SIGTSTP, SIGXFSZ}) signal(number, SIG_IGN);
}

[[noreturn]] void run_child(const std::function<ImportedCharacter()>& read, const ImportLimits& limits,
                            int to) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  forget_signals();
  // The parent speaks for both.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  set_limits(limits);
  const std::string bytes = answer(read);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(to, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) _exit(1);
    done += static_cast<std::size_t>(written);
  }
  _exit(0);  // without destructors: a damaged heap must not undo the answer
}

/// A child, ended and waited for at the latest when this goes.
class Child {
 public:
  Child(const std::function<ImportedCharacter()>& read, const ImportLimits& limits) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[0]);
      run_child(read, limits, ends[1]);
    }
    const int error = errno;
    from_ = ends[0];
    close(ends[1]);
    if (pid_ > 0) return;
    close(from_);
    errno = error;
    fail("no child process");
  }
  ~Child() {
    close(from_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns all that it says until it ends, or the first bytes beyond the limit; nothing when the time is over or the
  /// caller does not want to go on.
  std::optional<std::string> listen(const ImportLimits& limits) const {
    const Clock::time_point until = Clock::now() + limits.time;
    std::string bytes;
    char part[1 << 16];
    while (Clock::now() < until && (!limits.go_on || limits.go_on())) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
      pollfd waiting{from_, POLLIN, 0};
      const int ready = poll(&waiting, 1, static_cast<int>(std::clamp(left, 0ms, asked_every).count()));
      if (ready == 0) continue;
      const ssize_t got = ready < 0 ? -1 : ::read(from_, part, sizeof part);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail("the importing process was lost");
      if (got == 0) return bytes;
      bytes.append(part, static_cast<std::size_t>(got));
      if (bytes.size() > limits.memory) return bytes;
    }
    return std::nullopt;
  }

  /// Waits for its end.
  /// Returns: its status; 0 where the program lets nobody see it, by ignoring SIGCHLD.
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0)
      if (errno == ECHILD)
        break;
      else if (errno != EINTR)
        fail("the importing process was lost");
    pid_ = 0;
    return status;
  }

 private:
  static constexpr std::chrono::milliseconds asked_every{50};
  pid_t pid_ = 0;
  int from_ = -1;

  [[noreturn]] static void fail(const char* what) {
    throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
  }
};

std::string seconds(const ImportLimits& limits) {
  return "reading it takes more than " + shortest(static_cast<double>(limits.time.count()) / 1000) +
         " seconds";
}

std::string gibibytes(const ImportLimits& limits) {
  return "reading it takes more than " +
         shortest(static_cast<double>(limits.memory) / static_cast<double>(1 << 30)) + " GiB of memory";
}

}  // namespace

ImportedCharacter guarded_import(const std::string& file, const std::function<ImportedCharacter()>& read,
                                 const ImportLimits& limits) {
  const auto reject = [&](const std::string& reason) -> void { throw ImportStopped(file + ": " + reason); };
  Child child(read, limits);
  const std::optional<std::string> words = child.listen(limits);
  if (!words) reject(limits.go_on && !limits.go_on() ? "reading it was cancelled" : seconds(limits));
  if (words->size() > limits.memory) reject(gibibytes(limits));
  const int status = child.wait();
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) reject(seconds(limits));
  if (WIFSIGNALED(status))
    reject("malformed: the importer crashes on it (signal " + std::to_string(WTERMSIG(status)) + ")");
  if (WEXITSTATUS(status) != 0 || words->empty()) reject("malformed: the importer gives up on it");
  switch (words->front()) {
    case no_memory:
      reject(gibibytes(limits));
      break;
    case import_error:
      throw ImportError(words->substr(1));
    default:
      break;
  }
  try {
    return imported_from(std::span(*words).subspan(1));
  } catch (const std::invalid_argument& error) {
    throw ImportStopped(file + ": malformed: " + error.what());
  }
}

}  // namespace bch::detail

namespace bch {

ImportedCharacter import_in_child(const std::filesystem::path& file, const ImportOptions& options,
                                  const ImportLimits& limits) {
  return detail::guarded_import(
      file.string(), [&] { return import_character(file, options); }, limits);
}

}  // namespace bch
