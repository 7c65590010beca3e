// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Tables of agents and pairs, of any bytes: each is refused with an InputError, or every value is in range. What is
// shown of them has no control characters.

#include <cmath>
#include <string>

#include "bench/base/csv_input.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"
#include "layout/base/rounding.hpp"
#include "layout/recordings/trajectory.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace bch::fuzz {
namespace {

void check(const cli::AgentTable& table, std::uint32_t shapes, std::uint32_t levels) {
  const std::size_t count = table.id.size();
  require(table.shape.size() == count && table.x.size() == count && table.y.size() == count &&
              table.heading.size() == count && (table.level.empty() || table.level.size() == count),
          "columns are of one length");
  require(table.dx.size() == table.dy.size() && (table.dx.empty() || table.dx.size() == count),
          "ways are of all agents or of none");
  for (std::size_t i = 0; i < table.dx.size(); ++i)
    require(std::isfinite(table.dx[i]) && std::isfinite(table.dy[i]), "ways are finite");
  require(table.index_of.size() == count, "ids differ");
  for (std::size_t i = 0; i < count; ++i) {
    require(table.shape[i] < shapes, "shapes are in range");
    require(std::abs(table.x[i]) <= detail::rounding::largest_position &&
                std::abs(table.y[i]) <= detail::rounding::largest_position,
            "positions are in range");
    require(std::abs(table.heading[i]) <= detail::rounding::largest_heading, "headings are in range");
    if (!table.level.empty()) require(table.level[i] < levels, "levels are in range");
    require(!cli::csv_field(table.id[i]).empty(), "ids are not empty");
  }
}

void check_printable(const std::string& text) {
  const std::string shown = cli::printable_line(text);
  for (const char c : shown)
    require(static_cast<unsigned char>(c) >= ' ' && c != '\x7f', "no controls are shown");
  require(cli::printable_line(shown) == shown, "what is shown is printable");
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  const std::uint32_t shapes = 1 + bytes.below(8), levels = 1 + bytes.below(4);
  const bool moving = bytes.below(2) == 1;
  const std::size_t length = bytes.take<std::uint16_t>();
  const std::string text(bytes.rest().begin(), bytes.rest().end());
  const std::string first = text.substr(0, length), second = text.substr(first.size());
  fuzz::check_printable(text);
  const fuzz::MemoryFile agents(first), pairs(second);
  try {
    const cli::AgentTable table = cli::read_agents(agents.path(), shapes, levels, moving);
    fuzz::require(first.find('\0') == std::string::npos, "no byte behind a NUL byte is left out");
    fuzz::check(table, shapes, levels);
    for (const auto& [a, b] : cli::read_pairs(pairs.path(), table))
      fuzz::require(a < table.id.size() && b < table.id.size(), "pairs are of agents");
    fuzz::require(second.find('\0') == std::string::npos, "no byte behind a NUL byte is left out");
  } catch (const cli::InputError& error) {
    fuzz::require(*error.what() != '\0', "errors say something");
  } catch (const detail::TrajectoryError& error) {  // no text
    fuzz::require(*error.what() != '\0', "errors say something");
  }
  return 0;
}
