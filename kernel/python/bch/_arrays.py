# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Arrays that go into the library and come out of it, by their addresses, and the dtypes of their entries."""

import ctypes
import operator
import os
from typing import Any, Dict, List, Optional, Tuple, Type, TypeVar

import numpy as np
import numpy.typing as npt

from ._library import ArgumentError, ArrayError, RangeError, check

UInt8 = npt.NDArray[np.uint8]
UInt32 = npt.NDArray[np.uint32]
UInt64 = npt.NDArray[np.uint64]
Float32 = npt.NDArray[np.float32]
Float64 = npt.NDArray[np.float64]
Bool = npt.NDArray[np.bool_]
Records = npt.NDArray[np.void]
Shape = Tuple[Optional[int], ...]
T = TypeVar("T")

u1, u4, u8 = np.dtype(np.uint8), np.dtype(np.uint32), np.dtype(np.uint64)
i4, i8 = np.dtype(np.int32), np.dtype(np.int64)
f4, f8, b1 = np.dtype(np.float32), np.dtype(np.float64), np.dtype(np.bool_)

#: A disc on the ground, metres.
DISC = np.dtype([("x", f4), ("y", f4), ("radius", f4)])
#: A ball, metres.
SPHERE = np.dtype([("x", f4), ("y", f4), ("z", f4), ("radius", f4)])
#: A time in a clip of a character; clip 0xffffffff is the rest pose.
POSE = np.dtype([("clip", u4), ("seconds", f4)])
#: The character, by its index in a list, and the pose that a shape shows.
POSE_ID = np.dtype([("character", u4), ("clip", u4), ("seconds", f4)])
#: Two spheres that overlap, in space: their indices, the point of the first that is deepest in the second (relative to the
#: first agent's position), the normal from the first to the second, and the depth, metres.
SPHERE_CONTACT = np.dtype([("spheres", u4, 2), ("point", f4, 3), ("normal", f4, 3), ("depth", f4)])
#: How far the first agent of a pair has to move, metres, and the direction of the move, a unit vector.
PENETRATION = np.dtype({"names": ["depth", "x", "y"], "formats": [f4, f8, f8], "offsets": [0, 8, 16], "itemsize": 24})
#: Where two agents touch after a move of `nearest_free`: the point relative to the first agent's position after the move, in the
#: world's axes, metres, and the normal from the second to the first, a unit vector; zeros where they do not collide.
TOUCH = np.dtype([("point", f4, 3), ("normal", f4, 3)])


def address(array: npt.NDArray[Any]) -> int:
    """Return where an array's data begin."""
    return array.ctypes.data


def records(call: Any, dtype: npt.DTypeLike, *arguments: Any) -> Records:
    """Return what a call writes into an array: it is first asked how much that is."""
    count = ctypes.c_size_t()
    check(call(*arguments, None, 0, ctypes.byref(count)))
    written = np.empty(count.value, dtype)
    check(call(*arguments, address(written), len(written), ctypes.byref(count)))
    return written


def _words(array: Any) -> str:
    if not isinstance(array, np.ndarray):
        return f"a {type(array).__name__}"
    if isinstance(array, np.ma.MaskedArray):
        return "a masked array"
    layout = "" if array.flags.c_contiguous else ", not contiguous"
    layout += "" if array.flags.aligned else ", not aligned"
    return f"an array of {array.dtype} with shape {array.shape}{layout}"


def _shape_words(shape: Shape) -> str:
    return "(" + ", ".join("n" if length is None else str(length) for length in shape) + ("," if len(shape) == 1 else "") + ")"


def _dtype_words(dtype: np.dtype[Any]) -> str:
    names = {DISC: "bch.DISC", SPHERE: "bch.SPHERE", POSE: "bch.POSE", POSE_ID: "bch.POSE_ID", PENETRATION: "bch.PENETRATION", TOUCH: "bch.TOUCH", b1: "bool"}
    return names.get(dtype, dtype.name)


def fits(array: Any, dtype: np.dtype[Any], shape: Shape) -> bool:
    """Return whether the library can take an array without a copy."""
    if not isinstance(array, np.ndarray) or array.dtype != dtype or isinstance(array, np.ma.MaskedArray):
        return False
    return array.flags.c_contiguous and array.flags.aligned and _has_shape(array, shape)


