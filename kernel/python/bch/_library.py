# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The shared library: its structs, functions and errors."""

import ctypes
import os
import re
import threading
from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path
from typing import Any, Callable, Dict, List, Type

ABI_VERSION = 1


class Error(Exception):
    """An error of the library. The message names the argument, an index and the value."""


class ArgumentError(Error, ValueError):
    """An argument with an invalid value."""


class ArrayError(Error, TypeError):
    """An array with a dtype, shape or layout that a call does not take, or an object of the wrong type."""


class RangeError(Error, IndexError):
    """An index out of range."""


class SizeError(Error, OverflowError):
    """A size beyond the limits of the library."""


class OutOfMemory(Error, MemoryError):
    """Not enough memory."""


class FileMissing(Error, FileNotFoundError):
    """A file that does not exist."""


class FileError(Error, OSError):
    """A file that cannot be read or written, or is not valid."""


OK, CANCELLED = 0, 7
_errors: Dict[int, Type[Error]] = {
    1: ArgumentError,
    2: RangeError,
    3: SizeError,
    4: OutOfMemory,
    5: FileMissing,
    6: FileError,
}


class Vec2(ctypes.Structure):
    _fields_ = [("x", c_float), ("y", c_float)]


class Heights(ctypes.Structure):
    _fields_ = [("bottom", c_float), ("top", c_float)]


class Pose(ctypes.Structure):
    _fields_ = [("clip", c_uint32), ("seconds", c_float)]


Progress = ctypes.CFUNCTYPE(c_int32, c_void_p, c_uint64, c_uint64)
Finding = ctypes.CFUNCTYPE(None, c_void_p, c_char_p)


class _Sized(ctypes.Structure):
    """A struct that begins with its size."""

    def __init__(self, **values: Any) -> None:
        super().__init__(size=ctypes.sizeof(type(self)), **values)


class Work(_Sized):
    _fields_ = [("size", c_uint32), ("threads", c_uint32), ("progress", Progress), ("user", c_void_p)]


class ImportOptions(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("up", c_int32),
        ("scale", c_float),
        ("force_clips", c_int32),
        ("clip_files", POINTER(c_char_p)),
        ("clip_file_count", c_size_t),
        ("most_triangles", c_uint64),
        ("seconds", c_double),
        ("memory", c_uint64),
        ("progress", Progress),
        ("user", c_void_p),
    ]


class Curve(ctypes.Structure):
    _fields_ = [
        ("times", c_void_p),
        ("values", c_void_p),
        ("tangents", c_void_p),
        ("count", c_size_t),
        ("interpolation", c_int32),
    ]


class Channel(ctypes.Structure):
    _fields_ = [("joint", c_uint32), ("positions", Curve), ("rotations", Curve), ("scales", Curve)]


class Clip(ctypes.Structure):
    _fields_ = [
        ("name", c_char_p),
        ("seconds", c_float),
        ("channels", POINTER(Channel)),
        ("channel_count", c_size_t),
    ]


class CharacterArrays(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("root_joint", c_int32),
        ("name", c_char_p),
        ("vertices", c_void_p),
        ("vertex_count", c_size_t),
        ("triangles", c_void_p),
        ("triangle_count", c_size_t),
        ("parents", c_void_p),
        ("rests", c_void_p),
        ("joint_names", POINTER(c_char_p)),
        ("joint_count", c_size_t),
        ("bone_joints", c_void_p),
        ("inverse_binds", c_void_p),
        ("bone_count", c_size_t),
        ("influence_offsets", c_void_p),
        ("influences", c_void_p),
        ("clips", POINTER(Clip)),
        ("clip_count", c_size_t),
        ("to_ground", c_void_p),
    ]


class SceneAgents(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("character", c_void_p),
        ("poses", c_void_p),
        ("distance", c_void_p),
        ("depth", c_void_p),
        ("count", c_size_t),
    ]


class SceneUse(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("solid", c_int32),
        ("leaves", c_int32),
        ("heights", c_int32),
        ("slices", c_void_p),
        ("slice_count", c_size_t),
        ("whole_from", c_double),
        ("pairs_per_shape", c_double),
        ("pose_step", c_float),
    ]


class CharacterInfo(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("joints", c_uint32),
        ("clips", c_uint32),
        ("height", c_float),
        ("vertices", c_uint64),
        ("triangles", c_uint64),
        ("name", c_char_p),
        ("notes", c_char_p),
    ]


