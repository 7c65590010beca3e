// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// A baked file made in bad faith: it is refused, or else every query on it ends, and so do poses of the models that are not refused.

#include <vector>

#include <bch/bodies.hpp>
#include <bch/files.hpp>

#include "layout/baked/checksum.hpp"
#include "layout/baked/format.hpp"
#include "layout/base/aligned_vector.hpp"
#include "layout/shape_set/verify.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/all_queries.hpp"
#include "tests/support/scenes.hpp"

namespace bch::fuzz {
namespace {

using Image = detail::AlignedVector<std::byte>;

/// Makes the checksums of all sections that lie inside right, and the header's: else nothing but a good file
/// would ever pass them.
void seal(Image& image) {
  detail::baked::Preamble preamble;
  if (image.size() < sizeof preamble) return;
  std::memcpy(&preamble, image.data(), sizeof preamble);
  for (detail::baked::SectionEntry& entry : preamble.entries) {
    if (entry.element_size > 4096 || entry.count > image.size() || entry.offset > image.size()) continue;
    const std::size_t size = entry.count * entry.element_size;
    const std::size_t whole = detail::baked::padded(size);
    if (whole > image.size() - entry.offset) continue;
    entry.checksum = detail::baked::checksum(std::span<const std::byte>(image).subspan(entry.offset, whole));
  }
  preamble.header.checksum = 0;
  preamble.header.checksum = detail::baked::checksum(preamble);
  std::memcpy(image.data(), &preamble, sizeof preamble);
}

void query(const ShapeSet& set, const Implementation& implementation) {
  test::Crowd crowd;
  for (std::uint32_t s = 0; s < std::min(set.shape_count(), 6u); ++s)
    for (std::uint32_t level = 0; level < std::min(set.level_count(), 4u); ++level)
      crowd.add({s, 0.1 * level, 0.05 * s, 0.7 * level, static_cast<std::uint8_t>(level)});
  if (set.has_heights())
    for (std::size_t i = 0; i < crowd.x.size(); ++i) crowd.z.push_back(0.3 * static_cast<double>(i % 3));
  const Agents agents = crowd.agents();
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < agents.size(); ++a)
    for (std::uint32_t b = 0; b <= a; ++b) pairs.push_back({a, b});

  test::query_all(set, agents, pairs, implementation);
  test::query_all_of_a_dynamic_copy(set, agents, pairs, implementation);
  detail::verify(set);
}

/// Looks at clips that are not too long for that.
void play(std::span<const BakedClip> clips) {
  for (const auto& [character, clip, discs] : clips) {
    std::size_t numbers = 0;
    for (const AnimatedChunk& chunk : discs.chunks) numbers += chunk.keys.size();
    if (numbers > 2000) continue;
    const AnimatedShape shape(discs);
    const double end = shape.end();
    for (const double seconds : {shape.begin(), shape.begin() / 2 + end / 2, end, end + 0.3})
      ShapeSet({{shape.shape(seconds)}}, {});
  }
}

/// Poses the bodies of models that are accepted.
void pose(std::span<const BakedBody> bodies) {
  for (const BakedBody& body : bodies) try {
      BodyPoser(body_model(body)).spheres({});
    } catch (const std::logic_error&) {
    }
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  const auto mode = bytes.take<std::uint8_t>();
  const auto rest = std::as_bytes(bytes.rest());
  fuzz::Image image(rest.begin(), rest.end());
  image.shrink_to_fit();
  if (mode % 2 == 1) fuzz::seal(image);
  try {
    const BakedShapes baked = load_baked(image, "file", nullptr);
    const auto all = implementations();
    const Implementation& implementation = all[mode / 2 % all.size()];
    if (implementation.supported()) fuzz::query(baked.set, implementation);
    fuzz::play(baked.clips);
    fuzz::pose(baked.bodies);
  } catch (const BakedFileError&) {
  }
  return 0;
}
