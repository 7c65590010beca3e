// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/embedding.hpp"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace bch::cli {

static_assert(std::endian::native == std::endian::little);

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text(base64_size(bytes.size()), '=');
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i]) : 0;
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

std::string script_json(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&')
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      text += c;
  }
  return text;
}

std::string json_block(std::string_view name, const nlohmann::ordered_json& json) {
  return fmt::format("<script type=\"application/json\" id=\"data-{}\">{}</script>\n", name,
                     script_json(json));
}

std::string number_block(std::string_view name, std::string_view type, std::span<const std::byte> bytes) {
  return fmt::format(
      "<script type=\"application/octet-stream\" id=\"data-{}\" data-type=\"{}\">{}</script>\n", name, type,
      base64(bytes));
}

}  // namespace bch::cli
