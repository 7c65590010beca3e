# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""People without overlaps: 500 people are moved, as little as it takes, until nobody collides. Writes no_overlaps.png."""

import bch
import matplotlib.pyplot as plt
import numpy as np

characters, poses = [bch.default_male(), bch.default_female()], 50
people = bch.bake([bch.default_body(character) for character in characters], poses=poses)
outlines = bch.bake(characters, poses=poses)  # of the same poses, to be drawn


def spaced(random, n, side, least):
    """Return places on a square that repeats, at least so far from each other."""
    places = np.empty((0, 2))
    while len(places) < n:
        place = random.uniform(0, side, 2)
        apart = np.abs(places - place)
        apart = np.minimum(apart, side - apart)
        if (np.hypot(*apart.T) >= least).all():
            places = np.vstack([places, place])
    return np.ascontiguousarray(places.T)


def draw(ax, agents, pairs, title):
    hits = np.zeros(len(agents), bool)
    hits[pairs.ravel()] = True
    bch.plot.crowd(ax, outlines, agents, hits=hits)
    ax.set(title=title, xlim=(0, 6), ylim=(0, 6))


n = 500
figure, (before, after) = plt.subplots(1, 2, figsize=(12, 6.6), layout="constrained")
cases = [(3, least, turn) for least in (0.45, 0.35, 0) for turn in (0, 0.35)]
cases += [(4, 0.4, turn) for turn in (0, 0.35, 1.6)] + [(5, 0.35, turn) for turn in (0, 1.6)]
print("people/m2  apart   turn   pairs  left  sweeps  shift")
for density, least, turn in cases:
    random = np.random.default_rng(57)
    side = np.sqrt(n / density)
    x, y = spaced(random, n, side, least)
    heading = random.uniform(-np.pi, np.pi, n)
    agents = bch.Agents(random.integers(len(people), size=n), x, y, heading)
    crowd = bch.Crowd(period=(side, side))
    pairs = crowd.collisions(people, agents)
    found = crowd.resolve(people, agents, sweeps=300, largest_turn=turn)
    shift = np.hypot(found.x - x, found.y - y).mean()
    print(f"{density:9}  {least:3.2f} m {turn:5.2f}  {len(pairs):6} {len(found.left):5} {found.sweeps:7}  {100 * shift:4.1f} cm")
    if least == 0.45 and turn > 0:
        free = bch.Agents(agents.shape, found.x, found.y, heading + found.turn)
        draw(before, agents, pairs, f"{len(pairs)} pairs collide in space")
        draw(after, free, found.left, f"nobody does, {100 * shift:.1f} cm farther on average, some turned")
figure.savefig("no_overlaps.png", dpi=120)
