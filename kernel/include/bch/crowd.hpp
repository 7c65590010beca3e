// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/obstacles.hpp>
#include <bch/pairs.hpp>
#include <bch/query.hpp>

namespace bch::detail {
struct CrowdMemory;
}

namespace bch {

/// Holds the options that all calls of a Crowd share.
struct CrowdOptions {
  /// Holds the periods of periodic boundary conditions along x and y, metres; 0: not periodic.
  struct Period {
    double x = 0, y = 0;
  };

  Period period = {};
  /// Limits the candidate pairs of a call, which throws std::length_error if there are more. (n agents at one
  /// place make n^2 / 2 candidates.)
  std::size_t max_pairs = std::numeric_limits<std::size_t>::max();
};

/// Selects the pairs of a crowd that a query considers, as collision filters of physics engines do.
/// Two agents are a pair if each one's mask has a bit of the other's category.
/// Sizes:   as many categories and masks as agents, or none: then category 1, and a mask of all bits.
struct PairFilter {
  std::span<const std::uint32_t> category = {};
  std::span<const std::uint32_t> mask = {};
  std::span<const Pair> excluded = {};  ///< pairs to leave out, in any order
};

/// Answers queries about all pairs of a crowd: broad and narrow phase in one call.
///
///     bch::Crowd crowd;
///     for (const auto [a, b] : crowd.collisions(shapes, {shape, x, y, heading})) ...
/// Memory:  answers are valid until the next call; the object reuses its memory, so create it once.
/// Errors:  throws std::invalid_argument like validate(shapes, agents), and on options out of range.
/// Threads: runs in the caller's TBB arena; one call at a time. One Crowd per TBB thread is enough.
/// See:     "Crowds" in kernel/accuracy.md, for the order of pairs, periods and memory.
class Crowd {
 public:
  /// Names the other agent of a pair.
  struct Neighbour {
    std::uint32_t agent;
    std::uint32_t pair;  ///< index of the pair in the answer
    friend bool operator==(const Neighbour&, const Neighbour&) = default;
  };

  /// Views the pairs of an answer, each once, with first < second.
  /// It is valid until the next call of the Crowd.
  class Pairs {
   public:
    Pairs() = default;

    std::size_t size() const noexcept { return pairs_.size(); }
    bool empty() const noexcept { return pairs_.empty(); }
    const Pair* begin() const noexcept { return pairs_.data(); }
    const Pair* end() const noexcept { return pairs_.data() + pairs_.size(); }
    const Pair& operator[](std::size_t i) const noexcept { return pairs_[i]; }
    std::span<const Pair> span() const noexcept { return pairs_; }

    /// Returns the same pairs by agent: one row per agent of the crowd, ascending by neighbour.
    /// The first call builds the rows.
    /// Errors:  throws std::length_error beyond 2^32 - 1 pairs.
    Rows<Neighbour> by_agent() const;

   private:
    friend class Crowd;
    friend struct detail::CrowdMemory;
    Pairs(std::span<const Pair> pairs, detail::CrowdMemory& memory) noexcept
        : pairs_(pairs), memory_(&memory) {}

    Rows<Neighbour> nearest(std::span<const float> distance, std::uint32_t max_count) const;
    std::vector<double> disc_radii(std::span<const float> distance, const Agents& agents, double alone) const;

    std::span<const Pair> pairs_;
    detail::CrowdMemory* memory_ = nullptr;
  };

  /// Holds the pairs that have contacts, and their contacts.
  struct Contacts {
    Pairs pairs;
    Rows<DiscPair> contacts;  ///< one row per pair, none empty
  };

  /// Represents an overlap of two spheres in space.
  /// The normal points from the first agent's sphere to the second's; if centres coincide it is (1, 0, 0).
  /// Moving the second agent by depth * normal separates the two spheres.
  struct SphereContact {
    DiscPair spheres;  ///< indices into BodySet::spheres() of each agent's body
    /// The point of the first sphere that is deepest in the second, from the first agent's position, metres.
    Vec3 point;
    Vec3 normal;
    float depth;  ///< metres
    friend bool operator==(const SphereContact&, const SphereContact&) = default;
  };
  /// Holds the bodies of spheres that collide, and their contacts.
  struct BodyContacts {
    Pairs pairs;
    Rows<SphereContact> contacts;  ///< one row per pair, none empty
  };

