# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""What meshes and characters cover, seen from above."""

from __future__ import annotations

import ctypes
import json
import math
from ctypes import byref, c_size_t
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import Float32, address, as_array, bounded, f4, pair, table, u4
from ._library import ArrayError, Handle, check, lib
from ._progress import Watched
from ._shapes import REST_POSE, Character, _as_poses, _contours

_WKT, _GEOJSON = 0, 1


class Outline:
    """What a mesh covers in one pose, seen from above. shapely takes it as it is: `shapely.geometry.shape(outline)`."""

    __slots__ = ("_handle", "_pose", "contours")

    def __init__(self, handle: Handle, pose: int) -> None:
        self._handle, self._pose = handle, pose
        #: (n, 2) arrays of points, metres. Counter-clockwise ones are exteriors; a clockwise one is a hole of the exterior before it.
        #: Contours without area are triangles seen edge-on; `wkt` and `geojson` omit them.
        self.contours: List[Float32] = _contours(lib.bch_outlines_get, handle.pointer, pose)

    def _text(self, format: int) -> str:
        length = c_size_t()
        call = lib.bch_outlines_get_text
        check(call(self._handle.pointer, self._pose, format, None, 0, byref(length)))
        text = ctypes.create_string_buffer(max(length.value, 1))
        check(call(self._handle.pointer, self._pose, format, ctypes.addressof(text), length.value, byref(length)))
        return text.raw[: length.value].decode()

    @property
    def wkt(self) -> str:
        """The polygons as well-known text, a MULTIPOLYGON, which `Obstacles.from_wkt` reads, too."""
        return self._text(_WKT)

    @property
    def geojson(self) -> str:
        """The polygons as GeoJSON, a geometry of type MultiPolygon, in metres."""
        return self._text(_GEOJSON)

    @property
    def __geo_interface__(self) -> Dict[str, Any]:
        """The polygons as a mapping, by the protocol of that name."""
        mapping: Dict[str, Any] = json.loads(self.geojson)
        return mapping

    def __repr__(self) -> str:
        return f"<bch.Outline of {len(self.contours)} contours, {sum(map(len, self.contours))} points>"


def outline(
    body: Union[Character, npt.ArrayLike],
    triangles: Any = None,
    *,
    poses: Any = None,
    heights: Optional[Tuple[float, float]] = None,
    holes: bool = False,
    threads: int = 0,
    progress: bool = False,
) -> Union[Outline, List[Outline]]:
    """Find the exact union of a mesh's triangles, seen from above, in one pose or in many.

    Parameters
    ----------
    body : (n, 3) positions in metres, z up; (frames, n, 3) positions of many poses; or a Character
    triangles : (m, 3) whole numbers
        Indices of positions; not for a character, which has its own.
    poses : (clip, seconds), (frames,) POSE, or a sequence of (clip, seconds)
        Of a character; by default the rest pose.
    heights : (bottom, top), optional
        Cut the mesh at two heights, metres, and leave out what is below and above. They may be infinite.
    holes : bool
        Also find holes, and parts inside holes. This takes about a hundred times as long.
    threads : int
        Number of threads for many poses; 0: all processors.
    progress : bool
        Show a progress bar on a terminal.

    Returns
    -------
    Outline, or a list of them
        A list with one Outline per pose; for a single pose, that Outline.
    """
    bottom, top = (-math.inf, math.inf) if heights is None else pair(heights, "heights")
    options = _library.OutlineOptions(holes=bool(holes), bottom=bottom, top=top)
    if isinstance(body, Character):
        if triangles is not None:
            raise ArrayError("triangles are for positions; a bch.Character has its own")
        alone = poses is None or isinstance(poses, tuple) and len(poses) == 2 and not isinstance(poses[0], tuple)
        array = _as_poses([(REST_POSE, 0.0)] if poses is None else [poses] if alone else poses)
        count = len(array)
        arguments: Tuple[Any, ...] = (body._pointer, address(array), count)
        find = "of_character"
    else:
        if poses is not None:
            raise ArrayError("poses are for a bch.Character; positions of many poses are (frames, n, 3)")
        positions = as_array(body, "body")
        alone = positions.ndim == 2
        if positions.ndim not in (2, 3) or positions.shape[-1] != 3 or positions.dtype.kind not in "iuf":
            raise ArrayError(f"body is an array of {positions.dtype} with shape {positions.shape}; expected (n, 3) or (frames, n, 3)")
        array = np.ascontiguousarray(positions, f4)
        corners = table(triangles, u4, 3, "triangles")
        count = 1 if alone else len(array)
        arguments = (address(array), array.shape[-2], count, address(corners), len(corners))
        find = "of_mesh"
    with Watched("outlining", progress) as watched:
        work = _library.Work(threads=bounded(threads, "threads", 0, 1024), progress=watched.callback)
        handle = Handle("outlines", find, *arguments, byref(options), byref(work), checked=watched.run)
    found = [Outline(handle, i) for i in range(count)]
    return found[0] if alone else found
