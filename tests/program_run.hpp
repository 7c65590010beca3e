// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace bch::test {

/// A temporary folder that goes with its content.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Returns: the new file's path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);

/// What a program said and how it ended.
struct Ending {
  int code = 0;  ///< exit code, or minus the signal that ended it
  std::string out, err;
};

struct Streams {
  std::string out;                               ///< where standard output goes; empty: into the Ending
  std::chrono::milliseconds interrupt_after{0};  ///< send SIGINT then; 0: never
};

Ending run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const Streams& streams = {});

}  // namespace bch::test
