// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <bch/query.hpp>
#include <bch/shapes.hpp>

#include "kernel/c_api/failure.hpp"
#include "kernel/c_api/members.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::c_api {

/// Checks a pointer of the caller.
/// Errors:  throws Failure naming the argument where it is NULL.
template <class Value>
Value& required(Value* pointer, const char* argument) {
  if (pointer == nullptr) throw Failure(BCH_INVALID_ARGUMENT, std::string(argument) + " is NULL");
  return *pointer;
}

/// Checks that there is a file.
/// Errors:  throws Failure with BCH_FILE_NOT_FOUND.
void require_file(const char* path);

/// Views an array of the caller.
/// Errors:  throws Failure naming the argument where it is NULL and not empty, or longer than memory.
template <class Value>
std::span<Value> array_of(Value* values, std::size_t count, const char* argument) {
  using One = Value[1];  // not Value, which may be a pointer: clang-tidy takes its size for a mistake
  if (count > PTRDIFF_MAX / sizeof(One))
    throw Failure(BCH_INVALID_ARGUMENT, std::string(argument) + " has " + std::to_string(count) + " entries");
  if (count > 0) required(values, argument);
  return {values, count};
}

/// Views an array that says where each of `count` parts of another one begins, and where the last one ends.
inline std::span<const uint64_t> offsets_of(const uint64_t* offsets, std::size_t count,
                                            const char* argument) {
  return array_of(offsets, count < SIZE_MAX ? count + 1 : count, argument);  // which no memory holds
}

/// Views an array of the caller as one of the library's own type, which has the same members one after the other.
template <class Own, class Value>
auto same_array(Value* values, std::size_t count, const char* argument) {
  using Target = std::conditional_t<std::is_const_v<Value>, const Own, Own>;
  static_assert(sizeof(Own) == sizeof(Value) && alignof(Own) == alignof(Value));
  return std::span<Target>(reinterpret_cast<Target*>(array_of(values, count, argument).data()), count);
}

/// Writes as many of the library's values into an array of the caller as there is room for, and how many there are.
template <class Own, class Value>
void deliver(const std::vector<Own>& all, Value* values, std::size_t capacity, const char* argument,
             std::size_t* count) {
  const auto to = same_array<Own>(values, capacity, argument);
  required(count, "count") = all.size();
  std::copy_n(all.begin(), std::min(to.size(), all.size()), to.begin());
}

/// Copies `count` parts of an array of the caller, which offsets delimit, as values of the library's own type.
template <class Own, class Value>
std::vector<std::vector<Own>> parts_of(const Value* values, const uint64_t* offsets, std::size_t count,
                                       const char* argument) {
  const auto begin = offsets_of(offsets, count, "offsets");
  for (std::size_t i = 0; i < count; ++i)
    if (begin[i] > begin[i + 1])
      throw Failure(BCH_INVALID_ARGUMENT,
                    "offsets[" + std::to_string(i + 1) + "] is less than the one before");
  const auto all = same_array<Own>(values, begin.back(), argument);
  std::vector<std::vector<Own>> parts;
  for (std::size_t i = 0; i < count; ++i) {
    const auto of = all.subspan(begin[i], begin[i + 1] - begin[i]);
    parts.emplace_back(of.begin(), of.end());
  }
  return parts;
}

/// Checks the size that a struct begins with, for a library that knows `known` bytes of it.
/// Errors:  throws Failure naming the argument, on a size below that of its first version's size itself, and where a later version's
///          fields say anything.
void check_size(const void* given, std::size_t known, const char* argument);

[[noreturn]] void reject_cut(std::uint32_t size, const char* argument);

/// Checks the size of a struct of an earlier version.
/// Errors:  throws Failure naming the argument, where it ends inside a member, as no version's does.
template <class Struct>
void check_end(std::uint32_t size, const char* argument) {
  if (size < sizeof(Struct) && cuts_a_member<Struct>(size)) reject_cut(size, argument);
}

/// Reads a struct of the caller's version: what it does not have stays as in `defaults`, which NULL means as well.
template <class Struct>
Struct sized(const Struct* given, Struct defaults, const char* argument) {
  if (given == nullptr) return defaults;
  check_size(given, sizeof(Struct), argument);
  check_end<Struct>(given->size, argument);
  std::memcpy(&defaults, given, given->size < sizeof(Struct) ? given->size : sizeof(Struct));
  return defaults;
}

/// Writes a struct of the caller's version.
template <class Struct>
void fill(Struct* to, Struct values, const char* argument) {
  check_size(&required(to, argument), SIZE_MAX, argument);
  check_end<Struct>(to->size, argument);
  values.size = to->size;
  std::memcpy(to, &values, to->size < sizeof(Struct) ? to->size : sizeof(Struct));
}

/// Checks an index.
/// Errors:  throws Failure with BCH_OUT_OF_RANGE, naming the argument.
void check_index(std::size_t index, std::size_t count, const char* argument);

/// Returns the enumerator of a number.
/// Errors:  throws Failure naming the argument, beyond the last one.
template <class Enum>
Enum one_of(int32_t value, Enum last, const char* argument) {
  if (value < 0 || value > static_cast<int32_t>(last))
    throw Failure(BCH_INVALID_ARGUMENT, std::string(argument) + " is " + std::to_string(value) +
                                            "; expected 0 to " + std::to_string(static_cast<int32_t>(last)));
  return static_cast<Enum>(value);
}

Agents agents_of(const bch_agents* agents);
ShapeSetPlan plan_of(const bch_plan* plan);
float threshold_of(const bch_plan* plan);

/// Holds the options of a call, and how many threads it asks for.
struct CallOptions {
  detail::AllOptions query;
  std::uint32_t threads;
};
CallOptions options_of(const bch_query_options* options);

/// Runs work on so many threads, with the caller's thread among them; 0: on those that the library has.
void on_threads(std::uint32_t threads, const std::function<void()>& work);

}  // namespace bch::c_api
