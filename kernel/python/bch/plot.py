# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Pictures of crowds, drawn with matplotlib, which has to be installed."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import Bool, Float64
from ._crowds import Crowd
from ._queries import Agents, pointers
from ._shapes import ShapeSet

_FREE, _HIT, _DISC = "#4c78a8", "#e45756", "#9aa5b1"


def _placed(points: Any, agents: Agents, i: int) -> Float64:
    heading = agents.heading[i]
    c, s = heading if np.ndim(heading) == 1 else (np.cos(heading), np.sin(heading))
    turned: Float64 = np.asarray(points, np.float64) @ np.array([[c, s], [-s, c]])
    turned += (agents.x[i], agents.y[i])
    return turned


def crowd(
    ax: Any,
    shapes: ShapeSet,
    agents: Agents,
    *,
    hits: Optional[Bool] = None,
    discs: Optional[int] = None,
    numbers: bool = False,
) -> None:
    """Draw agents seen from above: outlines, filled red for agents that collide and blue for the others.

    Parameters
    ----------
    ax : matplotlib axes
    shapes : ShapeSet
        Shapes with outlines; a shape without one is drawn as its discs.
    agents : Agents
    hits : (agents,) bool, optional
        The agents to draw in red; by default all that collide with another one.
    discs : int, optional
        Level whose discs are drawn, too, an index into `ShapeSet.depths`.
    numbers : bool
        Write each agent's index at its position.
    """
    from matplotlib.collections import EllipseCollection, PatchCollection
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    pointers(shapes, agents)  # are these
    if hits is None:
        hits = np.zeros(len(agents), bool)
        hits[Crowd().collisions(shapes, agents).ravel()] = True
    patches, colours, circles = [], [], []
    for i in range(len(agents)):
        shape = int(agents.shape[i])
        contours = [_placed(contour, agents, i) for contour in shapes.outline(shape)]
        if contours:
            paths = [Path(np.vstack([each, each[:1]]), closed=True) for each in contours]
            patches.append(PathPatch(Path.make_compound_path(*paths)))
            colours.append(_HIT if hits[i] else _FREE)
        if discs is not None or not contours:
            each = shapes.discs(shape, -1 if discs is None else discs)
            centres = _placed(np.stack([each["x"], each["y"]], axis=1), agents, i)
            circles += [(*centre, radius) for centre, radius in zip(centres, each["radius"])]
    ax.add_collection(PatchCollection(patches, facecolors=colours, edgecolors="#1f2933", linewidths=0.5, alpha=0.8))
    if circles:
        x, y, radius = np.array(circles).T
        ax.add_collection(
            EllipseCollection(
                2 * radius,
                2 * radius,
                np.zeros(len(radius)),
                units="xy",
                offsets=np.stack([x, y], axis=1),
                transOffset=ax.transData,
                facecolors="none",
                edgecolors=_DISC,
                linewidths=0.5,
            )
        )
    if numbers:
        for i in range(len(agents)):
            ax.text(agents.x[i], agents.y[i], str(i), ha="center", va="center", fontsize=7)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")
