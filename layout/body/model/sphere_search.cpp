// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "layout/body/model/piece_gathering.hpp"
#include "layout/body/model/sphere_descent.hpp"
#include "layout/body/model/sphere_fit.hpp"

namespace bch::detail {
namespace {

using Ball = SphereFit::Ball;
using Space = std::array<float, 3>;

static_assert(searched_poses == SphereFit::poses);

constexpr int search_rounds = 30;
constexpr float first_step = 1e-3f, last_step = 2e-4f;        // metres
constexpr double first_deleted = 0.06, last_deleted = 0.006;  // of the spheres
constexpr int last_rounds = search_rounds / 5;                // which neither delete nor split
constexpr float worth_of_corner = 1e-5f;   // metres that all slides may meet earlier, of a corner less
constexpr float least_contacts = 0.05f;    // of the mean: what spheres without contact count
constexpr float exposing_growth = 0.005f;  // metres: who grows by half has the mean of contacts more

class SphereSearch {
 public:
  SphereSearch(const SkinPieces& skin, const TrainingPoses& poses, const SphereChoice& choice)
      : skin_(skin), fit_(skin, poses, choice), descent_(fit_) {}

  void round(int number) {
    const float progress = static_cast<float>(number) / (search_rounds - 1);
    const bool is_last = number + last_rounds >= search_rounds;
    if (is_last) gather();
    descent_.round(first_step + progress * (last_step - first_step));
    mean_contacts_ = std::accumulate(descent_.contacts.begin(), descent_.contacts.end(), 1e-3f) /
                     static_cast<float>(fit_.balls.size());
    if (is_last) return;
    hand_over_farthest();
    const double fraction = first_deleted + double{progress} * (last_deleted - first_deleted);
    const double rounded_up_from_half = fraction * static_cast<double>(fit_.balls.size()) + 0.5;
    replace(static_cast<std::size_t>(rounded_up_from_half));
  }

  SphereChoice choice() const { return fit_.choice(); }

 private:
  /// Returns by how much earlier all slides together meet when a sphere takes a triangle, metres.
  float price(std::uint32_t sphere, const SphereFit::Corners& triangle) const {
    const float growth = fit_.growth(fit_.balls[sphere], triangle);
    return growth *
           (descent_.contacts[sphere] + mean_contacts_ * (least_contacts + growth / exposing_growth));
  }

  /// Makes a sphere hold one triangle more: it has more contacts then.
  void grow(std::uint32_t sphere, const SphereFit::Corners& triangle) {
    const float growth = fit_.growth(fit_.balls[sphere], triangle);
    descent_.contacts[sphere] += 2 * mean_contacts_ * growth / exposing_growth;
    fit_.grow(fit_.balls[sphere], triangle);
  }

  /// Gives pieces to the spheres of their neighbours, by the contacts of the last round.
  void gather() {
    const float slides = SphereDescent::slides_a_round;
    gather_pieces(skin_, fit_,
                  {[&](std::uint32_t sphere, const auto& triangle) { return price(sphere, triangle); },
                   [&](std::uint32_t sphere, const auto& triangle) { grow(sphere, triangle); },
                   worth_of_corner * slides});
  }

  /// Gives the farthest pieces of the spheres with most blame to spheres that hold them anyway.
  void hand_over_farthest() {
    for (const std::uint32_t s : by_falling(descent_.blame)) {
      for (bool is_smaller = true; is_smaller && fit_.balls[s].pieces.size() > 1;) {
        is_smaller = false;
        const std::vector<std::uint32_t> pieces = fit_.balls[s].pieces;
        for (const std::uint32_t piece : pieces) {
          if (!is_farthest(fit_.balls[s], piece)) continue;
          const std::uint32_t to = holder(piece, s);
          if (to == none || fit_.balls[s].pieces.size() == 1) continue;
          fit_.hand_over(piece, to);
          is_smaller = true;
        }
        if (is_smaller) fit_.refit(fit_.balls[s]);
      }
    }
  }

