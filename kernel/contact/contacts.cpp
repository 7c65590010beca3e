// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/contact/contacts.hpp"

#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {
namespace {

constexpr std::size_t grain = 256;  ///< pairs a task; each may have thousands of contacts

void find_contacts(const kernel::Implementation& implementation, const kernel::Arguments& arguments,
                   std::size_t pairs, ContactTable& table) {
  table.offsets.resize(pairs + 1);
  kernel::for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    implementation.count_contacts(arguments, begin, end, table.offsets.data());
  });
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::uint64_t count = table.offsets[i];
    table.offsets[i] = end;
    end += count;
  }
  table.offsets[pairs] = end;
  table.contacts.resize(end);
  kernel::for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end_of_range) {
    implementation.fill_contacts(arguments, begin, end_of_range, table.offsets.data(), table.contacts.data());
  });
}

}  // namespace

void contacts(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs, ContactTable& table,
              const ContactOptions& options) {
  const kernel::FloatingPointStateGuard floats;
  const kernel::Implementation& implementation = kernel::chosen(options.implementation, "contacts");
  const bool exact_leaves = kernel::exact_leaves(options.leaves, "contacts");
  const ShapeSetView& view = shapes.view();
  kernel::require_valid(implementation, view, agents, pairs);
  try {
    kernel::Arguments arguments = kernel::arguments_for(view, agents, pairs);
    arguments.exact_leaves = exact_leaves && shapes.exact_leaves();
    find_contacts(implementation, arguments, pairs.size(), table);
  } catch (...) {
    table = {};
    throw;
  }
}

}  // namespace bch
