# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Bodies that move through a whole clip."""

from __future__ import annotations

import ctypes
from ctypes import byref

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import DISC, SPHERE, Records, address, converted, f4, f8, number, records, u4
from ._library import ArrayError, Handle, check, lib


class AnimatedShape:
    """An animated body: discs or spheres whose centres and radii are linear in time between keys. `animate` makes one from a
    clip.

    Times outside the clip are clamped or, if it loops, wrap around.

    Parameters
    ----------
    times : (k,) numbers
        Times of the keys, seconds, ascending; at least two.
    discs : (k, n, 3) or (k, n, 4) numbers
        x, y and radius of each disc at each key, or x, y, z and radius of each sphere, metres, relative to the agent's position.
    loops : bool
        Whether the motion repeats. It then lasts at least 1 ms.
    """

    __slots__ = ("_handle", "_pointer", "loops", "begin", "end", "bounding_radius", "nbytes", "chunk_count", "key_count")

    def __init__(self, times: npt.ArrayLike, discs: npt.ArrayLike, *, loops: bool = False) -> None:
        keys, all_discs = converted(times, f8, "times"), converted(discs, f4, "discs")
        if keys.ndim != 1 or all_discs.ndim != 3 or len(all_discs) != len(keys) or all_discs.shape[2] not in (3, 4):
            raise ArrayError(f"discs have shape {all_discs.shape} at times of shape {keys.shape}; expected (k, n, 3) or (k, n, 4) at (k,)")
        heights = None
        if all_discs.shape[2] == 4:
            heights = np.ascontiguousarray(all_discs[:, :, 2])
            all_discs = np.ascontiguousarray(all_discs[:, :, [0, 1, 3]])
        counts = np.array([len(keys), all_discs.shape[1]], u4)
        arrays = _library.AnimatedArrays(
            loops=bool(loops),
            key_counts=address(counts),
            disc_counts=address(counts[1:]),
            chunk_count=1,
            times=address(keys),
            discs=address(all_discs),
            z=None if heights is None else address(heights),
        )
        self._take(Handle("animated_shape", "create", ctypes.addressof(arrays)))

    @classmethod
    def _of(cls, handle: Handle) -> AnimatedShape:
        made = cls.__new__(cls)
        made._take(handle)
        return made

    def _take(self, handle: Handle) -> None:
        self._handle = handle
        self._pointer: int = handle.pointer
        info = _library.AnimatedShapeInfo()
        check(lib.bch_animated_shape_get_info(self._pointer, byref(info)))
        self.loops = bool(info.loops)
        self.begin, self.end, self.bounding_radius = float(info.begin), float(info.end), float(info.bounding_radius)
        self.nbytes, self.chunk_count, self.key_count = int(info.bytes), int(info.chunks), int(info.keys)

    def discs(self, seconds: float) -> Records:
        """Return the discs at a time of the clip, in seconds; for spheres, their discs as seen from above.

        Returns
        -------
        (n,) DISC
            Records of x, y and radius, metres.
        """
        return records(lib.bch_animated_shape_get_discs, DISC, self._pointer, number(seconds, "seconds"))

    def spheres(self, seconds: float) -> Records:
        """Return the spheres at a time of the clip, in seconds; empty for a body of discs.

        Returns
        -------
        (n,) SPHERE
            Records of x, y, z and radius, metres.
        """
        return records(lib.bch_animated_shape_get_spheres, SPHERE, self._pointer, number(seconds, "seconds"))

    def __repr__(self) -> str:
        return f"<bch.AnimatedShape from {self.begin:g} to {self.end:g} s{', loops' if self.loops else ''}: {self.key_count} keys>"
