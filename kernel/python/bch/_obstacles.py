# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Obstacles that do not move: walls, pillars, furniture."""

from __future__ import annotations

import ctypes
import math
from typing import Any, Optional, Tuple

import numpy as np

from . import _library
from ._arrays import Float64, UInt8, UInt64, address, encoded, f8, given, index, pair, u1, u8
from ._library import Handle, check, lib


class Obstacles:
    """Obstacles that do not move; queries take them in place of pairs.

    A line is one or more open polylines. An area is one or more rings, which close themselves, and the points that they enclose by
    the even-odd rule. Holes are further rings.

    Parameters
    ----------
    x, y : (n,) float64
        The points of all paths, metres.
    path_offsets : (p + 1,) uint64
        Path i has points path_offsets[i] to path_offsets[i + 1].
    obstacle_offsets : (o + 1,) uint64, optional
        Obstacle i has paths obstacle_offsets[i] to obstacle_offsets[i + 1]; by default each path is an obstacle.
    is_area : (o,) uint8, optional
        1 for areas, 0 for lines; by default all are lines.
    heights : (o, 2) float64, optional
        The bottom and the top of each obstacle, metres in the world, as agents' z; they may be infinite, and by default all are.
        Bodies with heights meet only obstacles whose heights meet theirs. Bodies without heights meet all obstacles.
    """

    __slots__ = ("_handle", "_pointer")

    def __init__(
        self,
        x: Float64,
        y: Float64,
        path_offsets: UInt64,
        obstacle_offsets: Optional[UInt64] = None,
        is_area: Optional[UInt8] = None,
        heights: Optional[Float64] = None,
    ) -> None:
        given(path_offsets, u8, (None,), "path_offsets")
        if obstacle_offsets is not None:
            given(obstacle_offsets, u8, (None,), "obstacle_offsets")
        paths = len(path_offsets) - 1
        obstacles = paths if obstacle_offsets is None else len(obstacle_offsets) - 1
        n = int(path_offsets[-1]) if paths >= 0 else 0
        columns = None
        if heights is not None:
            given(heights, f8, (obstacles, 2), "heights")
            columns = np.ascontiguousarray(heights.T)
        arrays = _library.ObstacleArrays(
            x=given(x, f8, (n,), "x"),
            y=given(y, f8, (n,), "y"),
            path_offsets=address(path_offsets),
            path_count=max(paths, 0),
            obstacle_offsets=None if obstacle_offsets is None else address(obstacle_offsets),
            obstacle_count=max(obstacles, 0),
            is_area=None if is_area is None else given(is_area, u1, (obstacles,), "is_area"),
            bottom=None if columns is None else columns[0].ctypes.data,
            top=None if columns is None else columns[1].ctypes.data,
        )
        self._take(Handle("obstacles", "create", ctypes.addressof(arrays)))

    @classmethod
    def from_wkt(
        cls, text: Any, walkable: bool = False, heights: Tuple[float, float] = (-math.inf, math.inf)
    ) -> Obstacles:
        """Read obstacles from well-known text, or from an object that has it, such as a shapely geometry.

        Parameters
        ----------
        text : str, or an object with an attribute `wkt`
            Any number of POLYGON, MULTIPOLYGON, LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION.
        walkable : bool
            If True, polygons are the floor that agents walk on, and their rings are walls: lines, without an inside. If False, polygons
            are solid.
        heights : (float, float)
            The bottom and the top of all obstacles of the text, metres in the world; by default they are infinite.
        """
        bottom, top = pair(heights, "heights")
        made = cls.__new__(cls)
        wkt = encoded(getattr(text, "wkt", text), "text")
        made._take(Handle("obstacles", "from_wkt", wkt, int(walkable), bottom, top))
        return made

    def _take(self, handle: Handle) -> None:
        self._handle = handle
        self._pointer: int = handle.pointer

    def __len__(self) -> int:
        return self._counts()[0]

    @property
    def segment_count(self) -> int:
        """The number of segments of all paths."""
        return self._counts()[1]

    def owner(self, segment: int) -> int:
        """Return the obstacle that a segment belongs to."""
        owner = ctypes.c_uint32()
        number = index(segment, "segment", self.segment_count)
        check(lib.bch_obstacles_get_owner(self._pointer, number, ctypes.byref(owner)))
        return owner.value

    def _counts(self) -> Tuple[int, int]:
        obstacles, segments = ctypes.c_uint32(), ctypes.c_uint32()
        check(lib.bch_obstacles_get_counts(self._pointer, ctypes.byref(obstacles), ctypes.byref(segments)))
        return obstacles.value, segments.value

    def __repr__(self) -> str:
        return f"<bch.Obstacles: {len(self)} of {self.segment_count} segments>"
