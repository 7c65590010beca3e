# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The shared libraries: their structs, functions and errors."""

import ctypes
import functools
import os
import re
import threading
from ctypes import c_char_p, c_double, c_float, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path
from typing import Any, Callable, Dict, List, Type

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


# kernel/c_api/abi.txt, which describes the C headers: the types of functions and callbacks, the members of structs, the values of constants.
_described = dict(line.split(": ", 1) for line in (Path(__file__).parent / "abi.txt").read_text().splitlines())
ABI_VERSION = int(_described["constant BCH_ABI_VERSION"])
_types: Dict[str, Any] = {
    "void": None,
    "bch_status": c_int32,
    "int32_t": c_int32,
    "uint32_t": c_uint32,
    "int64_t": c_int64,
    "uint64_t": c_uint64,
    "size_t": c_size_t,
    "float": c_float,
    "double": c_double,
    "const char*": c_char_p,
}


def _type(described: str) -> Any:
    """Return the type for ctypes. Pointers are addresses, except those of texts."""
    if described not in _types:
        _types[described] = c_void_p if described.endswith("*") else _struct_or_callback(described)
    return _types[described]


def _signature(described: str) -> List[Any]:
    """Return the types of a function's result and parameters."""
    result, parameters = described.rstrip(")").split("(")
    return [_type(result)] + [_type(each) for each in parameters.split(", ") if each != "void"]


class _Sized(ctypes.Structure):
    """A struct that begins with its size."""

    def __init__(self, **values: Any) -> None:
        super().__init__(size=ctypes.sizeof(type(self)), **values)


def _struct_or_callback(name: str) -> Any:
    if "callback " + name in _described:
        return ctypes.CFUNCTYPE(*_signature(_described["callback " + name]))
    *members, _ = _described["struct " + name].split("; ")
    fields = [(field, _type(kind)) for kind, _, field in (member.partition(" ")[2].rpartition(" ") for member in members)]
    return type(name, (_Sized if fields[0] == ("size", c_uint32) else ctypes.Structure,), {"_fields_": fields})


def __getattr__(name: str) -> Any:
    """Make a struct or callback of the C interface when it is first asked for: ShapeSetInfo is bch_shape_set_info."""
    described = "bch" + re.sub("([A-Z])", r"_\1", name).lower()
    if "struct " + described not in _described and "callback " + described not in _described:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = _type(described)
    return globals()[name]


class _Library:
    """The functions of libbch, and those of libbch_files, which is loaded when the first of them is asked for.

    The two are in the folder of this package, or in that of the libbch which the environment variable BCH_LIBRARY names.
    """

    def __init__(self) -> None:
        self._path = Path(os.environ.get("BCH_LIBRARY") or Path(__file__).parent / f"libbch.so.{ABI_VERSION}")
        self._first = self._load(self._path, "it needs Debian's libtbb12")
        if self.bch_abi_version() != ABI_VERSION:
            raise ImportError(f"bch: {self._path} has another interface ({self.bch_abi_version()}) than this package ({ABI_VERSION})")

    @functools.cached_property
    def _files(self) -> ctypes.CDLL:
        needs = "files of characters and recordings need Debian's libassimp5, libdraco7, zlib1g, libsqlite3-0, libhdf5-103-1"
        return self._load(self._path.with_name(f"libbch_files.so.{ABI_VERSION}"), needs)

    @staticmethod
    def _load(path: Path, needs: str) -> ctypes.CDLL:
        try:
            return ctypes.CDLL(str(path))
        except OSError as error:
            raise ImportError(f"bch: {error} ({needs})") from None

    def __getattr__(self, name: str) -> Any:
        """Find a function when it is first asked for."""
        if "function " + name not in _described:
            raise AttributeError(name)
        function = getattr(self._first if hasattr(self._first, name) else self._files, name)
        function.restype, *function.argtypes = _signature(_described["function " + name])
        setattr(self, name, function)
        return function


lib = _Library()


#: The arguments whose names are not those of the options that the command-line program has for the same.
_arguments = {"clip-speed": "clip_speeds", "character": "characters", "body": "footprints"}


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
