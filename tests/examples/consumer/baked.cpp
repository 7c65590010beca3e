#include <vector>

#include "kernel/collide/collide.hpp"
#include "layout/baked/file.hpp"
#include "layout/baked/image.hpp"

int main() {
  const std::vector<bch::Shape> shapes = {{{}, bch::fixed_cylinder(0.25f)}};
  const bch::ShapeSet built(shapes);
  const bch::BakedImage image(built, {});
  bch::AlignedVector<std::byte> bytes;
  for (const auto part : image.parts()) bytes.insert(bytes.end(), part.begin(), part.end());
  const bch::ShapeSet set = bch::load_baked(bytes, "memory", nullptr).set;
  const std::vector<std::uint32_t> shape = {0, 0};
  const std::vector<double> x = {0, 0.4}, y = {0, 0}, heading = {0, 0};
  const std::vector<bch::Pair> pairs = {{0, 1}};
  std::vector<std::uint8_t> hits(1);
  bch::collide(set, {shape, x, y, heading}, pairs, hits);
  return hits[0] == 1 ? 0 : 1;
}
