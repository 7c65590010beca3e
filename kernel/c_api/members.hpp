// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <type_traits>

namespace bch::c_api {

/// Stands for each member of a struct in turn, of whatever type, and asks whether the first `size` bytes of the struct end inside it.
class MemberProbe {
 public:
  explicit MemberProbe(std::size_t size) : size_(size) {}

  template <class Member>
  operator Member() {
    static_assert(std::is_scalar_v<Member>);
    struct Alone {
      Member member;  // a pointer, too, whose own size is seldom what is meant
    };
    const std::size_t begin = (end_ + alignof(Alone) - 1) / alignof(Alone) * alignof(Alone);
    end_ = begin + sizeof(Alone);
    is_cut_ |= begin < size_ && size_ < end_;
    return Member{};
  }
  bool is_cut() const { return is_cut_; }

 private:
  std::size_t size_, end_ = 0;
  bool is_cut_ = false;
};

/// Shows all members of a struct to a probe: as many as it can be made of.
template <class Struct, class... Probes>
bool is_cut(MemberProbe& probe, Probes&... probes) {
  if constexpr (requires { Struct{probe, probe, probes...}; }) {
    return is_cut<Struct>(probe, probe, probes...);
  } else {
    [[maybe_unused]] const Struct seen{probe, probes...};
    return probe.is_cut();
  }
}

/// Returns whether the first `size` bytes of a struct, which has no arrays and structs in it, end inside a member of it.
template <class Struct>
bool cuts_a_member(std::size_t size) {
  MemberProbe probe(size);
  return is_cut<Struct>(probe);
}

}  // namespace bch::c_api
