# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Characters, and the sets of shapes that queries take."""

from __future__ import annotations

import ctypes
import os
from ctypes import byref, c_char_p, c_float, c_size_t, c_uint32
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from . import _library
from ._animated import AnimatedShape
from ._arrays import (
    DISC,
    POSE,
    POSE_ID,
    Float32,
    Float64,
    Records,
    UInt32,
    address,
    as_array,
    bounded,
    converted,
    copied,
    encoded,
    f4,
    f8,
    given,
    index,
    instance,
    instances,
    listed,
    number,
    one_of,
    pair,
    records,
    table,
    u4,
    u8,
    integer,
)
from ._library import ArgumentError, ArrayError, Exclusive, Handle, check, lib, said
from ._poses import custom_poses
from ._progress import Watched

Path = Union[str, "os.PathLike[str]"]
#: The depth of a level that has all discs of a shape.
ALL_DEPTHS = 0xFFFFFFFF
#: The clip of the rest pose, which belongs to no clip.
REST_POSE = 0xFFFFFFFF


class Plan(NamedTuple):
    """Which levels and data a set stores for each shape. Nothing else is built."""

    depths: Sequence[int] = (ALL_DEPTHS,)  #: levels of detail, ascending: depths of the disc trees; 0: one disc, ALL_DEPTHS: all discs
    outlines: bool = True  #: keep outlines; without them, discs decide whether agents collide
    culling: bool = True  #: keep culling data, which lets queries skip most of their work; changes no answer
    heights: bool = False  #: keep the heights of bodies, for agents at different heights
    threshold: float = 0.01  #: the radius below which discs are not divided, metres


class _CPlan:
    """A plan as the library takes it, with the arrays that it points to."""

    def __init__(self, plan: Plan) -> None:
        depths = enumerate(listed(instance(plan, Plan, "plan").depths, "depths", "whole numbers"))
        self.depths = np.array([bounded(depth, f"depths[{i}]", 0, ALL_DEPTHS) for i, depth in depths], u4)
        self.struct = _library.Plan(
            outlines=bool(plan.outlines),
            culling=bool(plan.culling),
            heights=bool(plan.heights),
            depths=address(self.depths),
            depth_count=len(self.depths),
            threshold=number(plan.threshold, "threshold"),
        )
        self._pointer = ctypes.addressof(self.struct)


@overload
def depth_at_density(people_per_square_metre: float) -> int: ...
@overload
def depth_at_density(people_per_square_metre: Float64) -> UInt32: ...
def depth_at_density(people_per_square_metre: Union[float, Float64]) -> Union[int, UInt32]:
    """Return the depth of the disc trees to use at a density of people.

    It is 0 if false collisions of single cylinders stop a walking person at most once a second, else ALL_DEPTHS. Densities are
    in people per square metre; for an array, one depth per entry.
    """
    if isinstance(people_per_square_metre, np.ndarray):
        densities = converted(people_per_square_metre, f8, "people_per_square_metre")
        return np.array([depth_at_density(float(density)) for density in densities], u4)
    density = number(people_per_square_metre, "people_per_square_metre")
    if not 0 <= density < float("inf"):
        raise ArgumentError(f"people_per_square_metre is {people_per_square_metre}")
    depth = c_uint32()
    check(lib.bch_depth_at_density(density, byref(depth)))
    return depth.value


def _contours(get: Any, *of: int) -> List[Float32]:
    outline = _library.Outline()
    check(get(*of, byref(outline)))
    points, offsets = np.empty((outline.point_count, 2), f4), np.empty(outline.offset_count, u8)
    outline.points, outline.point_capacity = address(points), len(points)
    outline.offsets, outline.offset_capacity = address(offsets), len(offsets)
    check(get(*of, byref(outline)))
    return [points[int(begin) : int(end)] for begin, end in zip(offsets[:-1], offsets[1:])]


class Clip(NamedTuple):
    """A motion of a character."""

    name: str
    seconds: float


