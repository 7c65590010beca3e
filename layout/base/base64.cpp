// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/base64.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

namespace bch::detail {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text(base64_size(bytes.size()), '=');
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i])} : 0;
  };
  std::size_t out = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    const std::size_t used = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < used; ++k) text[out + k] = digits[three >> (18 - 6 * k) & 63];
    out += 4;
  }
  return text;
}

std::string from_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::array<int, 256> value_of;
  value_of.fill(-1);
  for (std::size_t d = 0; d < digits.size(); ++d)
    value_of[static_cast<unsigned char>(digits[d])] = static_cast<int>(d);

  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t group = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int value = value_of[static_cast<unsigned char>(text[i])];
    if (value < 0) throw std::invalid_argument("no base64 at its digit " + std::to_string(i));
    group = group << 6 | static_cast<std::uint32_t>(value);
    constexpr int shifts[] = {-1, 4, 2, 0};
    if (i % 4 > 0) bytes += static_cast<char>(group >> shifts[i % 4]);
  }
  return bytes;
}

}  // namespace bch::detail
