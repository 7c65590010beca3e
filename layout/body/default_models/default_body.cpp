// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <bch/bodies.hpp>

#include "layout/base/base64.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/body/model/model_bytes.hpp"
#include "layout/default_character/character_at_rest.hpp"

namespace bch {

using namespace detail;

namespace {

// Bytes of models in base64, line by line, as `bch_lab models` writes them.
constexpr std::string_view male_64[] = {
#include "layout/body/default_models/male_64.inc"
};
constexpr std::string_view male_128[] = {
#include "layout/body/default_models/male_128.inc"
};
constexpr std::string_view male_256[] = {
#include "layout/body/default_models/male_256.inc"
};
constexpr std::string_view male_512[] = {
#include "layout/body/default_models/male_512.inc"
};
constexpr std::string_view female_64[] = {
#include "layout/body/default_models/female_64.inc"
};
constexpr std::string_view female_128[] = {
#include "layout/body/default_models/female_128.inc"
};
constexpr std::string_view female_256[] = {
#include "layout/body/default_models/female_256.inc"
};
constexpr std::string_view female_512[] = {
#include "layout/body/default_models/female_512.inc"
};

/// A number of spheres, and the models that have so many.
struct DefaultModels {
  std::uint32_t spheres;
  std::span<const std::string_view> male, female;
};
constexpr DefaultModels default_models[] = {{64, male_64, female_64},
                                            {128, male_128, female_128},
                                            {256, male_256, female_256},
                                            {512, male_512, female_512}};

/// Says whether a character has the skin and the skeleton of a shape: clips, stature and root joint may be others. Compared with what
/// this very machine makes of the shape, because libm's last bits differ from machine to machine.
bool is_of(const Character& c, const BodyShape& shape) {
  const Character other = character_at_rest({}, shape);
  return c.vertices == other.vertices && c.triangles == other.triangles && c.bones == other.bones &&
         c.joints == other.joints && c.influence_begin == other.influence_begin &&
         c.influences == other.influences;
}

}  // namespace

BodyModel default_body(const Character& built_in, std::uint32_t spheres) {
  const FloatingPointStateGuard floats;
  const auto with = [&](std::span<const std::string_view> lines) {
    std::string text;
    for (const std::string_view line : lines) text += line;
    return model_from(from_base64(text), std::make_shared<const Character>(built_in));
  };
  const bool is_male = is_of(built_in, male_shape());
  if (!is_male && !is_of(built_in, female_shape()))
    throw std::invalid_argument(
        "default_body: expected the skin and skeleton of default_male() or default_female(), found those of "
        "'" +
        built_in.name + "', whose model make_body() makes");
  for (const DefaultModels& models : default_models)
    if (models.spheres == spheres) return with(is_male ? models.male : models.female);
  throw std::invalid_argument("default_body: expected 64, 128, 256 or 512 spheres, found " +
                              std::to_string(spheres) + ", which make_body() makes");
}

}  // namespace bch