class Character:
    """A character: a mesh, a skeleton and clips. `default_male`, `default_female` and `import_character` make one.

    `height` is that of an imported file's rest pose, metres; 0 for other characters.
    """

    __slots__ = ("_handle", "_pointer", "name", "notes", "joints", "vertices", "triangles", "height", "clips")

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        self._pointer: int = handle.pointer
        info = _library.CharacterInfo()
        check(lib.bch_character_get_info(self._pointer, byref(info)))
        self.name: str = info.name.decode(errors="replace")
        self.notes: List[str] = said(info.notes).splitlines()
        self.joints, self.vertices, self.triangles = info.joints, info.vertices, info.triangles
        self.height: float = info.height
        self.clips: List[Clip] = [self._clip(i) for i in range(info.clips)]

    def _clip(self, i: int) -> Clip:
        name, seconds = c_char_p(), c_float()
        check(lib.bch_character_get_clip(self._pointer, i, byref(name), byref(seconds)))
        return Clip((name.value or b"").decode(errors="replace"), seconds.value)

    def sample_poses(self, count: int) -> Records:
        """Return `count` poses, spread evenly over all clips.

        Returns
        -------
        (count,) POSE
            Records of clip and seconds.
        """
        poses = np.empty(bounded(count, "count", 0, 2**31), POSE)
        check(lib.bch_character_sample_poses(self._pointer, count, address(poses)))
        return poses

    def joint(self, name: str) -> int:
        """Return the index of the joint of a name."""
        found = c_uint32()
        check(lib.bch_character_find_joint(self._pointer, encoded(name, "name"), byref(found)))
        return found.value

    @property
    def joint_names(self) -> List[str]:
        """The names of all joints."""
        name, names = c_char_p(), []
        for joint in range(self.joints):
            check(lib.bch_character_get_joint(self._pointer, joint, byref(name), None))
            names.append((name.value or b"").decode(errors="replace"))
        return names

    def transforms(self, poses: Any, space: str = "parent") -> Float64:
        """Return the transforms of all joints in poses of clips, for `Transforms`.

        Parameters
        ----------
        poses : (n,) POSE, or a sequence of (clip, seconds)
        space : {"parent", "world"}

        Returns
        -------
        (n, joints, 3, 4) float64
        """
        array, kind = _as_poses(poses), one_of({"parent": 0, "world": 1}, space, "space")
        rows = np.empty((len(array), self.joints, 3, 4), f8)
        for pose, to in zip(array, rows):
            check(lib.bch_character_get_transforms(self._pointer, _library.Pose(*pose.item()), kind, address(to)))
        return rows

    def blend(self, poses: Any, weights: npt.ArrayLike) -> Float64:
        """Return the transforms of all joints in the weighted mean of poses of clips, each in its parent's frame.

        Parameters
        ----------
        poses : (n,) POSE, or a sequence of (clip, seconds)
        weights : (n,) array

        Returns
        -------
        (joints, 3, 4) float64
        """
        array, factors = _as_poses(poses), converted(weights, f4, "weights")
        if factors.shape != (len(array),):
            raise ArrayError(f"weights has shape {factors.shape}, and there are {len(array)} poses")
        rows = np.empty((self.joints, 3, 4), f8)
        check(lib.bch_character_blend(self._pointer, address(array), address(factors), len(array), address(rows)))
        return rows

    def posed_vertices(self, poses: Any) -> Float32:
        """Return the positions of all vertices in poses of clips, metres, z up, relative to the origin of the shape.

        Parameters
        ----------
        poses : (n,) POSE, or a sequence of (clip, seconds)

        Returns
        -------
        (n, vertices, 3) float32
        """
        array = _as_poses(poses)
        positions = np.empty((len(array), self.vertices, 3), f4)
        for pose, to in zip(array, positions):
            check(lib.bch_character_get_vertices(self._pointer, _library.Pose(*pose.item()), address(to)))
        return positions

    def __repr__(self) -> str:
        return f"<bch.Character {self.name!r}: {self.triangles} triangles, {len(self.clips)} clips>"


def _pointers(characters: Sequence[Character], name: str) -> Any:
    found = instances(characters, Character, name)
    return (ctypes.c_void_p * len(found))(*[character._pointer for character in found])


def default_male() -> Character:
    """Make the built-in man, who is 1.88 m tall and needs no file."""
    return Character(Handle("character", "default", 0))


def default_female() -> Character:
    """Make the built-in woman, who is 1.74 m tall and needs no file."""
    return Character(Handle("character", "default", 1))


def default_bulky_male() -> Character:
    """Make the built-in bulky man, who needs no file."""
    return Character(Handle("character", "default", 2))