class Plan(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("outlines", c_int32),
        ("culling", c_int32),
        ("heights", c_int32),
        ("depths", c_void_p),
        ("depth_count", c_size_t),
        ("slices", c_void_p),
        ("slice_count", c_size_t),
        ("threshold", c_float),
    ]


class ShapeSetInfo(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("shapes", c_uint32),
        ("levels", c_uint32),
        ("slabs", c_uint32),
        ("has_heights", c_int32),
        ("solid", c_int32),
        ("exact_leaves", c_int32),
        ("bytes", c_uint64),
        ("depths", c_void_p),
        ("slices", c_void_p),
    ]


class NamedMotion(ctypes.Structure):
    _fields_ = [("character", c_char_p), ("clip", c_char_p)]


class ShapeOrigin(ctypes.Structure):
    _fields_ = [("character", c_char_p), ("clip", c_char_p), ("seconds", c_float)]


class Outline(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("points", c_void_p),
        ("point_capacity", c_size_t),
        ("offsets", c_void_p),
        ("offset_capacity", c_size_t),
        ("point_count", c_size_t),
        ("offset_count", c_size_t),
    ]


class Agents(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("shape", c_void_p),
        ("x", c_void_p),
        ("y", c_void_p),
        ("heading", c_void_p),
        ("level", c_void_p),
        ("z", c_void_p),
        ("count", c_size_t),
    ]


class QueryOptions(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("semantics", c_int32),
        ("leaves", c_int32),
        ("distance_leaves", c_int32),
        ("overlap", c_int32),
        ("threads", c_uint32),
        ("max_distance", c_double),
        ("implementation", c_char_p),
    ]


class ClearanceOut(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("distance", c_void_p),
        ("direction", c_void_p),
        ("discs", c_void_p),
        ("points", c_void_p),
    ]


class IndexRows(ctypes.Structure):
    _fields_ = [("rows", c_size_t), ("offsets", c_void_p), ("values", c_void_p)]


class ContactRows(ctypes.Structure):
    _fields_ = [("rows", c_size_t), ("pairs", c_void_p), ("offsets", c_void_p), ("values", c_void_p)]


class ObstacleArrays(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("x", c_void_p),
        ("y", c_void_p),
        ("path_offsets", c_void_p),
        ("path_count", c_size_t),
        ("obstacle_offsets", c_void_p),
        ("obstacle_count", c_size_t),
        ("is_area", c_void_p),
        ("bottom", c_void_p),
        ("top", c_void_p),
    ]


class AnimateOptions(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("spacing", c_float),
        ("inset", c_float),
        ("error", c_float),
        ("slices", c_void_p),
        ("slice_count", c_size_t),
        ("loops", c_int32),
    ]


class AnimatedArrays(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("loops", c_int32),
        ("key_counts", c_void_p),
        ("disc_counts", c_void_p),
        ("ring_counts", c_void_p),
        ("chunk_count", c_size_t),
        ("times", c_void_p),
        ("discs", c_void_p),
        ("ring_ends", c_void_p),
    ]


class AnimatedShapeInfo(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("loops", c_int32),
        ("begin", c_double),
        ("end", c_double),
        ("reach", c_double),
        ("bytes", c_uint64),
        ("chunks", c_uint64),
        ("keys", c_uint64),
        ("slabs", c_uint64),
    ]


class Motion(ctypes.Structure):
    _fields_ = [("shape", c_void_p), ("path", c_void_p), ("path_count", c_size_t), ("clip_begin", c_double)]


class TrajectoryOptions(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("fps", c_double),
        ("unit", c_double),
        ("columns", c_char_p),
        ("progress", Progress),
        ("user", c_void_p),
    ]


class TrajectoryInfo(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("fps", c_double),
        ("rows", c_uint64),
        ("people", c_uint64),
        ("first_frame", c_int64),
        ("last_frame", c_int64),
        ("format", c_char_p),
        ("geometry", c_char_p),
        ("assumptions", c_char_p),
    ]


class ClipSpeed(ctypes.Structure):
    _fields_ = [("clip", c_char_p), ("speed", c_double)]


