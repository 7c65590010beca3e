// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <bch/baked.hpp>

#include "bench/base/text.hpp"
#include "bench/characters/baked_output.hpp"
#include "bench/ratios/ratios.hpp"
#include "layout/baked/checksum.hpp"
#include "layout/baked/file_bytes.hpp"
#include "layout/format/shape_validation.hpp"

namespace bch::bench {
namespace {

constexpr double baked_threshold = 0.01;  ///< metres

/// A file of its own for each object, which goes with it.
class TemporaryFile {
 public:
  TemporaryFile() : path((std::filesystem::temp_directory_path() / "bch_XXXXXX").string()) {
    const int descriptor = mkstemp(path.data());
    if (descriptor < 0) throw std::runtime_error(path + ": cannot be written");
    close(descriptor);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path;
};

detail::FileBytes bake(Scene& scene, const std::string& file) {
  cli::bake_file(file, scene.characters(), scene.sources(), baked_threshold, {});
  return detail::map_file(file);
}

/// A file of the scene's poses.
struct Loaded {
  explicit Loaded(Scene& scene)
      : bytes(bake(scene, file.path)), baked(load_baked(bytes.bytes, file.path, bytes.memory)) {}

  TemporaryFile file;
  detail::FileBytes bytes;
  BakedShapes baked;
};

struct Part {
  const char* name;
  void (*load)(const Loaded& loaded);
};
/// The file by either way, in the file cache; then what that consists of. Mapping includes its end.
constexpr Part parts[] = {
    {"map",
     [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file.path, FileAccess::map)); }},
    {"read", [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file.path)); }},
    {"map_alone", [](const Loaded& from) { benchmark::DoNotOptimize(detail::map_file(from.file.path)); }},
    {"checksum_alone",
     [](const Loaded& from) { benchmark::DoNotOptimize(detail::baked::checksum(from.bytes.bytes)); }},
    {"validation_alone", [](const Loaded& from) { validate(from.baked.set.arrays()); }}};

std::string load_name(const Part& part) {
  return fmt::format("load/{}", part.name);
}

void print_load(const Results& results) {
  const auto& counters = results.at(load_name(parts[0])).counters;
  fmt::print("loading a baked file of {:.0f} shapes, {:.1f} MB, us\n", counters.at("shapes"),
             counters.at("bytes") / 1e6);
  for (const Part& part : parts)
    fmt::print("  {:18}{:8.1f}\n", part.name, results.at(load_name(part)).nanoseconds / 1000);
}

}  // namespace

std::vector<Table> load_tables(Suite& suite, Scene& scene) {
  const Shared<Loaded> loaded([&scene] { return std::make_shared<Loaded>(scene); });
  for (const Part& part : parts)
    suite.add(load_name(part), [loaded, load = part.load]() -> Contender {
      const auto kept = loaded.get();
      return {[kept, load] { load(*kept); },
              1,
              {{"shapes", kept->baked.set.shape_count()},
               {"bytes", static_cast<double>(kept->bytes.bytes.size())}}};
    });
  return {{"load", "^load/", print_load}};
}

}  // namespace bch::bench
