// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <xsimd/config/xsimd_arch.hpp>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace xsimd {
template <class T, class Arch>
class batch;
template <class T, class Arch>
class batch_bool;
}  // namespace xsimd

namespace bch::detail {

/// Represents registers of 16 bytes for processors that xsimd does not know, as GCC's and Clang's vectors: the compiler
/// makes of them what the processor has.
struct PortableArch : xsimd::generic {
  static constexpr bool supported() noexcept { return true; }
  static constexpr bool available() noexcept { return true; }
  static constexpr bool requires_alignment() noexcept { return true; }
  static constexpr std::size_t alignment() noexcept { return 16; }
  static constexpr const char* name() noexcept { return "portable"; }
};

}  // namespace bch::detail

namespace xsimd {
namespace types {

template <class T>
struct simd_register<T, bch::detail::PortableArch> {
  typedef T register_type __attribute__((vector_size(16)));
  register_type data;
  operator register_type() const noexcept { return data; }
};
template <class T>
struct has_simd_register<T, bch::detail::PortableArch> : std::is_arithmetic<T> {};

/// Holds all bits of a lane that is set, as comparisons give them.
template <class T>
struct portable_mask {
  using lanes = typename simd_register<T, bch::detail::PortableArch>::register_type;
  using register_type = decltype(lanes{} < lanes{});
  register_type data;
  operator register_type() const noexcept { return data; }
};
template <class T>
struct get_bool_simd_register<T, bch::detail::PortableArch> {
  using type = portable_mask<T>;
};

}  // namespace types

namespace kernel {

using portable = bch::detail::PortableArch;

/// Returns a register whose lane i is of(i). Without a loop: compilers that do not unroll one would write and read memory lane by lane.
template <class Register, class Lane, std::size_t... I>
inline Register portable_lanes(std::index_sequence<I...>, const Lane& of) noexcept {
  return Register{of(I)...};
}
template <class Batch, class Lane>
inline typename Batch::register_type portable_lanes(const Lane& of) noexcept {
  return portable_lanes<typename Batch::register_type>(std::make_index_sequence<Batch::size>{}, of);
}

template <class A, class T>
inline batch<T, A> broadcast(T value, requires_arch<portable>) noexcept {
  return portable_lanes<batch<T, A>>([&](std::size_t) { return value; });
}
template <class A, class T, class... Lane>
inline batch<T, A> set(batch<T, A> const&, requires_arch<portable>, Lane... lane) noexcept {
  return typename batch<T, A>::register_type{static_cast<T>(lane)...};
}
template <class A, class T, class... Lane>
inline batch_bool<T, A> set(batch_bool<T, A> const&, requires_arch<portable>, Lane... lane) noexcept {
  return typename batch_bool<T, A>::register_type{(lane ? -1 : 0)...};
}
template <class A, class T>
inline batch<T, A> load_unaligned(T const* from, convert<T>, requires_arch<portable>) noexcept {
  typename batch<T, A>::register_type v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class A, class T>
inline batch<T, A> load_aligned(T const* from, convert<T>, requires_arch<portable>) noexcept {
  return load_unaligned<A>(from, convert<T>{}, A{});
}
template <class A, class T>
inline void store_unaligned(T* to, batch<T, A> const& v, requires_arch<portable>) noexcept {
  __builtin_memcpy(to, &v.data, sizeof v.data);
}
template <class A, class T>
inline void store_aligned(T* to, batch<T, A> const& v, requires_arch<portable>) noexcept {
  store_unaligned<A>(to, v, A{});
}
template <class A, class T>
inline void store(batch_bool<T, A> const& v, bool* to, requires_arch<portable>) noexcept {
  for (std::size_t i = 0; i < batch_bool<T, A>::size; ++i) to[i] = v.data[i] != 0;
}

template <class A, class T>
inline batch<T, A> add(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data + b.data;
}
template <class A, class T>
inline batch<T, A> sub(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data - b.data;
}
template <class A, class T>
inline batch<T, A> mul(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data * b.data;
}
template <class A, class T>
inline batch<T, A> div(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data / b.data;
}
template <class A, class T>
inline batch<T, A> neg(batch<T, A> const& v, requires_arch<portable>) noexcept {
  return -v.data;
}
template <class A, class T>
inline batch<T, A> abs(batch<T, A> const& v, requires_arch<portable>) noexcept {
#if defined(__wasm_simd128__)
  if constexpr (std::is_same_v<T, float>) return __builtin_wasm_abs_f32x4(v.data);
  if constexpr (std::is_same_v<T, double>) return __builtin_wasm_abs_f64x2(v.data);
#endif
  return portable_lanes<batch<T, A>>([&](std::size_t i) { return static_cast<T>(std::abs(v.data[i])); });
}
template <class A, class T>
inline batch<T, A> sqrt(batch<T, A> const& v, requires_arch<portable>) noexcept {
#if defined(__wasm_simd128__)
  if constexpr (sizeof(T) == 4) return __builtin_wasm_sqrt_f32x4(v.data);
  if constexpr (sizeof(T) == 8) return __builtin_wasm_sqrt_f64x2(v.data);
#else
  return portable_lanes<batch<T, A>>([&](std::size_t i) { return std::sqrt(v.data[i]); });
#endif
}

template <class A, class T>
inline batch_bool<T, A> eq(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data == b.data;
}
template <class A, class T>
inline batch_bool<T, A> eq(batch_bool<T, A> const& a, batch_bool<T, A> const& b,
                           requires_arch<portable>) noexcept {
  return a.data == b.data;
}
template <class A, class T>
inline batch_bool<T, A> neq(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data != b.data;
}
template <class A, class T>
inline batch_bool<T, A> neq(batch_bool<T, A> const& a, batch_bool<T, A> const& b,
                            requires_arch<portable>) noexcept {
  return a.data != b.data;
}
template <class A, class T>
inline batch_bool<T, A> lt(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data < b.data;
}
template <class A, class T>
inline batch_bool<T, A> le(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data <= b.data;
}
template <class A, class T>
inline batch_bool<T, A> isnan(batch<T, A> const& v, requires_arch<portable>) noexcept {
  return v.data != v.data;
}
template <class A, class T>
inline batch<T, A> select(batch_bool<T, A> const& where, batch<T, A> const& yes, batch<T, A> const& no,
                          requires_arch<portable>) noexcept {
  return where.data ? yes.data : no.data;
}
/// Returns the second where neither is less, as where one is NaN or both are 0.
template <class A, class T>
inline batch<T, A> min(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return a.data < b.data ? a.data : b.data;
}
template <class A, class T>
inline batch<T, A> max(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return b.data < a.data ? a.data : b.data;
}

template <class A, class T>
inline batch_bool<T, A> bitwise_and(batch_bool<T, A> const& a, batch_bool<T, A> const& b,
                                    requires_arch<portable>) noexcept {
  return a.data & b.data;
}
template <class A, class T>
inline batch_bool<T, A> bitwise_or(batch_bool<T, A> const& a, batch_bool<T, A> const& b,
                                   requires_arch<portable>) noexcept {
  return a.data | b.data;
}
template <class A, class T>
inline batch_bool<T, A> bitwise_xor(batch_bool<T, A> const& a, batch_bool<T, A> const& b,
                                    requires_arch<portable>) noexcept {
  return a.data ^ b.data;
}
template <class A, class T>
inline batch<T, A> bitwise_or(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  using bits = typename batch_bool<T, A>::register_type;
  return (typename batch<T, A>::register_type)((bits)a.data | (bits)b.data);
}
template <class A, class T>
inline batch_bool<T, A> bitwise_not(batch_bool<T, A> const& v, requires_arch<portable>) noexcept {
  return ~v.data;
}
template <class A, class T>
inline bool any(batch_bool<T, A> const& v, requires_arch<portable>) noexcept {
#if defined(__wasm_simd128__)  // whose compiler finds no instruction for the loop
  typedef signed char bytes __attribute__((vector_size(16)));
  return __builtin_wasm_any_true_v128((bytes)v.data);
#else
  bool set = false;
  for (std::size_t i = 0; i < batch_bool<T, A>::size; ++i) set |= v.data[i] != 0;
  return set;
#endif
}

// Never called: xsimd's functions name them, and no processor that it does not know declares any.
template <class A, class T>
batch<T, A> rsqrt(batch<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> sadd(batch<T, A> const&, batch<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> ssub(batch<T, A> const&, batch<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> bitwise_andnot(batch<T, A> const&, batch<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> bitwise_xor(batch<T, A> const&, batch<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> haddp(batch<T, A> const*, requires_arch<portable>) noexcept;
template <class A, class T>
batch<T, A> bool_cast(batch_bool<T, A> const&, requires_arch<portable>) noexcept;
template <class A, class T>
bool all(batch_bool<T, A> const&, requires_arch<portable>) noexcept;

template <class A, class T>
inline batch<T, A> bitwise_lshift(batch<T, A> const& v, std::int32_t bits, requires_arch<portable>) noexcept {
  return v.data << bits;
}
template <class A, class T>
inline batch<T, A> bitwise_rshift(batch<T, A> const& v, std::int32_t bits, requires_arch<portable>) noexcept {
  return v.data >> bits;
}
template <class A, class T, class To>
inline batch<To, A> bitwise_cast(batch<T, A> const& v, batch<To, A> const&,
                                 requires_arch<portable>) noexcept {
  return (typename batch<To, A>::register_type)v.data;
}
template <class A>
inline batch<std::int32_t, A> nearbyint_as_int(batch<float, A> const& v, requires_arch<portable>) noexcept {
  return portable_lanes<batch<std::int32_t, A>>(
      [&](std::size_t i) { return static_cast<std::int32_t>(__builtin_nearbyintf(v.data[i])); });
}
template <class A, class T>
inline batch<T, A> zip_lo(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  return portable_lanes<batch<T, A>>([&](std::size_t i) { return (i % 2 == 0 ? a : b).data[i / 2]; });
}
template <class A, class T>
inline batch<T, A> zip_hi(batch<T, A> const& a, batch<T, A> const& b, requires_arch<portable>) noexcept {
  constexpr std::size_t half = batch<T, A>::size / 2;
  return portable_lanes<batch<T, A>>([&](std::size_t i) { return (i % 2 == 0 ? a : b).data[half + i / 2]; });
}
template <class A>
inline double hadd(batch<double, A> const& v, requires_arch<portable>) noexcept {
  return v.data[0] + v.data[1];
}

}  // namespace kernel
}  // namespace xsimd