def default_pedestrian(sex: str = "male", stature: float = 1.75, shoulders: float = 0.0) -> Character:
    """Make a pedestrian for recorded and simulated crowds: the built-in man or woman, scaled to a stature.

    Clip k is one stride at a speed of k * 0.03 m/s, from 0 to 2.19 m/s, and begins when the left heel touches the ground. The arms are
    kept close to the body. The origin of the shape is under the head, because cameras track heads.

    Parameters
    ----------
    sex : {"female", "male"}
    stature : float
        Metres, from 0.8 to 2.4.
    shoulders : float
        How far the shoulders are turned from the direction of motion, radians, counter-clockwise.
    """
    tall, turned = number(stature, "stature"), number(shoulders, "shoulders")
    return Character(Handle("character", "pedestrian", one_of({"female": 0, "male": 1}, sex, "sex"), tall, turned))


def pedestrian_strides_per_second(speed: float) -> float:
    """Return the number of strides per second, of two steps each, of a pedestrian at a speed in m/s."""
    return float(lib.bch_pedestrian_strides_per_second(number(speed, "speed")))


def import_character(
    path: Path,
    *,
    up: Optional[str] = None,
    scale: float = 0.0,
    clip_files: Sequence[Path] = (),
    force_clips: bool = False,
    max_triangles: int = 0x7FFFFFFF,
    timeout: float = 60.0,
    memory_limit: int = 2 << 30,
) -> Character:
    """Read a character from a file: glTF 2, FBX, Collada, MD5, IQM, OBJ, PLY or STL.

    A child process reads the file, within limits, so a malformed file cannot harm the calling process. Ctrl-C interrupts it.

    Parameters
    ----------
    path : path
    up : {"x", "y", "z"}, optional
        The axis that points up, instead of the one that the file states.
    scale : float
        Metres per unit of the file; 0: what the file states, or a guess. The character's `notes` tell which.
    clip_files : sequence of paths
        Files whose clips follow those of the character's own file.
    force_clips : bool
        Also accept clips that belong to another skeleton.
    max_triangles, timeout, memory_limit
        Limits of reading: number of triangles, seconds, bytes.
    """
    paths = [encoded(file, f"clip_files[{i}]") for i, file in enumerate(listed(clip_files, "clip_files", "paths"))]
    files = (c_char_p * len(paths))(*paths)
    axis = -1 if up is None else one_of({"x": 0, "y": 1, "z": 2}, up, "up")
    with Watched("importing", False) as watched:
        options = _library.ImportOptions(
            up=axis,
            scale=number(scale, "scale"),
            force_clips=bool(force_clips),
            clip_files=ctypes.addressof(files),
            clip_file_count=len(paths),
            max_triangles=bounded(max_triangles, "max_triangles", 1, 2**63 - 1),
            seconds=number(timeout, "timeout"),
            memory=bounded(memory_limit, "memory_limit", 1, 2**63 - 1),
            progress=watched.callback,
        )
        return Character(
            Handle("character", "import", encoded(path, "path"), byref(options), checked=watched.run)
        )


def _as_poses(poses: Any, name: str = "poses") -> Records:
    if isinstance(poses, (list, tuple)):
        pairs = [pose.item() if isinstance(pose, np.void) else pose for pose in poses]
        if not all(isinstance(each, tuple) and len(each) == 2 for each in pairs):
            raise ArrayError(f"{name} is a {type(poses).__name__} of others than (clip, seconds)")
        timed = [(bounded(clip, f"a clip of {name}", 0, REST_POSE), number(at, f"seconds of {name}")) for clip, at in pairs]
        return np.array(timed, POSE)
    array: Records = poses
    given(array, POSE, (None,), name)
    return array


class ShapeBuilder:
    """Makes the outlines of a character, one pose at a time.

    Parameters
    ----------
    character : Character
    """

    __slots__ = ("_handle", "_pointer", "_clips", "_exclusive")

    def __init__(self, character: Character) -> None:
        self._clips = len(instance(character, Character, "character").clips)
        self._exclusive = Exclusive("ShapeBuilder")
        self._handle = Handle("shape_builder", "create", character._pointer, None)
        self._pointer: int = self._handle.pointer

    def outline(self, clip: int = REST_POSE, seconds: float = 0.0) -> List[Float32]:
        """Return the outline of a pose: closed contours, counter-clockwise, of points in metres.

        Parameters
        ----------
        clip : int
            Index in `Character.clips`, or REST_POSE.
        seconds : float
            Time from the start of the clip.
        """
        of = integer(clip, "clip")
        of = of if of == REST_POSE else index(of, "clip", self._clips)
        at = number(seconds, "seconds")
        with self._exclusive:
            check(lib.bch_shape_builder_make(self._pointer, _library.Pose(of, at)))
            return _contours(lib.bch_shape_builder_get_outline, self._pointer)


