// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>
#include <bch/motion.hpp>
#include <bch/pairs.hpp>
#include <bch/poses.hpp>

// Motions: a man walks towards another one, who stands there. first_contact() tells when they touch; AnimatedShape::spheres() makes
// their bodies at that time, and at any other one, for every query.

namespace {

/// Returns the first half second of a clip, played over and over.
bch::AnimatedDiscs first_half_second(bch::Character character, std::uint32_t clip) {
  character.clips[clip].seconds = 0.5f;
  bch::AnimatedDiscs discs = bch::animate(bch::make_body(character, {.spheres = 64, .draft = true}), clip);
  discs.loops = true;
  return discs;
}

}  // namespace

int main() {
  const bch::Character man = bch::default_male();
  const bch::AnimatedShape body(first_half_second(man, 0));

  // One walks 1 m a second along x for 5 s, the other one stands in the way and looks at him.
  const std::vector<bch::PathKey> walk = {{0, -3, 0, 0}, {5, 2, 0, 0}}, stand = {{0, 0, 0, std::numbers::pi}};
  const std::vector<bch::Motion> motions = {{&body, walk, 0}, {&body, stand, 0.25}};
  const std::vector<bch::Pair> pairs = {{0, 1}};
  double contact = 0;
  bch::first_contact(motions, pairs, {0, 5}, {&contact, 1});
  const double free = bch::free_until(motions[0], std::vector<bch::Motion>{motions[1]}, {0, 5});
  std::printf("they touch at %.3f s; the first one is free until %.3f s\n", contact, free);

  const auto overlap_at = [&](double time) {
    const std::vector<std::vector<bch::Sphere>> bodies = {body.spheres(time - motions[0].clip_begin),
                                                          body.spheres(time - motions[1].clip_begin)};
    const bch::BodySet set(bodies);
    const std::vector<std::uint32_t> shape = {0, 1};
    const std::vector<double> x = {-3 + time, 0}, y = {0, 0}, heading = {0, std::numbers::pi};
    std::uint8_t hit = 0;
    bch::collide(set, {shape, x, y, heading}, pairs, {&hit, 1});
    return hit != 0;
  };
  // Nothing overlaps before the first contact, and somebody who goes on is in the other one.
  const bool before = overlap_at(contact - 0.001), after = overlap_at(contact + 0.25);
  std::printf("a millisecond before: %s; a quarter of a second on: %s\n", before ? "overlap" : "apart",
              after ? "overlap" : "apart");
  return contact == free && !before && after ? 0 : 1;
}
