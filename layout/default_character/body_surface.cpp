// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/body_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace bch::detail {

std::uint32_t BodySurface::add(const Eigen::Vector3d& position, const SkinTag& tag) {
  positions.push_back(position);
  tags.push_back(tag);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void BodySurface::strip(const Loop& from, const Loop& to, bool closed, std::size_t skip_begin,
                        std::size_t skip_end) {
  assert(from.size() == to.size());
  const std::size_t count = from.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    if (i >= skip_begin && i < skip_end) continue;
    const std::size_t next = (i + 1) % count;
    faces.push_back({from[i], from[next], to[next], to[i]});
  }
}

void BodySurface::cap(const Loop& loop) {
  std::size_t low = 0;
  std::size_t high = loop.size() - 1;
  for (; low + 1 < high - 1; ++low, --high)
    faces.push_back({loop[low], loop[low + 1], loop[high - 1], loop[high]});
  if (low + 2 == high) faces.push_back({loop[low], loop[low + 1], loop[high], loop[high]});
}

BodySurface::Loop BodySurface::extrude(const Loop& base, const Eigen::Vector3d& offset, double scale,
                                       const SkinTag& tag) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : base) middle += positions[v] / static_cast<double>(base.size());
  const Eigen::Vector3d direction = offset.normalized();
  Loop top;
  for (const std::uint32_t v : base) {
    const Eigen::Vector3d arm = positions[v] - middle;
    top.push_back(add(middle + offset + scale * (arm - arm.dot(direction) * direction), tag));
  }
  strip(base, top, true);
  return top;
}

BodySurface mirrored(const BodySurface& left) {
  BodySurface whole = left;
  std::vector<std::uint32_t> twin(left.positions.size());
  const auto other_side = [](std::uint32_t joint) {
    return joint < midline_joints ? joint : joint + side_joints;
  };
  for (std::uint32_t v = 0; v < twin.size(); ++v) {
    twin[v] = v;
    const Eigen::Vector3d& p = left.positions[v];
    if (p.y() == 0) continue;
    SkinTag tag = left.tags[v];
    tag.joint = other_side(tag.joint);
    tag.next = other_side(tag.next);
    twin[v] = whole.add({p.x(), -p.y(), p.z()}, tag);
  }
  for (const BodySurface::Face& f : left.faces) {
    const bool triangle = f[2] == f[3];
    if (triangle)
      whole.faces.push_back({twin[f[1]], twin[f[0]], twin[f[2]], twin[f[2]]});
    else
      whole.faces.push_back({twin[f[1]], twin[f[0]], twin[f[3]], twin[f[2]]});
  }
  return whole;
}

std::vector<std::vector<std::uint32_t>> neighbours(const BodySurface& surface) {
  std::vector<std::vector<std::uint32_t>> around(surface.positions.size());
  for (const BodySurface::Face& f : surface.faces)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t a = f[i];
      const std::uint32_t b = f[(i + 1) % 4];
      if (a == b) continue;
      around[a].push_back(b);
      around[b].push_back(a);
    }
  for (std::vector<std::uint32_t>& list : around) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return around;
}

void smooth(BodySurface& surface, int rounds) {
  const auto around = neighbours(surface);
  std::vector<Eigen::Vector3d> moved(surface.positions.size());
  for (int step = 0; step < 2 * rounds; ++step) {
    const double factor = step % 2 == 0 ? 0.5 : -0.53;
    for (std::size_t v = 0; v < moved.size(); ++v) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const std::uint32_t n : around[v]) mean += surface.positions[n];
      mean /= static_cast<double>(around[v].size());
      const Eigen::Vector3d& p = surface.positions[v];
      moved[v] = p + factor * surface.tags[v].softness * (mean - p);
    }
    surface.positions.swap(moved);
  }
}

std::vector<std::array<std::uint32_t, 3>> triangulated(const BodySurface& surface) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(2 * surface.faces.size());
  const auto length = [&](std::uint32_t a, std::uint32_t b) {
    return (surface.positions[a] - surface.positions[b]).squaredNorm();
  };
  const auto out_of_lower_end = [&](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector3d &p = surface.positions[a], &q = surface.positions[b];
    return std::abs(p.z() < q.z() ? p.y() : q.y());
  };
  // Where both are as long but for rounding, which libm's last bits decide, it is the one from the lower corner that is farther out.
  const auto is_cut_from_first = [&](const BodySurface::Face& f) {
    const double first = length(f[0], f[2]), second = length(f[1], f[3]);
    if (std::abs(first - second) > 1e-14 * first) return first < second;
    return out_of_lower_end(f[0], f[2]) > out_of_lower_end(f[1], f[3]);
  };
  for (const BodySurface::Face& f : surface.faces) {
    if (f[2] == f[3]) {
      triangles.push_back({f[0], f[1], f[2]});
    } else if (is_cut_from_first(f)) {
      triangles.push_back({f[0], f[1], f[2]});
      triangles.push_back({f[0], f[2], f[3]});
    } else {
      triangles.push_back({f[0], f[1], f[3]});
      triangles.push_back({f[1], f[2], f[3]});
    }
  }
  return triangles;
}

}  // namespace bch::detail
