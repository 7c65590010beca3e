// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/contacts.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "kernel/pair_validation.hpp"
#include "kernel/standard_floats.hpp"

namespace bch {
namespace {

constexpr std::size_t grain = 256;  ///< pairs a task; each may have thousands of contacts

void find_contacts(const kernel::Implementation& implementation, const kernel::Arguments& arguments,
                   std::size_t pairs, ContactTable& table) {
  using Range = tbb::blocked_range<std::size_t>;
  const Range all(0, pairs, grain);
  table.begin.resize(pairs + 1);
  tbb::parallel_for(all, [&](const Range& range) {
    const kernel::StandardFloats floats;
    implementation.count_contacts(arguments, range.begin(), range.end(), table.begin.data());
  });
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::uint64_t count = table.begin[i];
    table.begin[i] = end;
    end += count;
  }
  table.begin[pairs] = end;
  table.contacts.resize(end);
  tbb::parallel_for(all, [&](const Range& range) {
    const kernel::StandardFloats floats;
    implementation.fill_contacts(arguments, range.begin(), range.end(), table.begin.data(),
                                 table.contacts.data());
  });
}

}  // namespace

void contacts(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs, ContactTable& table,
              const ContactOptions& options) {
  const kernel::StandardFloats floats;
  const kernel::Implementation& implementation = kernel::chosen(options.implementation, "contacts");
  kernel::require_valid(implementation, shapes, agents, pairs);
  const ShapeSetView view = shapes.view();
  try {
    find_contacts(implementation, kernel::arguments_for(view, agents, pairs), pairs.size(), table);
  } catch (...) {
    table = {};
    throw;
  }
}

}  // namespace bch
