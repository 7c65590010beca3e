// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "bench/baking.hpp"
#include "bench/micro.hpp"
#include "layout/baked_checksum.hpp"
#include "layout/baked_file.hpp"
#include "layout/baked_format.hpp"
#include "layout/baked_image.hpp"
#include "layout/file_bytes.hpp"
#include "layout/shape_validation.hpp"

namespace bch::bench {
namespace {

constexpr double threshold = 0.01;  ///< metres

/// The scene's poses in a file that goes with this.
class TemporaryBakedFile {
 public:
  explicit TemporaryBakedFile(Scene& scene)
      : path((std::filesystem::temp_directory_path() / "bch_XXXXXX").string()) {
    const int descriptor = mkstemp(path.data());
    if (descriptor < 0) throw std::runtime_error(path + ": cannot be written");
    close(descriptor);
    const ShapeSet set = cli::bake_shapes(scene.characters(), scene.sources(), threshold, {});
    const BakedImage image(set, cli::origins_of(scene.characters(), scene.sources(), threshold));
    std::ofstream file(path, std::ios::binary);
    for (const auto part : image.parts())
      file.write(reinterpret_cast<const char*>(part.data()), static_cast<std::streamsize>(part.size()));
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
  }
  ~TemporaryBakedFile() { std::filesystem::remove(path); }
  TemporaryBakedFile(const TemporaryBakedFile&) = delete;
  TemporaryBakedFile& operator=(const TemporaryBakedFile&) = delete;

  std::string path;
};

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
        : file(from), bytes(map_file(file.path)), baked(load_baked(bytes.bytes, file.path, bytes.memory)) {}
    TemporaryBakedFile file;
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
