// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/text.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/cli/inspection.hpp"

namespace bch::cli {

std::vector<bool> BodyFacts::are_core() const {
  std::vector<bool> are(spheres.size());
  for (const std::uint32_t sphere : model.core) are[sphere] = true;
  return are;
}

BodyFacts examine(const BodyModel& model, const ShapeSource& source) {
  const BodySet set = posed_bodies({&model, 1}, {&source, 1});
  return {source, model, set.spheres(0), set.heights(0), set.bytes()};
}

std::string text_of(const LoadedCharacter& character, const BodyFacts& facts) {
  const auto [least, most] = std::ranges::minmax(facts.spheres, {}, &Sphere::radius);
  return fmt::format("\n{}\n", pose_title(character, facts.source.at)) +
         fact("  spheres", fmt::format("{}, radii of {:.1f} to {:.1f} mm", grouped(facts.spheres.size()),
                                       1e3 * double{least.radius}, 1e3 * double{most.radius})) +
         fact("  heights", fmt::format("{:.3f} to {:.3f} m", facts.heights.bottom, facts.heights.top)) +
         fact("  memory", fmt::format("{:.1f} kB", static_cast<double>(facts.bytes) / 1e3)) +
         fact("  model",
              fmt::format("{} to bones, {} of the skin, of which cuts made {}",
                          counted(facts.model.influences.size(), "binding"),
                          counted(facts.model.corners.size(), "corner"), grouped(facts.model.cuts.size())));
}

nlohmann::ordered_json json_of(const LoadedCharacter& character, const BodyFacts& facts) {
  nlohmann::ordered_json json{{"pose", pose_title(character, facts.source.at)},
                              {"bytes", facts.bytes},
                              {"bottom_m", shortest(facts.heights.bottom)},
                              {"top_m", shortest(facts.heights.top)},
                              {"core", facts.model.core}};
  for (const Sphere& s : facts.spheres)
    json["spheres_xyz_radius_m"].push_back({shortest(s.x), shortest(s.y), shortest(s.z), shortest(s.radius)});
  return json;
}

}  // namespace bch::cli
