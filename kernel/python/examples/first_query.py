# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""First query: a crowd, the people in it who collide, and a picture of them. Writes first_query.png."""

import bch
import matplotlib.pyplot as plt
import numpy as np

people = bch.bake(
    [bch.default_male(), bch.default_female()], poses=50, plan=bch.Plan(depths=(3, bch.ALL_DEPTHS))
)

n = 40
random = np.random.default_rng(2014)
agents = bch.Agents(
    shape=random.integers(len(people), size=n),
    x=random.uniform(0, 5, n),
    y=random.uniform(0, 4, n),
    heading=random.uniform(-np.pi, np.pi, n),
)

crowd = bch.Crowd()
may = crowd.candidates(people, agents)
colliding = crowd.collisions(people, agents)
print(f"{len(may)} pairs of {n} people may collide, {len(colliding)} do")

figure, ax = plt.subplots(figsize=(7, 6), layout="constrained")
bch.plot.crowd(ax, people, agents, discs=0)
ax.set_title(f"{len(colliding)} collisions, and the discs at depth 3")
figure.savefig("first_query.png", dpi=120)
