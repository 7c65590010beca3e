# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Agents, options, and the queries about pairs of agents and about agents and obstacles."""

from __future__ import annotations

import ctypes
import functools
import math
from typing import Any, Callable, Dict, List, Literal, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import (
    PENETRATION,
    TOUCH,
    Bool,
    Float32,
    Float64,
    Records,
    UInt8,
    UInt32,
    address,
    b1,
    bounded,
    f4,
    f8,
    given,
    indices,
    instance,
    number,
    numbers,
    one_of,
    rejected,
    result,
    u1,
    u4,
)
from ._bodies import BodySet
from ._library import ArgumentError, ArrayError, check, lib
from ._obstacles import Obstacles
from ._shapes import ShapeSet


class Agents:
    """The agents of a crowd: one entry per agent in each array.

    Arrays of the types below are viewed, not copied, also fields of structured arrays: after `agents.x[:] += dx` the next query
    sees the new values. Numbers of other types, and lists, are copied.

    Parameters
    ----------
    shape : (n,) uint32, or other integers
        Index of each agent's shape in the set.
    x, y : (n,) float64 or float32; x, y, heading and z have the same dtype
        Positions, metres, within 1e9 m.
    heading : (n,) or (n, 2) float64, or float32
        Angles by which shapes are turned about their positions, radians, counter-clockwise. At 0 the built-in characters face
        +x, and characters from files stand as in the file. Or (n, 2) unit vectors (cos, sin): where an agent's +x points; their
        length is 1 within 1e-3.
    level : (n,) uint8, or other integers, optional
        Index into the set's depths; by default every agent uses the last level.
    z : (n,) float64, or float32, optional
        Height of the ground under each agent, metres; by default the same for all.
    """

    __slots__ = ("_arrays", "_struct", "_pointer")

    def __init__(
        self,
        shape: npt.ArrayLike,
        x: npt.ArrayLike,
        y: npt.ArrayLike,
        heading: npt.ArrayLike,
        level: Optional[npt.ArrayLike] = None,
        z: Optional[npt.ArrayLike] = None,
    ) -> None:
        shapes = indices(shape, u4, (None,), "shape")
        n = len(shapes)
        directions = np.ndim(heading) == 2
        given_numbers = {"x": x, "y": y, "heading": heading, **({} if z is None else {"z": z})}
        columns: Dict[str, npt.NDArray[Any]] = numbers(given_numbers, {name: (n, 2) if directions and name == "heading" else (n,) for name in given_numbers})
        levels = None if level is None else indices(level, u1, (n,), "level")
        self._arrays = (shapes, columns["x"], columns["y"], columns["heading"], levels, columns.get("z"))
        columns["shape"] = shapes
        if levels is not None:
            columns["level"] = levels
        if directions:
            columns["heading"], columns["heading_y"] = columns["heading"].T
        self._struct = _library.Agents(count=n, numbers=int(columns["x"].dtype == f4))
        for name, column in columns.items():
            setattr(self._struct, name, address(column) if n > 0 else None)
            setattr(self._struct, f"{name}_stride", 0 if column.flags.c_contiguous else column.strides[0])
        self._pointer: int = ctypes.addressof(self._struct)

    # The arrays themselves: write into them to move people.

    @property
    def shape(self) -> UInt32:
        """Index of each agent's shape in the set, (n,) uint32, as it is viewed."""
        return self._arrays[0]

    @property
    def x(self) -> Float64:
        """Positions, (n,) float64, metres."""
        return self._arrays[1]

    @property
    def y(self) -> Float64:
        """Positions, (n,) float64, metres."""
        return self._arrays[2]

    @property
    def heading(self) -> Float64:
        """Angles by which shapes are turned, (n,) float64, radians, counter-clockwise, or directions, (n, 2) float64."""
        return self._arrays[3]

    @property
    def level(self) -> Optional[UInt8]:
        """Index into the set's depths, (n,) uint8, or None."""
        return self._arrays[4]

    @property
    def z(self) -> Optional[Float64]:
        """Heights of the grounds that agents stand on, (n,) float64, metres, or None."""
        return self._arrays[5]

    def __len__(self) -> int:
        return len(self._arrays[0])

    def __reduce__(self) -> Tuple[Any, ...]:
        return Agents, self._arrays

    def __repr__(self) -> str:
        return f"<bch.Agents of {len(self)}>"


