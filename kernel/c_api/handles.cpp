// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/handles.hpp"

#include <mutex>
#include <shared_mutex>
#include <unordered_map>

namespace bch::c_api {
namespace registry {
namespace {

struct Living {
  std::shared_mutex mutex;
  std::unordered_map<const void*, std::string_view> kinds;
};

/// Never destroyed: a program may free objects while it ends.
Living& living() {
  static Living& all = *new Living;
  return all;
}

}  // namespace

void add(const void* object, std::string_view kind) {
  const std::unique_lock lock(living().mutex);
  living().kinds[object] = kind;
}

void remove(const void* object) noexcept {
  const std::unique_lock lock(living().mutex);
  living().kinds.erase(object);
}

bool contains(const void* object, std::string_view kind) noexcept {
  const std::shared_lock lock(living().mutex);
  const auto found = living().kinds.find(object);
  return found != living().kinds.end() && found->second == kind;
}

}  // namespace registry

}  // namespace bch::c_api
