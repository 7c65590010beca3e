// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/contacts.hpp>

#include <numeric>
#include <vector>

#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t grain = 256;  ///< pairs a task; each may have thousands of contacts

}  // namespace

struct ContactFinder::State {
  std::vector<std::uint64_t> offsets;
  std::vector<DiscPair> contacts;

  void find(const Implementation& implementation, const Arguments& arguments, std::size_t pairs);
  Rows<DiscPair> find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                      const QueryOptions& options);
};

void ContactFinder::State::find(const Implementation& implementation, const Arguments& arguments,
                                std::size_t pairs) {
  offsets.resize(pairs + 1);
  for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->count_contacts(arguments, begin, end, offsets.data());
  });
  offsets[pairs] = 0;
  std::exclusive_scan(offsets.begin(), offsets.end(), offsets.begin(), std::uint64_t{0});
  contacts.resize(offsets[pairs]);
  for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->fill_contacts(arguments, begin, end, offsets.data(), contacts.data());
  });
}

Rows<DiscPair> ContactFinder::State::find(const ShapeSet& shapes, const Agents& agents,
                                          std::span<const Pair> pairs, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(options, "contacts");
  const bool exact = exact_leaves(shapes, options.leaves, "contacts");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);
  Arguments arguments = arguments_for(view, agents, pairs);
  arguments.exact_leaves = exact;
  try {
    find(implementation, arguments, pairs.size());
  } catch (...) {
    *this = {};
    throw;
  }
  return {offsets, contacts};
}

ContactFinder::ContactFinder() : state_(std::make_unique<State>()) {}
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;
ContactFinder::~ContactFinder() = default;

Rows<DiscPair> ContactFinder::find(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                                   const QueryOptions& options) {
  return without_tasks_from_outside([&] { return state_->find(shapes, agents, pairs, options); });
}

}  // namespace bch