Leaves = Literal["discs", "segments"]
Overlap = Literal["zero", "deepest"]
LEAVES: Dict[str, int] = {"discs": 0, "segments": 1}
_overlaps: Dict[str, int] = {"zero": 0, "deepest": 1}


def options(
    leaves: Leaves = "segments",
    overlap: Overlap = "zero",
    max_distance: float = math.inf,
    threads: int = 0,
    implementation: Optional[str] = None,
    distance_leaves: Leaves = "discs",
) -> Tuple[int, _library.QueryOptions]:
    """Return the address of a struct of options, and the struct."""
    if not (implementation is None or isinstance(implementation, str)):
        raise rejected(implementation, "implementation", "one of bch.implementations()")
    return _options(
        one_of(LEAVES, leaves, "leaves"),
        one_of(_overlaps, overlap, "overlap"),
        number(max_distance, "max_distance"),
        bounded(threads, "threads", 0, 1024),
        implementation,
        one_of(LEAVES, distance_leaves, "leaves"),
    )


@functools.lru_cache(maxsize=256)
def _options(
    leaves: int,
    overlap: int,
    max_distance: float,
    threads: int,
    implementation: Optional[str],
    distance_leaves: int,
) -> Tuple[int, _library.QueryOptions]:
    struct = _library.QueryOptions(
        leaves=leaves,
        distance_leaves=distance_leaves,
        overlap=overlap,
        threads=threads,
        max_distance=max_distance,
        implementation=None if implementation is None else implementation.encode(),
    )
    return ctypes.addressof(struct), struct


#: What a query is about: (n, 2) uint32 indices of agents, or obstacles.
Pairs = Union[UInt32, Obstacles]


def pointers(shapes: Union[ShapeSet, BodySet], agents: Agents, bodies: bool = False) -> Tuple[int, int]:
    """Return the addresses of a set, of bodies or of shapes, and of agents, or raise an error if an argument is something else."""
    if not isinstance(shapes, BodySet if bodies else ShapeSet):
        hint = "; ask about its .shapes" if hasattr(shapes, "shapes") else ""
        raise ArrayError(f"shapes is a {type(shapes).__name__}; expected a bch.ShapeSet{hint}")
    if not isinstance(agents, Agents):
        raise rejected(agents, "agents", "a bch.Agents")
    return shapes._pointer, agents._pointer


#: What cannot be asked about bodies and obstacles.
_of_pairs_alone = ("nearest_free", "penetration", "penetration_along", "time_of_impact")


def _bound_query(
    name: str, shapes: Union[ShapeSet, BodySet], agents: Agents, pairs: Pairs, of_bodies: str = "_bodies"
) -> Tuple[Callable[..., int], int]:
    """Return the function of a query, bound to what it is about, and the number of its answers."""
    bodies = isinstance(shapes, BodySet)
    set_at, agents_at = pointers(shapes, agents, bodies)
    if isinstance(pairs, Obstacles) and not (bodies and name in _of_pairs_alone):
        function = getattr(lib, f"bch_obstacles_{name}{'_bodies' * bodies}")
        return functools.partial(function, set_at, agents_at, pairs._pointer), len(agents)
    where = given(pairs, u4, (None, 2), "pairs")
    return functools.partial(getattr(lib, f"bch_{name}{of_bodies * bodies}"), set_at, agents_at, where, len(pairs)), len(pairs)


def collide(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Bool] = None,
) -> Bool:
    """Test whether the two agents of each pair collide; touching counts.

    A collision is never missed: agents collide at every level if their outlines overlap, even if one is wholly inside the
    other.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
        Bodies collide if they have a point in common in space.
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
        Indices of agents; with obstacles, every agent is tested against all of them.
    leaves : {"segments", "discs"}
        What decides at depth ALL_DEPTHS: segments of the outlines, or discs that cover them. No effect for bodies.
    threads : int
        Number of threads; 0: all processors. The answer is the same for any number.
    implementation : str, optional
        One of `implementations()`. The answer is the same for all.
    out : (n,) bool, optional
        Array for the answers, instead of a new one.

    Returns
    -------
    (n,) bool
    """
    how, _ = options(leaves, "zero", math.inf, threads, implementation)
    call, n = _bound_query("collide", shapes, agents, pairs)
    hits = result(out, b1, (n,))
    check(call(how, address(hits)))
    return hits


