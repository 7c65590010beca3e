# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Progress bars of long work on a terminal, and its interruption by Ctrl-C."""

from __future__ import annotations

import signal
import sys
import threading
from types import FrameType, TracebackType
from typing import Any, Optional, Type

from . import _library
from ._library import CANCELLED, check


class Watched:
    """A call that Ctrl-C interrupts, with a progress bar on standard error.

    The library calls back on the caller's thread, where Python handles signals. No exception may be raised there. So an interrupt is
    stored, ends the work, and is raised when the library has returned.
    """

    def __init__(self, what: str, shown: bool) -> None:
        self.callback = _library.Progress(self._advance)
        self._what, self._shown = what, shown and sys.stderr.isatty()
        self._interrupted = False
        self._bar: Any = None
        self._before: Any = None

    def run(self, status: int) -> None:
        """Raise the error or the interrupt that ended the work, if any."""
        self._close()
        if status == CANCELLED:
            raise KeyboardInterrupt
        check(status)

    def _interrupt(self, _number: int, _frame: Optional[FrameType]) -> None:
        self._interrupted = True

    def _advance(self, _user: Any, done: int, total: int) -> int:
        if self._shown and not self._interrupted:
            if self._bar is None:
                self._bar = _bar(self._what, total)
            self._bar.update(done - self._bar.n)
        return int(self._interrupted)

    def _close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def __enter__(self) -> Watched:
        main = threading.current_thread() is threading.main_thread()
        if main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            self._before = signal.signal(signal.SIGINT, self._interrupt)
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        trace: Optional[TracebackType],
    ) -> None:
        self._close()
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
        if self._interrupted and kind is None:  # after the last call back
            raise KeyboardInterrupt


class _Bar:
    """A progress bar for use where tqdm is not installed."""

    def __init__(self, what: str, total: int) -> None:
        self.n, self._what, self._total = 0, what, total

    def update(self, more: int) -> None:
        self.n += more
        fraction = self.n / self._total if self._total else 0.0
        filled = "#" * int(30 * fraction)
        print(f"\r{self._what}: [{filled:30}] {self.n}/{self._total}", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print(file=sys.stderr)


def _bar(what: str, total: int) -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return _Bar(what, total)
    return tqdm(desc=what, total=total, unit="shape", leave=False)
