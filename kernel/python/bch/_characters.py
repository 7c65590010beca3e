# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Characters from arrays of the caller."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_char_p
from typing import Any, List, NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import address, as_array, bounded, converted, encoded, f4, instance, instances, number, table, u4, u8
from ._library import ArgumentError, ArrayError, Handle
from ._shapes import Character

_interpolations = ("linear", "step", "cubic")
_influence = np.dtype([("bone", u4), ("weight", f4)])


class Joint(NamedTuple):
    """A node of a skeleton."""

    name: str = ""
    parent: int = -1  #: the index of an earlier joint; -1: none
    rest: Optional[npt.ArrayLike] = None  #: (3, 4) or (4, 4), in the parent's frame; None: the identity


class Bone(NamedTuple):
    """A bone, which moves vertices: a joint, and an inverse bind matrix, which maps the vertices' frame to the joint's in the
    bind pose."""

    joint: int
    inverse_bind: Optional[npt.ArrayLike] = None  #: (3, 4) or (4, 4); None: vertices are in the joint's frame


class Curve(NamedTuple):
    """The motion of one part of a joint's transform: keys in order of time."""

    times: npt.ArrayLike  #: (k,) seconds from the start of the motion
    values: npt.ArrayLike  #: (k, 3); for rotations (k, 4), unit quaternions x, y, z, w
    interpolation: str = "linear"  #: or "step", or "cubic", a Hermite spline
    tangents: Optional[npt.ArrayLike] = None  #: for "cubic": (k, 2, 3) or (k, 2, 4), before and after each key, per second


class Channel(NamedTuple):
    """The motion of one joint relative to its parent. A part that is None stays at rest."""

    joint: int
    positions: Optional[Curve] = None
    rotations: Optional[Curve] = None
    scales: Optional[Curve] = None


class Motion(NamedTuple):
    """A clip of a character that is made from arrays."""

    name: str
    seconds: float
    channels: Sequence[Channel] = ()  #: at most one per joint


class _Arrays:
    """Keeps converted arrays alive while a call views them."""

    def __init__(self) -> None:
        self._kept: List[Any] = []

    def keep(self, array: npt.NDArray[Any]) -> int:
        self._kept.append(array)
        return address(array)

    def maps(self, maps: Sequence[Optional[npt.ArrayLike]], name: str) -> int:
        """Return the address of affine maps. None is the identity."""
        rows = np.empty((len(maps), 3, 4), f4)
        for i, each in enumerate(maps):
            found = np.eye(4) if each is None else as_array(each, f"{name} {i}")
            if found.shape not in ((3, 4), (4, 4)) or found.dtype.kind not in "iuf":
                raise ArrayError(f"{name} {i} has shape {found.shape}; expected (3, 4) or (4, 4)")
            rows[i] = found[:3]
        return self.keep(rows)

    def curve(self, curve: Optional[Curve], width: int) -> _library.Curve:
        if curve is None:
            return _library.Curve()
        instance(curve, Curve, "a curve of a channel")
        if curve.interpolation not in _interpolations:
            raise ArgumentError(f"interpolation is {curve.interpolation!r}; expected one of {', '.join(_interpolations)}")
        times = converted(curve.times, f4, "the times of a curve")
        values = table(curve.values, f4, width, "the values of a curve")
        if times.shape != (len(values),):
            raise ArrayError(f"the times of a curve have shape {times.shape}, and there are {len(values)} values")
        tangents = None
        if curve.interpolation == "cubic":
            given_tangents = () if curve.tangents is None else curve.tangents
            tangents = converted(given_tangents, f4, "the tangents of a curve")
            if tangents.shape != (len(values), 2, width):
                raise ArrayError(f"the tangents of a curve have shape {tangents.shape}; expected {(len(values), 2, width)}")
        return _library.Curve(
            times=self.keep(times),
            values=self.keep(values),
            tangents=None if tangents is None else self.keep(tangents),
            count=len(times),
            interpolation=_interpolations.index(curve.interpolation),
        )

    def motion(self, motion: Motion) -> _library.Clip:
        given_channels = instances(motion.channels, Channel, "channels")
        channels = (_library.Channel * len(given_channels))(
            *[
                _library.Channel(
                    bounded(channel.joint, "the joint of a channel", 0, 2**32 - 1),
                    self.curve(channel.positions, 3),
                    self.curve(channel.rotations, 4),
                    self.curve(channel.scales, 3),
                )
                for channel in given_channels
            ]
        )
        self._kept.append(channels)
        return _library.Clip(encoded(motion.name, "a name"), number(motion.seconds, "seconds of a motion"), ctypes.addressof(channels), len(channels))

    def influences(self, bones: npt.ArrayLike, weights: npt.ArrayLike, vertices: int, to: Any) -> None:
        """Set the influences of vertices. A weight of 0 is no influence."""
        weight = as_array(weights, "weights")
        columns = weight.shape[1] if weight.ndim == 2 else 1
        weight, bone = table(weights, f4, columns, "weights"), table(bones, u4, columns, "vertex_bones")
        if len(weight) != vertices or len(bone) != vertices:
            raise ArrayError(f"weights has {len(weight)} rows, vertex_bones {len(bone)}, and there are {vertices} vertices")
        used = weight != 0
        offsets = np.zeros(vertices + 1, u8)
        offsets[1:] = np.cumsum(used.sum(axis=1))
        influences = np.empty(int(offsets[-1]), _influence)
        influences["bone"], influences["weight"] = bone[used], weight[used]
        to.influence_offsets, to.influences = self.keep(offsets), self.keep(influences)


