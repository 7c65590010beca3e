// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/baking/pose_baker.hpp"

#include <stdexcept>
#include <utility>
#include <variant>

#include "kernel/runtime/ordered_build.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {

PoseBaker::PoseBaker(std::vector<BakedCharacter> characters, const ShapeSetPlan& plan, float threshold,
                     std::optional<std::size_t> max_nodes)
    : characters_(std::move(characters)),
      plan_(plan),
      threshold_(threshold),
      max_nodes_(max_nodes),
      shape_builders_(characters_.size()) {
  validate(plan);
}

void PoseBaker::add(ShapeSetBuilder& to, std::span<const PoseId> sources, const BakeSteps& steps) {
  add(
      to, sources.size(),
      [&](std::size_t i) {
        return PoseOfCharacter{sources[i].character, sources[i].at};
      },
      steps);
}

void PoseBaker::add(ShapeSetBuilder& to, std::size_t count,
                    const std::function<PoseOfCharacter(std::size_t)>& pose_of, const BakeSteps& steps) {
  for (std::size_t i = 0; i < count; ++i)
    if (const std::uint32_t character = pose_of(i).character; character >= characters_.size())
      throw std::invalid_argument("shape " + std::to_string(i) + ": expected one of " +
                                  std::to_string(characters_.size()) + " characters, found " +
                                  std::to_string(character));
  add_in_order(
      to, plan_, count, [&](BuiltShape& place, std::size_t i) { prepare(place, pose_of(i), i, steps); },
      [&](std::size_t i) {
        if (steps.added) steps.added(i);
      });
}

ShapeBuilder PoseBaker::shape_builder_of(std::uint32_t character) const {
  ShapeBuilder shape_builder(*characters_[character].character, plan_, threshold_);
  if (max_nodes_) shape_builder.limit_nodes(*max_nodes_);
  return shape_builder;
}

void PoseBaker::prepare(BuiltShape& place, const PoseOfCharacter& source, std::size_t i,
                        const BakeSteps& steps) {
  try {
    const auto shape_builder =
        shape_builders_[source.character].borrow([&] { return shape_builder_of(source.character); });
    const Shape& outline = shape_builder->make_outline(source.pose);
    if (steps.outlined) steps.outlined(i, outline);
    place.prepare(shape_builder->make_hierarchy(), i);
  } catch (const std::length_error& error) {
    throw std::length_error(name_of(source, i) + error.what());
  } catch (const std::domain_error& error) {
    throw std::domain_error(name_of(source, i) + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name_of(source, i) + error.what());
  }
}

std::string PoseBaker::name_of(const PoseOfCharacter& source, std::size_t i) const {
  const auto& [character, given] = characters_[source.character];
  const std::string name = given.empty() ? "character " + std::to_string(source.character) : given;
  const PoseTime* const at = std::get_if<PoseTime>(&source.pose.kind());
  if (at == nullptr) return name + ": poses[" + std::to_string(i) + "]: ";
  const auto& [clip, seconds] = *at;
  if (clip == PoseTime::rest) return name + ": rest pose: ";
  const bool is_there = clip < character->clips.size();
  return name + ": " + (is_there ? character->clips[clip].name : "clip " + std::to_string(clip)) + " at " +
         shortest(seconds) + " s: ";
}

}  // namespace bch::detail
