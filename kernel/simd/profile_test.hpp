// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/arguments.hpp"
#include "kernel/simd/record_fields.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Tests pairs by their profiles (layout/culling/profile.hpp) along the line between the profiles' centres, which are the
/// centroids of the largest contours; lane = pair.
template <class Simd>
class ProfileTest {
 public:
  /// Holds the answers for a register's pairs.
  struct Answers {
    std::uint32_t apart = 0;     ///< a line separates the cuts, by more than the gap
    std::uint32_t meet = 0;      ///< the largest contours' areas meet, or are within the gap of each other
    std::uint32_t may_nest = 0;  ///< a contour of one may lie inside one of the other
    std::uint32_t likely = 0;    ///< likely hits, for which accepting is tried first
  };

  ProfileTest(const ShapeSetView& shapes, const RelativeTransforms<Simd>& transforms,
              const Arguments& arguments) noexcept
      : shapes_(shapes),
        transforms_(transforms),
        prefetch_(arguments.prefetch_shapes),
        discs_decide_(arguments.exact_leaves ? 0.0f : 1.0f) {}

  /// Finds, for all pairs of the packet, the line between the centres, and loads the sectors of both profiles along it.
  /// `row_a`, `row_b`: for each pair, Root::row of the two roots, which is the row of their supports or the value
  /// single_disc or no_supports (layout/format/shape_set_view.hpp). Both are null if ShapeSetView::rows_follow_roots.
  void load_sectors(const std::uint32_t* row_a, const std::uint32_t* row_b) noexcept {
    const float* const records = &shapes_.profiles->x;
    const std::uint32_t count = transforms_.whole_registers();
    find_profiles(transforms_.shape_a, record_a_, count);
    find_profiles(transforms_.shape_b, record_b_, count);
    records_a_.template load<stride>(records, record_a_, count, prefetch_);
    records_b_.template load<stride>(records, record_b_, count, prefetch_);
    find_excess(row_a, row_b);
    find_sectors();
    for_whole_registers<Simd>(count, [&](std::uint32_t k) {
      record_a_[k] += record_of(sector_a_[k]);
      record_b_[k] += record_of(sector_b_[k]);
    });
    records_a_.template load<stride>(records, record_a_, count, prefetch_);
    records_b_.template load<stride>(records, record_b_, count, prefetch_);
    if (row_a == nullptr) return;
    choose_outer(records_a_, row_a, count);
    choose_outer(records_b_, row_b, count);
  }

  /// Returns the answers for the pairs from k on, after load_sectors(). If the centres coincide, there is no line between
  /// them and the sectors need not be opposite to each other. Then the only conclusion is that the areas meet.
  Answers answers(std::uint32_t k) const noexcept {
    const Float distance = Simd::load(distance_ + k), coincident(1e-20f);
    const Float outer_a = field(records_a_, sector_outer, k), outer_b = field(records_b_, sector_outer, k);
    Float inner = field(records_a_, sector_inner, k) + field(records_b_, sector_inner, k),
          outer = outer_a + outer_b + Simd::load(excess_ + k);
    if constexpr (KnowsGaps<Simd>) {
      inner = inner + Float(sure_gap) * Simd::load(transforms_.gap + k);
      outer = outer + Simd::load(transforms_.bound_gap + k);
    }
    return {.apart = Simd::bits(xsimd::max(coincident, outer) < distance),
            .meet = Simd::bits(distance <= inner),
            .may_nest = Simd::bits(distance <=
                                   xsimd::max(coincident, outer_a - field(records_b_, sector_extent, k))) |
                        Simd::bits(distance <= outer_b - field(records_a_, sector_extent, k)),
            .likely = Simd::bits(distance < inner + Float(likely_fraction) * (outer - inner))};
  }

  /// Returns how far discs of the pair may stick out of the outlines, which supports and profiles bound, metres; 0 if
  /// segments decide. Call it after load_sectors().
  float excess(std::uint32_t pair) const noexcept { return excess_[pair]; }

 private:
  using Float = typename Simd::Float;
  using Fields = RecordFields<Simd>;
  /// Names the fields of the records that load() reads: of a Profile, and of a Sector.
  enum HeaderField : std::uint32_t { header_x, header_y, header_excess, header_discs_decide };
  enum SectorField : std::uint32_t { sector_inner, sector_outer, sector_extent, sector_shallow_outer };
  /// The unit of record indices, in floats: half a record, 8 bytes, which is the largest scale of an x86 address. A
  /// larger one takes an additional instruction for each record.
  static constexpr std::size_t stride = 2;
  static constexpr std::uint32_t strides_each = sizeof(Sector) / sizeof(float) / stride;
  static constexpr std::uint32_t profile_strides = sizeof(Profile) / sizeof(float) / stride;
  /// Pairs nearer than this, between the distances at which areas surely meet (0) and cuts are surely apart (1), are
  /// likely hits. The value was measured.
  static constexpr float likely_fraction = 0.6f;

