# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Agents, options, and the queries about pairs of agents and about agents and obstacles."""

from __future__ import annotations

import ctypes
import functools
import math
from typing import Any, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import (
    PENETRATION,
    Bool,
    Float32,
    Float64,
    Records,
    UInt8,
    UInt32,
    address,
    b1,
    f4,
    f8,
    given,
    result,
    u1,
    u4,
)
from ._library import ArgumentError, check, lib
from ._obstacles import Obstacles
from ._shapes import ShapeSet


class Agents:
    """A crowd as a simulation holds it: one entry an agent in each array.

    The arrays are viewed, not copied: what is written into them later is seen by the next query.

    Parameters
    ----------
    shape : (n,) uint32
        Index of each agent's shape in the set.
    x, y : (n,) float64
        Positions, metres, within 1e9 m.
    heading : (n,) float64
        Angles by which shapes are turned about their positions, radians, counter-clockwise.
    level : (n,) uint8, optional
        Index into the set's depths; by default the last level for all.
    z : (n,) float64, optional
        Heights of the grounds that agents stand on, metres; by default one ground for all.
    """

    __slots__ = ("shape", "x", "y", "heading", "level", "z", "_struct", "_pointer")

    def __init__(
        self,
        shape: UInt32,
        x: Float64,
        y: Float64,
        heading: Float64,
        level: Optional[UInt8] = None,
        z: Optional[Float64] = None,
    ) -> None:
        n = len(shape)
        self.shape, self.x, self.y, self.heading, self.level, self.z = shape, x, y, heading, level, z
        self._struct = _library.Agents(
            shape=given(shape, u4, (None,), "shape"),
            x=given(x, f8, (n,), "x"),
            y=given(y, f8, (n,), "y"),
            heading=given(heading, f8, (n,), "heading"),
            level=None if level is None else given(level, u1, (n,), "level"),
            z=None if z is None else given(z, f8, (n,), "z"),
            count=n,
        )
        self._pointer: int = ctypes.addressof(self._struct)

    def __len__(self) -> int:
        return len(self.shape)

    def __repr__(self) -> str:
        return f"<bch.Agents of {len(self)}>"


_semantics: Dict[str, int] = {"boundary": 0, "solid": 1}
_leaves: Dict[str, int] = {"discs": 0, "segments": 1}
_overlaps: Dict[str, int] = {"zero": 0, "deepest": 1}


def _one_of(words: Dict[str, int], word: str, name: str) -> int:
    if word not in words:
        raise ArgumentError(f"{name} is {word!r}; it is one of {', '.join(map(repr, words))}")
    return words[word]


@functools.lru_cache(maxsize=256)
def options(
    semantics: str = "boundary",
    leaves: str = "segments",
    overlap: str = "zero",
    max_distance: float = math.inf,
    threads: int = 0,
    implementation: Optional[str] = None,
    distance_leaves: str = "discs",
) -> Tuple[int, _library.QueryOptions]:
    """Return the address of a struct of options, and the struct."""
    if not 0 <= threads <= 1024:
        raise ArgumentError(f"threads is {threads}; it is from 0, for all processors, to 1024")
    struct = _library.QueryOptions(
        semantics=_one_of(_semantics, semantics, "semantics"),
        leaves=_one_of(_leaves, leaves, "leaves"),
        distance_leaves=_one_of(_leaves, distance_leaves, "leaves"),
        overlap=_one_of(_overlaps, overlap, "overlap"),
        threads=threads,
        max_distance=max_distance,
        implementation=None if implementation is None else implementation.encode(),
    )
    return ctypes.addressof(struct), struct


#: What queries are asked about: (n, 2) uint32 indices of agents, or obstacles.
Pairs = Union[UInt32, Obstacles]


def _asked(agents: Agents, pairs: Pairs) -> Tuple[int, int]:
    """Return the address of pairs or obstacles, and the number of answers."""
    if isinstance(pairs, Obstacles):
        return pairs._pointer, len(agents)
    return given(pairs, u4, (None, 2), "pairs"), len(pairs)


