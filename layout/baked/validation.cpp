// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/validation.hpp"

#include <stdexcept>
#include <string>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/format/shape_validation.hpp"

namespace bch::detail::baked {

void reject(const char* section, std::size_t place, const std::string& what) {
  throw std::invalid_argument(std::string(section) + " " + std::to_string(place) + ": " + what);
}

namespace {

void require_settings(std::span<const Settings> settings) {
  if (settings.size() != 1)
    throw std::invalid_argument("settings: " + std::to_string(settings.size()) + ", not 1");
  if (!is_finite(settings[0].threshold) || settings[0].threshold < 0)
    reject("settings", 0, "threshold " + shortest(settings[0].threshold));
}

/// Returns: how many there are.
std::size_t require_names(std::span<const std::uint32_t> begin, std::size_t size) {
  if (begin.empty() || begin.front() != 0) throw std::invalid_argument("name_begin: does not begin with 0");
  for (std::size_t i = 1; i < begin.size(); ++i)
    if (begin[i] < begin[i - 1]) reject("name_begin", i, std::to_string(begin[i]) + " does not ascend");
  if (begin.back() != size)
    reject("name_begin", begin.size() - 1,
           std::to_string(begin.back()) + " is not the end, " + std::to_string(size));
  return begin.size() - 1;
}

void require_origins(std::span<const ShapeOrigin> origins, std::size_t shapes, std::size_t names) {
  if (!origins.empty() && origins.size() != shapes)
    throw std::invalid_argument("origins: " + std::to_string(origins.size()) + " of " +
                                std::to_string(shapes) + " shapes");
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const auto& [character, clip, seconds] = origins[i];
    if (character >= names) reject("origins", i, "character has name " + std::to_string(character));
    if (clip >= names && clip != ShapeOrigin::no_clip)
      reject("origins", i, "clip has name " + std::to_string(clip));
    if (!is_finite(seconds)) reject("origins", i, "time " + shortest(seconds) + " s");
  }
}

void require_bodies(const BodyArrays& bodies) {
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < bodies.ends.size(); begin = bodies.ends[i++])
    if (bodies.ends[i] < begin) reject("body_ends", i, std::to_string(bodies.ends[i]) + " does not ascend");
  if (begin != bodies.bytes.size())
    throw std::invalid_argument("body_ends: they end with " + std::to_string(begin) + ", and there are " +
                                std::to_string(bodies.bytes.size()) + " body_bytes");
}

}  // namespace

void validate(const Arrays& arrays, const std::function<void(std::size_t)>& before_nodes) {
  const FloatingPointStateGuard floats;
  detail::validate(arrays.shapes, before_nodes);
  require_settings(arrays.settings);
  require_origins(arrays.origins, arrays.shapes.shape_count(),
                  require_names(arrays.name_begin, arrays.names.size()));
  require_bodies(arrays.bodies);
}

}  // namespace bch::detail::baked