class CheckOptions(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("threads", c_uint32),
        ("slices", c_void_p),
        ("slice_count", c_size_t),
        ("max_distance", c_double),
        ("walls", c_void_p),
        ("without_walls", c_int32),
        ("progress", Progress),
        ("user", c_void_p),
        ("depth", c_uint32),
        ("leaves", c_int32),
        ("characters", c_void_p),
        ("character_count", c_size_t),
        ("baked", c_void_p),
        ("clip_speeds", c_void_p),
        ("clip_speed_count", c_size_t),
        ("facing", c_double),
        ("max_pairs", c_size_t),
    ]


class CheckSummary(_Sized):
    _fields_ = [
        ("size", c_uint32),
        ("shapes", c_uint32),
        ("fps", c_double),
        ("frames", c_uint64),
        ("people", c_uint64),
        ("person_frames", c_uint64),
        ("overlapping", c_uint64),
        ("in_walls", c_uint64),
        ("guessed_headings", c_uint64),
        ("near_pairs", c_uint64),
        ("overlapping_near_pairs", c_uint64),
    ]


# Parameters by letters: p pointer or handle, n size_t, u uint32, i int32, f float, d double, s text, P pose.
_letters: Dict[str, Any] = {
    "p": c_void_p,
    "n": c_size_t,
    "u": c_uint32,
    "i": c_int32,
    "f": c_float,
    "d": c_double,
    "s": c_char_p,
    "P": Pose,
}
_functions = {
    "character_default": "ip",
    "character_pedestrian": "iddp",
    "character_create": "pp",
    "character_import": "spp",
    "character_get_info": "pp",
    "character_get_clip": "pupp",
    "character_sample_poses": "pup",
    "character_free": "p",
    "shape_set_load": "sip",
    "shape_set_save": "ps",
    "shape_set_get_info": "pp",
    "shape_set_get_origin": "pup",
    "shape_set_get_radius": "pup",
    "shape_set_get_discs": "puupnp",
    "shape_set_get_slab_offsets": "puup",
    "shape_set_get_outline": "puup",
    "shape_set_verify": "pnppp",
    "shape_set_free": "p",
    "pose_shaper_create": "ppp",
    "pose_shaper_make": "pPi",
    "pose_shaper_get_outline": "pup",
    "pose_shaper_free": "p",
    "shape_set_builder_create": "pp",
    "shape_set_builder_add_poses": "pppnp",
    "shape_set_builder_add_sources": "ppnpnp",
    "shape_set_builder_add_shape": "pp",
    "shape_set_builder_add_polygons": "pppnp",
    "shape_set_builder_add_capsules": "ppnfp",
    "shape_set_builder_add_discs": "ppnp",
    "shape_set_builder_add_cylinder": "pfp",
    "shape_set_builder_add_mesh": "ppnpn",
    "shape_set_builder_finish": "pp",
    "shape_set_builder_free": "p",
    "dynamic_shape_set_create": "pp",
    "dynamic_shape_set_get_shapes": "pp",
    "dynamic_shape_set_replace_poses": "ppppnfp",
    "dynamic_shape_set_free": "p",
    "validate_agents": "pp",
    "collide": "pppnpp",
    "within": "pppnpnpp",
    "clearance": "pppnpp",
    "penetration": "pppnupp",
    "penetration_along": "pppnppp",
    "time_of_impact": "pppnpppp",
    "broad_phase_create": "p",
    "broad_phase_find": "pppdppp",
    "broad_phase_free": "p",
    "crowd_collider_create": "p",
    "crowd_collider_collide_all": "ppppppp",
    "crowd_collider_free": "p",
    "contact_finder_create": "p",
    "contact_finder_find": "ppppnpp",
    "contact_finder_find_all": "ppppp",
    "contact_finder_free": "p",
    "obstacles_create": "pp",
    "obstacles_from_wkt_at": "siddp",
    "obstacles_get_counts": "ppp",
    "obstacles_get_owner": "pup",
    "obstacles_free": "p",
    "obstacles_collide": "ppppp",
    "obstacles_within": "ppppnpp",
    "obstacles_clearance": "ppppp",
    "obstacles_penetration": "ppppp",
    "obstacles_time_of_impact": "ppppppp",
    "animated_shape_animate": "pupp",
    "animated_shape_create": "pp",
    "animated_shape_get_info": "pp",
    "animated_shape_get_discs": "pdpnp",
    "animated_shape_free": "p",
    "shape_set_builder_add_moment": "ppd",
    "shape_set_add_clip": "ppss",
    "shape_set_get_clip_count": "pp",
    "shape_set_get_clip": "pnppp",
    "moment_set_create": "pnpp",
    "moment_set_show": "pppnpp",
    "moment_set_get_shapes": "pp",
    "moment_set_free": "p",
    "first_contact": "pnpndddup",
    "obstacles_first_contact": "pnpdddup",
    "free_until": "ppndddp",
    "trajectory_open": "spp",
    "trajectory_get_info": "pp",
    "trajectory_get_motions": "ppp",
    "trajectory_read_moving": "ppnp",
    "trajectory_free": "p",
    "check_run": "ppp",
    "check_get_summary": "pp",
    "check_get_assumptions": "pp",
    "check_get_frames": "ppp",
    "check_get_pairs": "ppp",
    "check_get_events": "ppp",
    "check_free": "p",
    "local_densities": "ppndp",
    "depth_at_density": "dp",
    "standing_slices": "up",
    "best_slices": "ppnpnupp",
    "scene_plan_create": "ppp",
    "scene_plan_get_set": "pp",
    "scene_plan_get_shapes": "ppp",
    "scene_plan_get_agents": "pppp",
    "scene_plan_free": "p",
}


