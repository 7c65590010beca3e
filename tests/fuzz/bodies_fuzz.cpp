// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Bodies of arbitrary spheres in arbitrary places: every implementation answers like brute force. Models of arbitrary meshes in arbitrary
// poses: their spheres hold all triangles.

#include <bch/bodies.hpp>

#include <cmath>
#include <memory>
#include <stdexcept>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "baselines/body_reference.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/body_scenes.hpp"
#include "tests/support/covered_triangles.hpp"

namespace bch::fuzz {
namespace {

/// Returns a step from a micrometre to a hundred metres.
float step_of(Bytes& bytes) {
  return std::ldexp(1.0f, static_cast<int>(bytes.below(28)) - 20);
}

std::vector<Sphere> spheres_of(Bytes& bytes) {
  const float step = step_of(bytes) / 256;
  std::vector<Sphere> spheres(1 + bytes.below(40));
  for (Sphere& s : spheres)
    s = {bytes.number(step), bytes.number(step), bytes.number(step), std::abs(bytes.number(step / 16))};
  return spheres;
}

/// Places agents by twos, each beside the other by about the bodies' extents.
test::BodyCrowd crowd_of(Bytes& bytes, const BodySet& bodies) {
  constexpr double worlds[] = {0, 1, -1e3, 1e6, 1e7, -9e8};
  test::BodyCrowd crowd;
  const auto add = [&](double x, double y, double z) {
    crowd.body.push_back(bytes.below(bodies.body_count()));
    crowd.x.push_back(x), crowd.y.push_back(y), crowd.z.push_back(z);
    crowd.heading.push_back(bytes.below(2) == 0 ? bytes.below(9) * 0.78539816339744831
                                                : 1e-9 * bytes.take<std::int32_t>());
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double x = worlds[bytes.below(6)], y = worlds[bytes.below(6)], z = worlds[bytes.below(5)];
    add(x, y, z);
    const double step = double{step_of(bytes)} / 4096;
    add(x + step * bytes.take<std::int16_t>(), y + step * bytes.take<std::int16_t>(),
        z + step * bytes.take<std::int16_t>());
    crowd.pairs.push_back(bytes.below(2) == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  return crowd;
}

void check(const BodySet& bodies, const test::BodyCrowd& crowd, double distance) {
  const baselines::BodyReference reference(bodies);
  const Agents agents = crowd.agents();
  const std::size_t n = crowd.pairs.size();
  Crowd finder;
  std::vector<std::uint8_t> hits(n), near(n);
  std::vector<float> gaps(n), times(n);
  std::vector<DiscPair> spheres(n);
  const std::vector<double> way(n, distance);
  for (const Implementation& implementation : implementations()) {
    if (!implementation.supported()) continue;
    collide(bodies, agents, crowd.pairs, hits, &implementation);
    within(bodies, agents, crowd.pairs, {&distance, 1}, near, &implementation);
    clearance(bodies, agents, crowd.pairs, {.distance = gaps, .spheres = spheres},
              {.implementation = &implementation, .overlap = Overlap::deepest});
    time_of_impact(bodies, agents, crowd.pairs, {way, way, way}, times, &implementation);
    const auto contacts = finder.contacts(bodies, agents, crowd.pairs, &implementation);
    for (std::size_t i = 0; i < n; ++i) {
      const Pair pair = crowd.pairs[i];
      const baselines::BodyClearance expected = reference.clearance(agents, pair);
      require((hits[i] != 0) == reference.collide(agents, pair), "collisions are those of brute force");
      require((near[i] != 0) == reference.within(agents, pair, distance), "within is that of brute force");
      require(gaps[i] == expected.distance && spheres[i] == DiscPair{expected.first, expected.second},
              "distances are those of brute force");
      require(times[i] == reference.time_of_impact(agents, pair, distance, distance, distance),
              "times are those of brute force");
      require(contacts[i].empty() == (hits[i] == 0), "those that collide have contacts");
    }
  }
}

Affine3d affine_of(Bytes& bytes, float step) {
  Affine3d map;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      map.rows[i][j] = (i == j ? 1.0 : 0.0) + double{bytes.number(j == 3 ? step : 0x1p-14f)};
  return map;
}

/// Makes a mesh that two bones move.
Character character_of(Bytes& bytes, float step) {
  Character character;
  character.name = "soup";
  character.joints.resize(2);
  character.joints[1].parent = 0;
  character.bones.resize(2);
  character.bones[1].joint = 1;
  character.root_joint = 0;
  const std::uint32_t vertices = 3 + bytes.below(20), triangles = 1 + bytes.below(4);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    character.influence_begin.push_back(static_cast<std::uint32_t>(character.influences.size()));
    character.vertices.push_back({bytes.number(step), bytes.number(step), bytes.number(step)});
    const float weight = static_cast<float>(bytes.below(5)) / 4;
    if (weight > 0) character.influences.push_back({0, weight});
    if (weight < 1) character.influences.push_back({1, 1 - weight});
  }
  character.influence_begin.push_back(static_cast<std::uint32_t>(character.influences.size()));
  for (std::uint32_t t = 0; t < triangles; ++t)
    character.triangles.push_back({bytes.below(vertices), bytes.below(vertices), bytes.below(vertices)});
  return character;
}

void check_model(Bytes& bytes) {
  const float step = step_of(bytes) / 4096;
  const BodyModel model =
      make_body(character_of(bytes, step), {.spheres = 1 + bytes.below(16), .draft = true});
  validate(model);
  require(to_bytes(body_model(to_bytes(model))) == to_bytes(model), "bytes of a model are read as they are");
  const test::CoveredTriangles triangles(model);
  BodyPoser poser(model);
  test::expect_covered(triangles, poser, *model.character, Pose());
  for (int pose = 0; pose < 4; ++pose) {
    const Affine3d bones[] = {affine_of(bytes, step), affine_of(bytes, step)};
    test::expect_covered(triangles, poser, *model.character, SkinningPalette{bones, 0, 0});
  }
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  try {
    if (bytes.below(2) == 0) {
      std::vector<std::vector<Sphere>> spheres(3);
      for (auto& body : spheres) body = fuzz::spheres_of(bytes);
      const BodySet bodies(spheres);
      const double distance = static_cast<double>(std::abs(bytes.coordinate(fuzz::step_of(bytes) / 4096)));
      fuzz::check(bodies, fuzz::crowd_of(bytes, bodies), distance);
    } else {
      fuzz::check_model(bytes);
    }
  } catch (const std::invalid_argument&) {  // no body: out of range, not finite, nothing there
  } catch (const std::domain_error&) {      // a pose out of range
  }
  return 0;
}
