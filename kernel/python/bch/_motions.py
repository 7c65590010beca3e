# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Clips as moving spheres, and the first contact of moving agents."""

from __future__ import annotations

from ctypes import byref, c_double
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._animated import AnimatedShape
from ._arrays import (
    Float64,
    UInt32,
    address,
    as_array,
    bounded,
    f8,
    given,
    instance,
    instances,
    number,
    pair,
    result,
    table,
    u4,
)
from ._bodies import BodyModel
from ._library import ArgumentError, Handle, check, lib
from ._obstacles import Obstacles


def animate(model: BodyModel, clip: int, *, error: float = 0.005, loops: Optional[bool] = None) -> AnimatedShape:
    """Make moving spheres that enclose a body at every time of a clip, one for each sphere of the model.

    Parameters
    ----------
    model : BodyModel
    clip : int
        Index in `Character.clips` of the model's character.
    error : float
        How far the moving spheres may protrude at most from the spheres of a pose, between keys more than 9 ms apart, metres.
    loops : bool, optional
        Whether the clip repeats without a pause. None: it repeats if its last pose is its first one.
    """
    of = bounded(clip, "clip", 0, 2**32 - 1)
    options = _library.AnimateOptions(error=number(error, "error"), loops=-1 if loops is None else bool(loops))
    pointer = instance(model, BodyModel, "model")._pointer
    return AnimatedShape._of(Handle("animated_shape", "animate", pointer, of, byref(options)))


class Mover:
    """An agent that moves along a path and plays a clip.

    Parameters
    ----------
    shape : AnimatedShape
    path : (k, 4) or (k, 5) numbers
        Keys of time, x, y, heading and z, in seconds, metres and radians, with ascending times. Between two keys the agent moves straight
        and turns evenly. Before the first key and after the last one it stands there. z, by default 0, is the height of its
        ground; it matters only between bodies of spheres.
    clip_begin : float
        The time at which the clip begins, seconds.
    """

    __slots__ = ("shape", "path", "clip_begin")

    def __init__(self, shape: AnimatedShape, path: npt.ArrayLike, clip_begin: float = 0.0) -> None:
        self.shape = instance(shape, AnimatedShape, "shape")
        self.clip_begin = number(clip_begin, "clip_begin")
        keys = as_array(path, "path")
        flat = keys.ndim != 2 or keys.shape[1] != 5
        self.path = np.pad(table(keys, f8, 4, "path"), ((0, 0), (0, 1))) if flat else table(keys, f8, 5, "path")

    def _struct(self) -> _library.Motion:
        return _library.Motion(
            shape=self.shape._pointer, path=address(self.path), path_count=len(self.path), clip_begin=self.clip_begin
        )


def _structs(movers: Sequence[Mover]) -> Any:
    return (_library.Motion * len(movers))(*[mover._struct() for mover in movers])


def _interval(interval: Tuple[float, float]) -> Tuple[float, float]:
    begin, end = pair(interval, "interval")
    if not begin <= end:
        raise ArgumentError(f"interval is from {begin:g} to {end:g} s")
    return begin, end


def first_contact(
    movers: Sequence[Mover],
    pairs: Union[UInt32, Obstacles],
    interval: Tuple[float, float],
    *,
    tolerance: float = 0.005,
    out: Optional[Float64] = None,
    threads: int = 0,
) -> Float64:
    """Find when the two movers of each pair first touch, or when each mover first touches an obstacle.

    Bodies of spheres meet each other in space. With discs or obstacles, both count as seen from above.

    Parameters
    ----------
    movers : sequence of Mover
    pairs : (m, 2) uint32, or Obstacles
        Indices of movers; with obstacles, every mover is tested against all of them, whatever their heights.
    interval : (begin, end)
        The interval of time to search, seconds, both ends included.
    tolerance : float
        Metres. The answer is never too late, and too early by at most the time in which the two come closer by this distance.
    out : (m,) float64, optional
        Where to write the result.
    threads : int
        Number of threads; 0: all processors.

    Returns
    -------
    (m,) float64
        Time of the first contact, seconds; infinity where there is none.
    """
    movers = instances(movers, Mover, "movers")
    near = number(tolerance, "tolerance")
    structs, (begin, end) = _structs(movers), _interval(interval)
    threads = bounded(threads, "threads", 0, 1024)
    if isinstance(pairs, Obstacles):
        times = result(out, f8, (len(movers),))
        check(
            lib.bch_obstacles_first_contact(
                structs, len(structs), pairs._pointer, begin, end, near, threads, address(times)
            )
        )
        return times
    asked, count = given(pairs, u4, (None, 2), "pairs"), len(pairs)
    times = result(out, f8, (count,))
    check(
        lib.bch_first_contact(
            structs, len(structs), asked, count, begin, end, near, threads, address(times)
        )
    )
    return times


def free_until(
    mover: Mover, others: Sequence[Mover], interval: Tuple[float, float], *, tolerance: float = 0.005
) -> float:
    """Return when a mover first touches one of the others, seconds; infinity if it never does.

    Parameters
    ----------
    mover : Mover
    others : sequence of Mover
    interval, tolerance
        As for `first_contact`. The result is the earliest time that `first_contact` finds for the mover and each of the others.
    """
    own = _structs([instance(mover, Mover, "mover")])
    structs, (begin, end) = _structs(instances(others, Mover, "others")), _interval(interval)
    time = c_double()
    near = number(tolerance, "tolerance")
    check(lib.bch_free_until(own, structs, len(structs), begin, end, near, byref(time)))
    return time.value
