// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/embedding.hpp"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "layout/base/base64.hpp"

namespace bch::cli {

static_assert(std::endian::native == std::endian::little);

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
      detail::to_base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

}  // namespace bch::cli
