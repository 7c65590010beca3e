// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/contact/disc_contacts.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/format/shape_arrays.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t contact_grain = 256;  ///< pairs per task; each may have thousands of contacts

/// The number of floats of nodes of a body of at most eight discs, plus padding at the end of all; and the
/// number of pairs of such bodies that one thread answers before others would have begun.
constexpr std::size_t light_floats = 64, max_light_pairs = 2048;
bool is_light(const ShapeSet& shapes, std::size_t pairs) {
  const ShapeArrays& arrays = shapes.arrays();
  return pairs <= max_light_pairs && arrays.nodes.size() <= light_floats * (arrays.trees.size() + 1);
}

}  // namespace

void DiscContacts::find_in_two_passes(const Implementation& implementation, const Arguments& arguments,
                                      std::size_t pairs) {
  offsets_.resize(pairs + 1);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->count_contacts(arguments, begin, end, offsets_.data());
  });
  offsets_[pairs] = 0;
  std::exclusive_scan(offsets_.begin(), offsets_.end(), offsets_.begin(), std::uint64_t{0});
  contacts_.resize(offsets_[pairs]);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->fill_contacts(arguments, begin, end, offsets_.data(), contacts_.data());
  });
}

/// Expands the rows of pairs whose heights overlap to rows of all pairs; the others are empty.
void DiscContacts::add_empty_rows(const Arguments& arguments, std::span<const Pair> pairs) {
  std::size_t row = overlapping_heights_.size();
  offsets_.resize(pairs.size() + 1);
  offsets_[pairs.size()] = offsets_[row];
  for (std::size_t i = pairs.size(); i-- > 0;) {
    row -= heights_meet(arguments, pairs[i]);
    offsets_[i] = offsets_[row];
  }
}

/// Finds contacts in one pass, with the memory of the last call's contacts.
void DiscContacts::find_few(const Implementation& implementation, const Arguments& arguments,
                            std::size_t pairs) {
  constexpr std::size_t least_capacity = block_width * block_width;
  offsets_.resize(pairs + 1);
  offsets_[0] = 0;
  for (std::size_t done = 0;;) {
    done = implementation.kernels->append_contacts(arguments, done, pairs, offsets_.data(), contacts_.data(),
                                                   contacts_.size());
    if (done == pairs) return;
    contacts_.resize(2 * contacts_.size() + least_capacity);
  }
}

Rows<DiscPair> DiscContacts::find_valid(const ShapeSet& shapes, const Agents& agents,
                                        std::span<const Pair> pairs, Leaves leaves,
                                        const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(wanted, "contacts");
  const ShapeSetView& view = shapes.view();
  Arguments arguments = arguments_for(view, agents, pairs);
  arguments.exact_leaves = exact_leaves(shapes, leaves, "contacts");
  const bool by_height = !agents.z.empty();
  std::span<const Pair> queried = pairs;
  try {
    if (by_height) {
      overlapping_heights_.clear();
      std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(overlapping_heights_),
                   [&](Pair pair) { return heights_meet(arguments, pair); });
      queried = overlapping_heights_, arguments.pairs = overlapping_heights_.data();
    }
    if (is_light(shapes, queried.size()))
      find_few(implementation, arguments, queried.size());
    else
      find_in_two_passes(implementation, arguments, queried.size());
    if (by_height) add_empty_rows(arguments, pairs);
  } catch (...) {
    *this = {};
    throw;
  }
  return {offsets_, std::span(contacts_).first(offsets_.back())};
}

Rows<DiscPair> DiscContacts::find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                                  Leaves leaves, const Implementation* wanted) {
  require_valid(chosen(wanted, "contacts"), shapes.view(), agents, pairs);
  return find_valid(shapes, agents, pairs, leaves, wanted);
}

}  // namespace bch::detail