class Origin(NamedTuple):
    """The character, clip and time that a shape was made from; None if unknown, and for the rest pose."""

    character: Optional[str]
    clip: Optional[str]
    seconds: float


class KeptClip(NamedTuple):
    """An animated body that a set stores, with its names."""

    character: str
    clip: Optional[str]
    shape: AnimatedShape


class ShapeSet:
    """A set of shapes of bodies, ready for queries. Any number of threads may query a set at once.

    `ShapeSet.load` maps a baked file, `bake` makes a set from characters, and `ShapeSetBuilder` makes one from polygons,
    capsules, discs, meshes and chosen poses.

    Attributes: `depths`, the depth of each level; `outlines`, whether outlines are kept (if not, discs decide collisions);
    `exact_leaves`, whether leaves="segments" has an effect at some level of some shape; `has_heights`, whether agents may have
    a z.
    """

    __slots__ = ("_owner", "_pointer", "shape_count", "depths", "has_heights", "outlines", "exact_leaves", "nbytes")

    def __init__(self, pointer: int, owner: Any) -> None:
        self._owner = owner
        self._pointer = pointer
        info = _library.ShapeSetInfo()
        check(lib.bch_shape_set_get_info(pointer, byref(info)))
        self.shape_count: int = info.shapes
        self.depths: Tuple[int, ...] = tuple(copied(info.depths, u4, (info.levels,)).tolist())
        self.has_heights, self.outlines = bool(info.has_heights), bool(info.outlines)
        self.exact_leaves, self.nbytes = bool(info.exact_leaves), int(info.bytes)

    @classmethod
    def load(cls, path: Path, mapped: bool = True) -> ShapeSet:
        """Load a baked file.

        Parameters
        ----------
        path : path
        mapped : bool
            Map the file instead of reading it. This makes no copy. No process may then write to the file or shorten it while the set
            lives: that would end the calling process. Replacing it by another file is fine.
        """
        handle = Handle("shape_set", "load", encoded(path, "path"), int(mapped))
        return cls(handle.pointer, handle)

    @classmethod
    def from_polygons(
        cls,
        bodies: Sequence[Sequence[npt.ArrayLike]],
        *,
        heights: Optional[Sequence[Tuple[float, float]]] = None,
        plan: Plan = Plan(),
    ) -> ShapeSet:
        """Make a set from footprints.

        Parameters
        ----------
        bodies : sequence of sequences of (k, 2) arrays
            The polygons of each body, metres, relative to the agent's position, in either orientation.
        heights : sequence of (bottom, top), optional
            The range of heights that each body occupies, metres; by default all heights.
        plan : Plan
        """
        builder = ShapeSetBuilder(plan)
        bodies = listed(bodies, "bodies", "sequences of polygons")
        ranges = [None] * len(bodies) if heights is None else listed(heights, "heights", "(bottom, top)")
        if len(ranges) < len(bodies):
            raise ArgumentError(f"heights has length {len(ranges)}, and there are {len(bodies)} bodies")
        for i, polygons in enumerate(bodies):
            builder._add_polygons(polygons, ranges[i], f"bodies[{i}]")
        return builder.finish()

    def save(self, path: Path) -> None:
        """Write the set as a baked file. The file is written completely or not at all."""
        check(lib.bch_shape_set_save(self._pointer, encoded(path, "path")))

    def __len__(self) -> int:
        return self.shape_count

    def discs(self, shape: int, level: int = -1) -> Records:
        """Return the discs of a shape at a level, in the order in which queries number them.

        Parameters
        ----------
        shape : int
        level : int
            Index into `depths`; negative indices count from the end.

        Returns
        -------
        (n,) DISC
            Records of x, y and radius, metres.
        """
        number = integer(level, "level")
        number += len(self.depths) if number < 0 else 0
        shape, number = index(shape, "shape", self.shape_count), index(number, "level", len(self.depths))
        return records(lib.bch_shape_set_get_discs, DISC, self._pointer, shape, number)

    def outline(self, shape: int) -> List[Float32]:
        """Return the outline of a shape: closed contours, counter-clockwise, of points in metres.

        Parameters
        ----------
        shape : int

        Returns
        -------
        list of (k, 2) float32
        """
        shape = index(shape, "shape", self.shape_count)
        return _contours(lib.bch_shape_set_get_outline, self._pointer, shape)

    def radius(self, shape: int) -> float:
        """Return the radius, in metres, of the disc about an agent's position that covers its shape at every heading."""
        radius = c_float()
        shape = index(shape, "shape", self.shape_count)
        check(lib.bch_shape_set_get_radius(self._pointer, shape, byref(radius)))
        return radius.value

    def origin(self, shape: int) -> Origin:
        """Return the character, clip and time that a shape was made from."""
        origin = _library.ShapeOrigin()
        shape = index(shape, "shape", self.shape_count)
        check(lib.bch_shape_set_get_origin(self._pointer, shape, byref(origin)))
        character, clip = (None if name is None else name.decode() for name in (origin.character, origin.clip))
        return Origin(character, clip, origin.seconds)

    def keep_clip(self, shape: AnimatedShape, character: str, clip: Optional[str] = None) -> None:
        """Store an animated body, with its names, in the set. `save` writes it with the shapes."""
        body, name = instance(shape, AnimatedShape, "shape"), None if clip is None else encoded(clip, "clip")
        check(lib.bch_shape_set_add_clip(self._pointer, body._pointer, encoded(character, "character"), name))

    @property
    def clips(self) -> List[KeptClip]:
        """The animated bodies: those of the loaded file, and those that `keep_clip` added."""
        count = c_size_t()
        check(lib.bch_shape_set_get_clip_count(self._pointer, byref(count)))
        return [self._clip(i) for i in range(count.value)]

    def _clip(self, i: int) -> KeptClip:
        names = c_char_p(), c_char_p()
        handle = Handle("shape_set", "get_clip", self._pointer, i, *map(byref, names), free="animated_shape")
        character, clip = (None if name.value is None else name.value.decode(errors="replace") for name in names)
        return KeptClip(character or "", clip, AnimatedShape._of(handle))

    def __reduce__(self) -> Any:
        raise TypeError("a bch.ShapeSet cannot be pickled; save() it, and load() the file elsewhere, which maps it")

    def verify(self, most: int = 100) -> List[str]:
        """Check a set from an untrusted file: recompute from discs and outlines all other data of the shapes, and compare.

        Returns
        -------
        list of str
            One line per difference, at most `most`; none for sets that the library made.
        """
        lines: List[str] = []
        callback = _library.Inconsistency(lambda _, line: lines.append(line.decode(errors="replace")))
        count = c_size_t()
        check(lib.bch_shape_set_verify(self._pointer, bounded(most, "most", 0, 2**31), callback, None, byref(count)))
        return lines

    def __repr__(self) -> str:
        return f"<bch.ShapeSet of {self.shape_count} shapes, {len(self.depths)} levels, {self.nbytes / 1e6:.1f} MB>"


