// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "baselines/counts.hpp"
#include "baselines/structure.hpp"

namespace bch::baselines {

/// Implements the interface over models of one type. A Model answers
///   static bool meet(const Model& a, const Model& b, const Agents&, Pair, max_depth, Counts)
/// where a belongs to the agent of the smaller index, and tells its bytes().
template <class Model>
class Built final : public Structure {
 public:
  explicit Built(std::vector<Model> models) : models_(std::move(models)) {}

  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth) const override {
    return meet(agents, pair, max_depth, NoCounts{});
  }
  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth, TestCounts& counts) const override {
    return meet(agents, pair, max_depth, AddCounts{counts});
  }
  std::size_t bytes(std::uint32_t shape) const override { return models_.at(shape).bytes(); }
  std::uint32_t shape_count() const override { return static_cast<std::uint32_t>(models_.size()); }

 private:
  void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
              std::uint32_t max_depth) const override {
    for (std::size_t i = 0; i < pairs.size(); ++i)
      hits[i] = meet(agents, pairs[i], max_depth, NoCounts{}) ? 1 : 0;
  }

  template <class Counts>
  bool meet(const Agents& agents, Pair pair, std::uint32_t max_depth, Counts counts) const {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    return Model::meet(models_[agents.shape[a]], models_[agents.shape[b]], agents, pair, max_depth, counts);
  }

  std::vector<Model> models_;
};

/// Makes a model of each body; make(body) says what is wrong with a body by throwing std::invalid_argument.
template <class Model, class Make>
std::unique_ptr<Structure> build_models(std::span<const Body> bodies, Make make) {
  std::vector<Model> models;
  models.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) try {
      models.push_back(make(bodies[i]));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("body " + std::to_string(i) + ": " + error.what());
    }
  return std::make_unique<Built<Model>>(std::move(models));
}

}  // namespace bch::baselines