  static Float field(const Fields& of, std::uint32_t i, std::uint32_t k) noexcept {
    return Simd::load(of.field[i] + k);
  }

  /// Computes the excess of each pair, from the headers of both profiles.
  void find_excess(const std::uint32_t* row_a, const std::uint32_t* row_b) noexcept {
    for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width) {
      const Float discs_decide = xsimd::max(
          xsimd::max(field(records_a_, header_discs_decide, k), field(records_b_, header_discs_decide, k)),
          Float(discs_decide_));
      Simd::store(excess_ + k,
                  discs_decide * (field(records_a_, header_excess, k) + field(records_b_, header_excess, k)));
    }
    if (row_a == nullptr) return;
    // Discs decide if either shape is not at its deepest level.
    for_whole_registers<Simd>(transforms_.whole_registers(), [&](std::uint32_t k) {
      const float both = records_a_.field[header_excess][k] + records_b_.field[header_excess][k];
      excess_[k] = ((row_a[k] < first_row) | (row_b[k] < first_row)) != 0 ? both : excess_[k];
    });
  }

  /// Writes the bound of the pair's level into sector_outer, which holds that of the deepest level; sector_shallow_outer
  /// holds that of the others. A cut of a single disc gets an infinite bound, because PairKernel::test_roots() tests
  /// it.
  static void choose_outer(Fields& of, const std::uint32_t* row, std::uint32_t count) noexcept {
    for_whole_registers<Simd>(count, [&](std::uint32_t k) {
      const float shallow = row[k] == no_supports ? of.field[sector_shallow_outer][k] : __builtin_inff();
      of.field[sector_outer][k] = row[k] >= first_row ? of.field[sector_outer][k] : shallow;
    });
  }

  static void find_profiles(const std::uint32_t* __restrict shape, std::uint32_t* __restrict record,
                            std::uint32_t count) noexcept {
    for_whole_registers<Simd>(count, [=](std::uint32_t k) { record[k] = shape[k] * profile_strides; });
  }

  /// Returns the offset of a sector's record from its profile, in strides.
  static std::uint32_t record_of(float sector) noexcept {
    return (1 + static_cast<std::uint32_t>(static_cast<std::int32_t>(sector)) % profile_sectors) *
           strides_each;
  }

  void find_sectors() noexcept {
    for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width) {
      const auto b_in_a = transforms_.transforms(k);
      const auto centre = b_in_a.apply(field(records_b_, header_x, k), field(records_b_, header_y, k));
      const Float c = b_in_a.c, s = b_in_a.s, zero(0.0f);
      const Float x = centre.x - field(records_a_, header_x, k),
                  y = centre.y - field(records_a_, header_y, k);
      Simd::store(distance_ + k, xsimd::sqrt(x * x + y * y));
      Simd::store(sector_a_ + k, sector(x, y));
      Simd::store(sector_b_ + k, sector(zero - (c * x + s * y), s * x - c * y));
    }
  }

  /// Returns the pseudo-angle of a direction, y / (|x| + |y|) quadrant by quadrant, in sectors, counter-clockwise from +x:
  /// 0 to 32, where 32 is sector 0 again; for (0, 0), any.
  static Float sector(Float x, Float y) noexcept {
    constexpr float quadrant = 0.25f * profile_sectors, not_zero = 1e-30f;
    const Float zero(0.0f), ax = xsimd::abs(x), ay = xsimd::abs(y);
    const Float fraction = Float(quadrant) * ay / (ax + ay + Float(not_zero));
    const Float half = Simd::select(x < zero, Float(2 * quadrant) - fraction, fraction);
    return Simd::select(y < zero, Float(4 * quadrant) - half, half);
  }

  const ShapeSetView& shapes_;
  const RelativeTransforms<Simd>& transforms_;
  const bool prefetch_;
  const float discs_decide_;  ///< 1 where discs decide, 0 where segments do
  alignas(64) std::uint32_t record_a_[packet_size], record_b_[packet_size];
  alignas(64) float distance_[packet_size], sector_a_[packet_size], sector_b_[packet_size],
      excess_[packet_size];
  Fields records_a_, records_b_;
};

}  // namespace bch::detail