class ShapeSetBuilder:
    """Builds a set body by body. Shapes are numbered in the order in which they are added.

    If the plan keeps heights, polygons, capsules, discs and cylinders may have a range of heights, (bottom, top) in metres; by
    default they are infinitely high.

    Parameters
    ----------
    plan : Plan
    """

    __slots__ = ("_handle", "_pointer", "_exclusive", "_has_heights")

    def __init__(self, plan: Plan = Plan()) -> None:
        c_plan = _CPlan(plan)
        self._handle = Handle("shape_set_builder", "create", c_plan._pointer)
        self._pointer: int = self._handle.pointer
        self._exclusive = Exclusive("ShapeSetBuilder")
        self._has_heights = bool(plan.heights)

    def _heights(self, heights: Optional[Tuple[float, float]]) -> Any:
        if heights is None:
            return None
        if not self._has_heights:
            raise ArgumentError("heights are for plans that keep them: Plan(heights=True)")
        bottom, top = pair(heights, "heights")
        return byref(_library.Heights(bottom, top))

    def add_poses(self, character: Character, poses: Any, *, threads: int = 0, progress: bool = False) -> None:
        """Add shapes of a character in poses, on all processors. If Ctrl-C interrupts the work, no shape is added.

        Parameters
        ----------
        character : Character
        poses : (n,) POSE, a sequence of (clip, seconds), Transforms or Vertices
        threads : int
            Number of threads; 0: all processors.
        progress : bool
            Show a progress bar on a terminal.
        """
        instance(character, Character, "character")
        custom = custom_poses(poses)
        array: Any = _as_poses(poses) if custom is None else custom
        with self._exclusive, Watched(f"baking {character.name}", progress) as watched:
            work = _library.Work(threads=bounded(threads, "threads", 0, 1024), progress=watched.callback)
            of_arrays, of_clips = lib.bch_shape_set_builder_add_pose_arrays, lib.bch_shape_set_builder_add_poses
            add, data = (of_clips, address(array)) if custom is None else (of_arrays, byref(custom.struct))
            watched.run(add(self._pointer, character._pointer, data, len(array), byref(work)))

    def add_pose_ids(
        self, characters: Sequence[Character], pose_ids: Records, *, threads: int = 0, progress: bool = False
    ) -> None:
        """Add shapes of several characters in poses, as `plan_scene` lists them. If Ctrl-C interrupts the work, no shape is
        added.

        Parameters
        ----------
        characters : sequence of Character
        pose_ids : (n,) POSE_ID
            Records of character, clip and seconds. `character` is an index in `characters`.
        threads : int
            Number of threads; 0: all processors.
        progress : bool
            Show a progress bar on a terminal.
        """
        which = given(pose_ids, POSE_ID, (None,), "pose_ids")
        pointers = _pointers(characters, "characters")
        with self._exclusive, Watched("baking", progress) as watched:
            work = _library.Work(threads=bounded(threads, "threads", 0, 1024), progress=watched.callback)
            watched.run(
                lib.bch_shape_set_builder_add_pose_ids(
                    self._pointer, pointers, len(pointers), which, len(pose_ids), byref(work)
                )
            )

    def add_polygons(
        self, polygons: Sequence[npt.ArrayLike], *, heights: Optional[Tuple[float, float]] = None
    ) -> None:
        """Add a body of polygons: (k, 2) corners in metres, relative to the agent's position, in either orientation."""
        self._add_polygons(polygons, heights, "polygons")

    def _add_polygons(self, polygons: Any, heights: Optional[Tuple[float, float]], name: str) -> None:
        corners = [table(polygon, f4, 2, f"{name}[{i}]") for i, polygon in enumerate(listed(polygons, name, "polygons"))]
        offsets = np.zeros(len(corners) + 1, u8)
        offsets[1:] = np.cumsum([len(each) for each in corners])
        points = np.concatenate(corners) if corners else np.empty((0, 2), f4)
        with self._exclusive:
            check(
                lib.bch_shape_set_builder_add_polygons(
                    self._pointer, address(points), address(offsets), len(corners), self._heights(heights)
                )
            )

    def add_capsules(
        self, capsules: npt.ArrayLike, *, tolerance: float = 0.001, heights: Optional[Tuple[float, float]] = None
    ) -> None:
        """Add a body of capsules: (k, 5) numbers, x and y of one end, x and y of the other, and the radius, in metres."""
        array, near = table(capsules, f4, 5, "capsules"), number(tolerance, "tolerance")
        with self._exclusive:
            check(
                lib.bch_shape_set_builder_add_capsules(
                    self._pointer, address(array), len(array), near, self._heights(heights)
                )
            )

    def add_discs(self, discs: npt.ArrayLike, *, heights: Optional[Tuple[float, float]] = None) -> None:
        """Add a body of discs: (k, 3) numbers, x, y and radius in metres, or (k,) DISC. Queries number the discs in this order.

        Discs have no outline; capsules have one.
        """
        given_discs = as_array(discs, "discs")
        if given_discs.dtype == DISC:
            given_discs = np.stack([given_discs[name] for name in ("x", "y", "radius")], axis=-1)
        array = table(given_discs, f4, 3, "discs")
        with self._exclusive:
            check(lib.bch_shape_set_builder_add_discs(self._pointer, address(array), len(array), self._heights(heights)))

    def add_cylinder(self, radius: float, *, heights: Optional[Tuple[float, float]] = None) -> None:
        """Add a cylinder about the agent's position, with a radius in metres."""
        with self._exclusive:
            check(lib.bch_shape_set_builder_add_cylinder(self._pointer, number(radius, "radius"), self._heights(heights)))

    def add_mesh(self, positions: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """Add a mesh as it is: (n, 3) positions in metres, z up, and (t, 3) indices of them."""
        points, corners = table(positions, f4, 3, "positions"), table(triangles, u4, 3, "triangles")
        with self._exclusive:
            check(
                lib.bch_shape_set_builder_add_mesh(
                    self._pointer, address(points), len(points), address(corners), len(corners)
                )
            )

    def add_animated_shape(self, shape: AnimatedShape, seconds: float) -> None:
        """Add a snapshot of an animated body: its shape at one time of its clip, in seconds."""
        body, at = instance(shape, AnimatedShape, "shape"), number(seconds, "seconds")
        with self._exclusive:
            check(lib.bch_shape_set_builder_add_animated_shape(self._pointer, body._pointer, at))

    def finish(self) -> ShapeSet:
        """Return the set of all bodies that were added. The builder is then empty."""
        with self._exclusive:
            handle = Handle("shape_set_builder", "finish", self._pointer, free="shape_set")
        return ShapeSet(handle.pointer, handle)


def bake_shapes(
    characters: Union[Character, Sequence[Character]],
    poses: Any = 100,
    *,
    plan: Plan = Plan(),
    path: Optional[Path] = None,
    threads: int = 0,
    progress: bool = False,
) -> ShapeSet:
    """Make the set of shapes that `bake` returns."""
    alone = isinstance(characters, Character)
    people: List[Character] = (
        [characters] if isinstance(characters, Character) else instances(characters, Character, "characters")
    )
    if isinstance(poses, (int, np.integer)):
        count = bounded(poses, "poses", 0, 2**31)
        each = [character.sample_poses(count) for character in people]
    else:
        each = [poses] if alone else listed(poses, "poses", "those of each character")
    if len(each) != len(people):
        raise ArgumentError(f"poses has those of {len(each)} characters, and there are {len(people)}")
    builder = ShapeSetBuilder(plan)
    for character, of_character in zip(people, each):
        builder.add_poses(character, of_character, threads=threads, progress=progress)
    made = builder.finish()
    if path is not None:
        made.save(path)
    return made


class DynamicShapeSet:
    """A set whose shapes can be replaced, for characters with new poses in every frame.

    Parameters
    ----------
    start : ShapeSet
        The set whose shapes and plan it begins with.
    """

    __slots__ = ("_handle", "_pointer", "_exclusive", "shapes")

    def __init__(self, start: ShapeSet) -> None:
        self._exclusive = Exclusive("DynamicShapeSet")
        self._handle = Handle("dynamic_shape_set", "create", instance(start, ShapeSet, "start")._pointer)
        self._pointer: int = self._handle.pointer
        lent = ctypes.c_void_p()
        check(lib.bch_dynamic_shape_set_get_shapes(self._pointer, byref(lent)))
        #: The current shapes, for queries.
        self.shapes = ShapeSet(lent.value or 0, self._handle)

    def replace(
        self,
        character: Character,
        shapes: UInt32,
        poses: Any,
        *,
        threshold: float = 0.01,
        threads: int = 0,
    ) -> None:
        """Replace shapes by new poses of a character, on all processors. No query may run at the same time.

        Parameters
        ----------
        character : Character
        shapes : (n,) uint32
            Indices of the shapes to replace, each once.
        poses : (n,) POSE, a sequence of (clip, seconds), Transforms or Vertices
        threshold : float
            The radius below which discs are not divided, metres.
        threads : int
            Number of threads; 0: all processors.
        """
        instance(character, Character, "character")
        custom, least = custom_poses(poses), number(threshold, "threshold")
        array: Any = _as_poses(poses) if custom is None else custom
        which = given(shapes, u4, (len(array),), "shapes")
        with self._exclusive, Watched("posing", False) as watched:
            work = _library.Work(threads=bounded(threads, "threads", 0, 1024), progress=watched.callback)
            of_arrays, of_clips = lib.bch_dynamic_shape_set_replace_pose_arrays, lib.bch_dynamic_shape_set_replace_poses
            replace, data = (of_clips, address(array)) if custom is None else (of_arrays, byref(custom.struct))
            watched.run(replace(self._pointer, character._pointer, which, data, len(array), least, byref(work)))
