// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/baseline_scene.hpp"

#include <cstdlib>
#include <ios>

#include "layout/character/skinning.hpp"

namespace bch::test {
namespace {

/// A number as operator<< wrote it with std::hexfloat, which operator>> does not read.
double next_number(std::istream& text) {
  std::string word;
  if (!(text >> word)) throw std::invalid_argument("BCH_REPLAY: fewer than 8 numbers");
  return std::strtod(word.c_str(), nullptr);
}

PairScene replayed_scene(const std::string& line, std::size_t bodies) {
  std::istringstream text(line);
  PairScene scene;
  for (int agent = 0; agent < 2; ++agent) {
    std::uint32_t shape = 0;
    if (!(text >> shape) || shape >= bodies) throw std::invalid_argument("BCH_REPLAY: no such shape");
    const double x = next_number(text), y = next_number(text), heading = next_number(text);
    scene.crowd.add({shape, x, y, heading, 0});
  }
  scene.pairs = {{0, 1}};
  return scene;
}

}  // namespace

std::vector<baselines::Body> posed_bodies(const std::vector<Character>& characters, std::uint32_t poses) {
  std::vector<baselines::Body> bodies;
  for (const Character& character : characters) {
    detail::Skinner skinner(character);
    ShapeBuilder shape_builder(character);
    for (const PoseTime& time : sample_poses(character, poses)) {
      const auto positions = skinner.pose(time);
      bodies.push_back(
          {{positions.begin(), positions.end()}, character.triangles, shape_builder.shape(time)});
    }
  }
  return bodies;
}

std::vector<Answers> build_all(const std::vector<baselines::Body>& bodies) {
  std::vector<Answers> all;
  for (const baselines::Kind& kind : baselines::kinds()) all.push_back({&kind, kind.build(bodies, {}), {}});
  return all;
}

bool replaying() {
  return std::getenv("BCH_REPLAY") != nullptr;
}

PairScene placements(std::uint64_t seed, const std::vector<baselines::Body>& bodies, std::uint32_t pairs) {
  if (const char* line = std::getenv("BCH_REPLAY")) return replayed_scene(line, bodies.size());
  pairs = samples(pairs);
  Random random(seed);
  PairScene scene;
  const auto count = static_cast<std::uint32_t>(bodies.size());
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::uint32_t a = random.below(count), b = random.below(count);
    const auto radius = [&](std::uint32_t body) {
      return static_cast<double>(bodies[body].shape.hierarchy.nodes[0].disc.radius);
    };
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double distance = (radius(a) + radius(b)) * random.uniform(0.1, 1.1);
    const double x = random.uniform(-50, 50), y = random.uniform(-50, 50);
    scene.crowd.add({a, x, y, random.uniform(-10, 10), 0});
    scene.crowd.add(
        {b, x + distance * std::cos(angle), y + distance * std::sin(angle), random.uniform(-10, 10), 0});
    scene.pairs.push_back(random.below(2) == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  return scene;
}

void slide_to_contact(std::uint64_t seed, PairScene& scene,
                      const std::vector<const baselines::Structure*>& structures) {
  if (replaying()) return;
  Random random(seed);
  Crowd& crowd = scene.crowd;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::size_t a = 2 * i, b = a + 1;
    const baselines::Structure& structure = *structures[i % structures.size()];
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double dx = std::cos(angle), dy = std::sin(angle);
    const double dz = crowd.z.empty() ? 0 : random.uniform(-1, 1);
    const auto hits_at = [&](double distance) {
      crowd.x[b] = crowd.x[a] + distance * dx;
      crowd.y[b] = crowd.y[a] + distance * dy;
      if (dz != 0) crowd.z[b] = crowd.z[a] + distance * dz;
      return structure.query(crowd.agents(), scene.pairs[i], all_depths);
    };
    double near = 0, far = 3;
    for (int step = 0; step < 45; ++step) {
      const double middle = 0.5 * (near + far);
      (hits_at(middle) ? near : far) = middle;
    }
    const double step = random.below(2) == 0 ? far - near : 1e-9;
    hits_at(near + step * (static_cast<int>(random.below(17)) - 8));
  }
}

std::string replay_line(const PairScene& scene, std::size_t pair) {
  std::ostringstream line;
  line << std::hexfloat << "replay: BCH_REPLAY=\"";
  for (const std::size_t i : {2 * pair, 2 * pair + 1})
    line << (i % 2 == 0 ? "" : " ") << scene.crowd.shape[i] << ' ' << scene.crowd.x[i] << ' '
         << scene.crowd.y[i] << ' ' << scene.crowd.heading[i];
  line << "\" with --gtest_filter=<this test>";
  return line.str();
}

}  // namespace bch::test
