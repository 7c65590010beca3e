// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/body_models.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/progress.hpp"
#include "layout/body/body_record.hpp"

namespace bch::cli {

void BodyKind::add_to(CLI::App& command) {
  OptionAdder{command}("--bodies", bodies, "KIND",
                       "Bodies: outlines, seen from above, or spheres bound to bones, in space [outlines]",
                       one_of({"outlines", "spheres"}));
  add_spheres_option(command, spheres);
}

bool BodyKind::are_spheres(const CLI::App& command) const {
  if (bodies == "spheres") return true;
  require_absent(command, {"--spheres"}, "belongs to --bodies spheres");
  return false;
}

void add_spheres_option(CLI::App& command, std::uint32_t& spheres) {
  OptionAdder{command}("--spheres", spheres, "N", fmt::format("Spheres per body [{}]", spheres),
                       whole_between(1, detail::max_spheres));
}

BodySet posed_bodies(std::span<const BodyModel> models, std::span<const PoseId> sources) {
  std::vector<PoseOfBody> bodies;
  for (const PoseId& source : sources) bodies.push_back({source.character, source.at});
  return bake(models, {.bodies = bodies});
}

namespace {

/// Returns the model that comes with the library, where there is one.
std::optional<BodyModel> model_of_library(const Character& character, std::uint32_t spheres) try {
  return default_body(character, spheres);
} catch (const std::invalid_argument&) {
  return {};
}

}  // namespace

std::vector<BodyModel> make_models(std::span<const LoadedCharacter> characters, std::uint32_t spheres,
                                   bool draft) {
  constexpr std::size_t steps = 100;  // of a character
  std::vector<BodyModel> models;
  Progress bar("placing spheres", steps * characters.size());
  for (const LoadedCharacter& loaded : characters) try {
      std::size_t done = 0;
      const auto advance_to = [&](double fraction) {
        for (; static_cast<double>(done) < fraction * steps; ++done) bar.advance();
        return true;
      };
      auto model = model_of_library(loaded.character, spheres);
      if (!model)
        model = make_body(loaded.character, {.spheres = spheres, .draft = draft, .progress = advance_to});
      models.push_back(std::move(*model));
      advance_to(1);
    } catch (const std::invalid_argument& error) {
      throw InputError(loaded.source + ": " + error.what());
    }
  return models;
}

}  // namespace bch::cli