def _load() -> ctypes.CDLL:
    """Load the library of this package, or the one that the environment variable BCH_LIBRARY names."""
    path = os.environ.get("BCH_LIBRARY") or str(Path(__file__).parent / "libbch.so.1")
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"bch: {error} (it needs Debian's libtbb12, libassimp5, libdraco7, zlib1g, libsqlite3-0, libhdf5-103-1)") from None
    if library.bch_abi_version() != ABI_VERSION:
        raise ImportError(f"bch: {path} has another interface ({library.bch_abi_version()}) than this package ({ABI_VERSION})")
    for name, parameters in _functions.items():
        function = getattr(library, "bch_" + name)
        function.argtypes = [_letters[letter] for letter in parameters]
        function.restype = c_int32
    for name in ("bch_last_error", "bch_version", "bch_implementation_name"):
        getattr(library, name).restype = c_char_p
    library.bch_pedestrian_strides_per_second.argtypes = [c_double]
    library.bch_pedestrian_strides_per_second.restype = c_double
    return library


lib = _load()


#: The arguments whose names are not those of the options that the command-line program has for the same.
_arguments = {"clip-speed": "clip_speeds", "character": "characters", "semantics": "outlines, for semantics"}


def said(text: bytes) -> str:
    """Return what the library says, with the names of arguments in place of options of the command-line program."""
    name = lambda option: _arguments.get(option[1], option[1].replace("-", "_"))  # noqa: E731
    return re.sub(r"(?<![^ (])--([a-z][a-z-]*)", name, text.decode(errors="replace"))


def check(status: int) -> None:
    """Raise the error that a status stands for."""
    if status != OK:
        raise _errors.get(status, Error)(said(lib.bch_last_error()))


class Handle:
    """An object of the library, which is freed with this one."""

    __slots__ = ("pointer", "_free", "__weakref__")

    def __init__(
        self, kind: str, create: str, *arguments: Any, free: str = "", checked: Callable[[int], None] = check
    ) -> None:
        self.pointer: int = 0
        self._free = getattr(lib, f"bch_{free or kind}_free")
        pointer = c_void_p()
        checked(getattr(lib, f"bch_{kind}_{create}")(*arguments, ctypes.byref(pointer)))
        self.pointer = pointer.value or 0

    def __del__(self) -> None:
        if self.pointer:
            self._free(self.pointer)
            self.pointer = 0


class Exclusive:
    """Refuses the second thread that would use an object at the same time."""

    __slots__ = ("_name", "_lock")

    def __init__(self, name: str) -> None:
        self._name, self._lock = name, threading.Lock()

    def __enter__(self) -> None:
        if not self._lock.acquire(blocking=False):
            raise Error(f"this {self._name} is in use by another thread; each thread needs one of its own")

    def __exit__(self, *_: Any) -> None:
        self._lock.release()


def implementations() -> List[str]:
    """Return the names of the implementations that this processor runs, the best first."""
    names = []
    for i in range(16):
        name = lib.bch_implementation_name(i)
        if name is not None and lib.bch_implementation_supported(i):
            names.append(name.decode())
    return names
