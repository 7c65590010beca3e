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
  struct Object {
    std::string_view kind;
    bool is_lent;
  };
  std::unordered_map<const void*, Object> objects;
};

/// Never destroyed: a program may free objects while it ends.
Living& living() {
  static Living& all = *new Living;
  return all;
}

}  // namespace

void add(const void* object, std::string_view kind) {
  const std::unique_lock lock(living().mutex);
  living().objects[object] = {kind, false};
}

void lend(const void* object, std::string_view kind) {
  const std::unique_lock lock(living().mutex);
  living().objects[object] = {kind, true};
}

Removal remove(const void* object, std::string_view kind) noexcept {
  const std::unique_lock lock(living().mutex);
  const auto found = living().objects.find(object);
  if (found == living().objects.end() || found->second.kind != kind) return Removal::unknown;
  if (found->second.is_lent) return Removal::lent;
  living().objects.erase(found);
  return Removal::removed;
}

void end_loan(const void* object) noexcept {
  const std::unique_lock lock(living().mutex);
  living().objects.erase(object);
}

bool contains(const void* object, std::string_view kind) noexcept {
  const std::shared_lock lock(living().mutex);
  const auto found = living().objects.find(object);
  return found != living().objects.end() && found->second.kind == kind;
}

}  // namespace registry

}  // namespace bch::c_api
