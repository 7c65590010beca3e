# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Sets of characters or of models in many poses."""

from __future__ import annotations

from ctypes import byref
from typing import Any, List, Optional, Sequence, Union, overload

import numpy as np

from . import _library
from ._arrays import address, bounded, instances, listed, rejected, u4
from ._bodies import BodyModel, BodySet, LiveBodies, _pointers
from ._library import ArgumentError, Handle
from ._poses import custom_poses
from ._progress import Watched
from ._shapes import Character, Path, Plan, ShapeSet, _as_poses, bake_shapes


@overload
def bake(
    characters: Union[Character, Sequence[Character]],
    poses: Any = 100,
    *,
    plan: Optional[Plan] = None,
    path: Optional[Path] = None,
    threads: int = 0,
    progress: bool = False,
) -> ShapeSet: ...
@overload
def bake(
    characters: Union[BodyModel, Sequence[BodyModel]], poses: Any = 100, *, threads: int = 0, progress: bool = False
) -> BodySet: ...
def bake(
    characters: Any,
    poses: Any = 100,
    *,
    plan: Optional[Plan] = None,
    path: Optional[Path] = None,
    threads: int = 0,
    progress: bool = False,
) -> Union[ShapeSet, BodySet]:
    """Make a set of characters in many poses: a ShapeSet from characters, or a BodySet from body models.

    Ctrl-C interrupts the work. No partial file is left.

    Parameters
    ----------
    characters : Character or BodyModel, or a sequence of either
    poses : int, or poses
        The number of poses of each character, spread evenly over its clips; or the poses themselves: an (n,) POSE array, a
        sequence of (clip, seconds), Transforms or Vertices. For several characters or models: a sequence of these, one for
        each. Models do not take Vertices. Several models take only (clip, seconds) or POSE.
    plan : Plan, optional
        What a ShapeSet stores.
    path : path, optional
        Where to write the set of shapes.
    threads : int
        Number of threads; 0: all processors. The bytes are the same for any number.
    progress : bool
        Show a progress bar on a terminal.

    Returns
    -------
    ShapeSet or BodySet
        A set with the poses of one character or model after the other.
    """
    alone = isinstance(characters, (Character, BodyModel))
    each = [characters] if alone else listed(characters, "characters", "bch.Character or bch.BodyModel")
    if not (each and isinstance(each[0], BodyModel)):
        of = characters if alone else each
        return bake_shapes(of, poses, plan=Plan() if plan is None else plan, path=path, threads=threads, progress=progress)
    if plan is not None or path is not None:
        raise ArgumentError("plan and path are for shapes; save_models() writes models")
    models = instances(each, BodyModel, "characters")
    if isinstance(poses, (int, np.integer)):
        return _bake_bodies(models, bounded(poses, "poses", 0, 2**31), threads, progress)
    return _posed(models, [poses] if alone else listed(poses, "poses", "those of each model"), threads)


def _bake_bodies(models: List[BodyModel], poses: int, threads: int, progress: bool) -> BodySet:
    pointers = _pointers(models)
    with Watched("bodies", progress) as watched:
        work = _library.Work(threads=bounded(threads, "threads", 0, 1024), progress=watched.callback)
        handle = Handle(
            "bake",
            "bodies",
            address(pointers),
            len(pointers),
            poses,
            byref(work),
            free="body_set",
            checked=watched.run,
        )
    return BodySet._lent(handle, handle.pointer)


def _posed(models: List[BodyModel], poses: List[Any], threads: int) -> BodySet:
    if len(poses) != len(models):
        raise ArgumentError(f"poses has those of {len(poses)} models, and there are {len(models)}")
    if len(models) > 1 and any(custom_poses(of_model) is not None for of_model in poses):
        raise rejected(poses, "poses", "times of clips for several models")
    all_poses = poses[0] if len(models) == 1 else np.concatenate([_as_poses(of_model) for of_model in poses])
    counts = [len(custom_poses(of_model) or _as_poses(of_model)) for of_model in poses]
    bodies = LiveBodies(models, np.repeat(np.arange(len(models), dtype=u4), counts))
    bodies.pose(all_poses, threads=threads)
    return bodies.bodies
