# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Recordings in memory, as columns with names."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, List, Mapping, Optional

import numpy as np

from . import _library
from ._arrays import _strided, address, as_array, encoded, f4, f8, i4, i8, rejected
from ._library import ArrayError, RangeError

#: What the library takes as it is: BCH_COLUMN_DOUBLE ...
_TYPES = {f8: 0, f4: 1, i8: 2, i4: 3}


class Columns:
    """Columns with names, which have a value for each row. The library reads arrays where they are, so this has to live as long as it does."""

    __slots__ = ("array", "rows", "_kept")

    def __init__(self, named: Mapping[str, Any], units: Mapping[str, str] = MappingProxyType({})) -> None:
        self._kept: List[Any] = []
        self.rows: Optional[int] = None
        first = ""
        columns = []
        for name, values in named.items():
            array = _numbers(values, name)
            unit = units.get(name, "")
            if array.dtype.kind in "Mm":  # times
                array, unit = array.astype(f"{array.dtype.kind}8[us]").astype(i8), "us"
            if self.rows is None:
                self.rows, first = len(array), name
            if len(array) != self.rows:
                raise ArrayError(f"{name} has {len(array)} rows, and {first} has {self.rows}")
            self._kept.append(array)
            header = f"{name} [{unit}]" if unit else name
            columns.append(_library.Column(encoded(header, "column"), address(array), array.strides[0], _TYPES[array.dtype]))
        self.array = (_library.Column * len(columns))(*columns)


def _numbers(values: Any, name: str) -> "np.ndarray[Any, Any]":
    """Return a column's numbers, of a type that the library takes, or times. What a masked array lacks is NaN."""
    array = values if isinstance(values, np.ndarray) else as_array(values, name)
    if array.ndim != 1 or array.dtype.kind not in "biufMm":
        raise rejected(values, name, "numbers with shape (n,)")
    if isinstance(array, np.ma.MaskedArray):
        array = array.astype(f8).filled(np.nan)
    if array.dtype.kind == "u" and array.size > 0 and int(array.max()) > np.iinfo(i8).max:
        raise RangeError(f"{name}[{array.argmax()}] is {array.max()}, above {np.iinfo(i8).max}")
    if array.dtype.kind in "biuf" and array.dtype not in _TYPES:
        array = array.astype(f8 if array.dtype.kind == "f" else i8)
    return _strided(array)