def within(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    distance: Union[float, Float64],
    *,
    leaves: Leaves = "discs",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Bool] = None,
) -> Bool:
    """Test whether the two agents of each pair come within a distance of each other, in about the time of `collide`.

    Distances are measured between the discs at the agents' levels, so they are never larger than the distances of the outlines.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
        Bodies are measured in space.
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
    distance : float, or (n,) float64
        Metres; one for all pairs, or one for each.
    leaves : {"discs", "segments"}
        For obstacles, as for `clearance`. Distances between agents are always those of discs.
    threads, implementation, out
        As for `collide`.

    Returns
    -------
    (n,) bool
    """
    call, n = _bound_query("within", shapes, agents, pairs)
    if leaves != "discs" and not isinstance(pairs, Obstacles):
        raise ArgumentError("leaves are for obstacles; pairs are measured between discs")
    answers = result(out, b1, (n,))
    how, _ = options("segments", "zero", math.inf, threads, implementation, leaves)
    near: Any = distance
    if not isinstance(distance, (np.ndarray, list, tuple)):
        near = np.array([number(distance, "distance")], f8)
    at = given(near, f8, (None,), "distance")
    check(call(at, len(near), how, address(answers)))
    return answers


class Nearest(NamedTuple):
    """The result of `nearest`, with one entry per pair."""

    distance: Float32  #: (n,), metres; infinite beyond the largest distance
    direction: Float32  #: (n, 2), unit vectors from the first agent to the second; of bodies (n, 3)
    discs: UInt32  #: (n, 2), the nearest disc, or sphere, of each agent; with obstacles, a disc and a segment; 0xffffffff: none
    points: Float32  #: (n, 2, 2), the nearest point of each agent, relative to its position, in the world's axes, metres; of bodies (n, 2, 3)


def _measure(
    call: Callable[..., int],
    bodies: bool,
    how: int,
    distance: Float32,
    direction: Optional[Float32] = None,
    discs: Optional[UInt32] = None,
    points: Optional[Float32] = None,
) -> None:
    to = (_library.BodyClearanceOut if bodies else _library.ClearanceOut)(distance=address(distance))
    for name, array in {"direction": direction, "spheres" if bodies else "discs": discs, "points": points}.items():
        setattr(to, name, None if array is None else address(array))
    check(call(how, ctypes.addressof(to)))


def clearance(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    *,
    max_distance: float = math.inf,
    leaves: Leaves = "discs",
    overlap: Overlap = "zero",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Float32] = None,
) -> Float32:
    """Measure how far apart the two agents of each pair are.

    The distance is never larger than that of the outlines, and 0 if they overlap. By default it is measured between discs,
    which are larger than the outlines, so agents at distance 0 need not collide.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
        Bodies are measured in space, from sphere to sphere.
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
    max_distance : float
        Metres. The result is infinite for pairs farther apart. Smaller limits are faster.
    leaves : {"discs", "segments"}
        With "discs", the distance is up to 3 cm less than that of the outlines. With "segments", it is that of the outlines
        themselves, in about seven times the time, for shapes that have outlines, at depth ALL_DEPTHS.
    overlap : {"zero", "deepest"}
        The distance where discs overlap: 0, or with "deepest" the deepest overlap of two discs, as a negative number.
    threads, implementation
        As for `collide`.
    out : (n,) float32, optional

    Returns
    -------
    (n,) float32
        Metres.
    """
    call, n = _bound_query("clearance", shapes, agents, pairs)
    distance = result(out, f4, (n,))
    how, _ = options("segments", overlap, max_distance, threads, implementation, leaves)
    _measure(call, isinstance(shapes, BodySet), how, distance)
    return distance