def given(array: Any, dtype: np.dtype[Any], shape: Shape, name: str) -> int:
    """Return the address of an array of the caller, or raise an error that says what is wanted instead."""
    if not fits(array, dtype, shape):
        wanted = f"expected a C-contiguous array of {_dtype_words(dtype)} with shape {_shape_words(shape)}"
        if name.startswith("out"):
            raise ArrayError(f"{name} is {_words(array)}; {wanted}, such as numpy.empty makes")
        raise ArrayError(f"{name} is {_words(array)}; {wanted}; numpy.ascontiguousarray converts")
    return array.ctypes.data  # type: ignore[no-any-return]


def result(out: Optional[npt.NDArray[Any]], dtype: np.dtype[Any], shape: Tuple[int, ...], name: str = "out") -> npt.NDArray[Any]:
    """Return the caller's array for a result, or a new one."""
    if out is None:
        return np.empty(shape, dtype)
    given(out, dtype, shape, name)
    if not out.flags.writeable:
        raise ArrayError(f"{name} is read-only")
    return out


def indices(values: Any, dtype: np.dtype[Any], shape: Shape, name: str) -> npt.NDArray[Any]:
    """Return an array of indices where it is, if it has that dtype; other integers are copied, if they fit."""
    array = values if isinstance(values, np.ndarray) else np.asarray(values)
    if array.size == 0 and not isinstance(values, np.ndarray):
        array = array.astype(dtype)
    if array.dtype.kind not in "iu" or isinstance(array, np.ma.MaskedArray) or not _has_shape(array, shape):
        raise rejected(values, name, f"integers with shape {_shape_words(shape)}")
    if array.dtype == dtype:
        return _strided(array)
    most = np.iinfo(dtype).max
    wrong = np.flatnonzero((array < 0) | (array > most))
    if wrong.size > 0:
        raise RangeError(f"{name}[{wrong[0]}] is {array[wrong[0]]}; expected an index from 0 to {most}")
    return array.astype(dtype)


def numbers(named: Dict[str, Any], shapes: Dict[str, Shape]) -> Dict[str, npt.NDArray[Any]]:
    """Return arrays of float or of double where they are. Other numbers are copied, to double if no array is of floats."""
    kinds = {name: values.dtype for name, values in named.items() if isinstance(values, np.ndarray) and values.dtype in (f4, f8)}
    dtype = next(iter(kinds.values()), f8)
    arrays = {}
    for name, values in named.items():
        array = values if isinstance(values, np.ndarray) else np.asarray(values)
        if array.dtype.kind not in "fiu" or isinstance(array, np.ma.MaskedArray) or not _has_shape(array, shapes[name]):
            raise rejected(values, name, f"numbers with shape {_shape_words(shapes[name])}")
        if kinds.get(name, dtype) != dtype:
            raise ArrayError(f"{name} is {_words(values)}; expected {dtype.name}, as {next(iter(kinds))} has")
        arrays[name] = _strided(array if name in kinds else array.astype(dtype))
    return arrays


def _has_shape(array: npt.NDArray[Any], shape: Shape) -> bool:
    return len(array.shape) == len(shape) and all(want is None or want == has for want, has in zip(shape, array.shape))


