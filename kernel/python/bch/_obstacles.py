# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Obstacles that do not move: walls, pillars, furniture."""

from __future__ import annotations

import ctypes
import math
from typing import Any, List, Mapping, Optional, Tuple

import numpy as np

from . import _library
from ._arrays import Float64, UInt8, UInt64, address, encoded, f8, given, index, listed, pair, table, u1, u8
from ._library import ArgumentError, ArrayError, Handle, check, lib


class Obstacles:
    """Obstacles that do not move. Pass them to queries as the argument instead of pairs.

    An obstacle is a line or an area. A line is one or more open polylines. An area is all points enclosed by one or more rings,
    by the even-odd rule, so that further rings are holes. Rings close themselves.

    Parameters
    ----------
    x, y : (n,) float64
        The points of all polylines, metres.
    polyline_offsets : (p + 1,) uint64
        Polyline i has points polyline_offsets[i] to polyline_offsets[i + 1].
    obstacle_offsets : (o + 1,) uint64, optional
        Obstacle i has polylines obstacle_offsets[i] to obstacle_offsets[i + 1]; by default each polyline is an obstacle.
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
        polyline_offsets: UInt64,
        obstacle_offsets: Optional[UInt64] = None,
        is_area: Optional[UInt8] = None,
        heights: Optional[Float64] = None,
    ) -> None:
        given(polyline_offsets, u8, (None,), "polyline_offsets")
        if obstacle_offsets is not None:
            given(obstacle_offsets, u8, (None,), "obstacle_offsets")
        polylines = len(polyline_offsets) - 1
        obstacles = polylines if obstacle_offsets is None else len(obstacle_offsets) - 1
        n = int(polyline_offsets[-1]) if polylines >= 0 else 0
        columns = None
        if heights is not None:
            given(heights, f8, (obstacles, 2), "heights")
            columns = np.ascontiguousarray(heights.T)
        arrays = _library.ObstacleArrays(
            x=given(x, f8, (n,), "x"),
            y=given(y, f8, (n,), "y"),
            polyline_offsets=address(polyline_offsets),
            polyline_count=max(polylines, 0),
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
        """Read obstacles from well-known text, or from a geometry.

        Parameters
        ----------
        text : str, or a geometry
            A geometry is an object of shapely or PedPy (with an attribute `wkt` or `polygon`), GeoJSON (a mapping, or an object
            with `__geo_interface__`), or (n, 2) points, of one polygon or of several. It may consist of POLYGON, MULTIPOLYGON,
            LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION.
        walkable : bool
            If True, polygons are the floor that agents walk on, and their rings are walls: lines, without an inside. If False, polygons
            are solid.
        heights : (float, float)
            The bottom and the top of all obstacles of the text, metres in the world; by default they are infinite.
        """
        bottom, top = pair(heights, "heights")
        made = cls.__new__(cls)
        wkt = encoded(well_known_text(text, "text"), "text")
        made._take(Handle("obstacles", "from_wkt", wkt, int(walkable), bottom, top))
        return made

    def _take(self, handle: Handle) -> None:
        self._handle = handle
        self._pointer: int = handle.pointer

    def __len__(self) -> int:
        return self._counts()[0]

    @property
    def segment_count(self) -> int:
        """The number of segments of all polylines."""
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


def walls_of(geometry: Any) -> Obstacles:
    """Return obstacles, or those of a geometry that people walk on."""
    if isinstance(geometry, Obstacles):
        return geometry
    try:
        return Obstacles.from_wkt(well_known_text(geometry, "walls"), walkable=True)
    except ArgumentError as error:
        raise ArgumentError(f"walls: {error}") from None


def well_known_text(geometry: Any, name: str) -> Any:
    """Return a geometry as well-known text."""
    geometry = getattr(geometry, "polygon", geometry)  # of PedPy's WalkableArea
    if isinstance(geometry, str) or hasattr(geometry, "wkt"):
        return getattr(geometry, "wkt", geometry)
    geometry = getattr(geometry, "__geo_interface__", geometry)
    if isinstance(geometry, Mapping):
        return _of_geojson(geometry, name)
    polygons = listed(geometry, name, "polygons")
    if polygons and np.ndim(polygons[0]) == 1:
        polygons = [geometry]
    rings = [table(points, f8, 2, f"{name}[{i}]").tolist() for i, points in enumerate(polygons)]
    return _collection([f"POLYGON ({_coordinates(ring)})" for ring in rings])


def _of_geojson(geometry: Mapping[str, Any], name: str) -> str:
    kind = str(geometry.get("type"))
    for several in ("features", "geometries"):
        if several in geometry:
            return _collection([_of_geojson(each, name) for each in geometry[several]])
    if kind == "Feature":
        return _of_geojson(geometry["geometry"], name)
    if "coordinates" not in geometry:
        raise ArrayError(f"{name} is a mapping of type {kind!r} without coordinates; expected a geometry of GeoJSON")
    return f"{kind.upper()} {_coordinates(geometry['coordinates'])}"


def _coordinates(nested: Any) -> str:
    if not isinstance(nested[0], (list, tuple)):
        return f"{float(nested[0])!r} {float(nested[1])!r}"
    return "(" + ", ".join(map(_coordinates, nested)) + ")"


def _collection(parts: List[str]) -> str:
    return f"GEOMETRYCOLLECTION ({', '.join(parts)})" if parts else "GEOMETRYCOLLECTION EMPTY"
