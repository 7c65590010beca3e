# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Bodies of spheres, in space."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_size_t, c_uint32
from typing import Any, List, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import SPHERE, Records, UInt32, address, bounded, encoded, f4, given, index, instance, instances, listed, number, pair, records, rejected, table, u4, u8
from ._library import Exclusive, Handle, check, lib
from ._poses import custom_poses
from ._progress import Watched
from ._shapes import Character, Path, _as_poses


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
        self._take(Handle("body_set", "create", address(spheres), address(offsets), len(rows)))

    def _take(self, owner: Handle, pointer: int = 0) -> None:
        self._handle, self._pointer = owner, pointer or owner.pointer

    @classmethod
    def _lent(cls, owner: Handle, pointer: int) -> BodySet:
        """Return a view of bodies that belong to another object."""
        bodies = cls.__new__(cls)
        bodies._take(owner, pointer)
        return bodies

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
        return records(lib.bch_body_set_get_spheres, SPHERE, self._pointer, index(body, "body", len(self)))

    def __repr__(self) -> str:
        return f"<bch.BodySet of {len(self)}>"


def _spheres_of(call: Any, *arguments: Any) -> npt.NDArray[np.float32]:
    """Return what a call writes of spheres."""
    spheres, count = np.empty((4096, 4), f4), c_size_t()
    check(call(*arguments, address(spheres), len(spheres), byref(count)))
    return spheres[: count.value].copy()


def spheres_from_capsules(capsules: npt.ArrayLike, *, error: float = 0.005) -> npt.NDArray[np.float32]:
    """Return spheres that together enclose capsules, such as those of a ragdoll.

    Parameters
    ----------
    capsules : (k, 7) array
        x, y and z of one end, those of the other, and the radius, metres.
    error : float
        How far spheres may protrude from the capsules at most, metres.

    Returns
    -------
    (n, 4) float32
        x, y, z and radius of each sphere, as `BodySet` and `BodyModel.from_spheres` take them.
    """
    array = table(capsules, f4, 7, "capsules")
    return _spheres_of(lib.bch_spheres_from_capsules, address(array), len(array), number(error, "error"))


def spheres_from_polygons(
    polygons: Sequence[npt.ArrayLike], heights: Tuple[float, float], *, error: float = 0.05
) -> npt.NDArray[np.float32]:
    """Return spheres that together enclose upright prisms over polygons, such as a cart.

    Parameters
    ----------
    polygons : sequence of (k, 2) arrays
        Corners in metres, relative to the agent's position, in either orientation.
    heights : (bottom, top)
        Bottom and top of the prisms above the agent's ground, metres.
    error : float
        How far spheres may protrude from the prisms at most, metres.

    Returns
    -------
    (n, 4) float32
        x, y, z and radius of each sphere, as `BodySet` and `BodyModel.from_spheres` take them.
    """
    corners = [table(each, f4, 2, f"polygons[{i}]") for i, each in enumerate(listed(polygons, "polygons", "polygons"))]
    offsets = np.zeros(len(corners) + 1, u8)
    np.cumsum([len(each) for each in corners], out=offsets[1:])
    points = np.concatenate(corners) if corners else np.empty((0, 2), f4)
    bottom, top = pair(heights, "heights")
    between = _library.Heights(bottom=bottom, top=top)
    arguments = address(points), address(offsets), len(corners), byref(between), number(error, "error")
    return _spheres_of(lib.bch_spheres_from_polygons, *arguments)


class BodyModel:
    """A character as spheres that move with its skeleton and enclose every triangle of its skin in any pose.

    Parameters
    ----------
    character : Character
    spheres : int
        At most 4096. More spheres fit more closely and take longer.
    draft : bool
        Make the model in seconds instead of up to a minute. Its errors are about twice as large.
    progress : bool
        Show a progress bar on standard error. Ctrl-C ends the work in any case.
    """

    __slots__ = ("_handle", "_pointer")

    def __init__(self, character: Character, spheres: int = 256, *, draft: bool = False, progress: bool = False) -> None:
        how = _library.BodyOptions(spheres=bounded(spheres, "spheres", 1, 4096), draft=bool(draft))
        made = instance(character, Character, "character")._pointer
        with Watched("model", progress) as watched:
            work = _library.Work(progress=watched.callback)
            self._handle = Handle("body_model", "make", made, byref(how), byref(work), checked=watched.run)
        self._pointer = self._handle.pointer

    @classmethod
    def _of(cls, handle: Handle) -> BodyModel:
        """Return a model that was made elsewhere."""
        model = cls.__new__(cls)
        model._handle, model._pointer = handle, handle.pointer
        return model

    @classmethod
    def from_spheres(cls, spheres: npt.ArrayLike) -> BodyModel:
        """Return the model of a rigid body, such as a cart, made of spheres: (n, 4) numbers, x, y, z and radius, metres.

        Its poses are the rest pose, or transforms of its only joint.
        """
        array = table(spheres, f4, 4, "spheres")
        return cls._of(Handle("body_model", "from_spheres", address(array), len(array)))

    def __len__(self) -> int:
        count = c_uint32()
        check(lib.bch_body_model_get_sphere_count(self._pointer, byref(count)))
        return count.value

    def __repr__(self) -> str:
        return f"<bch.BodyModel of {len(self)} spheres>"


