# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Progress of work that takes a while, on a terminal, and its end by Ctrl-C."""

import sys
import time
from types import TracebackType
from typing import Any, Optional, Type

from . import _library
from ._library import CANCELLED, check


class Watched:
    """A call that can be interrupted, with a bar on standard error.

    The library calls back on the thread of the caller, where Python handles signals. What is raised there ends the work, and is
    raised again when the library has returned.
    """

    def __init__(self, what: str, shown: bool) -> None:
        self.callback = _library.Progress(self._advance)
        self._what, self._shown = what, shown and sys.stderr.isatty()
        self._raised: Optional[BaseException] = None
        self._bar: Any = None
        self._begin = time.monotonic()

    def run(self, status: int) -> None:
        """Raise what ended the work, an error or an interrupt."""
        self._close()
        if status == CANCELLED and self._raised is not None:
            raise self._raised
        check(status)

    def _advance(self, _: Any, done: int, total: int) -> int:
        try:
            if self._shown:
                self._draw(done, total)
            return 0
        except BaseException as error:  # an interrupt as well: nothing may leave a callback
            self._raised = error
            return 1

    def _draw(self, done: int, total: int) -> None:
        if self._bar is None:
            self._bar = _bar(self._what, total)
        self._bar.update(done - self._bar.n)

    def _close(self) -> None:
        if self._bar is not None:
            self._bar.close()

    def __enter__(self) -> "Watched":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        self._close()


class _Bar:
    """A bar where tqdm is not installed."""

    def __init__(self, what: str, total: int) -> None:
        self.n, self._what, self._total = 0, what, total

    def update(self, more: int) -> None:
        self.n += more
        share = self.n / self._total if self._total else 0.0
        filled = "#" * int(30 * share)
        print(f"\r{self._what}: [{filled:30}] {self.n}/{self._total}", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print(file=sys.stderr)


def _bar(what: str, total: int) -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return _Bar(what, total)
    return tqdm(desc=what, total=total, unit="shape", leave=False)
