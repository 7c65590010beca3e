# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Queries about whole crowds: candidate pairs, collisions, contacts."""

from __future__ import annotations

import ctypes
import math
from ctypes import byref
from typing import Any, Iterator, Optional, Tuple, Union, overload

import numpy as np

from . import _library
from ._arrays import UInt32, UInt64, copied, given, index, instance, number, u4, u8
from ._library import Exclusive, Handle, check, lib
from ._obstacles import Obstacles
from ._queries import Agents, Leaves, options, pointers
from ._shapes import ShapeSet


class Rows:
    """Rows of different lengths in one array: row i is values[offsets[i]:offsets[i + 1]].

    `len(rows)` is the number of rows, `rows[i]` is one row, and iteration yields the rows in order.

    Attributes
    ----------
    offsets : (n + 1,) uint64
    values : (m,) or (m, 2) uint32
    """

    __slots__ = ("offsets", "values")

    def __init__(self, offsets: UInt64, values: UInt32) -> None:
        self.offsets, self.values = offsets, values

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, i: int) -> UInt32:
        number = index(i + len(self) if i < 0 else i, "row", len(self))
        return self.values[int(self.offsets[number]) : int(self.offsets[number + 1])]

    def __iter__(self) -> Iterator[UInt32]:
        return (self[i] for i in range(len(self)))

    @property
    def counts(self) -> UInt64:
        """The length of each row, (n,) uint64."""
        return np.diff(self.offsets)

    def __repr__(self) -> str:
        return f"<bch.Rows: {len(self)} of {len(self.values)} values>"


def _rows(found: Any, shape: Tuple[int, ...] = ()) -> Rows:
    offsets = copied(found.offsets, u8, (found.rows + 1,)) if found.offsets else np.zeros(1, u8)
    return Rows(offsets, copied(found.values, u4, (int(offsets[-1]), *shape)))


class BroadPhase:
    """Finds pairs of agents that may collide. An object keeps its memory from call to call, so each thread needs its own."""

    __slots__ = ("_handle", "_exclusive")

    def __init__(self) -> None:
        self._handle, self._exclusive = Handle("broad_phase", "create"), Exclusive("BroadPhase")

    def find(self, shapes: ShapeSet, agents: Agents, margin: float = 0.0, *, threads: int = 0) -> UInt32:
        """Find pairs as the function `candidate_pairs` does."""
        set_at, agents_at = pointers(shapes, agents)
        within = number(margin, "margin")
        how, _ = options(threads=threads)
        pairs, count = ctypes.c_void_p(), ctypes.c_size_t()
        with self._exclusive:
            handle = self._handle.pointer
            check(lib.bch_broad_phase_find(handle, set_at, agents_at, within, how, byref(pairs), byref(count)))
            return copied(pairs.value, u4, (count.value, 2))


def candidate_pairs(shapes: ShapeSet, agents: Agents, margin: float = 0.0, *, threads: int = 0) -> UInt32:
    """Find every pair of agents that may collide or come within a margin of each other.

    The result contains every pair for which `collide` returns True, and every pair with a `clearance` of at most the margin.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    margin : float
        Metres.
    threads : int
        Number of threads; 0: all processors.

    Returns
    -------
    (n, 2) uint32
        Each pair once, the lower index first, ordered by position.
    """
    return BroadPhase().find(shapes, agents, margin, threads=threads)