def nearest(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    *,
    max_distance: float = math.inf,
    leaves: Leaves = "discs",
    overlap: Overlap = "zero",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Nearest] = None,
) -> Nearest:
    """Find the nearest points of the two agents of each pair, and their distance as `clearance` measures it.

    Parameters
    ----------
    shapes, agents, pairs, max_distance, leaves, overlap, threads, implementation
        As for `clearance`.
    out : Nearest, optional
        Arrays of the dtypes and shapes of a result, instead of new ones.

    Returns
    -------
    Nearest
        Where there are no nearest points, directions and points are 0 and discs 0xffffffff: beyond `max_distance`, and where
        agents overlap unless `overlap` is "deepest".
    """
    bodies = isinstance(shapes, BodySet)
    call, n = _bound_query("clearance", shapes, agents, pairs)
    axes = 3 if bodies else 2
    if out is not None:
        instance(out, Nearest, "out")
    found = Nearest(
        result(None if out is None else out.distance, f4, (n,), "out.distance"),
        result(None if out is None else out.direction, f4, (n, axes), "out.direction"),
        result(None if out is None else out.discs, u4, (n, 2), "out.discs"),
        result(None if out is None else out.points, f4, (n, 2, axes), "out.points"),
    )
    how, _ = options("segments", overlap, max_distance, threads, implementation, leaves)
    _measure(call, bodies, how, *found)
    return found


def penetration(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    directions: Union[int, Float32] = 16,
    *,
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Records] = None,
) -> Records:
    """Measure how far the first agent of each pair has to move until a straight line separates the discs of the two, and in
    which direction.

    Use it for pairs that collide. The depth may be positive although nothing overlaps, if one agent reaches around the other.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
        Bodies move on the ground, until a line separates them as seen from above.
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles
        With obstacles (ShapeSet only), the shortest move out of each single obstacle is found; the depth is the longest of
        these moves.
    directions : int, or (n, 2) float32
        The number of evenly spread directions to try, an even number from 2 to 256, of which the best one counts; or one
        direction per pair. Not for obstacles.
    threads, implementation
        As for `collide`.
    out : (n,) PENETRATION, optional

    Returns
    -------
    (n,) PENETRATION
        Records of depth, in metres, and of x and y, a unit vector.
    """
    is_along = isinstance(directions, np.ndarray)
    call, n = _bound_query("penetration_along" if is_along and not isinstance(pairs, Obstacles) else "penetration", shapes, agents, pairs)
    depths = result(out, PENETRATION, (n,))
    how, _ = options("segments", "zero", math.inf, threads, implementation)
    if not isinstance(pairs, Obstacles):
        to = given(directions, f4, (n, 2), "directions") if is_along else bounded(directions, "directions", 2, 256)
        check(call(to, how, address(depths)))
    elif is_along or directions != 16:
        raise ArgumentError("directions are for pairs; obstacles have directions of their own")
    else:
        check(call(how, address(depths)))
    return depths


def nearest_free(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    directions: int = 16,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Records] = None,
    touches: Optional[Records] = None,
) -> Records:
    """Measure how far the first agent of each pair has to move on the ground to separate from the second.

    The move is the shortest along `directions` evenly spread directions. The depth is 0 if the two do not collide, and at most
    that of `penetration`, because the agents may remain interlocked.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
    agents : Agents
    pairs : (n, 2) uint32
    directions : int
        The number of evenly spread directions to try, an even number from 2 to 256.
    leaves, threads, implementation
        As for `collide`.
    out : (n,) PENETRATION, optional
    touches : (n,) TOUCH, optional
        An array to write to where the two touch after the move, and the normal there: `np.empty(len(pairs), bch.TOUCH)`.

    Returns
    -------
    (n,) PENETRATION
        Records of depth, in metres, and of x and y, a unit vector.
    """
    if isinstance(pairs, Obstacles):
        raise rejected(pairs, "pairs", "an array of pairs")
    call, n = _bound_query("nearest_free", shapes, agents, pairs, "_bodies_touches")
    depths = result(out, PENETRATION, (n,))
    ends = None if touches is None else address(result(touches, TOUCH, (n,), "touches"))
    how, _ = options(leaves, "zero", math.inf, threads, implementation)
    check(call(bounded(directions, "directions", 2, 256), how, address(depths), ends))
    return depths


