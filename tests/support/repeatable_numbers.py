# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Random numbers and hashes that tests in other languages compute alike."""

import numpy as np

_state = 12345


def random():
    """The next number from 0 to 1."""
    global _state
    _state = (_state * 1103515245 + 12345) & 0x7FFFFFFF
    return _state / 0x7FFFFFFF


def fnv(numbers):
    """FNV-1a of the bytes of numbers."""
    h = 0x811C9DC5
    for byte in np.ascontiguousarray(numbers).tobytes():
        h = (h ^ byte) * 0x01000193 & 0xFFFFFFFF
    return f"{h:x}"
