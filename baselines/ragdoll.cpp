// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/ragdoll.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "baselines/built.hpp"
#include "baselines/capsule_lanes.hpp"
#include "baselines/placement.hpp"
#include "layout/base/instruction_set.hpp"

namespace bch::baselines {

CollideCapsules collide_capsules_base, collide_capsules_avx2;

namespace {

constexpr std::size_t batch_size = 64;

std::size_t lanes_of(std::size_t capsules) {
  return (capsules + capsule_lanes - 1) / capsule_lanes * capsule_lanes;
}

struct CapsuleImplementation : detail::InstructionSet {
  CollideCapsules* collide;
};

constexpr CapsuleImplementation implementations[] = {
    BCH_ON_X86({detail::avx2, collide_capsules_avx2}, ){detail::base, collide_capsules_base}};

class Ragdolls final : public Structure {
 public:
  explicit Ragdolls(std::vector<PosedRagdoll> ragdolls) : ragdolls_(std::move(ragdolls)) {}

  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth) const override {
    std::uint8_t hit = 0;
    answer(agents, {&pair, 1}, {&hit, 1}, max_depth);
    return hit != 0;
  }
  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth, TestCounts&) const override {
    return query(agents, pair, max_depth);
  }
  std::size_t bytes(std::uint32_t shape) const override { return ragdolls_.at(shape).bytes(); }
  std::uint32_t shape_count() const override { return static_cast<std::uint32_t>(ragdolls_.size()); }

 private:
  CapsulePair placed(const Agents& agents, Pair pair, const FloatPlacement& at) const {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const PosedRagdoll &of_a = ragdolls_[agents.shape[a]], &of_b = ragdolls_[agents.shape[b]];
    return {of_a.lanes.data(),
            of_b.lanes.data(),
            of_a.capsules,
            of_b.capsules,
            at.cosine,
            at.sine,
            at.x,
            at.y,
            at.z};
  }
  /// As engines do, a crowd's headings become directions once, not once for each pair.
  void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
              std::uint32_t) const override {
    std::vector<detail::UnitVector> directions;
    if (pairs.size() >= agents.size())
      for (std::size_t i = 0; i < agents.size(); ++i)
        directions.push_back(detail::unit_vector(agents.heading[i]));
    CollideCapsules& collide = *detail::first_supported(implementations).collide;
    CapsulePair batch[batch_size];
    for (std::size_t begin = 0; begin < pairs.size(); begin += batch_size) {
      const std::size_t count = std::min(batch_size, pairs.size() - begin);
      for (std::size_t i = 0; i < count; ++i) {
        const Pair pair = pairs[begin + i];
        batch[i] = placed(
            agents, pair,
            directions.empty() ? float_placement(agents, pair) : float_placement(agents, pair, directions));
      }
      collide(batch, count, &hits[begin]);
    }
  }

  std::vector<PosedRagdoll> ragdolls_;
};

}  // namespace

void pose_ragdoll(const Character& character, std::span<const Capsule> capsules,
                  std::span<const Affine3d> joints, float grown, PosedRagdoll& posed) {
  if (capsules.empty() || capsules.size() > max_capsules)
    throw std::invalid_argument("a ragdoll of " + std::to_string(capsules.size()) + " capsules, not 1 to " +
                                std::to_string(max_capsules));
  const std::size_t stride = lanes_of(capsules.size());
  posed.capsules = static_cast<std::uint32_t>(capsules.size());
  posed.lanes.resize(whole_box + Field::count * stride);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    posed.lanes[axis] = std::numeric_limits<float>::max();
    posed.lanes[3 + axis] = -std::numeric_limits<float>::max();
  }
  const auto root = static_cast<std::size_t>(character.root_joint);
  for (std::size_t i = 0; i < stride; ++i) {
    const Capsule& capsule = capsules[std::min(i, capsules.size() - 1)];
    const float r = capsule.thin + grown * (capsule.holding - capsule.thin);
    const auto field = [&](std::uint32_t first, std::size_t axis) -> float& {
      return posed.lanes[whole_box + (first + axis) * stride + i];
    };
    field(Field::radius, 0) = r;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* const row = joints[capsule.joint].rows[axis];
      const double origin = axis < 2 && character.root_joint >= 0 ? joints[root].rows[axis][3] : 0;
      const auto end = [&](std::size_t k) {
        const Vec3& p = capsule.ends[k];
        return static_cast<float>(row[0] * static_cast<double>(p.x) + row[1] * static_cast<double>(p.y) +
                                  row[2] * static_cast<double>(p.z) + (row[3] - origin));
      };
      const float from = end(0), to = end(1), low = std::min(from, to) - r, high = std::max(from, to) + r;
      field(Field::end_x, axis) = from, field(Field::along_x, axis) = to - from;
      field(Field::low_x, axis) = low, field(Field::high_x, axis) = high;
      posed.lanes[axis] = std::min(posed.lanes[axis], low);
      posed.lanes[3 + axis] = std::max(posed.lanes[3 + axis], high);
    }
  }
}

std::unique_ptr<Structure> ragdoll_structure(std::vector<PosedRagdoll> ragdolls) {
  return std::make_unique<Ragdolls>(std::move(ragdolls));
}

}  // namespace bch::baselines
