// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "bench/characters/baked_output.hpp"
#include "bench/micro/micro.hpp"
#include "layout/baked/checksum.hpp"
#include "layout/baked/file.hpp"
#include "layout/baked/file_bytes.hpp"
#include "layout/format/shape_validation.hpp"

namespace bch::bench {
namespace {

constexpr double threshold = 0.01;  ///< metres

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

/// The scene's poses. Returns: the file.
FileBytes bake(Scene& scene, const std::string& file) {
  cli::bake_file(file, scene.characters(), scene.sources(), threshold, {});
  return map_file(file);
}

template <class Step>
void time_step(benchmark::State& state, const FileBytes& file, std::size_t shapes, Step step) {
  for (auto _ : state) step();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.bytes.size()));
  state.counters["shapes"] = static_cast<double>(shapes);
}

}  // namespace

void register_load_benchmarks(Scene& scene) {
  struct Loaded {
    explicit Loaded(Scene& from)
        : bytes(bake(from, file.path)), baked(load_baked(bytes.bytes, file.path, bytes.memory)) {}
    TemporaryFile file;
    FileBytes bytes;
    BakedShapes baked;
  };
  const auto loaded = std::make_shared<std::unique_ptr<Loaded>>();
  const auto add = [&](const char* name, auto step) {
    benchmark::RegisterBenchmark(name, [&scene, loaded, step](benchmark::State& state) {
      if (!*loaded) *loaded = std::make_unique<Loaded>(scene);
      const Loaded& from = **loaded;
      time_step(state, from.bytes, from.baked.set.shape_count(), [&] { step(from); });
    })->Unit(benchmark::kMicrosecond);
  };
  add("load/map",
      [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file.path, FileAccess::map)); });
  add("load/read", [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file.path)); });
  add("load/map_alone", [](const Loaded& from) { benchmark::DoNotOptimize(map_file(from.file.path)); });
  add("load/checksum_alone",
      [](const Loaded& from) { benchmark::DoNotOptimize(baked::checksum(from.bytes.bytes)); });
  add("load/validation_alone", [](const Loaded& from) { validate(from.baked.set.arrays()); });
}

}  // namespace bch::bench
