// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "layout/base/base64.hpp"
#include "tests/support/standard.hpp"

namespace bch::test {

/// The values of an array of one type.
template <class Number>
std::vector<double> numbers(const std::string& bytes) {
  EXPECT_EQ(bytes.size() % sizeof(Number), 0u);
  std::vector<Number> values(bytes.size() / sizeof(Number));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return {values.begin(), values.end()};
}

/// The blocks of a page, as its scripts read them.
class Blocks {
 public:
  explicit Blocks(const std::string& html) : html_(html) {}

  std::string type(const std::string& name) const { return between("data-type=\"", "\"", at(name)); }
  std::vector<double> operator()(const std::string& name) const {
    const auto bytes = detail::from_base64(between(">", "</script>", at(name)));
    const std::string kind = type(name);
    if (kind == "u8") return numbers<std::uint8_t>(bytes);
    if (kind == "i16") return numbers<std::int16_t>(bytes);
    if (kind == "u16") return numbers<std::uint16_t>(bytes);
    if (kind == "i32") return numbers<std::int32_t>(bytes);
    if (kind == "u32") return numbers<std::uint32_t>(bytes);
    if (kind == "f64") return numbers<double>(bytes);
    throw std::runtime_error(kind);
  }
  nlohmann::json meta() const { return nlohmann::json::parse(between(">", "</script>", at("meta"))); }

 private:
  std::size_t at(const std::string& name) const {
    const std::size_t place = html_.find("id=\"data-" + name + "\"");
    if (place == std::string::npos) throw std::runtime_error("no block " + name);
    return place;
  }
  std::string between(const std::string& before, const std::string& after, std::size_t from) const {
    const std::size_t begin = html_.find(before, from) + before.size();
    return html_.substr(begin, html_.find(after, begin) - begin);
  }

  const std::string& html_;
};

}  // namespace bch::test
