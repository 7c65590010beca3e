// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <bch/bch.hpp>

// Prints what must not depend on anybody's compiler flags: a hash of every query's answers, and whether NaN is refused. Input is of
// integers over powers of two, which every flag leaves exact.

namespace {

std::uint64_t state = 1;

double random_number(double range) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 44) / 1048576.0 * range;
}

std::uint32_t random_index(std::uint32_t count) {
  return static_cast<std::uint32_t>(random_number(count));
}

std::vector<double> random_numbers(std::size_t count, double range) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(random_number(range));
  return numbers;
}

/// A star of eight corners about the origin.
bch::Shape star() {
  constexpr float way[8][2] = {{1, 0},  {.75f, .75f},   {0, 1},  {-.75f, .75f},
                               {-1, 0}, {-.75f, -.75f}, {0, -1}, {.75f, -.75f}};
  std::vector<bch::Vec2> corners;
  for (const auto& [x, y] : way) {
    const float length = .125f + static_cast<float>(random_index(64)) / 256;
    corners.push_back({x * length, y * length});
  }
  return bch::shape_from_polygons({&corners, 1});
}

std::vector<bch::Shape> shapes() {
  std::vector<bch::Shape> all;
  for (int k = 0; k < 16; ++k) all.push_back(star());
  const std::vector<bch::Capsule> arm{{{-.25f, 0}, {.25f, .125f}, .0625f}};
  all.push_back(bch::shape_from_capsules(arm));
  return all;
}

/// Two discs that come and go.
bch::AnimatedShape swinging() {
  const bch::AnimatedChunk chunk{
      {0, 1, 2},
      2,
      {{0, 0, .25f}, {.25f, 0, .25f}, {0, 0, .25f}, {.5f, 0, .25f}, {0, 0, .25f}, {.25f, 0, .25f}}};
  return bch::AnimatedShape({.chunks = {chunk}, .loops = true});
}

/// Hashes the answers of one query, bit by bit.
class Hash {
 public:
  explicit Hash(const char* query) : query_(query) {}
  Hash(const Hash&) = delete;
  ~Hash() { std::printf("%s %016llx\n", query_, static_cast<unsigned long long>(hash_)); }

  template <class Value>
  void add(std::span<const Value> values) {
    for (const std::byte byte : std::as_bytes(values))
      hash_ = (hash_ ^ static_cast<std::uint64_t>(byte)) * 1099511628211u;
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(std::span<const Value>(values));
  }
  template <class Value>
  void add(const bch::Rows<Value>& rows) {
    add(rows.offsets), add(rows.values);
  }
  void add(const std::vector<bch::Penetration>& ways) {  // without what pads them
    for (const auto& [depth, x, y] : ways) add(std::vector{double{depth}, x, y});
  }

 private:
  const char* query_;
  std::uint64_t hash_ = 14695981039346656037u;
};

struct Crowd {
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;

  explicit Crowd(std::size_t count)
      : x(random_numbers(count, 32)), y(random_numbers(count, 32)), heading(random_numbers(count, 8)) {
    for (std::size_t i = 0; i < count; ++i) shape.push_back(random_index(17));
  }
  operator bch::Agents() const { return {shape, x, y, heading}; }
};

/// Both for pairs, and for agents among obstacles.
template <class... Others>
void query_distances(const bch::ShapeSet& set, const bch::Agents& agents, std::size_t count,
                     const Others&... others) {
  std::vector<float> values(count);
  std::vector<bch::Vec2> directions(count);
  std::vector<bch::DiscPair> discs(count);
  std::vector<std::uint8_t> hits(count);
  const std::vector<double> gaps = random_numbers(count, .5);
  Hash clearance("clearance"), within("within"), collide("collide");
  for (const bch::Leaves leaves : {bch::Leaves::discs, bch::Leaves::segments}) {
    bch::clearance(set, agents, others..., {values, directions, discs}, {.leaves = leaves});
    clearance.add(values), clearance.add(directions), clearance.add(discs);
    if constexpr ((std::is_same_v<Others, bch::ObstacleSet> && ...))
      bch::within(set, agents, others..., gaps, hits, leaves);
    else
      bch::within(set, agents, others..., gaps, hits);
    within.add(hits);
    bch::collide(set, agents, others..., hits, {.leaves = leaves});
    collide.add(hits);
  }
  bch::clearance(set, agents, others..., {values, directions},
                 {.max_distance = .25, .overlap = bch::Overlap::deepest});
  clearance.add(values), clearance.add(directions);
}

