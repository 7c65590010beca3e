# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""What goes into the library and comes out of it: arrays by their addresses, and dtypes of what they hold."""

import ctypes
from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._library import ArrayError

UInt8 = npt.NDArray[np.uint8]
UInt32 = npt.NDArray[np.uint32]
UInt64 = npt.NDArray[np.uint64]
Float32 = npt.NDArray[np.float32]
Float64 = npt.NDArray[np.float64]
Bool = npt.NDArray[np.bool_]
Records = npt.NDArray[np.void]
Shape = Tuple[Optional[int], ...]

u1, u4, u8 = np.dtype(np.uint8), np.dtype(np.uint32), np.dtype(np.uint64)
f4, f8, b1 = np.dtype(np.float32), np.dtype(np.float64), np.dtype(np.bool_)

#: A disc on the ground, metres.
DISC = np.dtype([("x", f4), ("y", f4), ("radius", f4)])
#: A time in a clip of a character; clip 0xffffffff is the rest pose.
POSE = np.dtype([("clip", u4), ("seconds", f4)])
#: How far the first agent of a pair has to move, metres, and in which direction, a unit vector.
PENETRATION = np.dtype({"names": ["depth", "x", "y"], "formats": [f4, f8, f8], "offsets": [0, 8, 16], "itemsize": 24})


def address(array: npt.NDArray[Any]) -> int:
    """Return where an array's data begin."""
    return array.ctypes.data


def _words(array: Any) -> str:
    if not isinstance(array, np.ndarray):
        return f"a {type(array).__name__}"
    layout = "" if array.flags.c_contiguous else ", not contiguous"
    return f"an array of {array.dtype} with shape {array.shape}{layout}"


def _shape_words(shape: Shape) -> str:
    return "(" + ", ".join("n" if length is None else str(length) for length in shape) + ("," if len(shape) == 1 else "") + ")"


def fits(array: Any, dtype: np.dtype[Any], shape: Shape) -> bool:
    """Return whether an array can pass without a copy."""
    if not isinstance(array, np.ndarray) or array.dtype != dtype or not array.flags.c_contiguous:
        return False
    found = array.shape
    return len(found) == len(shape) and all(want is None or want == has for want, has in zip(shape, found))


def given(array: Any, dtype: np.dtype[Any], shape: Shape, name: str) -> int:
    """Return the address of an array of the caller, or raise an error that says what is wanted instead."""
    if not fits(array, dtype, shape):
        raise ArrayError(
            f"{name} is {_words(array)}; wanted is a C-contiguous array of {dtype} with shape {_shape_words(shape)}, "
            f"such as numpy.ascontiguousarray({name}, numpy.{dtype})"
        )
    return address(array)


def result(out: Optional[npt.NDArray[Any]], dtype: np.dtype[Any], shape: Tuple[int, ...], name: str = "out") -> npt.NDArray[Any]:
    """Return the caller's array for a result, or a new one."""
    if out is None:
        return np.empty(shape, dtype)
    given(out, dtype, shape, name)
    if not out.flags.writeable:
        raise ArrayError(f"{name} is read-only")
    return out


def copied(pointer: Optional[int], dtype: np.dtype[Any], shape: Tuple[int, ...]) -> npt.NDArray[Any]:
    """Return a copy of memory of the library."""
    return view(pointer, dtype, shape).copy()


def view(pointer: Optional[int], dtype: np.dtype[Any], shape: Tuple[int, ...]) -> npt.NDArray[Any]:
    """Return an array over memory of the library, as long as that is there."""
    size = int(np.prod(shape, dtype=np.int64)) * dtype.itemsize
    if size == 0 or pointer is None:
        return np.empty(shape, dtype)
    array: npt.NDArray[Any] = np.frombuffer(
        memoryview((ctypes.c_char * size).from_address(pointer)), dtype
    ).reshape(shape)
    array.flags.writeable = False
    return array
