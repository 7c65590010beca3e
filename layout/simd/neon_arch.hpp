// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <arm_neon.h>

#include <xsimd/types/xsimd_neon64_register.hpp>

namespace xsimd {
template <class T, class Arch>
class batch;
}  // namespace xsimd

namespace bch::detail {

/// Represents NEON with the minimum and maximum of other processors: the second where neither is less, as where one is NaN or
/// both are 0. NEON's instructions give NaN, and tell the zeros apart. Roots and quotients of floats are rounded as IEEE 754
/// says: those of xsimd 8.1 are estimates, off in the last bit.
struct NeonArch : xsimd::neon64 {};

}  // namespace bch::detail

namespace xsimd {
namespace types {

XSIMD_DECLARE_SIMD_REGISTER_ALIAS(bch::detail::NeonArch, neon64);
template <class T>
struct get_bool_simd_register<T, bch::detail::NeonArch> : detail::neon_bool_simd_register<T, neon64> {};

}  // namespace types

namespace kernel {

/// Returns a value in all lanes, which xsimd 8.1 has for neon64 alone.
template <class A, class T>
inline batch<T, A> broadcast(T value, requires_arch<bch::detail::NeonArch>) noexcept {
  typename batch<T, A>::register_type all;
  for (std::size_t i = 0; i < batch<T, A>::size; ++i) all[i] = value;
  return all;
}
template <class A, class T>
inline batch<T, A> min(batch<T, A> const& first, batch<T, A> const& second,
                       requires_arch<bch::detail::NeonArch>) noexcept {
  return select(first < second, first, second);
}
template <class A, class T>
inline batch<T, A> max(batch<T, A> const& first, batch<T, A> const& second,
                       requires_arch<bch::detail::NeonArch>) noexcept {
  return select(second < first, first, second);
}
template <class A>
inline batch<float, A> sqrt(batch<float, A> const& v, requires_arch<bch::detail::NeonArch>) noexcept {
  return vsqrtq_f32(v);
}
template <class A>
inline batch<float, A> div(batch<float, A> const& first, batch<float, A> const& second,
                           requires_arch<bch::detail::NeonArch>) noexcept {
  return vdivq_f32(first, second);
}

}  // namespace kernel
}  // namespace xsimd
