// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/baked_output.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <optional>
#include <string_view>

#include "layout/baked/format.hpp"
#include "layout/baked/image.hpp"

namespace bch::cli {
namespace {

/// Bytes: a large page. Of the file, too, as a file cache has large pages where they are written at once, and mapping
/// the file is then done sooner.
constexpr std::size_t piece = std::size_t{2} << 20;

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Returns whether a part of an image is an array that write_arrays() writes.
bool is_array(std::size_t part) {
  constexpr auto arrays = static_cast<std::size_t>(detail::baked::Section::settings);
  return part % 2 == 0 && part > 0 && part / 2 <= arrays;
}

}  // namespace

BakedOutput::BakedOutput(const std::string& file, std::size_t shapes, const ShapeSetPlan& plan)
    : file_(file),
      can_write_ahead_(file_.is_regular() && plan.slices.empty()),
      nodes_offset_(detail::baked::nodes_offset(shapes, plan.depths.size())) {}

void BakedOutput::write_ahead(std::span<const float> nodes) {
  if (!can_write_ahead_) return;
  const auto bytes = std::as_bytes(nodes);
  const std::uint64_t begin = nodes_offset_ + ahead_, end = (nodes_offset_ + bytes.size()) / piece * piece;
  if (end <= begin) return;
  file_.write_at(begin, text(bytes.subspan(ahead_, end - begin)));
  ahead_ += end - begin;
}

/// With what is there already left out.
void BakedOutput::write_arrays(const detail::ShapeArrays& shapes) {
  detail::baked::Arrays arrays{shapes, {}, {}, {}, {}};
  std::uint64_t offset = detail::baked::sections_offset;
  detail::baked::for_each_section(
      arrays, [&](detail::baked::Section section, const char*, const auto& array) {
        const auto bytes = std::as_bytes(array);
        const std::size_t written = section == detail::baked::Section::nodes ? ahead_ : 0;
        file_.write_at(offset + written, text(bytes.subspan(written)));
        offset += detail::baked::padded(bytes.size());
      });
}

void BakedOutput::finish(const BakedShapes& baked) {
  const detail::ShapeArrays& shapes = baked.set.arrays();
  // A set of which every cut turned out to be a single disc has let its trees go.
  if (ahead_ > shapes.nodes.size_bytes()) file_.clear(), ahead_ = 0;
  std::optional<detail::BakedImage> image;
  tbb::parallel_invoke([&] { image.emplace(baked.set, baked.origins, baked.clips); },
                       [&] {
                         if (file_.is_regular()) write_arrays(shapes);
                       });
  for (std::size_t i = 0; i < image->parts().size(); ++i) {
    const std::span<const std::byte> part = image->parts()[i];
    file_.is_regular() && is_array(i) ? file_.skip(part.size()) : file_.write(text(part));
  }
  file_.commit();
}

BakedShapes bake_file(const std::string& file, std::span<const LoadedCharacter> characters,
                      std::span<const ShapeSource> sources, double threshold, const ShapeSetPlan& plan,
                      const CostLimits& limits, std::span<const ClipOf> animated) {
  BakedOutput output(file, sources.size(), plan);
  const auto write_ahead = [&](std::span<const float> nodes) { output.write_ahead(nodes); };
  AnimateOptions how;
  how.slices = plan.slices;
  BakedShapes baked{bake_shapes(characters, sources, threshold, plan, write_ahead, limits),
                    origins_of(characters, sources, threshold), bake_clips(characters, animated, how)};
  output.finish(baked);
  return baked;
}

}  // namespace bch::cli
