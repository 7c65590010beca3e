#include <vector>

#include "kernel/collide/collide.hpp"
#include "layout/shape_set/shape_set.hpp"

int main() {
  const std::vector<bch::Shape> shapes = {{{}, bch::fixed_cylinder(0.25f)}};
  const bch::ShapeSet set(shapes);
  const std::vector<std::uint32_t> shape = {0, 0, 0};
  const std::vector<double> x = {0, 0.4, 0.6}, y = {0, 0, 0}, heading = {0, 0, 0};
  const std::vector<bch::Pair> pairs = {{0, 1}, {0, 2}};
  std::vector<std::uint8_t> hits(2);
  bch::collide(set, {shape, x, y, heading}, pairs, hits);
  return hits[0] == 1 && hits[1] == 0 ? 0 : 1;
}
