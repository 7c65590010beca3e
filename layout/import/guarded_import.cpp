// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/guarded_import.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "layout/base/child_process.hpp"
#include "layout/base/shortest.hpp"
#include "layout/import/character_bytes.hpp"

namespace bch::detail {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// How the child's words begin. Behind `no_memory` stands the file that needs it, where that is known.
enum Answer : char { character = 'c', import_error = 'e', no_memory = 'm' };

std::string answer(const std::function<ImportedCharacter()>& read) {
  try {
    return char{character} + to_bytes(read());
  } catch (const std::bad_alloc&) {
    return {char{no_memory}};
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    const std::size_t memory = reason.find(": needs more memory");
    return memory == std::string::npos ? char{import_error} + reason
                                       : char{no_memory} + reason.substr(0, memory);
  }
}

constexpr std::chrono::milliseconds queried_every{50};

/// Returns all that a child says until it ends, or the first bytes beyond the limit; nothing when the time is over or the
/// caller does not want to go on.
std::optional<std::string> listen(const ChildProcess& child, const ImportLimits& limits) {
  const Clock::time_point until = Clock::now() + limits.time;
  std::string bytes;
  char part[1 << 16];
  while (Clock::now() < until && (!limits.go_on || limits.go_on())) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    const std::optional<std::size_t> got = child.read(part, std::clamp(left, 0ms, queried_every));
    if (!got) continue;
    if (*got == 0) return bytes;
    bytes.append(part, *got);
    if (bytes.size() > limits.memory) return bytes;
  }
  return std::nullopt;
}

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
  ChildProcess child({limits.time, limits.memory, true}, [&](int to) { write_or_exit(to, answer(read)); });
  const std::optional<std::string> words = listen(child, limits);
  if (!words) reject(limits.go_on && !limits.go_on() ? "reading it was cancelled" : seconds(limits));
  if (words->size() > limits.memory) reject(gibibytes(limits));
  const int status = child.wait();
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) reject(seconds(limits));
  if (WIFSIGNALED(status))
    reject("malformed: the importer crashes on it (signal " + std::to_string(WTERMSIG(status)) + ")");
  if (WEXITSTATUS(status) != 0 || words->empty()) reject("malformed: the importer gives up on it");
  switch (words->front()) {
    case no_memory:
      throw ImportStopped((words->size() > 1 ? words->substr(1) : file) + ": " + gibibytes(limits));
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
  std::string files = file.string();
  for (const std::filesystem::path& clip_file : options.clip_files) files += " with " + clip_file.string();
  return detail::guarded_import(
      files, [&] { return import_character(file, options); }, limits);
}

}  // namespace bch
