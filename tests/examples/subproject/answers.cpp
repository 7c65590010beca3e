// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bit>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/penetration.hpp>
#include <bch/shape_set.hpp>

// Prints what must not depend on compiler flags: collisions of a crowd of polygons, a hash of its distances and depths, and whether NaN
// is refused. Input is of integers over powers of two, which every flag leaves exact.

namespace {

std::uint64_t state = 1;

double random_number(double range) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 44) / 1048576.0 * range;
}

std::uint32_t random_index(std::uint32_t count) {
  return static_cast<std::uint32_t>(random_number(count));
}

std::vector<bch::Shape> polygons() {
  std::vector<bch::Shape> shapes;
  for (int k = 0; k < 16; ++k) {
    // Stars of eight corners about the origin.
    constexpr float way[8][2] = {{1, 0},  {.75f, .75f},   {0, 1},  {-.75f, .75f},
                                 {-1, 0}, {-.75f, -.75f}, {0, -1}, {.75f, -.75f}};
    std::vector<bch::Vec2> corners;
    for (const auto& [x, y] : way) {
      const float length = .125f + static_cast<float>(random_index(64)) / 256;
      corners.push_back({x * length, y * length});
    }
    shapes.push_back(bch::shape_from_polygons({&corners, 1}));
  }
  return shapes;
}

void add(std::uint64_t& hash, std::uint64_t bits) {
  hash = (hash ^ bits) * 1099511628211u;
}

}  // namespace

int main() {
  const bch::ShapeSet set(polygons());
  constexpr std::uint32_t count = 4000;
  std::vector<std::uint32_t> shape(count);
  std::vector<double> x(count), y(count), heading(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    shape[i] = random_index(16);
    x[i] = random_number(32);
    y[i] = random_number(32);
    heading[i] = random_number(8);
  }
  const bch::Agents agents{shape, x, y, heading};

  bch::CrowdCollider collider;
  const bch::Rows<std::uint32_t> rows = collider.collide_all(set, agents);
  std::vector<bch::Pair> pairs;
  for (std::uint32_t agent = 0; agent < count; ++agent) {
    for (const std::uint32_t other : rows[agent]) pairs.push_back({agent, other});
  }
  std::vector<float> distance(pairs.size());
  bch::clearance(set, agents, pairs, {distance}, {.overlap = bch::Overlap::deepest});
  std::vector<bch::Penetration> depth(pairs.size());
  bch::penetration(set, agents, pairs, 16, depth);

  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    add(hash, std::uint64_t{pairs[k].first} << 32 | pairs[k].second);
    add(hash, std::bit_cast<std::uint32_t>(distance[k]));
    add(hash, std::bit_cast<std::uint32_t>(depth[k].depth));
  }
  std::printf("%zu collisions, hash %016llx\n", pairs.size(), static_cast<unsigned long long>(hash));

  x[7] = std::bit_cast<double>(std::uint64_t{0x7ff8} << 48);
  try {
    collider.collide_all(set, agents);
    std::printf("NaN is accepted\n");
    return 1;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
}
