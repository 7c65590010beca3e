# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Bodies of spheres, in space."""

from __future__ import annotations

from ctypes import byref, c_size_t
from typing import Sequence

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import SPHERE, Records, address, f4, index, listed, table, u8
from ._library import Handle, check, lib


class BodySet:
    """Bodies of spheres for queries, in three dimensions.

    Agents name bodies by their `shape`, stand at any `z`, and have no levels.

    Parameters
    ----------
    bodies : sequence of (n, 4) arrays
        The spheres of each body: rows of x, y, z and radius, metres, in the frame of its agent.

    Examples
    --------
    >>> snowman = [[0, 0, 0.5, 0.5], [0, 0, 1.25, 0.35], [0, 0, 1.75, 0.25]]
    >>> bodies = bch.BodySet([snowman])
    >>> agents = bch.Agents(np.zeros(2, np.uint32), np.array([0, 0.9]), np.zeros(2), np.zeros(2))
    >>> bch.Crowd().collisions(bodies, agents)
    array([[0, 1]], dtype=uint32)
    """

    __slots__ = ("_handle", "_pointer")

    def __init__(self, bodies: Sequence[npt.ArrayLike]) -> None:
        rows = [table(body, f4, 4, f"bodies[{i}]") for i, body in enumerate(listed(bodies, "bodies", "(n, 4) arrays"))]
        offsets = np.zeros(len(rows) + 1, u8)
        np.cumsum([len(body) for body in rows], out=offsets[1:])
        spheres = np.concatenate(rows) if rows else np.empty((0, 4), f4)
        self._handle = Handle("body_set", "create", address(spheres), address(offsets), len(rows))
        self._pointer = self._handle.pointer

    def _info(self) -> _library.BodySetInfo:
        info = _library.BodySetInfo()
        check(lib.bch_body_set_get_info(self._pointer, byref(info)))
        return info

    def __len__(self) -> int:
        return int(self._info().bodies)

    @property
    def nbytes(self) -> int:
        """The memory that the bodies take."""
        return int(self._info().bytes)

    def spheres(self, body: int) -> Records:
        """Return the spheres of a body as queries use them, with the rounding margin.

        Returns
        -------
        (n,) SPHERE
            Records of x, y, z and radius, metres.
        """
        number, count = index(body, "body", len(self)), c_size_t()
        check(lib.bch_body_set_get_spheres(self._pointer, number, None, 0, byref(count)))
        spheres = np.empty(count.value, SPHERE)
        check(lib.bch_body_set_get_spheres(self._pointer, number, address(spheres), len(spheres), byref(count)))
        return spheres

    def __repr__(self) -> str:
        return f"<bch.BodySet of {len(self)}>"