  /// Holds the pairs within max_distance of each other.
  /// Arrays have one value per pair, as in ClearanceAnswers.
  struct Clearances {
    Pairs pairs;
    std::span<const float> distance;
    std::span<const Vec2> direction;
    std::span<const DiscPair> discs;
    std::span<const NearestPoints> points;

    /// Returns at most `max_count` neighbours of each agent, the nearest first.
    /// Only pairs of this answer count. Of equal distances the lower agent comes first. With Overlap::deepest
    /// the deepest overlap is the nearest. Crowd models such as ORCA take these as the people to avoid.
    /// Errors:  throws std::length_error beyond 2^32 - 1 pairs.
    Rows<Neighbour> nearest(std::uint32_t max_count) const { return pairs.nearest(distance, max_count); }

    /// Returns the radii of discs that stand for the bodies in a simulator of discs: metres, one per agent.
    /// If two bodies moved towards each other, they would touch once the distance of their positions is less
    /// by the clearance. An agent's radius is half of that distance, as a mean over its pairs of this answer
    /// with weights of 1 / (clearance + 0.1 m)^2. An agent without a pair gets `alone`. Use Overlap::deepest.
    /// Input:   the agents of the query.
    /// Errors:  throws std::invalid_argument on another number of agents.
    std::vector<double> disc_radii(const Agents& agents, double alone) const {
      return pairs.disc_radii(distance, agents, alone);
    }
  };

  /// Holds the pairs of bodies of spheres within max_distance of each other.
  /// Arrays have one value per pair, as in BodyClearanceAnswers.
  struct BodyClearances {
    Pairs pairs;
    std::span<const float> distance;
    std::span<const Vec3> direction;
    std::span<const DiscPair> spheres;
    std::span<const BodyClearanceAnswers::Points> points;

    /// Returns the nearest neighbours of each agent, as Clearances::nearest() does.
    Rows<Neighbour> nearest(std::uint32_t max_count) const { return pairs.nearest(distance, max_count); }
    /// Returns the radii of discs that stand for the bodies, as Clearances::disc_radii() does.
    std::vector<double> disc_radii(const Agents& agents, double alone) const {
      return pairs.disc_radii(distance, agents, alone);
    }
  };

  /// Holds the pairs that collide, and for each the displacement of its first agent that separates the two.
  struct Penetrations {
    Pairs pairs;
    std::span<const Penetration> penetrations;  ///< one per pair
  };

  /// Holds the options of resolve().
  struct ResolveOptions {
    std::uint32_t directions = 16;  ///< how many nearest_free() tries
    std::uint32_t sweeps = 100;     ///< the most to make
    double gap = 0.001;             ///< metres, clearance to leave between separated agents
    double largest_step = 0.05;     ///< metres, limit of an agent's displacement in a sweep
    double largest_shift = std::numeric_limits<double>::infinity();  ///< metres, limit in all sweeps
    double largest_turn =
        0;  ///< radians, limit of an agent's turn in all sweeps; 0: agents keep their headings
    /// Says how easily each agent moves, from 0 (fixed) to 1. Of two agents that separate, the one with half
    /// the mobility of the other moves half as far.
    std::span<const double> mobility = {};   ///< one per agent; empty: 1 each
    const ObstacleSet* obstacles = nullptr;  ///< walls that bodies must not touch; null: none
    const Implementation* implementation = nullptr;
  };
  /// Holds where the agents of a crowd are after resolve(), and what they still touch.
  struct Resolved {
    std::span<const double> x, y;  ///< one per agent
    std::span<const double> turn;  ///< radians to add to headings, one per agent; empty: none
    Pairs left;                    ///< pairs that still collide
    std::span<const std::uint32_t> agents_at_walls;  ///< agents that still touch a wall, ascending
    std::uint32_t sweeps;                            ///< how many were made
  };

  Crowd();
  /// Errors:  throws std::invalid_argument on a period outside of 0 .. 5e8 m.
  explicit Crowd(const CrowdOptions& options);
  Crowd(Crowd&&) noexcept;
  Crowd& operator=(Crowd&&) noexcept;
  ~Crowd();

  /// Finds the pairs whose root discs, at the agents' levels, come within a margin of each other.
  /// They contain every pair that collides, and every pair with a clearance of at most the margin. For
  /// time_of_impact() use a margin of twice the longest displacement of an agent. Rounding may add pairs that
  /// are farther apart by a few millionths of the margin, of their radii and of their shapes' extents.
  /// Units:   the margin is metres, from 0 to 2e9.
  Pairs candidates(const ShapeSet& shapes, const Agents& agents, double margin = 0,
                   const PairFilter& filter = {}) &;

