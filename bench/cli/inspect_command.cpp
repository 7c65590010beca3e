// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/baking.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/characters/cost_guard.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/inspection.hpp"
#include "layout/shape_set/verify.hpp"

namespace bch::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InspectOptions {
  std::string character;
  ShapeOptions shapes;
  BodyKind kind;
  std::optional<std::uint32_t> shape;
  std::optional<std::string> clip;
  std::optional<double> time;
  std::uint32_t threads = 0;
  bool verify = false, animated = false;
  std::string json, svg;

  bool names_a_shape() const { return shape || clip; }
};

void require_consistent(const InspectOptions& options) {
  if (options.clip.has_value() != options.time.has_value())
    throw UsageError("--clip and --time belong together");
  if (options.shape && options.clip) throw UsageError("--shape and --clip: name a shape by one of them");
  if (options.animated && !options.clip) throw UsageError("--animated: which clip? Add --clip and --time");
  if (!options.svg.empty() && !options.names_a_shape() && options.kind.bodies == "outlines")
    throw UsageError("--svg: which shape? Add --shape, or --clip and --time");
  require_outputs({{"--json", options.json}, {"--svg", options.svg}},
                  options.shapes.inputs({options.character}));
}

PoseId at_index(const LoadedCharacter& from, std::span<const PoseId> sources, std::uint32_t index) {
  if (index >= sources.size())
    throw InputError(
        fmt::format("{}: has no shape {}, only 0 to {}", from.source, index, sources.size() - 1));
  return sources[index];
}

void inspect_shape(const InspectOptions& options, const LoadedCharacter& from, const PoseId& source) {
  const CostLimits& limits = options.shapes.limits;
  const CostGuard guard(limits, {&from, 1}, 1);
  const BuiltShapes built = build_shapes({&from, 1}, {&source, 1}, options.shapes.threshold, {}, limits);
  const std::size_t nodes = built.shapes.front().hierarchy.nodes.size();
  if (!options.svg.empty() && nodes > limits.drawn_nodes)
    throw InputError(fmt::format("{}: --svg would draw {}", from.source,
                                 beyond_limit(nodes, "nodes", limits.drawn_nodes, "--max-drawn-nodes")));
  const ShapeFacts facts = examine(built.shapes.front(), source, options.shape);
  write_json(options.json, {{"character", json_of(from)}, {"shape", json_of(from, facts)}});
  if (!options.svg.empty()) write_file(options.svg, draw_shape(from, facts));
  write_standard_output(text_of(from) + text_of(from, facts));
}

void inspect_body(const InspectOptions& options, const LoadedCharacter& from, const PoseId& source) {
  const std::vector<BodyModel> models = make_models({&from, 1}, options.kind.spheres);
  const BodyFacts facts = examine(models.front(), source);
  write_json(options.json, {{"character", json_of(from)}, {"body", json_of(from, facts)}});
  if (!options.svg.empty()) write_file(options.svg, draw_body(from, facts));
  write_standard_output(text_of(from) + text_of(from, facts));
}

void show(const InspectOptions& options, const std::string& head, const Json& head_json,
          const AnimatedView& view) {
  write_json(options.json, {head_json, {"animated", json_of(view)}});
  if (!options.svg.empty()) write_file(options.svg, draw_animated(view));
  write_standard_output(head + text_of(view));
}

/// Shows a clip of a character as moving spheres.
void inspect_animated(const InspectOptions& options, const LoadedCharacter& from, const PoseId& source) {
  const CostLimits& limits = options.shapes.limits;
  const Clip& clip = from.character.clips[source.at.clip];
  const BuiltShapes built = build_shapes({&from, 1}, {&source, 1}, options.shapes.threshold, {}, limits);
  const std::vector<BodyModel> models = make_models({&from, 1}, animated_spheres);
  const AnimatedDiscs discs = animate_clip(models.front(), from.source, source.at.clip);
  show(options, text_of(from), {"character", json_of(from)},
       {from.character.name, clip.name, discs, *options.time, &built.shapes.front().outline});
}

void inspect_table(const InspectOptions& options, const LoadedCharacter& from,
                   std::span<const PoseId> sources) {
  const CostLimits& limits = options.shapes.limits;
  const CostGuard guard(limits, {&from, 1}, sources.size());
  const BuiltShapes built = build_shapes({&from, 1}, sources, options.shapes.threshold, {}, limits);
  const ShapeTable table{sources, built.shapes};
  write_json(options.json, {{"character", json_of(from)}, {"shapes", json_of(from, table)}});
  write_standard_output(text_of(from) + text_of(from, table));
}

void require_verified(const std::string& file, const ShapeSet& set) {
  constexpr std::size_t most = 20;
  std::vector<std::string> lines;
  for (const detail::Inconsistency& inconsistency : detail::verify(set, most + 1))
    lines.push_back(file + ": " + text_of(inconsistency));
  if (lines.size() > most) lines.back() = file + ": and more";
  if (!lines.empty()) throw InputErrors(std::move(lines));
}

