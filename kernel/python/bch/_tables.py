# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Recordings in memory: tables of any library, as columns with names."""

from __future__ import annotations

import ctypes
import math
from types import MappingProxyType
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence

import numpy as np

from . import _library
from ._arrays import _strided, address, encoded, f4, f8, i4, i8, rejected
from ._library import ArrayError, RangeError

#: What the library takes as it is: BCH_COLUMN_DOUBLE ...
_TYPES = {f8: 0, f4: 1, i8: 2, i4: 3}
_TEXT = 4
_METRES = {"x": "m", "y": "m"}


class Table(NamedTuple):
    """A table with columns by name, and what else its object says."""

    columns: Mapping[str, Any]
    units: Mapping[str, str] = MappingProxyType({})  #: of columns whose names do not say theirs
    fps: Optional[float] = None
    walls: Any = None


class Columns:
    """Columns with names. The library reads arrays where they are, so this has to live as long as what reads them."""

    __slots__ = ("array", "rows", "_kept")

    def __init__(self, table: Table) -> None:
        self.rows = 0
        self._kept: List[Any] = []
        first = ""
        columns = []
        for name, values in table.columns.items():
            unit = table.units.get(name, "")
            array = _array(values, name)
            if array is None:
                columns.append(_library.Column(encoded(name, "column")))  # which the library refuses if it needs that one
                continue
            if not first:
                self.rows, first = len(array), name
            if len(array) != self.rows:
                raise ArrayError(f"{name} has {len(array)} rows, and {first} has {self.rows}")
            if array.dtype.kind in "Mm":  # times
                array, unit = array.astype(f"{array.dtype.kind}8[us]").astype(i8), "us"
            header = encoded(f"{name} [{unit}]" if unit else name, "column")
            if array.dtype.kind in "OUS":
                texts = _texts(array)
                self._kept.append(texts)
                columns.append(_library.Column(header, ctypes.addressof(texts), 0, _TEXT))
            else:
                self._kept.append(array)
                columns.append(_library.Column(header, address(array), array.strides[0], _TYPES[array.dtype]))
        self.array = (_library.Column * len(columns))(*columns)


def table_of(recording: Any) -> Table:
    """Return the columns of what has them by name, by what it offers.

    That is a mapping, a structured array, a dataframe (`columns`), a table of Arrow (`column_names`), PedPy's trajectories (`data`,
    `frame_rate`) or JuPedSim's recordings (`num_frames`, `fps`, `frame(i)`, `geometry()`).
    """
    names = _names(recording)
    if names is not None:
        return Table({str(name): recording[name] for name in names})
    if hasattr(recording, "data") and hasattr(recording, "frame_rate"):
        return table_of(recording.data)._replace(units=_METRES, fps=recording.frame_rate)
    if hasattr(recording, "num_frames") and hasattr(recording, "frame"):
        return _of_frames(recording)
    raise rejected(recording, "recording", "a path, or a table with columns by name")


def _names(table: Any) -> Optional[Sequence[Any]]:
    if isinstance(table, Mapping):
        return list(table)
    for names in (getattr(getattr(table, "dtype", None), "names", None), getattr(table, "column_names", None)):
        if names is not None:
            return list(names)
    return None if getattr(table, "columns", None) is None else list(table.columns)


def _of_frames(recording: Any) -> Table:
    columns: Dict[str, List[Any]] = {name: [] for name in ("frame", "id", "x", "y", "heading")}
    for number in range(recording.num_frames):
        for agent in recording.frame(number).agents:
            towards = math.atan2(agent.orientation[1], agent.orientation[0]) if any(agent.orientation) else math.nan
            for values, value in zip(columns.values(), (number, agent.id, *agent.position, towards)):
                values.append(value)
    return Table(columns, _METRES, recording.fps, recording.geometry())


def _array(values: Any, name: str) -> Optional["np.ndarray[Any, Any]"]:
    """Return a column's numbers, of a type that the library takes, or its times or texts, or None of anything else.

    What a masked array lacks is NaN. Texts alone are of columns that name motions.
    """
    try:
        array = values if isinstance(values, np.ndarray) else np.asarray(values)
        if isinstance(array, np.ma.MaskedArray):
            array = np.where(array.mask, np.nan, array.data)
        if array.dtype.kind in "OUS" and name.lower() in ("character", "clip", "body"):
            return array
        if array.dtype.kind == "O":  # numbers, of which some may lack
            array = array.astype(f8)
    except (TypeError, ValueError):
        return None
    if array.ndim != 1 or array.dtype.kind not in "biufMm":
        return None
    if array.dtype.kind == "u" and array.size > 0 and int(array.max()) > np.iinfo(i8).max:
        raise RangeError(f"{name}[{array.argmax()}] is {array.max()}, above {np.iinfo(i8).max}")
    if array.dtype.kind in "biuf" and array.dtype not in _TYPES:
        array = array.astype(f8 if array.dtype.kind == "f" else i8)
    return _strided(array)


def _texts(array: "np.ndarray[Any, Any]") -> "ctypes.Array[ctypes.c_char_p]":
    """Return texts for the library; None and NaN are empty."""
    texts = [None if value is None or value != value else encoded(value, "column") for value in array.tolist()]
    return (ctypes.c_char_p * len(texts))(*texts)
