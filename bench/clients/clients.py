# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Puts bodies behind two simulators of discs. People on a circle walk to its other side."""

import time

import bch
import numpy as np
from simulators import steer_by_orca, steer_by_social_forces

COUNT, CIRCLE, STEP, FRAMES, RADIUS = 60, 5.5, 0.05, 240, 0.2  # people, metres, s, frames, metres

pedestrians = [bch.default_pedestrian("female", 1.66), bch.default_pedestrian("male", 1.79)]
number = np.arange(COUNT)
sex = number % 2
strides = np.array([[clip.seconds for clip in pedestrian.clips] for pedestrian in pedestrians])  # by speed


def run(name, steer, coupling):
    turn = 2 * np.pi * number / COUNT
    at = (CIRCLE + 0.1 * (number % 7))[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1)
    goal, velocity, radius = -at, np.zeros((COUNT, 2)), np.full(COUNT, RADIUS)
    live = bch.LiveBodies([bch.default_body(pedestrian) for pedestrian in pedestrians], sex.astype(np.uint32))
    crowd, heading, stride, overlaps = bch.Crowd(), np.zeros(COUNT), 0.618 * number % 1, 0
    times = np.zeros(3)
    for _ in range(FRAMES):
        marks = [time.perf_counter()]
        velocity = steer(at, velocity, goal, radius, STEP)
        at = at + STEP * velocity
        marks.append(time.perf_counter())
        # Each in the stride that belongs to its speed.
        speed = np.linalg.norm(velocity, axis=1)
        clip = np.rint(speed / 0.03).astype(int)
        stride = (stride + STEP / strides[sex, clip]) % 1
        heading = np.where(speed > 0.15, np.arctan2(velocity[:, 1], velocity[:, 0]), heading)
        live.pose(list(zip(clip, stride * strides[sex, clip])))
        marks.append(time.perf_counter())
        agents = bch.Agents(number.astype(np.uint32), *at.T.copy(), heading)
        if coupling == "bodies moved apart":
            found = crowd.resolve(live.bodies, agents)
            at, overlaps = np.stack([found.x, found.y], 1), overlaps + len(found.left)
        else:
            overlaps += len(crowd.collisions(live.bodies, agents))
        if coupling == "radii from clearances":
            crowd.clearances(live.bodies, agents, 0.7, overlap="deepest")
            radius = crowd.disc_radii(agents, RADIUS)
        marks.append(time.perf_counter())
        times += np.diff(marks)
    towards = (np.linalg.norm(2 * goal, axis=1) - np.linalg.norm(goal - at, axis=1)).mean() / (FRAMES * STEP)
    simulator, poses, bodies = 1000 / FRAMES * times
    print(
        f"{name}, {coupling}: {overlaps} overlaps in {FRAMES} frames, {towards:.2f} m/s towards the goals; "
        f"ms a frame: simulator {simulator:.2f}, poses {poses:.2f}, bodies {bodies:.2f}"
    )


for coupling in ("discs alone", "radii from clearances", "bodies moved apart"):
    run("orca", steer_by_orca, coupling)
    run("social forces", steer_by_social_forces, coupling)
