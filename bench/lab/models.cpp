// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/lab/models.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "bench/base/output.hpp"
#include "layout/base/base64.hpp"
#include "layout/body/model/model_bytes.hpp"

namespace bch::bench {
namespace {

constexpr std::size_t line_length = 100;

/// Returns a model as layout/body/default_models has it.
std::string source_of(const std::string& bytes) {
  const std::string text = detail::to_base64(bytes);
  std::string source = "// SPDX-License-Identifier: MIT\n// Copyright (c) 2026 the bch authors\n";
  for (std::size_t at = 0; at < text.size(); at += line_length)
    source += fmt::format("\"{}\",\n", std::string_view(text).substr(at, line_length));
  return source;
}

}  // namespace

std::string remake_models(const ModelsOptions& options) {
  const std::pair<const char*, Character> characters[] = {{"male", default_male()},
                                                          {"female", default_female()}};
  std::string lines;
  for (const auto& [name, character] : characters)
    for (const std::uint32_t spheres : {64u, 128u, 256u, 512u}) {
      if (options.spheres != 0 && options.spheres != spheres) continue;
      const std::string bytes = detail::bytes_of(make_body(character, {.spheres = spheres}));
      const std::string file = fmt::format("{}_{}.inc", name, spheres);
      if (!options.folder.empty())
        cli::write_file((std::filesystem::path(options.folder) / file).string(), source_of(bytes));
      else if (bytes != detail::bytes_of(default_body(character, spheres)))
        throw std::runtime_error(file + " holds another model than make_body() makes");
      lines += fmt::format("{}: {} bytes\n", file, bytes.size());
    }
  return lines;
}

}  // namespace bch::bench
