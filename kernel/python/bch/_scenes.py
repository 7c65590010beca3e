# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Plans of the shapes to build for a scene."""

from __future__ import annotations

import math
from ctypes import byref, c_size_t, c_void_p
from typing import Any, Optional, Sequence

from . import _library
from ._arrays import (
    POSE_ID,
    Records,
    UInt8,
    UInt32,
    address,
    copied,
    flag,
    given,
    number,
    u1,
    u4,
)
from ._library import Handle, check, lib
from ._shapes import Character, Plan, ShapeSet, ShapeSetBuilder, _as_poses


class ScenePlan:
    """The shapes to build for a scene, each listed once, and the shape and level of each agent. `plan_scene` makes one.

    Attributes
    ----------
    plan : Plan
        The plan of the set.
    pose_ids : (s,) POSE_ID
        The shapes to build, for `ShapeSetBuilder.add_pose_ids`.
    shape : (n,) uint32
        The shape of each agent, for `Agents`.
    level : (n,) uint8
        The level of each agent, for `Agents`.
    """

    __slots__ = ("plan", "pose_ids", "shape", "level")

    def __init__(self, handle: Handle) -> None:
        of, first, second, count = _library.Plan(), c_void_p(), c_void_p(), c_size_t()
        check(lib.bch_scene_plan_get_set(handle.pointer, byref(of)))
        self.plan = Plan(
            depths=tuple(copied(of.depths, u4, (of.depth_count,)).tolist()),
            outlines=bool(of.outlines),
            culling=bool(of.culling),
            heights=bool(of.heights),
        )
        check(lib.bch_scene_plan_get_shapes(handle.pointer, byref(first), byref(count)))
        self.pose_ids: Records = copied(first.value, POSE_ID, (count.value,))
        check(lib.bch_scene_plan_get_agents(handle.pointer, byref(first), byref(second), byref(count)))
        self.shape: UInt32 = copied(first.value, u4, (count.value,))
        self.level: UInt8 = copied(second.value, u1, (count.value,))

    def build(self, characters: Sequence[Character], *, threads: int = 0, progress: bool = False) -> ShapeSet:
        """Build the set of the planned shapes.

        Parameters
        ----------
        characters : sequence of Character
            The list whose indices were given to `plan_scene`.
        threads : int
            Number of threads; 0: all processors.
        progress : bool
            Show a progress bar on a terminal.
        """
        builder = ShapeSetBuilder(self.plan)
        builder.add_pose_ids(characters, self.pose_ids, threads=threads, progress=progress)
        return builder.finish()

    def __repr__(self) -> str:
        return f"<bch.ScenePlan of {len(self.pose_ids)} shapes for {len(self.shape)} agents>"


def plan_scene(
    poses: Any,
    *,
    character: Optional[UInt32] = None,
    depth: Optional[UInt32] = None,
    outlines: bool = True,
    heights: bool = False,
    pose_step: float = 0.0,
    pairs_per_shape: float = math.inf,
) -> ScenePlan:
    """Find which shapes the agents of a scene need, each listed once, at which depths and with which other data.

    Parameters
    ----------
    poses : (n,) POSE, or a sequence of (clip, seconds)
        One pose per agent.
    character : (n,) uint32, optional
        The index of each agent's character in a list of characters; by default the first one.
    depth : (n,) uint32, optional
        Level of detail: the depth of the disc tree that each agent needs, such as `depth_at_density` returns; by default
        ALL_DEPTHS.
    outlines : bool
        Whether to keep outlines, as `Plan` does.
    heights : bool
        Whether agents stand at different heights.
    pose_step : float
        Seconds. Times are rounded down to multiples of this step, so that agents share shapes; 0: times are not rounded.
    pairs_per_shape : float
        The expected number of pairs tested per shape in its lifetime. From 500 on, shapes get culling data.
    """
    array = _as_poses(poses)
    n = len(array)
    agents = _library.SceneAgents(
        character=None if character is None else given(character, u4, (n,), "character"),
        poses=address(array),
        depth=None if depth is None else given(depth, u4, (n,), "depth"),
        count=n,
    )
    requirements = _library.SceneRequirements(
        outlines=flag(outlines, "outlines"),
        heights=flag(heights, "heights"),
        pairs_per_shape=number(pairs_per_shape, "pairs_per_shape"),
        pose_step=number(pose_step, "pose_step"),
    )
    return ScenePlan(Handle("scene_plan", "create", byref(agents), byref(requirements)))
