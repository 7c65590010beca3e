// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/exit_codes.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include <bch/files.hpp>
#include <bch/import.hpp>

#include "bench/base/text.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::cli {
namespace {

constexpr rlim_t least_stack = 320;  ///< KiB, which queries need: <bch/query.hpp>

/// A stack that is too small ends the program by SIGSEGV somewhere in the work.
void require_stack() {
  rlimit stack;
  if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur / 1024 < least_stack)
    throw UsageError("the stack is limited to " + std::to_string(stack.rlim_cur / 1024) +
                     " KiB (ulimit -s), and " + std::to_string(least_stack) + " are needed");
}

/// Opens the standard streams that are closed, each the wrong way round, so that using them is still an error.
/// Otherwise the next file or pipe would be one of them.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 &&
        open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream)
      throw std::runtime_error("standard streams are closed, and there is no /dev/null in their place");
}

}  // namespace

int run_main(const char* program, const std::function<int()>& run) {
  const auto report = [&](int code, const std::string& message) {
    std::fprintf(stderr, "%s: %s\n", program, printable_line(message).c_str());
    return code;
  };
  try {
    occupy_standard_streams();
    require_stack();
    return run();
  } catch (const UsageError& error) {
    return report(exit_usage, error.what());
  } catch (const CheckFailed& error) {
    return report(exit_failed, error.what());
  } catch (const detail::TrajectoryError& error) {
    return report(exit_bad_input, error.what());
  } catch (const InputError& error) {
    return report(exit_bad_input, error.what());
  } catch (const InputErrors& errors) {
    for (const std::string& line : errors.lines) report(exit_bad_input, line);
    return exit_bad_input;
  } catch (const ImportError& error) {
    return report(exit_bad_input, error.what());
  } catch (const BakedFileError& error) {
    return report(exit_bad_input, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(exit_bad_input, error.path1().string() + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return report(exit_internal, "not enough memory");
  } catch (const std::exception& error) {
    return report(exit_internal, std::string("internal error: ") + error.what());
  }
}

}  // namespace bch::cli