  /// Finds the pairs for which collide() answers 1.
  Pairs collisions(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options = {},
                   const PairFilter& filter = {}) &;

  // The same for bodies of spheres. Candidates are pairs whose enclosing discs, as seen from above, come
  // within the margin of each other, and whose heights do, too.
  Pairs candidates(const BodySet& bodies, const Agents& agents, double margin = 0,
                   const PairFilter& filter = {}) &;
  Pairs collisions(const BodySet& bodies, const Agents& agents,
                   const Implementation* implementation = nullptr, const PairFilter& filter = {}) &;

  /// Finds all pairs of discs that make agents collide.
  /// Two such discs overlap, all ancestors of one overlap all ancestors of the other, and with exact leaves
  /// their segments meet; see Leaves. A pair that collides only because one agent is inside the other's
  /// outline has no contact. For forces use clearances() with Overlap::deepest; see "Contacts" in
  /// kernel/accuracy.md.
  /// Order:   contacts of a pair by the first discs, then the second discs.
  Contacts contacts(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options = {},
                    const PairFilter& filter = {}) &;

  /// Finds the contacts of given pairs: one row per pair, empty where there are none.
  /// If the two agents of a pair are exchanged, each contact has its two discs exchanged, and contacts are
  /// sorted by the discs of the new first agent. An agent may be paired with itself. Two cuts of n discs have
  /// at most n^2 contacts.
  /// Errors:  also those of collide(), and if the Crowd has a period; std::bad_alloc or std::length_error if
  ///          memory does not suffice.
  Rows<DiscPair> contacts(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                          const CollideOptions& options = {}) &;

  /// Finds all pairs of overlapping spheres of bodies that collide: contacts for a physics engine.
  /// Two bodies deep in each other have hundreds; clearances() with Overlap::deepest returns only the
  /// deepest.
  /// Order:   contacts of a pair by the first spheres, then the second spheres.
  BodyContacts contacts(const BodySet& bodies, const Agents& agents,
                        const Implementation* implementation = nullptr, const PairFilter& filter = {}) &;
  /// Finds the contacts of given pairs, as for shapes.
  Rows<SphereContact> contacts(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                               const Implementation* implementation = nullptr) &;

  /// Finds the pairs whose clearance() is at most max_distance, which has to be finite.
  Clearances clearances(const ShapeSet& shapes, const Agents& agents, const ClearanceOptions& options,
                        const PairFilter& filter = {}) &;

  /// Finds the pairs of bodies of spheres whose clearance() in space is at most max_distance.
  /// With Overlap::deepest each pair that collides has one contact for physics: the two spheres that overlap
  /// the deepest, with a normal and a depth that grows from 0.
  BodyClearances clearances(const BodySet& bodies, const Agents& agents, const BodyClearanceOptions& options,
                            const PairFilter& filter = {}) &;

  /// Finds the pairs that collide, and their penetration() with this number of directions.
  Penetrations penetrations(const ShapeSet& shapes, const Agents& agents, std::uint32_t directions = 16,
                            const CollideOptions& options = {}, const PairFilter& filter = {}) &;
  Penetrations penetrations(const BodySet& bodies, const Agents& agents, std::uint32_t directions = 16,
                            const Implementation* implementation = nullptr, const PairFilter& filter = {}) &;

  /// Finds the obstacles that each agent collides with: one row per agent, ascending.
  /// A row is empty exactly if collide() with obstacles answers 0 for the agent.
  Rows<std::uint32_t> obstacles(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                                const CollideOptions& options = {}) &;
  Rows<std::uint32_t> obstacles(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
                                const Implementation* implementation = nullptr) &;

  /// Moves agents on the ground until no two bodies collide and nobody touches a wall.
  /// It keeps displacements small, and turns agents up to largest_turn. Each sweep moves all agents at once.
  /// If there is too little room, some pairs still collide after the last sweep. With a period, agents meet
  /// across its borders, and the positions returned may lie outside the period.
  /// See:     "A crowd without overlaps" in kernel/README.md.
  /// Memory:  allocates in every sweep, as nearest_free() does.
  /// Errors:  also on an odd number of directions, and on lengths, turns and mobilities out of range.
  Resolved resolve(const BodySet& bodies, const Agents& agents, const ResolveOptions& options,
                   const PairFilter& filter = {}) &;

 private:
  std::unique_ptr<detail::CrowdMemory> memory_;
};

}  // namespace bch
