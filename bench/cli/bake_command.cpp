// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <memory>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/characters/baking.hpp"
#include "bench/characters/characters.hpp"
#include "bench/characters/cost_guard.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/inspection.hpp"
#include "layout/body/body_record.hpp"

namespace bch::cli {
namespace {

struct BakeOptions {
  std::vector<std::string> characters;
  std::string output;
  double rate = 0;  ///< poses a second; 0: a number of them
  ShapeOptions shapes;
  AnswerOptions answer;
  bool heights = false;
  std::vector<std::string> animated;  ///< names of clips
  std::uint32_t spheres = 0;          ///< of models; none: 0
  bool shapes_too = true;             ///< in addition to models
};

void run_bake(const BakeOptions& options) {
  if (!is_baked(options.output))
    throw UsageError(
        fmt::format("--output: '{}' does not end in .bch, by which baked files are known", options.output));
  const ShapeSetPlan plan{.depths = options.answer.cut_depths(), .heights = options.heights};
  require_outputs({{"--output", options.output}}, options.shapes.inputs(options.characters));
  const CostLimits& limits = options.shapes.limits;
  // Before there are threads: see import_in_child().
  const auto characters = load_characters(options.characters, options.shapes.import_options());
  const Threads threads(options.answer.threads);
  const auto sources = !options.shapes_too ? std::vector<PoseId>()
                       : options.rate > 0  ? list_shapes_at_rate(characters, options.rate)
                                           : list_shapes(characters, options.shapes.poses);
  const auto animated = find_clips<LoadedCharacter>(options.animated, characters, "--animated");
  constexpr std::size_t as_model = 120;  // shapes have as much time together
  const CostGuard guard(limits, characters,
                        sources.size() + (options.spheres > 0 ? as_model * characters.size() : 0));
  const BakedShapes baked = bake_file(options.output, characters, sources, options.shapes.threshold, plan,
                                      limits, animated, options.spheres);
  write_standard_output(text_of(options.output, baked) + notes_text(characters));
}

}  // namespace

std::function<void()> add_bake_command(CLI::App& program) {
  const auto options = std::make_shared<BakeOptions>();
  CLI::App& command = *program.add_subcommand(
      "bake", "Build shapes and write them to a baked file, which the other commands load");
  command.footer(
      R"(query, crowd, inspect and check take the baked file in place of a character. It holds only what queries need.
With --spheres it holds whole characters, and bodies of spheres that move with their skeletons.
Examples:
  bch bake man.glb woman.glb --rate 30 --depths 0,all -o people.bch
  bch bake man.glb --spheres 256 -o man.bch)");
  const OptionAdder add(command);
  add("FILE", options->characters, "", character_help)->required();
  add("-o,--output", options->output, "FILE", "Baked file to write, NAME.bch")->required();
  options->shapes.add_to(command);
  add("--rate", options->rate, "N", "N poses per second of every clip, instead of --poses",
      number_between(1e-3, 1e4))
      ->excludes("--poses");
  command.add_flag("--heights", options->heights, "Store the heights of bodies, which agents with a z need");
  add("--animated", options->animated, "CLIP",
      "Also store the clip of this name, or all clips, as moving spheres (repeatable)")
      ->allow_extra_args(false);
  add("--spheres", options->spheres, "N",
      "Store bodies of N spheres, up to a minute each; and shapes only with --poses or --rate",
      whole_between(1, detail::max_spheres));
  options->answer.add_levels_to(command);
  return [options, &command] {
    options->shapes_too = options->spheres == 0 || command.count("--poses") + command.count("--rate") > 0;
    run_bake(*options);
  };
}

}  // namespace bch::cli
