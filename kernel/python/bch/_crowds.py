# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Queries about whole crowds: candidates, collisions, contacts, clearances, penetrations."""

from __future__ import annotations

import ctypes
import math
from ctypes import byref
from typing import Any, Iterator, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _library
from ._arrays import (
    PENETRATION,
    SPHERE_CONTACT,
    Float32,
    Float64,
    Records,
    UInt32,
    UInt64,
    bounded,
    copied,
    f4,
    f8,
    given,
    index,
    instance,
    number,
    rejected,
    u4,
    u8,
)
from ._bodies import BodySet
from ._library import ArgumentError, Exclusive, Handle, check, lib
from ._obstacles import Obstacles
from ._queries import Agents, Leaves, Overlap, options, pointers
from ._shapes import ShapeSet


class Rows:
    """Rows of different lengths in one array: row i is values[offsets[i]:offsets[i + 1]].

    `len(rows)` is the number of rows, `rows[i]` is one row, and iteration yields the rows in order.

    Attributes
    ----------
    offsets : (n + 1,) uint64
    values : (m,) or (m, 2) uint32, or of contacts of bodies (m,) `SPHERE_CONTACT`
    """

    __slots__ = ("offsets", "values")

    def __init__(self, offsets: UInt64, values: Any) -> None:
        self.offsets, self.values = offsets, values

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, i: int) -> Any:
        number = index(i + len(self) if i < 0 else i, "row", len(self))
        return self.values[int(self.offsets[number]) : int(self.offsets[number + 1])]

    def __iter__(self) -> Iterator[Any]:
        return (self[i] for i in range(len(self)))

    @property
    def counts(self) -> UInt64:
        """The length of each row, (n,) uint64."""
        return np.diff(self.offsets)

    def __repr__(self) -> str:
        return f"<bch.Rows: {len(self)} of {len(self.values)} values>"


def _rows(found: Any, shape: Tuple[int, ...] = (), kind: Any = u4) -> Rows:
    offsets = copied(found.offsets, u8, (found.rows + 1,)) if found.offsets else np.zeros(1, u8)
    return Rows(offsets, copied(found.values, kind, (int(offsets[-1]), *shape)))


class Neighbours(Rows):
    """The neighbours of each agent: row i has the agents that are in a pair with agent i, ascending.

    Attributes
    ----------
    pairs : (m,) uint32
        For each value, the index of its pair in the answer.
    """

    __slots__ = ("pairs",)

    def __init__(self, offsets: UInt64, values: UInt32, pairs: UInt32) -> None:
        super().__init__(offsets, values)
        self.pairs = pairs


class Contacts(NamedTuple):
    """The result of `Crowd.contacts`."""

    pairs: UInt32  #: (n, 2), the pairs of agents
    #: one row per pair. ShapeSet: (m, 2) indices of the first agent's disc and the second's, see `ShapeSet.discs`. BodySet: (m,)
    #: `SPHERE_CONTACT`
    discs: Rows


class Clearances(NamedTuple):
    """The result of `Crowd.clearances`, with one entry per pair, as `nearest` has them."""

    pairs: UInt32  #: (n, 2), the pairs of agents
    distance: Float32  #: (n,), metres
    direction: Float32  #: (n, 2), unit vectors from the first agent to the second; of bodies (n, 3)
    discs: UInt32  #: (n, 2), the nearest disc, or sphere, of each agent; 0xffffffff: none
    points: Float32  #: (n, 2, 2), the nearest point of each agent, relative to its position, in the world's axes, metres; of bodies (n, 2, 3)


class Resolved(NamedTuple):
    """The result of `Crowd.resolve`."""

    x: Float64  #: (n,), where the agents are, metres
    y: Float64  #: (n,)
    left: UInt32  #: (m, 2), unresolved: the pairs of agents that still collide
    agents_at_walls: UInt32  #: (k,), the agents that still touch an obstacle
    sweeps: int  #: the number of sweeps that were made
    turn: Float64  #: (n,), radians to add to the agents' headings; zeros if `largest_turn` is 0


class Penetrations(NamedTuple):
    """The result of `Crowd.penetrations`, with one entry per pair."""

    pairs: UInt32  #: (n, 2), the pairs of agents
    penetrations: Records  #: (n,) `PENETRATION`


