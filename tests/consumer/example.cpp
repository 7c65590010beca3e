#include <cstdio>
#include <vector>

#include "kernel/broad_phase.hpp"
#include "kernel/collide.hpp"
#include "layout/default_characters.hpp"
#include "layout/pose_shape.hpp"

int main() {
  const bch::Character man = bch::default_male();
  bch::PoseShaper shaper(man);
  std::vector<bch::Shape> shapes;
  for (const bch::PoseTime& time : bch::sample_poses(man, 3)) shapes.push_back(shaper.shape(time));
  const bch::ShapeSet set(shapes);

  const std::vector<std::uint32_t> shape = {0, 1, 2, 0};  // your simulator's arrays
  const std::vector<double> x = {0, 0.3, 5, 5.5}, y = {0, 0.2, 5, 5}, heading = {0, 1.5, 3, 0};
  const bch::Agents agents{shape, x, y, heading};
  const std::vector<bch::Pair> pairs = bch::candidate_pairs(set, agents);
  std::vector<std::uint8_t> hits(pairs.size());
  bch::collide(set, agents, pairs, hits);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    std::printf("%u and %u %s\n", pairs[i].first, pairs[i].second, hits[i] ? "collide" : "pass");
}