def make_character(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    name: str = "arrays",
    joints: Sequence[Joint] = (),
    bones: Sequence[Bone] = (),
    vertex_bones: Optional[npt.ArrayLike] = None,
    weights: Optional[npt.ArrayLike] = None,
    motions: Sequence[Motion] = (),
    root_joint: int = -1,
    to_ground: Optional[npt.ArrayLike] = None,
) -> Character:
    """Make a character from a mesh, a skeleton, weights and motions in arrays, which are copied.

    Parameters
    ----------
    vertices : (n, 3) array
        Positions, in metres with z up, unless `to_ground` says otherwise.
    triangles : (t, 3) array
        Indices of vertices.
    name : str
    joints : sequence of Joint
        The skeleton, parents first. Without joints the mesh does not move, and its centre is the agent's position.
    bones : sequence of Bone
        The bones that move vertices.
    vertex_bones, weights : (n, k) arrays, optional
        The bones that each vertex follows, and their weights. The weights of a vertex sum to 1, and a bone with weight 0 is
        ignored. By default all vertices follow the first bone.
    motions : sequence of Motion
        The character's clips.
    root_joint : int
        The joint whose x and y are the origin of a shape; -1: the centre of the mesh's bounding rectangle.
    to_ground : (3, 4) or (4, 4) array, optional
        The map from the joints' frame to metres, z up.
    """
    arrays = _Arrays()
    joints, bones = instances(joints, Joint, "joints"), instances(bones, Bone, "bones")
    motions = instances(motions, Motion, "motions")
    points, corners = table(vertices, f4, 3, "vertices"), table(triangles, u4, 3, "triangles")
    names = (c_char_p * len(joints))(*[encoded(joint.name, "a name") for joint in joints])
    clips = (_library.Clip * len(motions))(*[arrays.motion(motion) for motion in motions])
    parents = np.array([bounded(joint.parent, "a parent", -1, 2**31 - 1) for joint in joints], np.int32)
    bone_joints = np.array([bounded(bone.joint, "the joint of a bone", 0, 2**32 - 1) for bone in bones], u4)
    given = _library.CharacterArrays(
        root_joint=bounded(root_joint, "root_joint", -1, 2**31 - 1),
        name=encoded(name, "name"),
        vertices=address(points),
        vertex_count=len(points),
        triangles=address(corners),
        triangle_count=len(corners),
        parents=address(parents),
        rests=arrays.maps([joint.rest for joint in joints], "the rest of joint"),
        joint_names=ctypes.addressof(names),
        joint_count=len(joints),
        bone_joints=address(bone_joints),
        inverse_binds=arrays.maps([bone.inverse_bind for bone in bones], "the inverse_bind of bone"),
        bone_count=len(bones),
        clips=ctypes.addressof(clips),
        clip_count=len(motions),
        to_ground=None if to_ground is None else arrays.maps([to_ground], "to_ground"),
    )
    if (vertex_bones is None) != (weights is None):
        raise ArgumentError("vertex_bones and weights: one of them is None")
    if vertex_bones is not None and weights is not None:
        arrays.influences(vertex_bones, weights, len(points), given)
    return Character(Handle("character", "create", byref(given)))