class Crowd:
    """Finds the pairs of a crowd that collide or are near each other: broad and narrow phase in one call.

    An object keeps its memory from call to call, so each thread needs its own. Every method that finds pairs accepts a filter
    like those of physics engines: two agents are a pair if each one's `mask` has a bit of the other's `category`, (n,) uint32
    with one entry per agent, and if the pair is not in `excluded`, (m, 2) uint32.

    Parameters
    ----------
    period : (float, float)
        Periods of periodic boundary conditions along x and y, metres; 0: not periodic.
    max_pairs : int, optional
        More candidate pairs than this are an error.

    Examples
    --------
    >>> crowd = bch.Crowd()
    >>> for a, b in crowd.collisions(people, agents): ...
    """

    __slots__ = ("_handle", "_exclusive")

    def __init__(self, period: Tuple[float, float] = (0.0, 0.0), max_pairs: Optional[int] = None) -> None:
        if not isinstance(period, (tuple, list)) or len(period) != 2:
            raise rejected(period, "period", "two lengths, (x, y)")
        x, y = (number(length, f"period[{i}]") for i, length in enumerate(period))
        most = 2**64 - 1 if max_pairs is None else bounded(max_pairs, "max_pairs", 0, 2**64 - 1)
        chosen = _library.CrowdOptions(period_x=x, period_y=y, max_pairs=most)
        self._handle, self._exclusive = Handle("crowd", "create", byref(chosen)), Exclusive("Crowd")

    def _pairs(self, find: str, shapes: Union[ShapeSet, BodySet], agents: Agents, *arguments: Any) -> UInt32:
        pairs, count, bodies = ctypes.c_void_p(), ctypes.c_size_t(), isinstance(shapes, BodySet)
        call, at = getattr(lib, f"bch_crowd_{'body_' * bodies}{find}"), pointers(shapes, agents, bodies)
        with self._exclusive:
            check(call(self._handle.pointer, *at, *arguments, byref(pairs), byref(count)))
            return copied(pairs.value, u4, (count.value, 2))

    def candidates(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        margin: float = 0.0,
        *,
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
    ) -> UInt32:
        """Find every pair that is close enough to test (broad phase): that may collide or be within a margin.

        The result contains every pair for which `collide` returns True, and every pair with a `clearance` of at most the margin.

        Parameters
        ----------
        shapes : ShapeSet or BodySet
        agents : Agents
        margin : float
            Metres.
        threads : int
            Number of threads; 0: all processors.

        Returns
        -------
        (n, 2) uint32
            Each pair once, the lower index first, in the order of a grid over the agents, not of indices.
        """
        how, _ = options(threads=threads)
        chosen = _filter(agents, category, mask, excluded)
        return self._pairs("candidates", shapes, agents, number(margin, "margin"), chosen, how)

    def collisions(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        *,
        leaves: Leaves = "segments",
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> UInt32:
        """Find the pairs for which `collide` returns True.

        Returns
        -------
        (n, 2) uint32
            Each pair once, the lower index first, in the order of a grid over the agents, not of indices.
        """
        how, _ = options(leaves=leaves, threads=threads, implementation=implementation)
        chosen = _filter(agents, category, mask, excluded)
        return self._pairs("collisions", shapes, agents, chosen, how)

    def contacts(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        pairs: Optional[UInt32] = None,
        *,
        leaves: Leaves = "segments",
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Contacts:
        """Find which discs (in a BodySet: spheres) of two agents overlap, for given pairs or for the whole crowd.

        Parameters
        ----------
        pairs : (n, 2) uint32, optional
            The pairs to test, each with one row in the result, which may be empty. By default all pairs of the crowd; only
            these can be filtered.
        """
        how, _ = options(leaves=leaves, threads=threads, implementation=implementation)
        bodies = isinstance(shapes, BodySet)
        at, kind = pointers(shapes, agents, bodies), "body_" * bodies
        found = _library.SphereContactRows() if bodies else _library.ContactRows()
        chosen = _filter(agents, category, mask, excluded)
        if pairs is not None and chosen is not None:
            raise ArgumentError("category, mask and excluded: expected none of them for given pairs")
        with self._exclusive:
            if pairs is None:
                check(getattr(lib, f"bch_crowd_{kind}contacts")(self._handle.pointer, *at, chosen, how, byref(found)))
            else:
                where = given(pairs, u4, (None, 2), "pairs")
                call = getattr(lib, f"bch_crowd_{kind}contacts_of")
                check(call(self._handle.pointer, *at, where, len(pairs), how, byref(found)))
            rows = _rows(found, (), SPHERE_CONTACT) if bodies else _rows(found, (2,))
            return Contacts(copied(found.pairs, u4, (found.rows, 2)), rows)

    def clearances(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        within: float,
        *,
        leaves: Leaves = "discs",
        overlap: Overlap = "zero",
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Clearances:
        """Find the pairs whose `clearance` is at most `within`, metres, and measure them as `nearest` does."""
        how, _ = options(
            overlap=overlap, threads=threads, implementation=implementation, distance_leaves=leaves
        )
        bodies = isinstance(shapes, BodySet)
        at, axes = pointers(shapes, agents, bodies), 3 if bodies else 2
        found = _library.CrowdBodyClearanceView() if bodies else _library.CrowdClearanceView()
        call = lib.bch_crowd_body_clearances if bodies else lib.bch_crowd_clearances
        chosen, metres = _filter(agents, category, mask, excluded), number(within, "within")
        with self._exclusive:
            check(call(self._handle.pointer, *at, metres, chosen, how, byref(found)))
            n = found.count
            return Clearances(
                copied(found.pairs, u4, (n, 2)),
                copied(found.distance, f4, (n,)),
                copied(found.direction, f4, (n, axes)),
                copied(found.spheres if bodies else found.discs, u4, (n, 2)),
                copied(found.points, f4, (n, 2, axes)),
            )

    def penetrations(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        directions: int = 16,
        *,
        leaves: Leaves = "segments",
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Penetrations:
        """Find the pairs that collide, and how far the first agent of each has to move, as `penetration` does."""
        how, _ = options(leaves=leaves, threads=threads, implementation=implementation)
        bodies = isinstance(shapes, BodySet)
        at, found = pointers(shapes, agents, bodies), _library.CrowdPenetrationView()
        call = lib.bch_crowd_body_penetrations if bodies else lib.bch_crowd_penetrations
        chosen, ways = _filter(agents, category, mask, excluded), bounded(directions, "directions", 0, 2**32 - 1)
        with self._exclusive:
            check(call(self._handle.pointer, *at, ways, chosen, how, byref(found)))
            n = found.count
            return Penetrations(copied(found.pairs, u4, (n, 2)), copied(found.depths, PENETRATION, (n,)))

    def resolve(
        self,
        bodies: BodySet,
        agents: Agents,
        *,
        directions: int = 16,
        sweeps: int = 100,
        gap: float = 0.001,
        largest_step: float = 0.05,
        largest_shift: float = math.inf,
        largest_turn: float = 0,
        mobility: Optional[Float64] = None,
        obstacles: Optional[Obstacles] = None,
        category: Optional[UInt32] = None,
        mask: Optional[UInt32] = None,
        excluded: Optional[UInt32] = None,
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Resolved:
        """Move agents on the ground, as little as possible, until no two bodies collide and nobody touches an obstacle.

        Each sweep moves all agents at once. It separates pairs that collide by their `nearest_free` moves, and keeps other nearby
        pairs from coming into collision. If there is no room, some pairs still collide after the last
        sweep.

        Parameters
        ----------
        directions : int
            The number of directions of `nearest_free`.
        sweeps : int
            The largest number of sweeps.
        gap : float
            The clearance to leave between two separated agents, metres.
        largest_step : float
            The limit of an agent's move in one sweep, metres.
        largest_shift : float
            The limit of its total move, metres.
        largest_turn : float
            The limit of an agent's turn from its heading, radians.
        mobility : (n,) float64, optional
            Weights of moves, from 0 (fixed) to 1. Of two agents, the one with half the mobility moves half as far.
        """
        how, _ = options(threads=threads, implementation=implementation)
        at, found = pointers(instance(bodies, BodySet, "bodies"), agents, True), _library.ResolvedView()
        most = 2**32 - 1
        chosen = _library.ResolveOptions(
            directions=bounded(directions, "directions", 0, most),
            sweeps=bounded(sweeps, "sweeps", 0, most),
            gap=number(gap, "gap"),
            largest_step=number(largest_step, "largest_step"),
            largest_shift=number(largest_shift, "largest_shift"),
            largest_turn=number(largest_turn, "largest_turn"),
            mobility=None if mobility is None else given(mobility, f8, (len(agents),), "mobility"),
            obstacles=None if obstacles is None else instance(obstacles, Obstacles, "obstacles")._pointer,
        )
        pairs = _filter(agents, category, mask, excluded)
        with self._exclusive:
            check(lib.bch_crowd_body_resolve(self._handle.pointer, *at, byref(chosen), pairs, how, byref(found)))
            return Resolved(
                copied(found.x, f8, (found.count,)),
                copied(found.y, f8, (found.count,)),
                copied(found.left, u4, (found.left_count, 2)),
                copied(found.agents_at_walls, u4, (found.agents_at_walls_count,)),
                found.sweeps,
                copied(found.turn, f8, (found.count,)) if found.turn else np.zeros(found.count),
            )

    def by_agent(self) -> Neighbours:
        """Return, for each agent, the agents that it is paired with in the last answer: one row per agent, ascending."""
        return self._neighbours(lib.bch_crowd_by_agent)

    def nearest(self, max_count: int) -> Neighbours:
        """Return the nearest others of each agent, at most `max_count` of them, nearest first, from the answer of `clearances`.

        `clearances` has to be this crowd's last query. Its distances decide, not those of centres. Crowd models such as ORCA
        take these agents as neighbours.
        """
        return self._neighbours(lib.bch_crowd_nearest, bounded(max_count, "max_count", 0, 2**32 - 1))

    def disc_radii(self, agents: Agents, alone: float = 0.25) -> Float64:
        """Return the radii of discs that stand for the bodies in a simulator of discs, (n,) metres, from the answer of `clearances`.

        A radius is half the distance of positions at which two bodies touch, in the mean over an agent's pairs, the near ones
        foremost. An agent without a pair gets `alone`. `clearances` of the same agents, with `overlap="deepest"`, has to be this
        crowd's last query.
        """
        radii = np.empty(len(instance(agents, Agents, "agents")))
        with self._exclusive:
            check(lib.bch_crowd_disc_radii(self._handle.pointer, agents._pointer, number(alone, "alone"), radii.ctypes.data))
        return radii

    def _neighbours(self, call: Any, *most: int) -> Neighbours:
        found = _library.NeighbourRows()
        with self._exclusive:
            check(call(self._handle.pointer, *most, byref(found)))
            rows = _rows(found, (2,))
        return Neighbours(rows.offsets, rows.values[:, 0].copy(), rows.values[:, 1].copy())

    def obstacles(
        self,
        shapes: Union[ShapeSet, BodySet],
        agents: Agents,
        obstacles: Obstacles,
        *,
        leaves: Leaves = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Rows:
        """Find the obstacles that each agent collides with: one row of obstacle indices per agent, ascending."""
        how, _ = options(leaves=leaves, threads=threads, implementation=implementation)
        bodies = isinstance(shapes, BodySet)
        at, found = pointers(shapes, agents, bodies), _library.IndexRows()
        call = lib.bch_crowd_body_obstacles if bodies else lib.bch_crowd_obstacles
        walls = instance(obstacles, Obstacles, "obstacles")._pointer
        with self._exclusive:
            check(call(self._handle.pointer, *at, walls, how, byref(found)))
            return _rows(found)


def _filter(agents: Agents, category: Optional[UInt32], mask: Optional[UInt32], excluded: Optional[UInt32]) -> Any:
    """Return a struct that holds a filter, or None if there is none."""
    if category is None and mask is None and excluded is None:
        return None
    n = len(instance(agents, Agents, "agents"))
    return byref(
        _library.PairFilter(
            category=None if category is None else given(category, u4, (n,), "category"),
            mask=None if mask is None else given(mask, u4, (n,), "mask"),
            excluded=None if excluded is None else given(excluded, u4, (None, 2), "excluded"),
            excluded_count=0 if excluded is None else len(excluded),
        )
    )
