// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <filesystem>
#include <vector>

#include <bch/files.hpp>
#include <bch/pairs.hpp>

// Shapes that were built once: a file is written, loaded without a copy, and asked.

int main() {
  const std::filesystem::path file = "pillars.bch";
  const bch::Disc disc{0, 0, 0.25f};
  const std::vector<bch::Shape> shapes = {bch::shape_from_discs({&disc, 1})};
  bch::save_baked(file, bch::ShapeSet(shapes));
  const bch::ShapeSet set = bch::load_baked(file, bch::FileAccess::map).set;
  std::filesystem::remove(file);  // the mapping keeps the bytes

  const std::vector<std::uint32_t> shape = {0, 0};
  const std::vector<double> x = {0, 0.4}, y = {0, 0}, heading = {0, 0};
  const std::vector<bch::Pair> pairs = {{0, 1}};
  std::vector<std::uint8_t> hits(pairs.size());
  bch::collide(set, {shape, x, y, heading}, pairs, hits);
  return hits[0] == 1 ? 0 : 1;
}