  bool is_farthest(const Ball& ball, std::uint32_t piece) const {
    for (const std::uint32_t corner : fit_.corners(piece))
      if (std::find(ball.farthest.begin(), ball.farthest.end(), corner) != ball.farthest.end()) return true;
    return false;
  }

  std::uint32_t holder(std::uint32_t piece, std::uint32_t but) const {
    for (std::uint32_t q = 0; q < fit_.balls.size(); ++q)
      if (q != but && fit_.contains(fit_.balls[q], piece)) return q;
    return none;
  }

  /// Returns spheres in the order of a number of theirs, the largest first.
  static std::vector<std::uint32_t> by_falling(const std::vector<float>& number) {
    std::vector<std::uint32_t> order(number.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return number[a] > number[b]; });
    return order;
  }

  struct Receiver {
    std::uint32_t sphere = none;
    float price = std::numeric_limits<float>::infinity();
  };

  /// Returns the sphere that takes a piece at the least growth times contacts.
  Receiver cheapest(std::uint32_t piece, std::uint32_t but) const {
    Receiver best;
    const Space at = fit_.at(fit_.corners(piece)[0], 0);
    for (std::uint32_t q = 0; q < fit_.balls.size(); ++q) {
      const Ball& ball = fit_.balls[q];
      if (q == but || ball.pieces.empty()) continue;
      const float x = at[0] - ball.x[0], y = at[1] - ball.y[0], z = at[2] - ball.z[0];
      const float range = ball.radius[0] + 0.1f;
      if (best.sphere != none && x * x + y * y + z * z > range * range) continue;
      const float now = price(q, fit_.corners(piece));
      if (now < best.price) best = {q, now};
      if (now <= 0) break;
    }
    return best;
  }

  /// Returns what the others grow, times their contacts, when a sphere goes.
  float price_of_deletion(std::uint32_t sphere) const {
    std::vector<Receiver> receivers;
    for (const std::uint32_t piece : fit_.balls[sphere].pieces) {
      const Receiver to = cheapest(piece, sphere);
      const auto found = std::find_if(receivers.begin(), receivers.end(),
                                      [&](const Receiver& r) { return r.sphere == to.sphere; });
      if (found == receivers.end())
        receivers.push_back(to);
      else
        found->price = std::max(found->price, to.price);
    }
    float sum = 0;
    for (const Receiver& receiver : receivers) sum += receiver.price;
    return sum;
  }

  /// Deletes the cheapest spheres and splits as many of those with most blame and size.
  void replace(std::size_t count) {
    if (fit_.balls.size() < 2) return;
    std::vector<float> worth;
    for (std::uint32_t s = 0; s < fit_.balls.size(); ++s) worth.push_back(-price_of_deletion(s));
    std::vector<std::uint32_t> freed = by_falling(worth);
    freed.resize(std::min(std::max<std::size_t>(count, 1), freed.size() / 2));
    for (const std::uint32_t s : freed) {
      const std::vector<std::uint32_t> pieces = fit_.balls[s].pieces;
      for (const std::uint32_t piece : pieces) {
        const std::uint32_t to = cheapest(piece, s).sphere;
        grow(to, fit_.corners(piece));
        fit_.hand_over(piece, to);
      }
    }
    split_worst();
  }

  /// Gives half of the worst spheres, those with most blame and size, to those that have no pieces.
  void split_worst() {
    std::vector<std::uint32_t> free;
    std::vector<float> urgency;
    for (std::uint32_t s = 0; s < fit_.balls.size(); ++s) {
      if (fit_.balls[s].pieces.empty()) free.push_back(s);
      urgency.push_back(fit_.balls[s].pieces.empty() ? -1 : descent_.blame[s] * fit_.balls[s].radius[0]);
    }
    for (const std::uint32_t worst : by_falling(urgency)) {
      if (free.empty()) return;
      if (fit_.balls[worst].pieces.size() > 1 && split(worst, free.back())) free.pop_back();
    }
  }

