// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/file_bytes.hpp"

#include <algorithm>
#include <new>
#include <vector>

#include "layout/baked/open_file.hpp"
#include "layout/base/aligned_memory.hpp"
#include "layout/base/system_memory.hpp"

namespace bch::detail {
namespace {

void accept(const OpenFile& from, const HeaderCheck& check) {
  if (!check.accept) return;
  std::vector<std::byte> first(std::min(check.bytes, from.size()));
  from.read(first);
  check.accept(first, from.size());
}

}  // namespace

FileBytes read_file(const std::filesystem::path& file, const HeaderCheck& check) {
  const OpenFile from(file);
  accept(from, check);
  // A system that promises more memory than it has would end some process later.
  if (from.size() > all_memory()) throw std::bad_alloc();
  const std::shared_ptr<void> memory(allocate_aligned(from.size()),
                                     [size = from.size()](void* bytes) { free_aligned(bytes, size); });
  const std::span bytes(static_cast<std::byte*>(memory.get()), from.size());
  from.read(bytes);
  return {bytes, memory};
}

FileBytes map_file(const std::filesystem::path& file, const HeaderCheck& check) {
  const OpenFile from(file);
  accept(from, check);
  if (from.size() == 0) return {};
  const std::shared_ptr<const void> memory = from.map();
  return {{static_cast<const std::byte*>(memory.get()), from.size()}, memory};
}

}  // namespace bch::detail
