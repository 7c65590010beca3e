// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/structure.hpp"
#include "tests/support/scenes.hpp"

// Characters in poses, all structures over them, and placements to ask about.

namespace bch::test {

/// Returns bodies in poses spread over each character's clips.
std::vector<baselines::Body> posed_bodies(const std::vector<Character>& characters, std::uint32_t poses);

/// Answers of one structure to all pairs.
struct Answers {
  const baselines::Kind* kind;
  std::unique_ptr<baselines::Structure> structure;
  std::vector<std::uint8_t> hits;
};

/// Builds every kind over the bodies; answers are not yet asked for.
std::vector<Answers> build_all(const std::vector<baselines::Body>& bodies);

/// Makes pairs (2 i, 2 i + 1) of agents whose root discs overlap in most. If the environment variable
/// BCH_REPLAY holds what replay_line() printed, that one pair alone.
PairScene placements(std::uint64_t seed, const std::vector<baselines::Body>& bodies, std::uint32_t pairs);

/// Slides the second agent of every pair to where the answer of one of the structures (in turn) changes: half
/// of them to within 1e-13 m, the others to within 1e-8 m. Agents with heights move up or down on the way.
void slide_to_contact(std::uint64_t seed, PairScene& scene,
                      const std::vector<const baselines::Structure*>& structures);

bool replaying();

/// Returns a line that says how to run one failing pair again.
std::string replay_line(const PairScene& scene, std::size_t pair);

/// Returns whether an answer changes when the second agent moves by `shift` metres in one of 32 directions.
/// This is how the tests recognise touching.
template <class Answer>
bool touches(const PairScene& scene, std::size_t pair, double shift, Answer answer);

}  // namespace bch::test

template <class Answer>
bool bch::test::touches(const PairScene& scene, std::size_t pair, double shift, Answer answer) {
  PairScene moved;
  for (const std::size_t i : {2 * pair, 2 * pair + 1}) {
    moved.crowd.add({scene.crowd.shape[i], scene.crowd.x[i], scene.crowd.y[i], scene.crowd.heading[i], 0});
    if (!scene.crowd.z.empty()) moved.crowd.z.push_back(scene.crowd.z[i]);
  }
  const bool here = answer(moved.crowd.agents(), Pair{0, 1});
  const double x = moved.crowd.x[1], y = moved.crowd.y[1];
  for (int direction = 0; direction < 32; ++direction) {
    const double angle = direction * std::numbers::pi / 16;
    moved.crowd.x[1] = x + shift * std::cos(angle);
    moved.crowd.y[1] = y + shift * std::sin(angle);
    if (answer(moved.crowd.agents(), Pair{0, 1}) != here) return true;
  }
  return false;
}
