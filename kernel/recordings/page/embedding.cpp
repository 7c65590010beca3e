// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/embedding.hpp"

#include <bit>
#include <nlohmann/json.hpp>

#include "layout/base/base64.hpp"
#include "layout/base/text.hpp"

namespace bch::detail {

static_assert(std::endian::native == std::endian::little);

std::string script_json(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&')
      text += "\\u" + hexadecimal(static_cast<unsigned char>(c), 4);
    else
      text += c;
  }
  return text;
}

std::string json_block(std::string_view name, const nlohmann::ordered_json& json) {
  return "<script type=\"application/json\" id=\"data-" + std::string(name) + "\">" + script_json(json) +
         "</script>\n";
}

std::string number_block(std::string_view name, std::string_view type, std::span<const std::byte> bytes) {
  return "<script type=\"application/octet-stream\" id=\"data-" + std::string(name) + "\" data-type=\"" +
         std::string(type) + "\">" + to_base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()}) +
         "</script>\n";
}

}  // namespace bch::detail