def nearest_free_of_all(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: UInt32,
    obstacles: Optional[Obstacles] = None,
    directions: int = 16,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Records] = None,
    touches: Optional[Records] = None,
) -> Records:
    """Measure how far each agent has to move on the ground, alone, until it is free of its neighbours and of obstacles at once.

    Afterwards `collide` with each of them is False, if nobody else moves. The depth is 0 for agents that collide with none of them.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
    agents : Agents
    pairs : (n, 2) uint32
        Pairs of an agent and a neighbour that may be in its way, in any order: list a pair both ways if either may move.
    obstacles : Obstacles, optional
    directions, leaves, threads, implementation
        As for `nearest_free`.
    out : (agents,) PENETRATION, optional
    touches : (agents,) TOUCH, optional
        As for `nearest_free`.

    Returns
    -------
    (agents,) PENETRATION
        Records of depth, in metres, and of x and y, the unit vector along which the agent moves.
    """
    set_at, agents_at = pointers(shapes, agents, isinstance(shapes, BodySet))
    function = lib.bch_nearest_free_of_all_bodies if isinstance(shapes, BodySet) else lib.bch_nearest_free_of_all
    depths = result(out, PENETRATION, (len(agents),))
    ends = None if touches is None else address(result(touches, TOUCH, (len(agents),), "touches"))
    walls = None if obstacles is None else obstacles._pointer
    how, _ = options(leaves, "zero", math.inf, threads, implementation)
    where, of = given(pairs, u4, (None, 2), "pairs"), bounded(directions, "directions", 2, 256)
    check(function(set_at, agents_at, where, len(pairs), walls, of, how, address(depths), ends))
    return depths


def time_of_impact(
    shapes: Union[ShapeSet, BodySet],
    agents: Agents,
    pairs: Pairs,
    dx: Float64,
    dy: Float64,
    *,
    dz: Optional[Float64] = None,
    threads: int = 0,
    implementation: Optional[str] = None,
    out: Optional[Float32] = None,
) -> Float32:
    """Find when discs (of bodies: spheres) of the two agents of each pair first touch while they move without turning.

    The time is never later than the first contact of the outlines. It is 0 if the agents already collide, even if one is inside
    the other.

    Parameters
    ----------
    shapes : ShapeSet or BodySet
        Bodies touch in space.
    agents : Agents
    pairs : (n, 2) uint32, or Obstacles (ShapeSet only)
    dx, dy : (n,) float64
        The displacement of the first agent of each pair relative to the second, or of each agent among obstacles, metres.
    dz : (n,) float64, optional
        The same upward (BodySet only); by default 0.
    threads, implementation
        As for `collide`.
    out : (n,) float32, optional

    Returns
    -------
    (n,) float32
        The fraction of the displacement, from 0 to 1, after which they touch; infinity where they do not touch.
    """
    bodies = isinstance(shapes, BodySet)
    if dz is not None and not bodies:
        raise ArrayError("dz is given; expected a bch.BodySet for shapes, or no dz: outlines do not move up or down")
    call, n = _bound_query("time_of_impact", shapes, agents, pairs)
    times = result(out, f4, (n,))
    how, _ = options("segments", "zero", math.inf, threads, implementation)
    way: List[Optional[int]] = [given(dx, f8, (n,), "dx"), given(dy, f8, (n,), "dy")]
    if bodies:
        way.append(None if dz is None else given(dz, f8, (n,), "dz"))
    check(call(*way, how, address(times)))
    return times


def local_densities(x: Float64, y: Float64, radius: float = 2.0) -> Float64:
    """Measure the density around each agent: the number of people within a radius, itself included, over the area of that circle.

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
    at_x, n = given(x, f8, (None,), "x"), len(x)
    densities = np.empty(n, f8)
    within_radius = number(radius, "radius")
    check(lib.bch_local_densities(at_x, given(y, f8, (n,), "y"), n, within_radius, address(densities)))
    return densities
