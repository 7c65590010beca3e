# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Two crowd simulators in which people are discs. They know nothing of bodies. Places and velocities are arrays (n, 2), radii (n,)."""

import numpy as np

WANTED_SPEED, FASTEST = 1.3, 1.8  # m/s


def shortened(vectors, most):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors * np.minimum(1, most / np.maximum(length, 1e-9))


def dot(a, b):
    return (a * b).sum(-1, keepdims=True)


def steer_by_social_forces(at, velocity, goal, radius, seconds):
    """Return new velocities, after Helbing and Molnar 1995: a drive to the goal, and exponential repulsion of discs."""
    relaxation, strength, reach = 0.5, 4.0, 0.15  # s, m/s^2, m
    away = at[:, None] - at
    distance = np.linalg.norm(away, axis=2, keepdims=True)
    push = np.minimum(40, strength * np.exp(((radius[:, None] + radius)[..., None] - distance) / reach)) / np.maximum(distance, 1e-9)
    force = (shortened(goal - at, WANTED_SPEED) - velocity) / relaxation + (push * away).sum(1)
    return shortened(velocity + seconds * force, FASTEST)


def half_planes(to, both, own, relative, horizon, seconds):
    """Return points and normals of the velocities with which a disc does its half to avoid each other one. `both`: sums of radii.

    After van den Berg, Guy, Lin, Manocha, "Reciprocal n-body collision avoidance", 2009, section 4.
    """
    square = dot(to, to)
    overlap = square < both**2
    time = np.where(overlap, seconds, horizon)
    from_cut = relative - to / time
    length = np.maximum(np.linalg.norm(from_cut, axis=-1, keepdims=True), 1e-9)
    ahead = dot(from_cut, to)
    in_front = overlap | ((ahead < 0) & (ahead**2 > both**2 * length**2))
    side = np.where(to[..., :1] * from_cut[..., 1:] > to[..., 1:] * from_cut[..., :1], 1, -1)
    leg = side * np.sqrt(np.maximum(0, square - both**2))
    along = np.concatenate([to[..., :1] * leg - to[..., 1:] * both, to[..., 1:] * leg + to[..., :1] * both], -1) / np.maximum(square, 1e-9)
    normal = np.where(in_front, from_cut / length, np.stack([-along[..., 1], along[..., 0]], -1))
    change = np.where(in_front, (both / time - length) * normal, dot(relative, along) * along - relative)
    return own + change / 2, normal


def steer_by_orca(at, velocity, goal, radius, seconds):
    """Return the velocities nearest the wanted ones that avoid everybody else (ORCA), by projections onto one half plane after the other."""
    horizon, reach, rounds = 2.0, 5.0, 30  # s, m
    to = at - at[:, None]
    point, normal = half_planes(to, (radius[:, None] + radius)[..., None], velocity[:, None], velocity[:, None] - velocity, horizon, seconds)
    distance = np.linalg.norm(to, axis=2)
    normal[(distance >= reach) | (distance == 0)] = 0
    chosen = shortened(goal - at, WANTED_SPEED)
    for _ in range(rounds):
        for k in range(len(at)):
            chosen += np.maximum(0, dot(point[:, k] - chosen, normal[:, k])) * normal[:, k]
    return shortened(chosen, FASTEST)
