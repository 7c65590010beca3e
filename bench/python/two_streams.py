# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""A simulated recording for the picture of the page: two streams of discs, pushed by social forces, meet in a corridor whose ends are joined.

Writes two_streams.csv and two_streams.wkt, its walls.
"""

import pathlib

import numpy as np

PEOPLE, SECONDS, FPS, STEPS = 60, 20, 25, 2  # STEPS of the simulation a frame
LENGTH, WIDTH = 20.0, 4.0  # metres

random = np.random.default_rng(5)
along = np.where(np.arange(PEOPLE) % 2 == 0, 1.0, -1.0)
wanted = np.stack([along * random.uniform(1.0, 1.4, PEOPLE), np.zeros(PEOPLE)], axis=1)
at = np.stack([-along * random.uniform(1.5, 9, PEOPLE), random.uniform(-1.6, 1.6, PEOPLE)], axis=1)
velocity = wanted.copy()
step = 1 / FPS / STEPS

rows = []
for frame in range(SECONDS * FPS):
    for _ in range(STEPS):
        between = at[:, None] - at[None]
        between[:, :, 0] -= LENGTH * np.round(between[:, :, 0] / LENGTH)
        distance = np.linalg.norm(between, axis=2) + LENGTH * np.eye(PEOPLE)
        push = np.minimum(40, 6 * np.exp((0.4 - distance) / 0.12) / distance)
        force = (wanted - velocity) / 0.5 + (push[:, :, None] * between).sum(axis=1)
        force[:, 1] -= 16 * np.sinh(at[:, 1] / 0.1) * np.exp((0.25 - WIDTH / 2) / 0.1)
        velocity += step * force
        velocity *= np.minimum(1, 1.8 / np.linalg.norm(velocity, axis=1))[:, None]
        at += step * velocity
        at[:, 0] -= LENGTH * np.round(at[:, 0] / LENGTH)
    rows += [(person, frame, x, y) for person, (x, y) in enumerate(at)]

np.savetxt("two_streams.csv", rows[2 * FPS * PEOPLE :], fmt=["%d", "%d", "%.3f", "%.3f"], delimiter=",", header="id,frame,x,y", comments="")
sides = [f"LINESTRING ({-LENGTH / 2} {y}, {LENGTH / 2} {y})" for y in (-WIDTH / 2, WIDTH / 2)]
pathlib.Path("two_streams.wkt").write_text(" ".join(sides))
