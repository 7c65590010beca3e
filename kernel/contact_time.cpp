// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/contact_time.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "kernel/contact_time_arguments.hpp"
#include "kernel/pair_validation.hpp"
#include "layout/heading.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

using kernel::ContactTimeArguments;
using Range = tbb::blocked_range<std::size_t>;

/// Pairs a task.
constexpr std::size_t grain = 1024;

/// The work of one task. Most pairs that overlap are known sooner from collide(), which has shortcuts for them.
void answer(const kernel::Implementation& implementation, ContactTimeArguments arguments,
            const Agents& agents, std::span<const Pair> pairs, const double* x, const double* y,
            float* times) noexcept {
  std::uint8_t codes[grain];
  float in_a_x[grain], in_a_y[grain];
  arguments.in.pairs = pairs.data();
  arguments.in.codes = codes;
  implementation.run(arguments.in, 0, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    times[i] = 0;
    if (codes[i] != kernel::apart) continue;
    const auto [first, second] = pairs[i];
    const double sign = second < first ? -1 : 1;
    const auto dx = static_cast<float>(sign * x[i]), dy = static_cast<float>(sign * y[i]);
    const UnitVector to = unit_vector(agents.heading[std::min(first, second)]);
    in_a_x[i] = to.cosine * dx + to.sine * dy;
    in_a_y[i] = to.cosine * dy - to.sine * dx;
  }
  arguments.x = in_a_x, arguments.y = in_a_y, arguments.time = times;
  implementation.contact_time(arguments, 0, pairs.size());
}

void require_sizes(const Displacements& displacements, std::size_t times, std::size_t pairs) {
  const auto require = [pairs](std::size_t size, const char* name) {
    if (size != pairs)
      throw std::invalid_argument("contact_time: " + std::to_string(pairs) + " pairs but " +
                                  std::to_string(size) + " " + name);
  };
  require(displacements.x.size(), "displacements in x");
  require(displacements.y.size(), "displacements in y");
  require(times, "times");
}

void require_valid(const Displacements& displacements) {
  const auto good = [](double length) { return std::abs(length) <= rounding::largest_position; };
  for (std::size_t i = 0; i < displacements.x.size(); ++i) {
    if (good(displacements.x[i]) && good(displacements.y[i])) continue;
    std::ostringstream message;
    message << "contact_time: pair " << i << ": displacement (" << displacements.x[i] << ", "
            << displacements.y[i] << ") m is not within +-1e9";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

void contact_time(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  const Displacements& displacements, std::span<float> times,
                  const ContactTimeOptions& options) {
  require_sizes(displacements, times.size(), pairs.size());
  const kernel::Implementation& implementation = kernel::chosen(options.implementation, "contact_time");
  kernel::require_valid(implementation, shapes, agents, pairs);
  require_valid(displacements);

  const ShapeSetView view = shapes.view();
  ContactTimeArguments arguments{kernel::arguments_for(view, agents, {}), nullptr, nullptr, nullptr};
  const auto answer_range = [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); i += grain)
      answer(implementation, arguments, agents, pairs.subspan(i, std::min(grain, range.end() - i)),
             displacements.x.data() + i, displacements.y.data() + i, times.data() + i);
  };
  const Range all(0, pairs.size(), grain);
  pairs.size() <= grain ? answer_range(all) : tbb::parallel_for(all, answer_range);
}

}  // namespace bch
