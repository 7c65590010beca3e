# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""From a character file of your own to a baked set. Usage: own_character.py FILE. Writes own_character.bch and own_character.png."""

import sys

import bch
import matplotlib.pyplot as plt
import numpy as np

character = bch.import_character(sys.argv[1])
print(f"{character.name}: {character.triangles} triangles, {character.height:.2f} m, {len(character.clips)} clips")
for note in character.notes:
    print(f"  {note}")

baked = bch.bake(character, poses=12, path="own_character.bch", progress=True)
shapes = bch.ShapeSet.load("own_character.bch")  # loads at once, also in another program
assert len(shapes) == len(baked)

column, row = np.divmod(np.arange(len(shapes)), 3)
crowd = bch.Agents(np.arange(len(shapes), dtype=np.uint32), 1.5 * column, 1.5 * row, np.zeros(len(shapes)))
figure, ax = plt.subplots(figsize=(7, 6), layout="constrained")
bch.plot.crowd(ax, shapes, crowd, discs=-1)
ax.set_title(f"{character.name}: {len(shapes)} poses of {shapes.nbytes / len(shapes) / 1000:.0f} kB")
figure.savefig("own_character.png", dpi=120)
