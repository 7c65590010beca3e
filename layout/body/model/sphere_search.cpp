// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "layout/base/random.hpp"
#include "layout/body/model/sphere_fit.hpp"
#include "layout/body/model/sphere_slide.hpp"

namespace bch::detail {
namespace {

using Ball = SphereFit::Ball;
using Space = std::array<float, 3>;

static_assert(searched_poses == SphereFit::poses);

constexpr std::uint64_t search_seed = 54;
constexpr int search_rounds = 30;
constexpr int steps_a_round = 100, slides_a_step = 100;
constexpr double widest_lateral = 0.5;                        // metres
constexpr float first_step = 1e-3f, last_step = 2e-4f;        // metres
constexpr double first_deleted = 0.06, last_deleted = 0.006;  // of the spheres
constexpr int last_rounds = search_rounds / 5;                // which neither delete nor split
constexpr float most_leverage = 4;  // of a contact: by how much later it is where a front is 1 less far
constexpr float kept_gradient = 0.9f, kept_square = 0.99f;
constexpr float least_contacts = 0.05f;  // of the mean: what spheres without contact count
constexpr float exposing_growth = 0.02f;  // metres: whoever grows by as much has the mean of contacts more

float dot_of(const Space& a, const Space& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Remembers the gradients of a centre in the frame of one bone.
struct Descent {
  Space mean = {};
  float square = 0;
};

class SphereSearch {
 public:
  SphereSearch(const SkinPieces& skin, const TrainingPoses& poses, const SphereChoice& choice)
      : fit_(skin, poses, choice), random_(search_seed) {
    reset_statistics();
    for (const Ball& ball : fit_.balls) descents_.emplace_back(ball.influences.size());
  }

  void round(int number) {
    const float progress = static_cast<float>(number) / (search_rounds - 1);
    reset_statistics();
    for (int step = 0; step < steps_a_round; ++step) move(first_step + progress * (last_step - first_step));
    hand_over_farthest();
    if (number + last_rounds >= search_rounds) return;
    const double share = first_deleted + double{progress} * (last_deleted - first_deleted);
    const double rounded_up_from_half = share * static_cast<double>(fit_.balls.size()) + 0.5;
    replace(static_cast<std::size_t>(rounded_up_from_half));
  }

  SphereChoice choice() const { return fit_.choice(); }

 private:
  void reset_statistics() {
    blame_.assign(fit_.balls.size(), 0);
    contacts_.assign(fit_.balls.size(), 0);
  }

  /// Makes slides, and moves the spheres that met first.
  void move(float length) {
    std::array<std::vector<Sphere>, SphereFit::poses> bodies;
    for (std::size_t pose = 0; pose < SphereFit::poses; ++pose)
      for (const Ball& ball : fit_.balls)
        bodies[pose].push_back({ball.x[pose], ball.y[pose], ball.z[pose], ball.radius[pose]});
    gradients_.clear();
    for (std::size_t s = 0; s < fit_.balls.size(); ++s)
      gradients_.emplace_back(fit_.balls[s].influences.size());
    std::vector<std::uint8_t> is_met(fit_.balls.size(), 0);
    for (int i = 0; i < slides_a_step; ++i) {
      const std::uint32_t a = random_.below(SphereFit::poses);
      const std::uint32_t b = (a + 1 + random_.below(SphereFit::poses - 1)) % SphereFit::poses;
      const Rotation turn_a = rotation(random_.between(0, 2 * std::numbers::pi));
      const Rotation turn_b = rotation(random_.between(0, 2 * std::numbers::pi));
      const auto lateral = static_cast<float>(random_.between(-widest_lateral, widest_lateral));
      first_.place(bodies[a], turn_a, 0, 1);
      second_.place(bodies[b], turn_b, lateral, -1);
      const auto contact = first_contact(first_, second_);
      if (!contact) continue;
      const float leverage = std::min(most_leverage, 1 / std::max(contact->normal[0], 0.01f));
      note(contact->first, a, turn_a, contact->normal, 1, leverage);
      note(contact->second, b, turn_b, contact->normal, -1, leverage);
      is_met[contact->first] = is_met[contact->second] = 1;
    }
    for (std::size_t s = 0; s < fit_.balls.size(); ++s)
      if (is_met[s] != 0) descend(s, length);
  }

  /// Notes the part of one of the spheres in a contact.
  void note(std::uint32_t sphere, std::size_t pose, const Rotation& turn, const float (&normal)[3],
            float sign, float leverage) {
    const Ball& ball = fit_.balls[sphere];
    const auto cosine = static_cast<float>(turn.cosine), sine = static_cast<float>(turn.sine);
    const Space outward = {sign * (cosine * normal[0] + sine * normal[1]),
                           sign * (cosine * normal[1] - sine * normal[0]), sign * normal[2]};
    const Space corner = fit_.at(ball.farthest[pose], pose);
    const float radius = std::max(ball.radius[pose], 1e-6f);
    const Space way = {(corner[0] - ball.x[pose]) / radius, (corner[1] - ball.y[pose]) / radius,
                       (corner[2] - ball.z[pose]) / radius};
    contacts_[sphere] += leverage;
    blame_[sphere] += leverage * (1 - dot_of(outward, way));
    for (std::size_t i = 0; i < ball.influences.size(); ++i) {
      const auto& rows = fit_.training().map(pose, ball.influences[i].bone).rows;
      const float share = leverage * ball.influences[i].weight / scale(rows);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < 3; ++row)
          gradients_[sphere][i][k] += share * static_cast<float>(rows[row][k]) * (outward[row] - way[row]);
    }
  }

  /// Returns how much longer a map makes lengths in the mean.
  static float scale(const double (&rows)[3][4]) {
    double sum = 0;
    for (const auto& row : rows)
      for (int k = 0; k < 3; ++k) sum += row[k] * row[k];
    return static_cast<float>(std::sqrt(sum / 3));
  }

  void descend(std::size_t sphere, float length) {
    Ball& ball = fit_.balls[sphere];
    for (std::size_t i = 0; i < ball.influences.size(); ++i) {
      const Space& gradient = gradients_[sphere][i];
      Descent& descent = descents_[sphere][i];
      descent.square = kept_square * descent.square + (1 - kept_square) * dot_of(gradient, gradient);
      const float step = length / (std::sqrt(descent.square) + 1e-9f) /
                         scale(fit_.training().map(0, ball.influences[i].bone).rows);
      float* const centre[3] = {&ball.influences[i].centre.x, &ball.influences[i].centre.y,
                                &ball.influences[i].centre.z};
      for (std::size_t k = 0; k < 3; ++k) {
        descent.mean[k] = kept_gradient * descent.mean[k] + (1 - kept_gradient) * gradient[k];
        *centre[k] -= step * descent.mean[k];
      }
    }
    fit_.place(ball);
    fit_.refit(ball);
  }

  /// Gives the farthest pieces of the spheres with most blame to spheres that hold them anyway.
  void hand_over_farthest() {
    for (const std::uint32_t s : by_falling(blame_)) {
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
      if (q != but && fit_.holds(fit_.balls[q], piece)) return q;
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
      const float reach = ball.radius[0] + 0.1f;
      if (best.sphere != none && x * x + y * y + z * z > reach * reach) continue;
      const float growth = fit_.growth(ball, piece);
      const float price = growth * (contacts_[q] + mean_contacts_ * (least_contacts + growth / exposing_growth));
      if (price < best.price) best = {q, price};
      if (price <= 0) break;
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
    const float all = std::accumulate(contacts_.begin(), contacts_.end(), 0.0f);
    mean_contacts_ = all / static_cast<float>(fit_.balls.size()) + 1e-6f;
    std::vector<float> worth;
    for (std::uint32_t s = 0; s < fit_.balls.size(); ++s) worth.push_back(-price_of_deletion(s));
    std::vector<std::uint32_t> freed = by_falling(worth);
    freed.resize(std::min(std::max<std::size_t>(count, 1), freed.size() / 2));
    for (const std::uint32_t s : freed) {
      const std::vector<std::uint32_t> pieces = fit_.balls[s].pieces;
      for (const std::uint32_t piece : pieces) {
        const std::uint32_t to = cheapest(piece, s).sphere;
        fit_.grow(fit_.balls[to], piece);
        fit_.hand_over(piece, to);
      }
    }
    std::vector<float> urgency;
    for (std::uint32_t s = 0; s < fit_.balls.size(); ++s)
      urgency.push_back(fit_.balls[s].pieces.size() < 2 ? -1 : blame_[s] * fit_.balls[s].radius[0]);
    const std::vector<std::uint32_t> worst = by_falling(urgency);
    for (std::size_t i = 0; i < freed.size(); ++i)
      if (urgency[worst[i]] >= 0) split(worst[i], freed[i]);
  }

  Space middle(std::uint32_t piece) const {
    Space sum = {};
    for (const std::uint32_t corner : fit_.corners(piece))
      for (std::size_t k = 0; k < 3; ++k) sum[k] += fit_.at(corner, 0)[k] / 3;
    return sum;
  }

  /// Halves the pieces of a sphere by 2-means and gives one half to a free sphere.
  void split(std::uint32_t sphere, std::uint32_t free) {
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
      if (members[0] == 0 || members[1] == 0) return;
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
      descents_[s].assign(fit_.balls[s].influences.size(), {});
    }
    blame_[sphere] = blame_[free] = 0;
  }

  /// Returns the influences of a sphere whose centre went halfway to a point of the first pose.
  std::vector<SphereInfluence> moved(const Ball& ball, const Space& to) const {
    std::vector<SphereInfluence> influences = ball.influences;
    const Space way = {0.5f * (to[0] - ball.x[0]), 0.5f * (to[1] - ball.y[0]), 0.5f * (to[2] - ball.z[0])};
    for (SphereInfluence& influence : influences) {
      const auto& rows = fit_.training().map(0, influence.bone).rows;
      const float shrink = 1 / (scale(rows) * scale(rows));
      float* const centre[3] = {&influence.centre.x, &influence.centre.y, &influence.centre.z};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < 3; ++row)
          *centre[k] += shrink * static_cast<float>(rows[row][k]) * way[row];
    }
    return influences;
  }

  static constexpr std::uint32_t none = 0xffffffff;

  SphereFit fit_;
  Random random_;
  SlidingBody first_, second_;
  std::vector<std::vector<Descent>> descents_;
  std::vector<std::vector<Space>> gradients_;
  std::vector<float> blame_, contacts_;
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
