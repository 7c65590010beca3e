// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::c_api {

/// Stands for a member of any type where members are counted. Is never made.
struct AnyMember {
  template <class Member>
  operator Member() const;
};

/// Returns the number of members of a struct without arrays and structs in it.
template <class Struct, class... Members>
consteval std::size_t member_count() {
  if constexpr (requires { Struct{Members{}..., AnyMember{}}; })
    return member_count<Struct, Members..., AnyMember>();
  else
    return sizeof...(Members);
}

/// Returns whether the first `size` bytes of a struct end inside one of these members.
template <class Struct, class... Members>
bool cuts_one_of(const Struct& of, std::size_t size, const Members&... members) {
  const auto place = [&](const auto* at) {
    return static_cast<std::size_t>(reinterpret_cast<const char*>(at) - reinterpret_cast<const char*>(&of));
  };
  return ((place(&members) < size && size < place(&members + 1)) || ...);
}

/// Returns whether the first `size` bytes of a struct end inside a member of it.
template <class Struct>
bool cuts_a_member(const Struct& of, std::size_t size) {
  constexpr std::size_t count = member_count<Struct>();
  static_assert(4 <= count && count <= 20, "add a line for this number");
  if constexpr (count == 4) {
    const auto& [a, b, c, d] = of;
    return cuts_one_of(of, size, a, b, c, d);
  }
  if constexpr (count == 5) {
    const auto& [a, b, c, d, e] = of;
    return cuts_one_of(of, size, a, b, c, d, e);
  }
  if constexpr (count == 6) {
    const auto& [a, b, c, d, e, f] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f);
  }
  if constexpr (count == 7) {
    const auto& [a, b, c, d, e, f, g] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g);
  }
  if constexpr (count == 8) {
    const auto& [a, b, c, d, e, f, g, h] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h);
  }
  if constexpr (count == 9) {
    const auto& [a, b, c, d, e, f, g, h, i] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i);
  }
  if constexpr (count == 10) {
    const auto& [a, b, c, d, e, f, g, h, i, j] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j);
  }
  if constexpr (count == 11) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k);
  }
  if constexpr (count == 12) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l);
  }
  if constexpr (count == 13) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
  if constexpr (count == 14) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  }
  if constexpr (count == 15) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  }
  if constexpr (count == 16) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }
  if constexpr (count == 17) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
  }
  if constexpr (count == 18) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
  }
  if constexpr (count == 19) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
  }
  if constexpr (count == 20) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = of;
    return cuts_one_of(of, size, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
  }
}

}  // namespace bch::c_api
