// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/stl_file.hpp"

namespace bch::test {
namespace {

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string stl_file(const Soup& soup) {
  std::string bytes(80, '\0');
  append(bytes, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& triangle : soup.triangles) {
    append(bytes, Vec3());  // no normal
    for (const std::uint32_t vertex : triangle) append(bytes, soup.positions[vertex]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace bch::test