def collide(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    *,
    semantics: str = "boundary",
    leaves: str = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Bool] = None,
) -> Bool:
    """Answer whether the two agents of each pair collide, touching included.

    A collision is never missed: agents whose outlines meet collide at every level. Bodies in slabs collide where two of their
    slabs do.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
        Indices of agents; with obstacles, every agent is asked whether it collides with one.
    semantics : {"boundary", "solid"}
        "solid" also counts an agent that is wholly inside another one's outline.
    leaves : {"segments", "discs"}
        What decides at the level of all depths: segments of the outlines, or discs about them.
    threads : int
        0: all processors. The answer is the same for any number.
    implementation : str, optional
        One of `implementations()`; the answer is the same for all.
    out : (n,) bool, optional
        Where the answers go, instead of into a new array.

    Returns
    -------
    (n,) bool
    """
    where, n = _asked(agents, pairs)
    hits = result(out, b1, (n,))
    how, _ = options(semantics, leaves, "zero", math.inf, threads, implementation)
    if isinstance(pairs, Obstacles):
        check(lib.bch_obstacles_collide(shapes._pointer, agents._pointer, where, how, address(hits)))
    else:
        check(lib.bch_collide(shapes._pointer, agents._pointer, where, n, how, address(hits)))
    return hits


def within(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    distance: Union[float, Float64],
    *,
    semantics: str = "boundary",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Bool] = None,
) -> Bool:
    """Answer whether the two agents of each pair come as close as a distance, in about the time of `collide`.

    Distances are those of the discs at the agents' levels, so never larger than the outlines'.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
    distance : float, or (n,) float64
        Metres; one for all, or one each.
    semantics, threads, implementation, out
        As for `collide`.

    Returns
    -------
    (n,) bool
    """
    where, n = _asked(agents, pairs)
    answers = result(out, b1, (n,))
    how, _ = options(semantics, "segments", "zero", math.inf, threads, implementation)
    near = np.array([distance], f8) if isinstance(distance, (int, float)) else distance
    at = given(near, f8, (len(near),), "distance")
    if isinstance(pairs, Obstacles):
        status = lib.bch_obstacles_within(shapes._pointer, agents._pointer, where, at, len(near), how, address(answers))
    else:
        status = lib.bch_within(shapes._pointer, agents._pointer, where, n, at, len(near), how, address(answers))
    check(status)
    return answers


class Nearest(NamedTuple):
    """What `nearest` tells of each pair."""

    distance: Float32  #: (n,), metres; infinite beyond the largest distance
    direction: Float32  #: (n, 2), unit vectors from the first agent to the second
    discs: UInt32  #: (n, 2), the nearest discs of each; with obstacles, a disc and a segment; 0xffffffff: none
    points: Float32  #: (n, 2, 2), the nearest points of each, from its own agent's position


def _measure(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    how: int,
    distance: Float32,
    direction: Optional[Float32] = None,
    discs: Optional[UInt32] = None,
    points: Optional[Float32] = None,
) -> None:
    where, n = _asked(agents, pairs)
    to = _library.ClearanceOut(
        distance=address(distance),
        direction=None if direction is None else address(direction),
        discs=None if discs is None else address(discs),
        points=None if points is None else address(points),
    )
    at = ctypes.addressof(to)
    if isinstance(pairs, Obstacles):
        check(lib.bch_obstacles_clearance(shapes._pointer, agents._pointer, where, how, at))
    else:
        check(lib.bch_clearance(shapes._pointer, agents._pointer, where, n, how, at))


def clearance(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    *,
    max_distance: float = math.inf,
    leaves: str = "discs",
    overlap: str = "zero",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Float32] = None,
) -> Float32:
    """Measure how far apart the two agents of each pair are.

    The distance is never larger than that of the outlines, and 0 where they overlap.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
    max_distance : float
        Metres. Pairs farther apart get infinity; the smaller the limit, the faster.
    leaves : {"discs", "segments"}
        "discs": up to 3 cm less than the outlines' distance. "segments": the outlines' distance itself, in about seven
        times the time.
    overlap : {"zero", "deepest"}
        "deepest": where discs overlap, the deepest overlap of two, below 0.
    threads, implementation
        As for `collide`.
    out : (n,) float32, optional

    Returns
    -------
    (n,) float32
        Metres.
    """
    n = len(agents) if isinstance(pairs, Obstacles) else len(pairs)
    distance = result(out, f4, (n,))
    how, _ = options("boundary", "segments", overlap, max_distance, threads, implementation, leaves)
    _measure(shapes, agents, pairs, how, distance)
    return distance


