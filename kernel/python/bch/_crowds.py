# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Queries of whole crowds: candidates, collisions, contacts."""

from __future__ import annotations

import ctypes
import math
from ctypes import byref
from typing import Any, Iterator, NamedTuple, Optional, Tuple

import numpy.typing as npt

from . import _library
from ._arrays import UInt32, UInt64, copied, given, u4, u8, view
from ._library import Handle, check, lib
from ._obstacles import Obstacles
from ._queries import Agents, options
from ._shapes import ShapeSet


class Rows(NamedTuple):
    """Rows of different lengths in one array: row i is values[offsets[i]:offsets[i + 1]]. `row(i)` returns it."""

    offsets: UInt64  #: (rows + 1,)
    values: UInt32

    def row(self, i: int) -> UInt32:
        """Return a row."""
        return self.values[int(self.offsets[i]) : int(self.offsets[i + 1])]

    @property
    def rows(self) -> int:
        """The number of rows."""
        return len(self.offsets) - 1


def _rows(found: Any, shape: Tuple[int, ...] = ()) -> Rows:
    offsets = copied(found.offsets, u8, (found.rows + 1,)) if found.offsets else copied(None, u8, (1,)) * 0
    return Rows(offsets, copied(found.values, u4, (int(offsets[-1]), *shape)))


class BroadPhase:
    """Finds pairs of agents that may collide. It keeps its memory from call to call; one thread may use it at a time."""

    __slots__ = ("_handle",)

    def __init__(self) -> None:
        self._handle = Handle("broad_phase", "create")

    def find(
        self, shapes: ShapeSet, agents: Agents, margin: float = 0.0, *, threads: int = 0, copy: bool = True
    ) -> UInt32:
        """Find the pairs as `candidate_pairs` does.

        Parameters
        ----------
        shapes, agents, margin, threads
            As for `candidate_pairs`.
        copy : bool
            False: return the memory of this object, read-only, which the next call overwrites.
        """
        how, _ = options(threads=threads)
        pairs, count = ctypes.c_void_p(), ctypes.c_size_t()
        handle = self._handle.pointer
        check(lib.bch_broad_phase_find(handle, shapes._pointer, agents._pointer, margin, how, byref(pairs), byref(count)))
        return (copied if copy else view)(pairs.value, u4, (count.value, 2))


def candidate_pairs(shapes: ShapeSet, agents: Agents, margin: float = 0.0, *, threads: int = 0) -> UInt32:
    """Find every pair of agents that may collide or come within a margin of each other.

    No pair is missing that `collide` answers with True, or that has a `clearance` of at most the margin.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    margin : float
        Metres.
    threads : int
        0: all processors.

    Returns
    -------
    (n, 2) uint32
        Each pair once, the lower index first, in an order by place.
    """
    return BroadPhase().find(shapes, agents, margin, threads=threads)


class CrowdCollider:
    """Finds who of a crowd collides with whom. It keeps its memory from call to call; one thread may use it at a time."""

    __slots__ = ("_handle",)

    def __init__(self) -> None:
        self._handle = Handle("crowd_collider", "create")

    def collide_all(
        self,
        shapes: ShapeSet,
        agents: Agents,
        *,
        semantics: str = "boundary",
        leaves: str = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Rows:
        """Find the colliding neighbours of every agent as `collide_all` does."""
        how, _ = options(semantics, leaves, "zero", math.inf, threads, implementation)
        found = _library.IndexRows()
        check(
            lib.bch_crowd_collider_collide_all(
                self._handle.pointer, shapes._pointer, agents._pointer, None, how, byref(found), None
            )
        )
        return _rows(found)

    def collide_all_with(
        self,
        shapes: ShapeSet,
        agents: Agents,
        obstacles: Obstacles,
        *,
        semantics: str = "boundary",
        leaves: str = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Tuple[Rows, Rows]:
        """Find the colliding neighbours of every agent, and the obstacles that it collides with."""
        how, _ = options(semantics, leaves, "zero", math.inf, threads, implementation)
        found, touched = _library.IndexRows(), _library.IndexRows()
        check(
            lib.bch_crowd_collider_collide_all(
                self._handle.pointer,
                shapes._pointer,
                agents._pointer,
                obstacles._pointer,
                how,
                byref(found),
                byref(touched),
            )
        )
        return _rows(found), _rows(touched)


def collide_all(
    shapes: ShapeSet,
    agents: Agents,
    *,
    semantics: str = "boundary",
    leaves: str = "segments",
    threads: int = 0,
    implementation: Optional[str] = None,
) -> Rows:
    """Find the colliding neighbours of every agent of a crowd, in one call.

    Parameters
    ----------
    shapes : ShapeSet
    agents : Agents
    semantics, leaves, threads, implementation
        As for `collide`.

    Returns
    -------
    Rows
        A row an agent: the indices of those whom it collides with, ascending.
    """
    return CrowdCollider().collide_all(
        shapes, agents, semantics=semantics, leaves=leaves, threads=threads, implementation=implementation
    )


class Contacts(NamedTuple):
    """The discs of two agents that touch, a row a pair."""

    pairs: UInt32  #: (n, 2), agents
    offsets: UInt64  #: (n + 1,)
    discs: UInt32  #: (m, 2), a disc of each, as `ShapeSet.discs` numbers them

    def row(self, i: int) -> UInt32:
        """Return the contacts of a pair, (k, 2)."""
        return self.discs[int(self.offsets[i]) : int(self.offsets[i + 1])]


class ContactFinder:
    """Finds all discs of two agents that touch. It keeps its memory from call to call; one thread may use it at a time."""

    __slots__ = ("_handle",)

    def __init__(self) -> None:
        self._handle = Handle("contact_finder", "create")

    def find(
        self,
        shapes: ShapeSet,
        agents: Agents,
        pairs: Optional[UInt32] = None,
        *,
        leaves: str = "segments",
        threads: int = 0,
        implementation: Optional[str] = None,
    ) -> Contacts:
        """Find the contacts as `contacts` does."""
        how, _ = options("boundary", leaves, "zero", math.inf, threads, implementation)
        found = _library.ContactRows()
        handle = self._handle.pointer
        if pairs is None:
            check(lib.bch_contact_finder_find_all(handle, shapes._pointer, agents._pointer, how, byref(found)))
        else:
            where = given(pairs, u4, (None, 2), "pairs")
            check(
                lib.bch_contact_finder_find(
                    handle, shapes._pointer, agents._pointer, where, len(pairs), how, byref(found)
                )
            )
        rows = _rows(found, (2,))
        return Contacts(copied(found.pairs, u4, (found.rows, 2)), rows.offsets, rows.values)


def contacts(
    shapes: ShapeSet,
    agents: Agents,
    pairs: Optional[UInt32] = None,
    *,
    leaves: str = "segments",
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
