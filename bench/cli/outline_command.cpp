// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include <bch/outline_builder.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/shape_table.hpp"
#include "bench/cli/commands.hpp"

namespace bch::cli {
namespace {

struct OutlineCommand {
  std::string character, clip, heights, format = "wkt", output;
  std::optional<double> time;
  bool holes = false;
  ShapeOptions shapes;
};

Heights parse_heights(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t comma = text.find(',');
  const auto bottom = parse_number(text.substr(0, comma));
  const auto top = parse_number(comma == std::string::npos ? "" : text.substr(comma + 1));
  if (!bottom || !top || !(*bottom < *top))
    throw UsageError(fmt::format("--heights: '{}' is not two ascending numbers, such as 0.4,1.2", text));
  return {static_cast<float>(*bottom), static_cast<float>(*top)};
}

std::string csv(const Outline& outline) {
  std::string text = "contour,x,y\n";
  for (std::size_t i = 0; i < outline.contours(); ++i)
    for (const auto& [x, y] : outline.contour(i)) text += fmt::format("{},{},{}\n", i, x, y);
  return text;
}

std::string text_of(const Outline& outline, const std::string& format) {
  if (format == "csv") return csv(outline);
  return (format == "wkt" ? to_wkt(outline) : to_geojson(outline)) + "\n";
}

void run_outline(const OutlineCommand& options) {
  if (options.clip.empty() != !options.time) throw UsageError("--clip and --time belong together");
  const Heights between = parse_heights(options.heights);
  require_outputs({{"--output", options.output}}, options.shapes.inputs({options.character}));
  const LoadedCharacter from = load_character(options.character, options.shapes.import_options());
  const PoseTime at = options.time ? source_at(from, options.clip, *options.time).at : PoseTime{};
  std::string text;
  try {
    text = text_of(outline(from.character, at, {.between = between, .holes = options.holes}), options.format);
  } catch (const std::logic_error& error) {
    throw InputError(fmt::format("{}: {}", from.source, error.what()));
  }
  options.output.empty() ? write_standard_data(text) : write_file(options.output, text);
}

}  // namespace

std::function<void()> add_outline_command(CLI::App& program) {
  const auto options = std::make_shared<OutlineCommand>();
  CLI::App& command = *program.add_subcommand(
      "outline", "Write what a character, a robot or a piece of furniture covers, seen from above");
  command.footer(
      R"(The outline is the exact union of the mesh's triangles, in metres about the root's point on the ground.
csv has a line for each point: contour,x,y; a clockwise contour is a hole of the one before it.
Example: bch outline chair.glb --heights 0.1,0.5 --holes --format geojson -o chair.json)");
  const OptionAdder add(command);
  add("FILE", options->character, "", character_help)->required();
  add("--clip", options->clip, "NAME", "Pose of this clip at --time [the rest pose]");
  add("--time", options->time, "SECONDS", "Seconds from the start of --clip", number_between(0, 1e9));
  add("--heights", options->heights, "BOTTOM,TOP", "Only what lies between two heights, metres [all]");
  command.add_flag("--holes", options->holes, "Also holes, and what lies in them");
  add("--format", options->format, "NAME", "wkt, geojson or csv [wkt]", one_of({"wkt", "geojson", "csv"}));
  add("-o,--output", options->output, "FILE", "File to write [standard output]");
  options->shapes.add_import_to(command);
  return [options] { run_outline(*options); };
}

}  // namespace bch::cli