def nearest(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    *,
    max_distance: float = math.inf,
    leaves: str = "discs",
    overlap: str = "zero",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Nearest] = None,
) -> Nearest:
    """Find the nearest points of the two agents of each pair: distances as `clearance` measures them, and where they are.

    Parameters
    ----------
    shapes, agents, pairs, max_distance, leaves, overlap, threads, implementation
        As for `clearance`.
    out : Nearest, optional
        Arrays of the types and shapes that a result has.

    Returns
    -------
    Nearest
        Directions and points are 0, and discs 0xffffffff, where there are none: beyond `max_distance`, and where agents
        overlap unless `overlap` is "deepest".
    """
    n = len(agents) if isinstance(pairs, Obstacles) else len(pairs)
    found = Nearest(
        result(None if out is None else out.distance, f4, (n,), "out.distance"),
        result(None if out is None else out.direction, f4, (n, 2), "out.direction"),
        result(None if out is None else out.discs, u4, (n, 2), "out.discs"),
        result(None if out is None else out.points, f4, (n, 2, 2), "out.points"),
    )
    how, _ = options("boundary", "segments", overlap, max_distance, threads, implementation, leaves)
    _measure(shapes, agents, pairs, how, *found)
    return found


def penetration(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    directions: Union[int, Float32] = 16,
    *,
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Records] = None,
) -> Records:
    """Measure how far the first agent of each pair has to move to be free of the second, and in which direction.

    Ask about pairs that collide: the depth may be positive where nothing overlaps yet and one reaches around the other.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
        With obstacles, how far each agent has to move to leave the one that it is deepest in.
    directions : int, or (n, 2) float32
        The number of evenly spread directions of which the best counts, even, from 2 to 256; or a direction for each
        pair. Not for obstacles.
    threads, implementation
        As for `collide`.
    out : (n,) PENETRATION, optional

    Returns
    -------
    (n,) PENETRATION
        Records of depth, x and y: metres, and a unit vector.
    """
    where, n = _asked(agents, pairs)
    depths = result(out, PENETRATION, (n,))
    how, _ = options("boundary", "segments", "zero", math.inf, threads, implementation)
    to = address(depths)
    if isinstance(pairs, Obstacles):
        check(lib.bch_obstacles_penetration(shapes._pointer, agents._pointer, where, how, to))
    elif isinstance(directions, int):
        if not 0 <= directions <= 256:
            raise ArgumentError(f"directions is {directions}; it is even, from 2 to 256")
        check(lib.bch_penetration(shapes._pointer, agents._pointer, where, n, directions, how, to))
    else:
        along = given(directions, f4, (n, 2), "directions")
        check(lib.bch_penetration_along(shapes._pointer, agents._pointer, where, n, along, how, to))
    return depths


def time_of_impact(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Pairs,
    x: Float64,
    y: Float64,
    *,
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Float32] = None,
) -> Float32:
    """Find when the two agents of each pair first touch while they move without turning.

    The time is never later than the outlines' first contact.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
    x, y : (n,) float64
        The way of the first agent of each pair relative to the second, or of each agent among obstacles, metres.
    threads, implementation
        As for `collide`.
    out : (n,) float32, optional

    Returns
    -------
    (n,) float32
        The share of the way, from 0 to 1, after which they touch; infinity where they do not.
    """
    where, n = _asked(agents, pairs)
    times = result(out, f4, (n,))
    how, _ = options("boundary", "segments", "zero", math.inf, threads, implementation)
    to_x, to_y = given(x, f8, (n,), "x"), given(y, f8, (n,), "y")
    if isinstance(pairs, Obstacles):
        check(lib.bch_obstacles_time_of_impact(shapes._pointer, agents._pointer, to_x, to_y, where, how, address(times)))
    else:
        check(lib.bch_time_of_impact(shapes._pointer, agents._pointer, where, n, to_x, to_y, how, address(times)))
    return times


def local_densities(x: Float64, y: Float64, radius: float = 2.0) -> Float64:
    """Measure how dense a crowd is around each agent: the people within a radius, himself among them, over its circle's area.

    Parameters
    ----------
    x, y : (n,) float64
        Positions, metres.
    radius : float
        Metres.

    Returns
    -------
    (n,) float64
        People per square metre.
    """
    n = len(x)
    densities = np.empty(n, f8)
    check(lib.bch_local_densities(given(x, f8, (n,), "x"), given(y, f8, (n,), "y"), n, radius, address(densities)))
    return densities
