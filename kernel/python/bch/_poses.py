# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Poses as arrays of the caller, for all calls that take poses of one character."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import address, as_array, f4, f8, one_of, rejected

_spaces = {"parent": 0, "world": 1, "palette": 2}
_VERTICES, _FLOAT_ROWS, _DOUBLE_ROWS = 3, 0, 2


class Transforms(NamedTuple):
    """Poses given by affine transforms, instead of (clip, seconds).

    The transforms that `Character.transforms` returns for a pose of a clip give the same shape as this pose, bit for bit.
    """

    transforms: npt.ArrayLike  #: (frames, joints, 4, 4) or (frames, joints, 3, 4), of any dtype of floats and any strides
    #: "parent": each joint in its parent's frame; "world": each joint in the world, metres, z up; "palette": skinning matrices,
    #: one per bone: the joint's world transform times the inverse bind matrix
    space: str = "world"
    origins: Optional[npt.ArrayLike] = None  #: (frames, 2), for palettes: x and y of the shapes' origins


class Vertices(NamedTuple):
    """Poses given by the positions of all vertices, instead of (clip, seconds)."""

    positions: npt.ArrayLike  #: (frames, n, 3), of any dtype of floats: metres, z up, relative to the origin of the shape


def _floats(values: npt.ArrayLike, name: str, shapes: Tuple[Tuple[int, ...], ...]) -> npt.NDArray[Any]:
    """Return floats as they are or, where they are neither float32 nor float64, as float32 or float64."""
    array = as_array(values, name)
    if array.dtype.kind != "f" or array.ndim != 2 + len(shapes[0]) or array.shape[2:] not in shapes:
        wanted = " or ".join(f"(frames, n, {', '.join(map(str, shape))})" for shape in shapes)
        raise rejected(values, name, f"an array of floats with shape {wanted}")
    return np.ascontiguousarray(array, f4 if array.dtype.itemsize <= 4 else f8)


class CustomPoses:
    """Custom poses as the library takes them, with the arrays that they point to."""

    def __init__(self, poses: Any) -> None:
        if isinstance(poses, Vertices):
            self._array = np.ascontiguousarray(_floats(poses.positions, "positions", ((3,),)), f4)
            kind, layout, stride = _VERTICES, _FLOAT_ROWS, 0
        else:
            self._array = _floats(poses.transforms, "transforms", ((3, 4), (4, 4)))
            kind = one_of(_spaces, poses.space, "space")
            layout = _FLOAT_ROWS if self._array.dtype == f4 else _DOUBLE_ROWS
            stride = 4 * self._array.shape[2]
        self._origins = None
        if isinstance(poses, Transforms) and poses.origins is not None:
            self._origins = np.ascontiguousarray(as_array(poses.origins, "origins"), f8)
            if self._origins.shape != (len(self._array), 2):
                raise rejected(poses.origins, "origins", f"an array with shape ({len(self._array)}, 2)")
        self.struct = _library.PoseArrays(
            kind=kind,
            layout=layout,
            data=address(self._array),
            count=self._array.shape[1],
            stride=stride,
            origins=None if self._origins is None else address(self._origins),
        )

    def __len__(self) -> int:
        return len(self._array)


def custom_poses(poses: Any) -> Optional[CustomPoses]:
    """Return custom poses, or None for those of clips."""
    return CustomPoses(poses) if isinstance(poses, (Transforms, Vertices)) else None