class CrowdCollider:
    """Finds who collides with whom in a crowd. An object keeps its memory from call to call, so each thread needs its own."""

    __slots__ = ("_handle", "_exclusive")

    def __init__(self) -> None:
        self._handle, self._exclusive = Handle("crowd_collider", "create"), Exclusive("CrowdCollider")

    @overload
    def collide_all(
        self,
        shapes: ShapeSet,
        agents: Agents,
        obstacles: None = None,
        *,
        leaves: Leaves = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Rows: ...

    @overload
    def collide_all(
        self,
        shapes: ShapeSet,
        agents: Agents,
        obstacles: Obstacles,
        *,
        leaves: Leaves = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Tuple[Rows, Rows]: ...

    def collide_all(
        self,
        shapes: ShapeSet,
        agents: Agents,
        obstacles: Optional[Obstacles] = None,
        *,
        leaves: Leaves = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Union[Rows, Tuple[Rows, Rows]]:
        """Find the colliding neighbours of every agent as the function `collide_all` does."""
        set_at, agents_at = pointers(shapes, agents)
        how, _ = options(leaves, "zero", math.inf, threads, implementation)
        found, touched = _library.IndexRows(), _library.IndexRows()
        walls = None if obstacles is None else instance(obstacles, Obstacles, "obstacles")._pointer
        with self._exclusive:
            status = lib.bch_crowd_collider_collide_all(
                self._handle.pointer, set_at, agents_at, walls, how, byref(found), None if walls is None else byref(touched)
            )
            check(status)
            return _rows(found) if walls is None else (_rows(found), _rows(touched))


@overload
def collide_all(
    shapes: ShapeSet,
    agents: Agents,
    obstacles: None = None,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
) -> Rows: ...


@overload
def collide_all(
    shapes: ShapeSet,
    agents: Agents,
    obstacles: Obstacles,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
) -> Tuple[Rows, Rows]: ...


def collide_all(
    shapes: ShapeSet,
    agents: Agents,
    obstacles: Optional[Obstacles] = None,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
) -> Union[Rows, Tuple[Rows, Rows]]:
    """Find the colliding neighbours of every agent of a crowd, in one call.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    obstacles : Obstacles, optional
        Also find the obstacles that each agent collides with.
    leaves, threads, implementation
        As for `collide`.

    Returns
    -------
    Rows, or (Rows, Rows) with obstacles
        One row per agent: the indices of the agents that it collides with, ascending. With obstacles, the second Rows has the
        indices of the obstacles that it collides with.
    """
    how = {"leaves": leaves, "threads": threads, "implementation": implementation}
    return CrowdCollider().collide_all(shapes, agents, obstacles, **how)  # type: ignore[call-overload,no-any-return]


class Contacts:
    """Pairs of discs that make two agents touch: one row per pair of agents.

    Attributes
    ----------
    pairs : (n, 2) uint32
        The pairs of agents.
    discs : Rows
        One row per pair of agents, of (m, 2) indices: a disc of the first agent and a disc of the second, as `ShapeSet.discs`
        numbers them.
    """

    __slots__ = ("pairs", "discs")

    def __init__(self, pairs: UInt32, discs: Rows) -> None:
        self.pairs, self.discs = pairs, discs

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        return f"<bch.Contacts: {len(self.discs.values)} of {len(self)} pairs>"


class ContactFinder:
    """Finds all discs of two agents that touch. An object keeps its memory from call to call, so each thread needs its own."""

    __slots__ = ("_handle", "_exclusive")

    def __init__(self) -> None:
        self._handle, self._exclusive = Handle("contact_finder", "create"), Exclusive("ContactFinder")

    def find(
        self,
        shapes: ShapeSet,
        agents: Agents,
        pairs: Optional[UInt32] = None,
        *,
        leaves: Leaves = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Contacts:
        """Find contacts as the function `contacts` does."""
        set_at, agents_at = pointers(shapes, agents)
        how, _ = options(leaves, "zero", math.inf, threads, implementation)
        found = _library.ContactRows()
        handle = self._handle.pointer
        with self._exclusive:
            if pairs is None:
                check(lib.bch_contact_finder_find_all(handle, set_at, agents_at, how, byref(found)))
            else:
                where = given(pairs, u4, (None, 2), "pairs")
                check(lib.bch_contact_finder_find(handle, set_at, agents_at, where, len(pairs), how, byref(found)))
            return Contacts(copied(found.pairs, u4, (found.rows, 2)), _rows(found, (2,)))


def contacts(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Optional[UInt32] = None,
    *,
    leaves: Leaves = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
) -> Contacts:
    """Find all discs of two agents that touch, for given pairs or for a whole crowd.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    pairs : (n, 2) uint32, optional
        By default every pair of agents whose root discs overlap.
    leaves, threads, implementation
        As for `collide`.

    Returns
    -------
    Contacts
    """
    return ContactFinder().find(
        shapes, agents, pairs, leaves=leaves, threads=threads, implementation=implementation
    )
