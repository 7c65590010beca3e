// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "kernel/c_api/failure.hpp"

// Of the library of files.
struct bch_trajectory;
struct bch_check;

namespace bch::c_api {

/// Holds the objects of the C interface that live. A pointer from outside is looked up before it is read, so that one that was
/// freed, or is of another kind, is an error.
namespace registry {
void add(const void* object, std::string_view kind);
/// Adds an object that belongs to another one, and that only end_loan() removes.
void lend(const void* object, std::string_view kind);
void end_loan(const void* object) noexcept;

enum class Removal { removed, unknown, lent };
/// Removes an object if it is of a kind and not lent. Of threads that remove one object at the same time, one does.
Removal remove(const void* object, std::string_view kind) noexcept;
bool contains(const void* object, std::string_view kind) noexcept;
}  // namespace registry

// The names of handles' types.
constexpr std::string_view kind_of(const bch_character*) {
  return "bch_character";
}
constexpr std::string_view kind_of(const bch_shape_set*) {
  return "bch_shape_set";
}
constexpr std::string_view kind_of(const bch_body_model*) {
  return "bch_body_model";
}
constexpr std::string_view kind_of(const bch_live_bodies*) {
  return "bch_live_bodies";
}
constexpr std::string_view kind_of(const bch_body_set*) {
  return "bch_body_set";
}
constexpr std::string_view kind_of(const bch_shape_builder*) {
  return "bch_shape_builder";
}
constexpr std::string_view kind_of(const bch_shape_set_builder*) {
  return "bch_shape_set_builder";
}
constexpr std::string_view kind_of(const bch_dynamic_shape_set*) {
  return "bch_dynamic_shape_set";
}
constexpr std::string_view kind_of(const bch_crowd*) {
  return "bch_crowd";
}
constexpr std::string_view kind_of(const bch_trajectory*) {
  return "bch_trajectory";
}
constexpr std::string_view kind_of(const bch_check*) {
  return "bch_check";
}
constexpr std::string_view kind_of(const bch_scene_plan*) {
  return "bch_scene_plan";
}
constexpr std::string_view kind_of(const bch_outlines*) {
  return "bch_outlines";
}
constexpr std::string_view kind_of(const bch_obstacles*) {
  return "bch_obstacles";
}
constexpr std::string_view kind_of(const bch_animated_shape*) {
  return "bch_animated_shape";
}

/// Throws what is said of a handle that is not a live object of its kind.
template <class Object>
[[noreturn]] void reject_handle(Object* handle, const char* argument) {
  throw Failure(BCH_INVALID_ARGUMENT,
                std::string(argument) + " is not a live " + std::string(kind_of(handle)) + "; was it freed?");
}

/// Returns the object of a handle.
/// Errors:  throws Failure naming the argument, on NULL and on what is not a live object of this kind.
template <class Object>
Object& object_of(Object* handle, const char* argument) {
  if (handle == nullptr) throw Failure(BCH_INVALID_ARGUMENT, std::string(argument) + " is NULL");
  if (!registry::contains(handle, kind_of(handle))) reject_handle(handle, argument);
  return *handle;
}

/// Hands an object out.
template <class Object>
void hand_out(std::unique_ptr<Object> object, Object** to) {
  registry::add(object.get(), kind_of(object.get()));
  *to = object.release();
}

/// Hands an object out that lends another one, which belongs to it.
template <class Object, class Lent>
void hand_out(std::unique_ptr<Object> object, const Lent* lent, Object** to) {
  registry::lend(lent, kind_of(lent));
  try {
    hand_out(std::move(object), to);
  } catch (...) {
    registry::end_loan(lent);
    throw;
  }
}

/// Takes an object back that was handed out; NULL is none. The object is not read before it is this thread's alone.
/// Errors:  as object_of(), and on an object that is lent.
template <class Object>
std::unique_ptr<Object> take_back(Object* handle, const char* argument) {
  if (handle == nullptr) return nullptr;
  switch (registry::remove(handle, kind_of(handle))) {
    case registry::Removal::removed:
      break;
    case registry::Removal::unknown:
      reject_handle(handle, argument);
    case registry::Removal::lent:
      throw Failure(BCH_INVALID_ARGUMENT,
                    std::string(argument) + " belongs to the object that lent it, which frees it");
  }
  return std::unique_ptr<Object>(handle);
}

/// Frees an object, as the functions of the C interface do that free one.
template <class Object>
bch_status free_object(Object* handle, const char* argument) noexcept {
  return guarded([&] { take_back(handle, argument); });
}

}  // namespace bch::c_api
