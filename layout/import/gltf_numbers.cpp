// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cstring>

#include "layout/import/gltf_file.hpp"
#include "layout/import/scene.hpp"

// The numbers in a glTF file's accessors.

namespace bch::detail::importing {
namespace {

/// The most numbers of an accessor without bytes, whose elements are 0 but for sparse ones.
constexpr std::size_t max_zeros = std::size_t{1} << 24;

template <class Number>
double read_number(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

}  // namespace

/// How the bytes of an accessor's elements become numbers.
struct Decoder {
  std::size_t bytes;  ///< of a component
  double one;         ///< the integer that stands for 1 where they are normalised; 0: no integers
  bool is_signed;
  double (*read)(const char*);
  std::size_t components = 1;
  bool normalised = false;

  std::size_t element_bytes() const { return bytes * components; }

  template <class Number>
  void decode(const char* from, Number* to) const {
    for (std::size_t c = 0; c < components; ++c) {
      const double number = read(from + c * bytes);
      to[c] = static_cast<Number>(normalised ? std::max(number / one, -1.0) : number);
    }
  }
};

namespace {

Decoder decoder_of(const JsonValue& type) {
  switch (type.integer(largest_index)) {
    case 5120:
      return {1, 0x7f, true, read_number<std::int8_t>};
    case 5121:
      return {1, 0xff, false, read_number<std::uint8_t>};
    case 5122:
      return {2, 0x7fff, true, read_number<std::int16_t>};
    case 5123:
      return {2, 0xffff, false, read_number<std::uint16_t>};
    case 5125:
      return {4, 0xffffffff, false, read_number<std::uint32_t>};
    case 5126:
      return {4, 0, true, read_number<float>};
    default:
      type.reject("is no component type");
  }
}

/// Errors:  throws ImportError on numbers that an index cannot be.
Decoder index_decoder_of(const JsonValue& type) {
  const Decoder decoder = decoder_of(type);
  if (decoder.is_signed) type.reject("is of no unsigned integers");
  return decoder;
}

}  // namespace

std::size_t components_of(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

/// Finds what has a bufferView and a byteOffset: an accessor, or a part of a sparse one, which has no stride.
Elements GltfFile::elements(const JsonValue& place, std::size_t count, std::size_t element_bytes,
                            bool strided) {
  const JsonValue view = named_by(place["bufferView"], "bufferViews");
  const std::string_view bytes = bytes_of(view);
  const std::size_t offset = place["byteOffset"].integer(largest_offset, 0);
  const std::size_t stride =
      strided ? view["byteStride"].integer(largest_offset, element_bytes) : element_bytes;
  if (stride < element_bytes)
    view["byteStride"].reject("is less than the " + std::to_string(element_bytes) + " bytes of an element");
  const bool fits = count == 0 || (offset <= bytes.size() && element_bytes <= bytes.size() - offset &&
                                   (count - 1) <= (bytes.size() - offset - element_bytes) / stride);
  if (!fits)
    place.reject("reaches beyond the " + importing::count(bytes.size(), "byte") + " of " + view.place());
  return {bytes.data() + offset, stride};
}

template <class Number>
void GltfFile::replace_sparse(const JsonValue& accessor, const Decoder& decoder,
                              std::vector<Number>& numbers) {
  const JsonValue sparse = accessor["sparse"], places = sparse["indices"];
  const std::size_t size = numbers.size() / decoder.components, count = sparse["count"].integer(size);
  const Decoder index = index_decoder_of(places["componentType"]);
  const Elements from = elements(places, count, index.element_bytes(), false);
  const Elements values = elements(sparse["values"], count, decoder.element_bytes(), false);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t element = 0;
    index.decode(from.bytes + i * from.stride, &element);
    if (element >= size)
      places.reject("names element " + std::to_string(element) + " of " + std::to_string(size));
    decoder.decode(values.bytes + i * values.stride, &numbers[element * decoder.components]);
  }
}

template <class Number>
std::vector<Number> GltfFile::read(const JsonValue& accessor, const char* type) {
  const JsonValue its_type = accessor["type"];
  if (its_type.text() != type) its_type.reject("is '" + its_type.text() + "', not " + type);
  Decoder decoder = std::is_integral_v<Number> ? index_decoder_of(accessor["componentType"])
                                               : decoder_of(accessor["componentType"]);
  decoder.components = components_of(type);
  decoder.normalised = !std::is_integral_v<Number> && decoder.one > 0 && accessor["normalized"].as_bool();
  const std::size_t count = accessor["count"].integer(largest_index);
  if (count * decoder.components > values_left_)
    accessor.reject("and those before it hold more than " + std::to_string(max_values) + " numbers");
  values_left_ -= count * decoder.components;

  std::vector<Number> numbers;
  if (accessor["bufferView"]) {
    const Elements from = elements(accessor, count, decoder.element_bytes(), true);
    numbers.resize(count * decoder.components);
    for (std::size_t i = 0; i < count; ++i)
      decoder.decode(from.bytes + i * from.stride, &numbers[i * decoder.components]);
  } else {
    if (count * decoder.components > max_zeros)
      accessor.reject("has no bytes for " + std::to_string(count) + " elements");
    numbers.resize(count * decoder.components);
  }
  if (accessor["sparse"]) replace_sparse(accessor, decoder, numbers);
  return numbers;
}

std::vector<float> GltfFile::floats(const JsonValue& accessor, const char* type) {
  return read<float>(accessor, type);
}

std::vector<std::uint32_t> GltfFile::indices(const JsonValue& accessor, const char* type) {
  return read<std::uint32_t>(accessor, type);
}

}  // namespace bch::detail::importing
