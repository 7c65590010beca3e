// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/clips.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/baked/validation.hpp"

namespace bch::detail::baked {
namespace {

/// Checks a clip, by its index.
void require_clip(std::size_t index, const BakedClip& clip, std::size_t names) {
  if (clip.character >= names) reject("clips", index, "character has name " + std::to_string(clip.character));
  if (clip.clip >= names && clip.clip != ShapeOrigin::no_clip)
    reject("clips", index, "clip has name " + std::to_string(clip.clip));
  try {
    validate(clip.discs);
  } catch (const std::invalid_argument& error) {
    reject("clips", index, error.what());
  }
}

/// Returns the exponent of the last bit of a number that is not 0.
int last_bit(float number) {
  int exponent = 0;
  const auto digits = static_cast<std::uint32_t>(std::ldexp(std::frexp(std::abs(number), &exponent), 24));
  return exponent - 24 + std::countr_zero(digits);
}

/// Calls visit(number) for the numbers of a chunk's discs, in the order of the file.
template <class Visit>
void for_each_number(const AnimatedChunk& chunk, const Visit& visit) {
  for (std::size_t i = 0; i < chunk.keys.size(); ++i) {
    const Disc& disc = chunk.keys[i];
    visit(disc.x), visit(disc.y), visit(disc.radius);
    if (!chunk.z.empty()) visit(chunk.z[i]);
  }
}

/// Returns the exponent of the largest power of two that all numbers are multiples of, by less than 2^15; or float_step.
std::int32_t step_of(const AnimatedChunk& chunk) {
  std::int32_t step = largest_step;
  float largest = 0;
  for_each_number(chunk, [&](float number) {
    if (number != 0) step = std::min(step, last_bit(number));
    largest = std::max(largest, std::abs(number));
  });
  return std::ldexp(double{largest}, -step) < 0x1p15 ? step : float_step;
}

std::uint32_t count_of(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("clips: too many keys");
  return static_cast<std::uint32_t>(count);
}

/// Takes the elements of a section one after the other.
template <class Element>
class Elements {
 public:
  Elements(const char* name, std::span<const Element> all) : name_(name), all_(all) {}

  /// Takes some for what stands at a place of another section.
  std::span<const Element> take(std::size_t count, const char* section, std::size_t place) {
    if (count > all_.size() - taken_)
      reject(section, place,
             std::to_string(count) + " of " + name_ + ", which has " + std::to_string(all_.size() - taken_) +
                 " left");
    taken_ += count;
    return all_.subspan(taken_ - count, count);
  }
  void require_all_taken() const {
    if (taken_ < all_.size()) reject(name_, taken_, "belongs to no clip");
  }

 private:
  const char* name_;
  std::span<const Element> all_;
  std::size_t taken_ = 0;
};

/// Unpacks chunk after chunk.
class Unpacking {
 public:
  explicit Unpacking(const ClipArrays& arrays)
      : chunks_("chunks", arrays.chunks),
        times_("key_times", arrays.key_times),
        steps_("disc_steps", arrays.disc_steps),
        floats_("disc_floats", arrays.disc_floats) {}

  AnimatedDiscs take_discs(const ClipRecord& record, std::size_t clip) {
    in_space_ = (record.kind & clip_in_space) != 0;
    return {take_chunks(record.chunks, clip), (record.kind & clip_loops) != 0, record.heights};
  }

  void require_all_taken() const {
    chunks_.require_all_taken(), times_.require_all_taken();
    steps_.require_all_taken(), floats_.require_all_taken();
  }

 private:
  std::vector<AnimatedChunk> take_chunks(std::size_t count, std::size_t clip) {
    const auto records = chunks_.take(count, "clips", clip);
    std::vector<AnimatedChunk> chunks(count);
    for (std::size_t i = 0; i < count; ++i) unpack(records[i], chunks[i]), ++next_;
    return chunks;
  }

  void unpack(const ChunkRecord& record, AnimatedChunk& chunk) {
    const auto times = times_.take(record.keys, "chunks", next_);
    chunk.times.assign(times.begin(), times.end());
    chunk.disc_count = record.discs;
    // No product of two numbers of 32 bits is too large for 64, but a few times it may be.
    const std::uint64_t discs = std::uint64_t{record.keys} * record.discs,
                        numbers_of_disc = in_space_ ? 4 : 3;
    if (discs > std::numeric_limits<std::uint64_t>::max() / numbers_of_disc)
      reject("chunks", next_, std::to_string(record.discs) + " discs");
    if (record.step == float_step) {
      read(floats_.take(discs * numbers_of_disc, "chunks", next_), 1, chunk);
    } else if (record.step >= least_step && record.step <= largest_step) {
      read(steps_.take(discs * numbers_of_disc, "chunks", next_), std::ldexp(1.0, record.step), chunk);
    } else {
      reject("chunks", next_, "step 2^" + std::to_string(record.step));
    }
  }

  /// The numbers come out as they were, because each is a float.
  template <class Number>
  void read(std::span<const Number> numbers, double step, AnimatedChunk& chunk) const {
    const std::size_t of_disc = in_space_ ? 4 : 3;
    chunk.keys.reserve(numbers.size() / of_disc);
    const auto number = [&](std::size_t i) {
      return static_cast<float>(static_cast<double>(numbers[i]) * step);
    };
    for (std::size_t i = 0; i < numbers.size(); i += of_disc) {
      chunk.keys.push_back({number(i), number(i + 1), number(i + 2)});
      if (in_space_) chunk.z.push_back(number(i + 3));
    }
  }

  Elements<ChunkRecord> chunks_;
  std::size_t next_ = 0;   ///< chunk
  bool in_space_ = false;  ///< the clip
  Elements<double> times_;
  Elements<std::int16_t> steps_;
  Elements<float> floats_;
};

}  // namespace

PackedClips::PackedClips(std::span<const BakedClip> clips, std::size_t names) {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    require_clip(i, clips[i], names);
    const auto& [chunks, loops, heights] = clips[i].discs;
    const std::uint32_t kind = (loops ? clip_loops : 0) + (chunks.front().z.empty() ? 0 : clip_in_space);
    clips_.push_back({clips[i].character, clips[i].clip, kind, count_of(chunks.size()), heights});
    for (const AnimatedChunk& chunk : chunks) add(chunk);
  }
}

void PackedClips::add(const AnimatedChunk& chunk) {
  const std::int32_t step = step_of(chunk);
  chunks_.push_back({count_of(chunk.times.size()), chunk.disc_count, step});
  key_times_.insert(key_times_.end(), chunk.times.begin(), chunk.times.end());
  for_each_number(chunk, [&](float number) {
    if (step == float_step)
      disc_floats_.push_back(number);
    else
      disc_steps_.push_back(static_cast<std::int16_t>(std::ldexp(double{number}, -step)));
  });
}

std::vector<BakedClip> unpack(const ClipArrays& arrays, std::size_t names) {
  Unpacking unpacking(arrays);
  std::vector<BakedClip> clips;
  for (std::size_t i = 0; i < arrays.clips.size(); ++i) {
    const ClipRecord& record = arrays.clips[i];
    if (record.kind > clip_loops + clip_in_space)
      reject("clips", i, "it is of kind " + std::to_string(record.kind));
    clips.push_back({record.character, record.clip, unpacking.take_discs(record, i)});
    require_clip(i, clips.back(), names);
  }
  unpacking.require_all_taken();
  return clips;
}

}  // namespace bch::detail::baked