void inspect_baked(const InspectOptions& options) {
  const BakedShapes baked = open_baked(options.character);
  if (options.verify) require_verified(options.character, baked.set);
  write_json(options.json, json_of(options.character, baked));
  write_standard_output(text_of(options.character, baked) + (options.verify ? verified_text(baked.set) : "") +
                        table_text(baked));
}

/// Shows a clip that a baked file has as moving spheres.
void inspect_baked_clip(const InspectOptions& options) {
  const BakedShapes baked = open_baked(options.character);
  if (options.verify) require_verified(options.character, baked.set);
  for (const BakedClip& clip : baked.clips) {
    if (clip_name(baked.origins, clip) != *options.clip) continue;
    const std::vector<AnimatedChunk>& chunks = clip.discs.chunks;
    const double begin = chunks.front().times.front(), end = chunks.back().times.back();
    if (!(*options.time >= begin && *options.time <= end))
      throw InputError(fmt::format("{}: clip '{}' is from {} to {} s and has no time {} s", options.character,
                                   *options.clip, begin, end, *options.time));
    return show(options, text_of(options.character, baked), {"source", options.character},
                {baked.origins.names[clip.character], *options.clip, clip.discs, *options.time, nullptr});
  }
  throw InputError(fmt::format("{}: has no clip '{}' as moving spheres; bch bake --animated keeps clips so",
                               options.character, *options.clip));
}

void run_inspect(const CLI::App& command, const InspectOptions& options) {
  require_consistent(options);
  const bool spheres = options.kind.are_spheres(command);
  if (spheres)
    require_absent(command, {"--threshold", "--animated", "--verify", "--max-drawn-nodes"},
                   "belongs to outlines, not to --bodies spheres");
  if (is_baked(options.character)) {
    require_absent(command, {"--bodies"}, "a baked file has outlines alone");
    require_unsettled(command, options.character);
    if (options.animated) return inspect_baked_clip(options);
    require_absent(command, {"--shape", "--clip", "--svg"},
                   "a baked file has no hierarchies to show; --animated shows its moving spheres");
    return inspect_baked(options);
  }
  require_absent(command, {"--verify"}, "only a baked file can be verified");
  const LoadedCharacter from = load_character(options.character, options.shapes.import_options());
  const Threads threads(options.threads);
  const auto sources = list_shapes({&from, 1}, options.shapes.poses);
  const auto named = [&] {
    if (options.clip) return source_at(from, *options.clip, *options.time);
    return options.shape ? at_index(from, sources, *options.shape) : PoseId{};
  };
  if (spheres)
    inspect_body(options, from, named());
  else if (options.animated)
    inspect_animated(options, from, named());
  else if (options.names_a_shape())
    inspect_shape(options, from, named());
  else
    inspect_table(options, from, sources);
}

}  // namespace

std::function<void()> add_inspect_command(CLI::App& program) {
  const auto options = std::make_shared<InspectOptions>();
  CLI::App& command = *program.add_subcommand("inspect", "Show a character or baked file and its shapes");
  command.footer(
      R"(Reads glTF 2, FBX, Collada, MD5, IQM, OBJ, PLY and STL, and clips from these and from BVH.
A file is rejected if reading it crashes or takes more than 2 GiB or 60 s.
Spheres are shown in the pose that --shape, or --clip and --time name, else in the rest pose.
Examples: bch inspect default:male --clip walk --time 1.5 --svg walk.svg
          bch inspect default:male --bodies spheres --clip walk --time 1.5 --svg spheres.svg)");
  const OptionAdder add(command);
  add("FILE", options->character, "", character_or_baked_help)->required();
  add("--shape", options->shape, "INDEX", "Show this shape of the table in detail");
  add("--clip", options->clip, "NAME", "Show this clip at --time in detail");
  add("--time", options->time, "SECONDS", "Seconds from the start of --clip", number_between(0, 1e9));
  command.add_flag("--animated", options->animated,
                   "Show the clip as moving spheres, at --time and between keys; also from a baked file");
  options->kind.add_to(command);
  options->shapes.add_to(command);
  add_threads_option(command, options->threads);
  command.add_flag(
      "--verify", options->verify,
      "Recompute what a baked file stores besides its discs and outlines, and report differences");
  add("--json", options->json, "FILE", "Write the same data as JSON, with all points of a shape's outline");
  add("--svg", options->svg, "FILE",
      "Draw the shape, a panel for each depth of its hierarchy, or the spheres from two sides");
  CostLimits& limits = options->shapes.limits;
  OptionAdder{command, "Limits"}("--max-drawn-nodes", limits.drawn_nodes, "N",
                                 fmt::format("Nodes of the shape that --svg draws [{}]", limits.drawn_nodes),
                                 whole_between(1, 1'000'000'000));
  return [options, &command] { run_inspect(command, *options); };
}

}  // namespace bch::cli
