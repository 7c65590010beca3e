// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "bench/base/text.hpp"
#include "layout/baked/clips.hpp"

namespace bch::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns how many bytes a baked file has of a clip.
std::size_t baked_bytes(const AnimatedDiscs& discs) {
  const BakedClip clip{0, ShapeOrigin::no_clip, discs};
  const detail::baked::PackedClips packed({&clip, 1}, 1);
  const detail::baked::ClipArrays arrays = packed.arrays();
  return arrays.clips.size_bytes() + arrays.chunks.size_bytes() + arrays.key_times.size_bytes() +
         arrays.disc_steps.size_bytes() + arrays.disc_floats.size_bytes();
}

Json discs_json(const std::vector<Disc>& discs) {
  Json json = Json::array();
  for (const Disc& disc : discs) json.push_back({shortest(disc.x), shortest(disc.y), shortest(disc.radius)});
  return json;
}

}  // namespace

const AnimatedChunk& chunk_at(const AnimatedDiscs& discs, double seconds) {
  std::size_t i = discs.chunks.size() - 1;
  while (i > 0 && seconds < discs.chunks[i].times.front()) --i;
  return discs.chunks[i];
}

AnimatedFacts facts_of(const AnimatedDiscs& discs) {
  const std::vector<AnimatedChunk>& chunks = discs.chunks;
  AnimatedFacts facts;
  facts.seconds = chunks.back().times.back() - chunks.front().times.front();
  facts.loops = discs.loops;
  facts.fewest = chunks.front().disc_count;
  std::size_t all = 0;
  facts.chunks = chunks.size();
  for (const AnimatedChunk& chunk : chunks) {
    const std::size_t count = chunk.disc_count;
    facts.keys += chunk.times.size();
    facts.fewest = std::min(facts.fewest, count), facts.most = std::max(facts.most, count);
    all += count;
  }
  facts.mean = static_cast<double>(all) / static_cast<double>(facts.chunks);
  facts.bytes = baked_bytes(discs);
  return facts;
}

std::string text_of(const AnimatedFacts& facts) {
  const std::string discs = facts.fewest == facts.most
                                ? counted(facts.most, "disc")
                                : fmt::format("{} to {} discs", facts.fewest, facts.most);
  return fmt::format("{:.2f} s{}, {}, {}, {:.1f} kB", facts.seconds, facts.loops ? ", loops" : "",
                     counted(facts.chunks, "chunk"), discs, static_cast<double>(facts.bytes) / 1e3);
}

Json json_of(const AnimatedFacts& facts) {
  return {{"seconds", facts.seconds}, {"loops", facts.loops},         {"chunks", facts.chunks},
          {"keys", facts.keys},       {"fewest_discs", facts.fewest}, {"max_discs", facts.most},
          {"mean_discs", facts.mean}, {"bytes", facts.bytes}};
}

std::string text_of(const AnimatedView& view) {
  const AnimatedFacts facts = facts_of(view.discs);
  std::string out = fmt::format("\n{} as moving spheres\n", printable_line(view.clip));
  out += fact("  clip", fmt::format("{:.2f} s, {}", facts.seconds, facts.loops ? "loops" : "does not loop"));
  out += fact("  keys", fmt::format("{} in {}", grouped(facts.keys), counted(facts.chunks, "chunk")));
  out += fact("  discs",
              fmt::format("{} to {} a chunk, {:.1f} in the mean", facts.fewest, facts.most, facts.mean));
  out += fact("  baked", fmt::format("{:.1f} kB, {:.1f} kB a second", static_cast<double>(facts.bytes) / 1e3,
                                     static_cast<double>(facts.bytes) / 1e3 / facts.seconds));
  const AnimatedChunk& chunk = chunk_at(view.discs, view.seconds);
  return out + fact(fmt::format("  {:.2f} s", view.seconds),
                    fmt::format("{}, keys at {:.3f} s", counted(chunk.disc_count, "disc"),
                                fmt::join(chunk.times, ", ")));
}

Json json_of(const AnimatedView& view) {
  Json json{{"clip", view.clip}};
  json.update(json_of(facts_of(view.discs)));
  for (const AnimatedChunk& chunk : view.discs.chunks) json["key_times"].push_back(chunk.times);
  json["at"] = {{"seconds", view.seconds},
                {"discs", discs_json(AnimatedShape(view.discs).discs(view.seconds))}};
  return json;
}

}  // namespace bch::cli