def default_body(character: Character, spheres: int = 256) -> BodyModel:
    """Return the model that comes with the library for a built-in character. This takes milliseconds.

    Parameters
    ----------
    character : Character
        `default_male()`, `default_female()`, or a pedestrian.
    spheres : int
        64, 128, 256 or 512.
    """
    made = instance(character, Character, "character")._pointer
    return BodyModel._of(Handle("body_model", "default", made, bounded(spheres, "spheres", 1, 4096)))


def _pointers(models: Sequence[BodyModel]) -> npt.NDArray[Any]:
    return np.array([model._pointer for model in models], u8)


def save_models(path: Path, models: Union[BodyModel, Sequence[BodyModel]]) -> None:
    """Write models and their characters to a baked file, for `load_models`. The characters' own files are not needed to load
    it.

    Parameters
    ----------
    path : str or path
    models : BodyModel or sequence of BodyModel
    """
    pointers = _pointers([models] if isinstance(models, BodyModel) else instances(models, BodyModel, "models"))
    check(lib.bch_body_models_save(address(pointers), len(pointers), encoded(path, "path")))


def load_models(path: Path) -> List[BodyModel]:
    """Return the models of a baked file that `save_models` or the program's `bch bake --spheres` wrote."""
    models: List[BodyModel] = []
    count = c_size_t(1)
    while len(models) < count.value:
        handle = Handle("body_model", "load", encoded(path, "path"), len(models), byref(count))
        if handle.pointer:
            models.append(BodyModel._of(handle))
    return models


class LiveBodies:
    """One body of spheres per agent, each in a new pose of its own in every frame.

    Parameters
    ----------
    models : BodyModel or sequence of BodyModel
    model_of_body : (n,) uint32, or int
        Index of each body's model; or a number n, for n bodies of the first model. Bodies begin in the rest pose.

    Examples
    --------
    >>> people = bch.LiveBodies(bch.BodyModel(bch.default_male()), 1000)
    >>> people.pose(bch.Transforms(matrices))  # (1000, joints, 4, 4), in every frame
    >>> crowd.collisions(people.bodies, agents)
    """

    __slots__ = ("_handle", "_exclusive", "bodies")

    def __init__(self, models: Union[BodyModel, Sequence[BodyModel]], model_of_body: Union[int, UInt32]) -> None:
        all_models = [models] if isinstance(models, BodyModel) else instances(models, BodyModel, "models")
        if isinstance(model_of_body, (int, np.integer)):
            model_of_body = np.zeros(bounded(model_of_body, "model_of_body", 0, 2**32 - 2), u4)
        which = given(model_of_body, u4, (None,), "model_of_body")
        pointers = _pointers(all_models)
        self._exclusive = Exclusive("LiveBodies")
        self._handle = Handle("live_bodies", "create", address(pointers), len(pointers), which, len(model_of_body))
        lent = ctypes.c_void_p()
        check(lib.bch_live_bodies_get_set(self._handle.pointer, byref(lent)))
        #: The bodies in their last poses, for queries.
        self.bodies = BodySet._lent(self._handle, lent.value or 0)

    def pose(self, poses: Any, *, threads: int = 0) -> None:
        """Pose all bodies, with one pose per body. No query may run at the same time.

        Parameters
        ----------
        poses : (n,) POSE, a sequence of (clip, seconds), or Transforms
        threads : int
            Number of threads; 0: all processors.
        """
        custom = custom_poses(poses)
        array: Any = _as_poses(poses) if custom is None else custom
        if len(array) != len(self.bodies):
            raise rejected(poses, "poses", f"one pose for each of {len(self.bodies)} bodies")
        of_arrays, of_clips = lib.bch_live_bodies_pose_from_arrays, lib.bch_live_bodies_pose
        call, data = (of_clips, address(array)) if custom is None else (of_arrays, byref(custom.struct))
        with self._exclusive:
            check(call(self._handle.pointer, data, bounded(threads, "threads", 0, 1024)))

    def __repr__(self) -> str:
        return f"<bch.LiveBodies of {len(self.bodies)}>"
