// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/baked_bytes.hpp"

#include "layout/baked/checksum.hpp"
#include "layout/baked/image.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

std::vector<Shape> few_shapes() {
  Random random(71);
  Outline two = star(random, 9, 0.2, 0.3);
  append(two, star(random, 5, 0.05, 0.1, 0.8, 0.1));
  return {contour_shape(star(random, 40, 0.2, 0.4), 0.01f), contour_shape(two, 0.05f),
          contour_shape(star(random, 4, 0.1, 0.1), 0.5f)};
}

ShapeOrigins origins_of(std::size_t shapes) {
  ShapeOrigins origins{0.01, {"man.glb", "walk", "", "run \xc3\xbc"}, {}};
  for (std::uint32_t s = 0; s < shapes; ++s)
    origins.origins.push_back({0, s == 0 ? ShapeOrigin::no_clip : 1 + s % 3, 0.25f * static_cast<float>(s)});
  return origins;
}

std::vector<BakedClip> few_clips() {
  const AnimatedChunk first{{1, 3, 4},
                            3,
                            {{0, 0, 1},
                             {1, 0, 1},
                             {0, 1, 1},
                             {0, 0.25f, 1},
                             {1.5f, 0, 1},
                             {0, 1, 1},
                             {-0.125f, 0, 1},
                             {1, 0, 0.5f},
                             {0, 1, 1}}};
  const AnimatedChunk next{{4, 4.5}, 2, {{5, 0, 1}, {6, 0, 1}, {5, 0, 1}, {6, 0, 2}}};
  const AnimatedChunk fine{{0, 0.1}, 1, {{0.1f, 0.3f, 0.2f}, {100, -0.7f, 0.2f}}};
  return {{0, 1, {{first, next}, true}}, {3, ShapeOrigin::no_clip, {{fine}, false}}};
}

std::vector<BakedBody> few_bodies() {
  return {{std::byte{7}, std::byte{0}, std::byte{255}}, {}, {std::byte{1}}};
}

BakedBytes::BakedBytes(const ShapeSet& set, const ShapeOrigins& origins, std::span<const BakedClip> clips,
                       std::span<const BakedBody> bodies) {
  const detail::BakedImage image(set, origins, clips, bodies);
  for (const auto part : image.parts()) bytes_.insert(bytes_.end(), part.begin(), part.end());
}

std::string BakedBytes::text() const {
  return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
}

void BakedBytes::seal() {
  for (detail::baked::SectionEntry& entry : preamble().entries) {
    const std::size_t size = entry.count * entry.element_size;
    entry.checksum = detail::baked::checksum(
        std::span<const std::byte>(bytes_).subspan(entry.offset, detail::baked::padded(size)));
  }
  seal_header();
}

void BakedBytes::seal_header() {
  preamble().header.checksum = detail::baked::checksum(preamble());
}

BakedShapes BakedBytes::load() const {
  return load_baked(bytes_, "file", nullptr);
}

BakedShapes BakedBytes::load_first(std::size_t size) const {
  detail::AlignedVector<std::byte> few(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
  few.shrink_to_fit();
  return load_baked(few, "file", nullptr);
}

std::string BakedBytes::error() const {
  try {
    load();
  } catch (const BakedFileError& error) {
    return error.what();
  }
  return {};
}

}  // namespace bch::test
