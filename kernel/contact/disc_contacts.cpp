// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/contact/disc_contacts.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/format/shape_arrays.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t contact_grain = 256;  ///< pairs a task; each may have thousands of contacts

/// Bodies of eight discs or less have so many floats of nodes, beside padding at the end of all; and one thread answers so many of their
/// pairs before others would have begun.
constexpr std::size_t light_floats = 64, most_light_pairs = 2048;
bool is_light(const ShapeSet& shapes, std::size_t pairs) {
  const ShapeArrays& arrays = shapes.arrays();
  return pairs <= most_light_pairs && arrays.nodes.size() <= light_floats * (arrays.trees.size() + 1);
}

}  // namespace

void DiscContacts::find_in_two_passes(const Implementation& implementation, const Arguments& arguments,
                                      std::size_t pairs, std::vector<std::uint64_t>& begins) {
  begins.resize(pairs + 1);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->count_contacts(arguments, begin, end, begins.data());
  });
  begins[pairs] = 0;
  std::exclusive_scan(begins.begin(), begins.end(), begins.begin(), std::uint64_t{0});
  contacts_.resize(begins[pairs]);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->fill_contacts(arguments, begin, end, begins.data(), contacts_.data());
  });
}

/// Contacts of parts, pair by pair, numbered as discs of their bodies.
void DiscContacts::find_of_parts(const Implementation& implementation, const Arguments& whole,
                                 const Agents& agents, std::span<const Pair> pairs) {
  items_.expand(*whole.shapes, agents, pairs);
  const ShapeSetView parts = parts_as_shapes(*whole.shapes);
  const Agents part_agents = items_.agents();
  Arguments arguments = arguments_for(parts, part_agents, items_.pairs());
  arguments.exact_leaves = whole.exact_leaves;
  find_in_two_passes(implementation, arguments, items_.size(), item_offsets_);
  for_ranges(pairs.size(), contact_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = items_.begin(i); k < items_.begin(i + 1); ++k)
        for (std::uint64_t c = item_offsets_[k]; c < item_offsets_[k + 1]; ++c) {
          auto& [first, second] = contacts_[c];
          first += items_.origin(k).first_disc_a, second += items_.origin(k).first_disc_b;
          if (pairs[i].second < pairs[i].first) std::swap(first, second);
        }
      const auto at = [&](std::size_t item) {
        return contacts_.begin() + static_cast<std::ptrdiff_t>(item_offsets_[item]);
      };
      std::sort(at(items_.begin(i)), at(items_.begin(i + 1)), [](const DiscPair& a, const DiscPair& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
      });
    }
  });
  offsets_.resize(pairs.size() + 1);
  for (std::size_t i = 0; i <= pairs.size(); ++i) offsets_[i] = item_offsets_[items_.begin(i)];
}

/// In one pass, with memory for as many contacts as there were before.
void DiscContacts::find_of_few_discs(const Implementation& implementation, const Arguments& arguments,
                                     std::size_t pairs) {
  constexpr std::size_t least_room = block_width * block_width;
  offsets_.resize(pairs + 1);
  offsets_[0] = 0;
  for (std::size_t done = 0;;) {
    done = implementation.kernels->append_contacts(arguments, done, pairs, offsets_.data(), contacts_.data(),
                                                   contacts_.size());
    if (done == pairs) return;
    contacts_.resize(2 * contacts_.size() + least_room);
  }
}

Rows<DiscPair> DiscContacts::find_valid(const ShapeSet& shapes, const Agents& agents,
                                        std::span<const Pair> pairs, Leaves leaves,
                                        const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen({.implementation = wanted}, "contacts");
  const ShapeSetView& view = shapes.view();
  Arguments arguments = arguments_for(view, agents, pairs);
  arguments.exact_leaves = exact_leaves(shapes, leaves, "contacts");
  try {
    if (asks_parts(view, agents))
      find_of_parts(implementation, arguments, agents, pairs);
    else if (is_light(shapes, pairs.size()))
      find_of_few_discs(implementation, arguments, pairs.size());
    else
      find_in_two_passes(implementation, arguments, pairs.size(), offsets_);
  } catch (...) {
    *this = {};
    throw;
  }
  return {offsets_, std::span(contacts_).first(offsets_.back())};
}

Rows<DiscPair> DiscContacts::find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                                  Leaves leaves, const Implementation* wanted) {
  require_valid(chosen({.implementation = wanted}, "contacts"), shapes.view(), agents, pairs);
  return find_valid(shapes, agents, pairs, leaves, wanted);
}

}  // namespace bch::detail
