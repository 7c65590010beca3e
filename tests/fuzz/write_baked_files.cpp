// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/baked_bytes.hpp"
#include "tests/support/body_models.hpp"
#include "tests/support/scenes.hpp"

// Writes baked files of several plans, each behind a byte that chooses options, into a folder.

namespace {

/// Returns the bytes of a model of a tetrahedron.
bch::BakedBody small_body() {
  bch::Character character;
  character.joints.emplace_back();
  character.bones.emplace_back();
  character.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  character.influence_begin = {0, 1, 2, 3, 4};
  character.influences.assign(4, {0, 1});
  character.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  return bch::to_bytes(bch::test::plain_model(character, 2, 1.1f));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace bch;
  if (argc != 2) return std::puts("usage: write_baked_files FOLDER"), 2;
  test::Random random(1);
  const std::vector<Shape> shapes{test::contour_shape(test::star(random, 5, 0.2, 0.4), 0.1f),
                                  test::contour_shape(test::star(random, 12, 0.1, 0.4), 0.02f)};
  const ShapeSetPlan plans[] = {{{0}},
                                {{all_depths}, true, false},
                                {{0, 1, all_depths}, true, true},
                                {.depths = {0, all_depths}, .heights = true}};
  int count = 0;
  for (const ShapeSetPlan& plan : plans)
    for (const char mode : {'\0', '\1', '\3', '\5', '\7'}) {
      const std::filesystem::path file = std::filesystem::path(argv[1]) / ("seed" + std::to_string(count++));
      std::ofstream(file, std::ios::binary)
          << mode
          << test::BakedBytes(ShapeSet(shapes, plan), test::origins_of(shapes.size()), test::few_clips(),
                              std::vector<BakedBody>{small_body()})
                 .text();
    }
}