void query_all(const bch::ShapeSet& set, const Crowd& crowd) {
  const bch::Agents agents = crowd;
  const std::size_t count = agents.size();
  bch::Crowd of;
  Hash("collisions").add(of.collisions(set, agents).span());
  Hash("contacts").add(of.contacts(set, agents).contacts);
  Hash("clearances").add(of.clearances(set, agents, {.max_distance = .25}).distance);
  const std::span<const bch::Pair> pairs = of.candidates(set, agents, .25).span();
  Hash("candidates").add(pairs);
  query_distances(set, agents, pairs.size(), pairs);
  std::vector<bch::Penetration> ways(pairs.size());
  bch::penetration(set, agents, pairs, 16, ways);
  Hash("penetration").add(ways);
  std::vector<float> times(pairs.size());
  const std::vector<double> x = random_numbers(pairs.size(), 1), y = random_numbers(pairs.size(), 1);
  bch::time_of_impact(set, agents, pairs, {x, y}, times);
  Hash("time_of_impact").add(times);

  const bch::ObstacleSet walls =
      bch::obstacles_from_wkt("POLYGON((4 4, 8 4, 7 9, 4 4)) LINESTRING(0 16, 32 17, 16 30)");
  query_distances(set, agents, count, walls);
  ways.resize(count), times.resize(count);
  bch::penetration(set, agents, walls, ways);
  Hash("penetration").add(ways);
  bch::time_of_impact(set, agents, {std::span(x).first(count), std::span(y).first(count)}, walls, times);
  Hash("time_of_impact").add(times);
}

void query_motions(const Crowd& crowd) {
  const bch::AnimatedShape body = swinging();
  std::vector<std::vector<bch::PathKey>> paths;
  std::vector<bch::Motion> motions;
  std::vector<bch::Pair> pairs;
  for (std::uint32_t i = 0; i < 200; ++i) {
    paths.push_back({{0, crowd.x[i], crowd.y[i], 0}, {8, crowd.y[i], crowd.x[i], crowd.heading[i]}});
    motions.push_back({&body, paths.back(), crowd.heading[i]});
    if (i > 0) pairs.push_back({i - 1, i});
  }
  std::vector<double> times(pairs.size());
  bch::first_contact(motions, pairs, {0, 8}, times);
  Hash("first_contact").add(times);
}

#if defined(__cpp_exceptions)
/// Prints why a call is refused.
template <class Call>
bool is_refused(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return true;
  }
  std::printf("NaN is accepted\n");
  return false;
}

bool is_nan_refused(const bch::ShapeSet& set, Crowd crowd) {
  const double nan = crowd.x[7] = std::bit_cast<double>(std::uint64_t{0x7ff8} << 48);
  const std::vector<bch::Vec2> corners{{0, 0}, {1, 0}, {static_cast<float>(nan), 1}};
  // Without optimisation these are functions of this program, which with -ffast-math are always true.
  if (std::isfinite(nan) != std::isfinite(corners[2].x)) return false;
  bch::Crowd of;
  return is_refused([&] { of.collisions(set, crowd); }) && is_refused([&] {
           bch::outline_from_polygons({&corners, 1});
         });
}
#else
bool is_nan_refused(const bch::ShapeSet&, const Crowd&) {
  return true;  // and the call would end the program
}
#endif

}  // namespace

int main() {
  const Crowd crowd(4000);
  const bch::ShapeSet set(shapes());
  query_all(set, crowd);
  query_motions(crowd);
  return is_nan_refused(set, crowd) ? 0 : 1;
}
