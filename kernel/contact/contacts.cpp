// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/contacts.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <bch/broad_phase.hpp>

#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/part_items.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/format/shape_arrays.hpp"

namespace bch {

using namespace detail;

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

struct ContactFinder::State {
  std::vector<std::uint64_t> offsets;
  std::vector<DiscPair> contacts;

  PartItems items;
  std::vector<std::uint64_t> item_offsets;  ///< as many as items, of which pairs may have none

  BroadPhase broad_phase;

  void find(const Implementation& implementation, const Arguments& arguments, std::size_t pairs,
            std::vector<std::uint64_t>& begins);
  void find_of_few_discs(const Implementation& implementation, const Arguments& arguments, std::size_t pairs);
  void find_of_parts(const Implementation& implementation, const Arguments& whole, const Agents& agents,
                     std::span<const Pair> pairs);
  Rows<DiscPair> find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                      const QueryOptions& options);
  CrowdContacts find_all(const ShapeSet& shapes, const Agents& agents, const QueryOptions& options);
  /// Everything was validated.
  Rows<DiscPair> find_valid(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                            const Implementation& implementation, bool exact);
};

void ContactFinder::State::find(const Implementation& implementation, const Arguments& arguments,
                                std::size_t pairs, std::vector<std::uint64_t>& begins) {
  begins.resize(pairs + 1);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->count_contacts(arguments, begin, end, begins.data());
  });
  begins[pairs] = 0;
  std::exclusive_scan(begins.begin(), begins.end(), begins.begin(), std::uint64_t{0});
  contacts.resize(begins[pairs]);
  for_ranges(pairs, contact_grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->fill_contacts(arguments, begin, end, begins.data(), contacts.data());
  });
}

/// Contacts of parts, pair by pair, numbered as discs of their bodies.
void ContactFinder::State::find_of_parts(const Implementation& implementation, const Arguments& whole,
                                         const Agents& agents, std::span<const Pair> pairs) {
  items.expand(*whole.shapes, agents, pairs);
  const ShapeSetView parts = parts_as_shapes(*whole.shapes);
  const Agents part_agents = items.agents();
  Arguments arguments = arguments_for(parts, part_agents, items.pairs());
  arguments.exact_leaves = whole.exact_leaves;
  find(implementation, arguments, items.size(), item_offsets);
  for_ranges(pairs.size(), contact_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = items.begin(i); k < items.begin(i + 1); ++k)
        for (std::uint64_t c = item_offsets[k]; c < item_offsets[k + 1]; ++c) {
          auto& [first, second] = contacts[c];
          first += items.origin(k).first_disc_a, second += items.origin(k).first_disc_b;
          if (pairs[i].second < pairs[i].first) std::swap(first, second);
        }
      const auto at = [&](std::size_t item) {
        return contacts.begin() + static_cast<std::ptrdiff_t>(item_offsets[item]);
      };
      std::sort(at(items.begin(i)), at(items.begin(i + 1)), [](const DiscPair& a, const DiscPair& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
      });
    }
  });
  offsets.resize(pairs.size() + 1);
  for (std::size_t i = 0; i <= pairs.size(); ++i) offsets[i] = item_offsets[items.begin(i)];
}

/// In one pass, with memory for as many contacts as there were before.
void ContactFinder::State::find_of_few_discs(const Implementation& implementation, const Arguments& arguments,
                                             std::size_t pairs) {
  constexpr std::size_t least_room = block_width * block_width;
  offsets.resize(pairs + 1);
  offsets[0] = 0;
  for (std::size_t done = 0;;) {
    done = implementation.kernels->append_contacts(arguments, done, pairs, offsets.data(), contacts.data(),
                                                   contacts.size());
    if (done == pairs) return;
    contacts.resize(2 * contacts.size() + least_room);
  }
}

Rows<DiscPair> ContactFinder::State::find_valid(const ShapeSet& shapes, const Agents& agents,
                                                std::span<const Pair> pairs,
                                                const Implementation& implementation, bool exact) {
  const ShapeSetView& view = shapes.view();
  Arguments arguments = arguments_for(view, agents, pairs);
  arguments.exact_leaves = exact;
  try {
    if (asks_parts(view, agents))
      find_of_parts(implementation, arguments, agents, pairs);
    else if (is_light(shapes, pairs.size()))
      find_of_few_discs(implementation, arguments, pairs.size());
    else
      find(implementation, arguments, pairs.size(), offsets);
  } catch (...) {
    *this = {};
    throw;
  }
  return {offsets, std::span(contacts).first(offsets.back())};
}

Rows<DiscPair> ContactFinder::State::find(const ShapeSet& shapes, const Agents& agents,
                                          std::span<const Pair> pairs, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(options, "contacts");
  const bool exact = exact_leaves(shapes, options.leaves, "contacts");
  require_valid(implementation, shapes.view(), agents, pairs);
  return find_valid(shapes, agents, pairs, implementation, exact);
}

CrowdContacts ContactFinder::State::find_all(const ShapeSet& shapes, const Agents& agents,
                                             const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(options, "contacts");
  const bool exact = exact_leaves(shapes, options.leaves, "contacts");
  const std::span<const Pair> pairs = broad_phase.find(shapes, agents);
  return {pairs, find_valid(shapes, agents, pairs, implementation, exact)};
}

ContactFinder::ContactFinder() : state_(std::make_unique<State>()) {}
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;
ContactFinder::~ContactFinder() = default;

Rows<DiscPair> ContactFinder::find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                                   const QueryOptions& options) {
  return without_tasks_from_outside([&] { return state_->find(shapes, agents, pairs, options); });
}

CrowdContacts ContactFinder::find_all(const ShapeSet& shapes, const Agents& agents,
                                      const QueryOptions& options) {
  return without_tasks_from_outside([&] { return state_->find_all(shapes, agents, options); });
}

}  // namespace bch