  Space middle(std::uint32_t piece) const {
    Space sum = {};
    for (const std::uint32_t corner : fit_.corners(piece))
      for (std::size_t k = 0; k < 3; ++k) sum[k] += fit_.at(corner, 0)[k] / 3;
    return sum;
  }

  /// Halves the pieces of a sphere by 2-means and gives one half to a free sphere.
  /// Returns: whether there are two halves.
  bool split(std::uint32_t sphere, std::uint32_t free) {
    const std::vector<std::uint32_t> pieces = fit_.balls[sphere].pieces;
    std::vector<Space> at;
    at.reserve(pieces.size());
    for (const std::uint32_t piece : pieces) at.push_back(middle(piece));
    const auto squared = [](const Space& a, const Space& b) {
      const Space d = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      return dot_of(d, d);
    };
    const auto farthest_from = [&](const Space& from) {
      return *std::max_element(at.begin(), at.end(), [&](const Space& a, const Space& b) {
        return squared(a, from) < squared(b, from);
      });
    };
    Space ends[2] = {farthest_from(at[0]), {}};
    ends[1] = farthest_from(ends[0]);
    std::vector<std::uint8_t> half(pieces.size(), 0);
    for (int i = 0; i < 8; ++i) {
      Space sum[2] = {};
      float members[2] = {};
      for (std::size_t p = 0; p < at.size(); ++p) {
        half[p] = squared(at[p], ends[1]) < squared(at[p], ends[0]) ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) sum[half[p]][k] += at[p][k];
        members[half[p]] += 1;
      }
      if (members[0] == 0 || members[1] == 0) return false;
      for (std::size_t h = 0; h < 2; ++h)
        for (std::size_t k = 0; k < 3; ++k) ends[h][k] = sum[h][k] / members[h];
    }
    const Ball old = fit_.balls[sphere];
    fit_.balls[free].influences = moved(old, ends[1]);
    fit_.balls[sphere].influences = moved(old, ends[0]);
    for (std::size_t p = 0; p < pieces.size(); ++p)
      if (half[p] != 0) fit_.hand_over(pieces[p], free);
    for (const std::uint32_t s : {sphere, free}) {
      fit_.place(fit_.balls[s]);
      fit_.refit(fit_.balls[s]);
      descent_.restart(s);
    }
    descent_.blame[sphere] = descent_.blame[free] = 0;
    return true;
  }

  /// Returns the influences of a sphere whose centre went halfway to a point of the first pose.
  std::vector<SphereInfluence> moved(const Ball& ball, const Space& to) const {
    std::vector<SphereInfluence> influences = ball.influences;
    const Space offset = {0.5f * (to[0] - ball.x[0]), 0.5f * (to[1] - ball.y[0]), 0.5f * (to[2] - ball.z[0])};
    for (SphereInfluence& influence : influences) {
      const auto& rows = fit_.training().map(0, influence.bone).rows;
      const float shrink = 1 / (scale_of(rows) * scale_of(rows));
      float* const centre[3] = {&influence.centre.x, &influence.centre.y, &influence.centre.z};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < 3; ++row)
          *centre[k] += shrink * static_cast<float>(rows[row][k]) * offset[row];
    }
    return influences;
  }

  static constexpr std::uint32_t none = 0xffffffff;

  const SkinPieces& skin_;
  SphereFit fit_;
  SphereDescent descent_;
  float mean_contacts_ = 0;
};

}  // namespace

SphereChoice improve_spheres(const SkinPieces& skin, const TrainingPoses& poses, const SphereChoice& choice,
                             const std::function<void(double)>& advance) {
  SphereSearch search(skin, poses, choice);
  for (int i = 0; i < search_rounds; ++i) {
    search.round(i);
    advance(static_cast<double>(i + 1) / search_rounds);
  }
  return search.choice();
}

}  // namespace bch::detail
