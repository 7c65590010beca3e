// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/ragdoll.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "baselines/built.hpp"
#include "baselines/capsule_lanes.hpp"
#include "baselines/placement.hpp"

namespace bch::baselines {

CollideCapsules collide_capsules_base, collide_capsules_avx2;

namespace {

constexpr float far_away = 1e9f;
constexpr std::size_t batch_size = 64;

std::size_t lanes_of(std::size_t capsules) {
  return (capsules + capsule_lanes - 1) / capsule_lanes * capsule_lanes;
}

CollideCapsules& fastest() {
#if defined(__x86_64__) && !defined(BCH_SCALAR)  // as CMake's BCH_ISA
  if (__builtin_cpu_supports("avx2")) return collide_capsules_avx2;
#endif
  return collide_capsules_base;
}

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
  CapsulePair placed(const Agents& agents, Pair pair) const {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const PosedRagdoll &of_a = ragdolls_[agents.shape[a]], &of_b = ragdolls_[agents.shape[b]];
    const FloatPlacement at = float_placement(agents, pair);
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
  void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
              std::uint32_t) const override {
    CapsulePair batch[batch_size];
    for (std::size_t begin = 0; begin < pairs.size(); begin += batch_size) {
      const std::size_t count = std::min(batch_size, pairs.size() - begin);
      for (std::size_t i = 0; i < count; ++i) batch[i] = placed(agents, pairs[begin + i]);
      fastest()(batch, count, &hits[begin]);
    }
  }

  std::vector<PosedRagdoll> ragdolls_;
};

}  // namespace

void pose_ragdoll(const Character& character, std::span<const Capsule> capsules,
                  std::span<const Affine3d> joints, float grown, PosedRagdoll& posed) {
  if (capsules.size() > most_capsules)
    throw std::invalid_argument("a ragdoll of " + std::to_string(capsules.size()) + " capsules, more than " +
                                std::to_string(most_capsules));
  const std::size_t stride = lanes_of(capsules.size());
  posed.capsules = static_cast<std::uint32_t>(capsules.size());
  posed.lanes.resize(Field::count * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const auto field = [&](std::uint32_t first, std::size_t axis) -> float& {
      return posed.lanes[(first + axis) * stride + i];
    };
    const bool is_there = i < capsules.size();
    const float r = is_there ? capsules[i].thin + grown * (capsules[i].holding - capsules[i].thin) : 0;
    field(Field::radius, 0) = r;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double origin = axis < 2 && character.root_joint >= 0
                                ? joints[static_cast<std::size_t>(character.root_joint)].rows[axis][3]
                                : 0;
      const auto end = [&](std::size_t k) {
        if (!is_there) return far_away;
        const double* const row = joints[capsules[i].joint].rows[axis];
        const Vec3& p = capsules[i].ends[k];
        return static_cast<float>(row[0] * static_cast<double>(p.x) + row[1] * static_cast<double>(p.y) +
                                  row[2] * static_cast<double>(p.z) + (row[3] - origin));
      };
      const float from = end(0), to = end(1);
      field(Field::end_x, axis) = from, field(Field::along_x, axis) = to - from;
      field(Field::low_x, axis) = std::min(from, to) - r, field(Field::high_x, axis) = std::max(from, to) + r;
    }
  }
}

std::unique_ptr<Structure> ragdoll_structure(std::vector<PosedRagdoll> ragdolls) {
  return std::make_unique<Ragdolls>(std::move(ragdolls));
}

}  // namespace bch::baselines