def _strided(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return an array of values that the library can step through, each aligned: the same one, or where it runs backwards or repeats, a copy."""
    size = array.dtype.itemsize
    steps = array.flags.aligned and all(stride > 0 and stride % size == 0 for stride in array.strides)
    return array if steps or array.shape[0] < 2 and array.flags.aligned else np.ascontiguousarray(array)


def rejected(value: Any, name: str, wanted: str) -> ArrayError:
    """Return the error about an argument of a wrong type."""
    return ArrayError(f"{name} is {_words(value)}; expected {wanted}")


def instance(value: Any, kind: Type[T], name: str) -> T:
    """Return an object of a class of the package, or raise an error that names the argument."""
    if not isinstance(value, kind):
        raise rejected(value, name, f"a bch.{kind.__name__}")
    return value


def listed(values: Any, name: str, wanted: str) -> List[Any]:
    """Return a sequence as a list, or raise an error that names it."""
    try:
        return list(values)
    except TypeError:
        raise rejected(values, name, f"a sequence of {wanted}") from None


def instances(values: Any, kind: Type[T], name: str) -> List[T]:
    """Return a sequence of objects of a class of the package as a list, or raise an error that names the one that is none."""
    found = listed(values, name, f"bch.{kind.__name__}")
    return [instance(each, kind, f"{name}[{i}]") for i, each in enumerate(found)]


def number(value: Any, name: str) -> float:
    """Return a number as a float, or raise an error that names it. Texts are no numbers."""
    if isinstance(value, (str, bytes, bytearray, complex)) or isinstance(value, np.ndarray) and value.ndim > 0:
        raise rejected(value, name, "a number")
    try:
        return float(value)
    except TypeError:
        raise rejected(value, name, "a number") from None
    except OverflowError:
        raise ArgumentError(f"{name} is beyond the largest number") from None


def pair(values: Any, name: str) -> Tuple[float, float]:
    """Return two numbers, or raise an error that names them."""
    found = listed(values, name, "two numbers")
    if len(found) != 2:
        raise ArgumentError(f"{name} has length {len(found)}; expected two numbers")
    return number(found[0], f"{name}[0]"), number(found[1], f"{name}[1]")


def flag(value: Any, name: str) -> bool:
    """Return a truth value, or raise an error that names it."""
    if not isinstance(value, (bool, np.bool_)):
        raise rejected(value, name, "True or False")
    return bool(value)


def one_of(words: Dict[str, int], word: Any, name: str) -> int:
    """Return the number that stands for a word, or raise an error that names the argument."""
    wanted = f"one of {', '.join(map(repr, words))}"
    if not isinstance(word, str):
        raise rejected(word, name, wanted)
    if word not in words:
        raise ArgumentError(f"{name} is {word!r}; expected {wanted}")
    return words[word]


def integer(value: Any, name: str) -> int:
    """Return a whole number, or raise an error that names it."""
    try:
        return operator.index(value)
    except TypeError:
        raise rejected(value, name, "a whole number") from None


def index(value: Any, name: str, end: int) -> int:
    """Return a whole number from 0 to below `end`, or raise an error that names it."""
    number = integer(value, name)
    if not 0 <= number < end:
        raise RangeError(f"{name} is {number}; expected 0 to {end - 1}")
    return number


def bounded(value: Any, name: str, low: int, high: int) -> int:
    """Return a whole number within bounds, or raise an error that names it."""
    number = integer(value, name)
    if not low <= number <= high:
        raise ArgumentError(f"{name} is {number}; expected {low} to {high}")
    return number


def as_array(values: Any, name: str) -> npt.NDArray[Any]:
    """Return what is an array or becomes one, or raise an error that names it."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError):  # rows of different lengths
        raise rejected(values, name, "an array of numbers") from None


def converted(values: Any, dtype: np.dtype[Any], name: str) -> npt.NDArray[Any]:
    """Return numbers as a C-contiguous array of a dtype, or raise an error that names them."""
    array = as_array(values, name)
    if array.dtype.kind not in "biuf":
        raise rejected(values, name, "an array of numbers")
    return np.ascontiguousarray(array, dtype)


def table(values: Any, dtype: np.dtype[Any], columns: int, name: str) -> npt.NDArray[Any]:
    """Return rows of `columns` numbers as an array, for calls that take lists and convert them."""
    array = as_array(values, name)
    whole = dtype.kind == "u"
    if array.ndim != 2 or array.shape[1] != columns or array.dtype.kind not in ("iu" if whole else "iuf"):
        kind = "whole numbers" if whole else "numbers"
        raise ArrayError(f"{name} is {_words(array)}; expected rows of {columns} {kind}")
    if whole and array.size > 0 and not (array.min() >= 0 and array.max() < 2**32):
        raise RangeError(f"{name} has {array.min()} and {array.max()}, which are no indices")
    return np.ascontiguousarray(array, dtype)


def encoded(text: Any, name: str) -> bytes:
    """Return a text or a path as the library takes it."""
    try:
        code = os.fsencode(text)
    except TypeError:
        raise rejected(text, name, "a text or a path") from None
    if b"\0" in code:
        raise ArgumentError(f"{name} has a NUL character")
    return code


def copied(pointer: Optional[int], dtype: np.dtype[Any], shape: Tuple[int, ...]) -> npt.NDArray[Any]:
    """Return a copy of memory of the library."""
    size = int(np.prod(shape, dtype=np.int64)) * dtype.itemsize
    if size == 0 or pointer is None:
        return np.empty(shape, dtype)
    memory = memoryview((ctypes.c_char * size).from_address(pointer))
    return np.frombuffer(memory, dtype).reshape(shape).copy()
