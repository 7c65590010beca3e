// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <bch/distributed_crowd.hpp>

namespace bch::cli {

/// The words for kinds of crowds: uniform; spot, a quarter of all in a disc at four times the density; stadium, half of all on stands
/// at twice the density around half of it; street, all in streets of 10 m, 100 m apart.
extern const std::vector<std::string> scenery_kinds;

/// Places the agents of a crowd. Each agent is drawn by its number alone, so that a rank needs no other's.
class Scenery {
 public:
  /// Takes a kind, the number of agents, and their density per square metre.
  Scenery(const std::string& kind, std::uint64_t agents, double density);

  /// Returns an agent, with a shape of so many; its level is 0.
  CrowdAgent agent(std::uint64_t number, std::uint32_t shapes) const;
  /// Returns how dense the crowd is about a point.
  double density(double x, double y) const;
  /// Returns half the side of the square about the origin that holds all.
  double half_side() const;

 private:
  /// Represents a part of the crowd that is equally dense in an area.
  struct Layer {
    double share, area;
    double half_side;           ///< of a square, of which streets take a tenth
    bool rows, columns;         ///< streets
    double inner, outer, x, y;  ///< of a ring, where outer is not 0
    bool holds(double px, double py) const;
  };

  std::uint64_t agents_;
  std::vector<Layer> layers_;
};

}  // namespace bch::cli
