// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/penetration/free_sources.hpp"
#include "kernel/penetration/free_way.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

/// Holds a move, and where it ends, which is searched where somebody asks for it.
struct Answer {
  Penetration move{0, 1, 0};
  Penetration::Touch touch{{0, 0, 0}, {0, 0, 0}};
};

/// Returns the answer of a pair as seen from the agent with the higher index, which moves in place of the other.
Answer from_b(const Agents& agents, std::uint32_t a, std::uint32_t b, const Answer& from_a) {
  const auto& [depth, x, y] = from_a.move;
  Answer answer = from_a;
  answer.move = {depth, -x, -y};
  if (depth == 0) return answer;
  Vec3 &point = answer.touch.point, &normal = answer.touch.normal;
  const double z = agents.z.empty() ? 0 : agents.z[a] - agents.z[b];
  point.x = static_cast<float>(double{point.x} + (agents.x[a] - agents.x[b] + double{depth} * x));
  point.y = static_cast<float>(double{point.y} + (agents.y[a] - agents.y[b] + double{depth} * y));
  point.z = static_cast<float>(double{point.z} + z);
  normal = {-normal.x, -normal.y, -normal.z};
  return answer;
}

constexpr std::size_t pairs_at_once = 64;

/// Answers some pairs after others, in memory of its own.
template <class Source>
class PairAnswers {
 public:
  PairAnswers(const Source& source, const Axes& axes, bool with_touches)
      : source_(source), axes_(axes), with_touches_(with_touches), search_(source) {}

  /// Answers up to pairs_at_once pairs.
  void answer(std::span<const Pair> pairs) {
    hits_.resize(pairs.size()), answers_.assign(pairs.size(), {});
    source_.find_hits(source_.agents(), pairs, hits_.data());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (hits_[i] != 0) find(pairs[i], answers_[i], true);
    if constexpr (!Source::is_in_space) close(pairs);
  }
  /// Returns the answer of a pair that was answered.
  Answer of(std::size_t i, Pair pair) const {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    return pair.second < pair.first ? from_b(source_.agents(), a, b, answers_[i]) : answers_[i];
  }

 private:
  void find(Pair pair, Answer& to, bool is_open) {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const FreeWay way = search_.find(a, {&b, 1}, axes_, is_open);
    to.move = {way.place, way.x, way.y};
    if (with_touches_) to.touch = search_.touch(way);
  }
  /// Tests all ends at once. Few of them are inside the other, from where their ways go on.
  void close(std::span<const Pair> pairs) {
    moved_.clear(), ended_.clear(), tests_.clear();
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      if (hits_[i] == 0) continue;
      const auto [a, b] = std::minmax(pairs[i].first, pairs[i].second);
      const auto& [depth, x, y] = answers_[i].move;
      const auto at = static_cast<std::uint32_t>(moved_.size());
      moved_.add(source_.agents(), a, double{depth} * x, double{depth} * y);
      moved_.add(source_.agents(), b);
      ended_.push_back(i), tests_.push_back({at, at + 1});
    }
    source_.find_hits(moved_.agents(), tests_, hits_.data());
    for (std::size_t k = 0; k < tests_.size(); ++k)
      if (hits_[k] != 0) find(pairs[ended_[k]], answers_[ended_[k]], false);
  }

  const Source& source_;
  const Axes& axes_;
  const bool with_touches_;
  FreeWaySearch<Source, NoWalls> search_;
  std::vector<std::uint8_t> hits_;
  std::vector<Answer> answers_;
  MovedAgents moved_;
  std::vector<std::uint32_t> ended_;
  std::vector<Pair> tests_;
};

/// Answers pairs, each as seen from the agent with the lower index. Searches need memory, so answers are written once all have ended.
template <class Source>
void answer_pairs(const Source& source, std::span<const Pair> pairs, const Axes& axes,
                  std::span<Penetration> out, std::span<Penetration::Touch> to_touches) {
  std::vector<Penetration> ways(pairs.size());
  std::vector<Penetration::Touch> touches(to_touches.size());
  Spares<PairAnswers<Source>> spares;
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    const auto answers = spares.borrow([&] { return PairAnswers<Source>(source, axes, !touches.empty()); });
    answers->answer(pairs.subspan(begin, size));
    for (std::size_t i = begin; i < begin + size; ++i) {
      const Answer answer = answers->of(i - begin, pairs[i]);
      ways[i] = answer.move;
      if (!touches.empty()) touches[i] = answer.touch;
    }
  });
  std::copy(ways.begin(), ways.end(), out.begin());
  std::copy(touches.begin(), touches.end(), to_touches.begin());
}

void check_sizes(std::span<const Pair> pairs, std::span<Penetration> out,
                 std::span<Penetration::Touch> touches) {
  check_size({"nearest_free", "pair", pairs.size()}, out.size(), "answers");
  if (!touches.empty()) check_size({"nearest_free", "pair", pairs.size()}, touches.size(), "touches");
}

}  // namespace

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const Implementation& implementation = chosen(wanted, "nearest_free");
  require_valid(implementation, bodies.view().ground, agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  answer_pairs(SphereSource(bodies.view(), agents, implementation), pairs, axes, out, touches);
}

void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const CollideOptions& options,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const bool exact = exact_leaves(shapes, options.leaves, "nearest_free");
  const Implementation& implementation = chosen(options.implementation, "nearest_free");
  require_valid(implementation, shapes.view(), agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  answer_pairs(OutlineSource(shapes, agents, implementation, exact), pairs, axes, out, touches);
}

}  // namespace bch
