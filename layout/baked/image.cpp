// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/image.hpp"

#include <limits>
#include <stdexcept>

#include "layout/baked/checksum.hpp"
#include "layout/baked/validation.hpp"

namespace bch::detail {

BakedImage::BakedImage(const ShapeSet& set, const ShapeOrigins& origins, std::span<const BakedClip> clips,
                       std::span<const BakedBody> bodies)
    : settings_{origins.threshold}, origins_(origins.origins), clips_(clips, origins.names.size()) {
  add_names(origins.names);
  add_bodies(bodies);
  arrays_ = {set.arrays(),    {&settings_, 1},          origins_, name_begin_, names_,
             clips_.arrays(), {body_ends_, body_bytes_}};
  baked::validate(arrays_);
  lay_out();
}

void BakedImage::add_names(const std::vector<std::string>& names) {
  name_begin_.push_back(0);
  for (const std::string& name : names) {
    names_.insert(names_.end(), name.begin(), name.end());
    if (names_.size() > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("names: longer than 4 GiB together");
    name_begin_.push_back(static_cast<std::uint32_t>(names_.size()));
  }
}

void BakedImage::add_bodies(std::span<const BakedBody> bodies) {
  for (const BakedBody& body : bodies) {
    body_bytes_.insert(body_bytes_.end(), body.begin(), body.end());
    body_ends_.push_back(body_bytes_.size());
  }
}

void BakedImage::lay_out() {
  static constexpr std::byte zeros[baked::alignment] = {};
  const auto add_part = [&](const void* data, std::size_t size) {
    parts_.emplace_back(static_cast<const std::byte*>(data), size);
    parts_.emplace_back(zeros, baked::zeros_after(size));
    return baked::padded(size);
  };
  std::uint64_t offset = add_part(&preamble_, sizeof preamble_);
  baked::for_each_section(arrays_, [&](baked::Section section, const char*, const auto& span) {
    const auto number = static_cast<std::uint32_t>(section);
    preamble_.entries[number] = {
        number, sizeof span[0], offset, span.size(),
        baked::SectionChecksum(std::as_bytes(span)).finish(baked::zeros_after(span.size_bytes()))};
    offset += add_part(span.data(), span.size_bytes());
  });
  preamble_.header = {baked::magic, baked::byte_order, baked::version, offset, baked::section_count, {}, 0};
  preamble_.header.checksum = baked::checksum(preamble_);
}

}  // namespace bch::detail
