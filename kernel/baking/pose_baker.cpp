// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/baking/pose_baker.hpp"

#include <stdexcept>
#include <utility>

#include "kernel/runtime/ordered_build.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {

PoseBaker::PoseBaker(std::vector<BakedCharacter> characters, const ShapeSetPlan& plan, float threshold,
                     std::optional<std::size_t> most_nodes)
    : characters_(std::move(characters)),
      plan_(plan),
      threshold_(threshold),
      most_nodes_(most_nodes),
      shapers_([count = characters_.size()] { return Shapers(count); }) {
  validate(plan);
}

void PoseBaker::add(ShapeSetBuilder& to, std::span<const ShapeSource> sources, const BakeSteps& steps) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (sources[i].character >= characters_.size())
      throw std::invalid_argument("shape " + std::to_string(i) + ": no character " +
                                  std::to_string(sources[i].character) + " of " +
                                  std::to_string(characters_.size()));
  add_in_order(
      to, plan_, sources.size(), [&](std::size_t i) -> const Shape& { return make(sources[i], i, steps); },
      [&](std::size_t i) {
        if (steps.added) steps.added(i);
      });
}

const Shape& PoseBaker::make(const ShapeSource& source, std::size_t i, const BakeSteps& steps) {
  std::optional<PoseShaper>& shaper = shapers_.local()[source.character];
  try {
    if (!shaper) {
      shaper.emplace(*characters_[source.character].character, plan_, threshold_);
      if (most_nodes_) shaper->limit_nodes(*most_nodes_);
    }
    const Shape& outlines = shaper->make_outlines(source.at, source.whole);
    if (steps.outlined) steps.outlined(i, outlines);
    return shaper->make_hierarchies();
  } catch (const std::length_error& error) {
    throw std::length_error(name_of(source) + error.what());
  } catch (const std::domain_error& error) {
    throw std::domain_error(name_of(source) + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name_of(source) + error.what());
  }
}

std::string PoseBaker::name_of(const ShapeSource& source) const {
  const auto& [character, given] = characters_[source.character];
  const std::string name = given.empty() ? "character " + std::to_string(source.character) : given;
  const auto& [clip, seconds] = source.at;
  if (clip == PoseTime::rest) return name + ": rest pose: ";
  const bool is_there = clip < character->clips.size();
  return name + ": " + (is_there ? character->clips[clip].name : "clip " + std::to_string(clip)) + " at " +
         shortest(seconds) + " s: ";
}

}  // namespace bch::detail
