"""While planning takes long: a line on the terminal, and a way to stop."""

from __future__ import annotations

import contextlib
import shutil
import signal
import sys
import threading
import time
from types import FrameType, TracebackType
from typing import Any, Self

from preimage.search.limits import Progress

QUIET = 0.5
"""Seconds before the first line: what is quick needs none."""

BAR = 30
"""Characters of a bar that fills."""

PAUSE = 0.1
"""Seconds between one line and the next."""


class ProgressLine:
    """A line on standard error that says how far a search has come, if that is a terminal."""

    def __init__(self) -> None:
        self._shown = False
        self._next = time.monotonic() + QUIET
        self._terminal = sys.stderr is not None and sys.stderr.isatty()

    def show(self, progress: Progress) -> None:
        """Say how far the search is, if it is time to."""
        if not self._terminal or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + PAUSE
        best = f", best {progress.best}" if progress.best else ""
        self._print(
            f"{progress.regions} regions, layer {progress.layer}{best}, {progress.seconds:.1f} s"
        )

    def runs(self, done: int, total: int) -> None:
        """Say how many runs are done, if it is time to."""
        self._bar(done, total, "runs")

    def cells(self, done: int, total: int) -> None:
        """Say how many cells are known, and how many are wanted so far, if it is time to."""
        self._bar(done, total, "cells")

    def _bar(self, done: int, total: int, what: str) -> None:
        """A bar that fills."""
        if not self._terminal or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + PAUSE
        full = round(BAR * done / max(total, 1))
        self._print(f"[{'#' * full}{'.' * (BAR - full)}] {done} of {total} {what}")

    def say(self, text: str) -> None:
        """Say what is being done."""
        if self._terminal:
            self._print(text)

    def clear(self) -> None:
        """Take the line away."""
        if self._shown:
            with contextlib.suppress(OSError):
                sys.stderr.write("\r\x1b[K")
                sys.stderr.flush()
        self._shown = False

    def _print(self, text: str) -> None:
        width = max(20, shutil.get_terminal_size().columns - 1)
        with contextlib.suppress(OSError):
            sys.stderr.write(f"\r\x1b[K{text[:width]}")
            sys.stderr.flush()
        self._shown = True

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.clear()


class Interruption:
    """Whether somebody wants the work to stop: asked once it stops in order, twice at once."""

    def __init__(self) -> None:
        self._wanted = False
        self._before: dict[signal.Signals, Any] = {}

    def __call__(self) -> bool:
        """Whether to stop."""
        return self._wanted

    def _ask(self, number: int, _frame: FrameType | None) -> None:
        if self._wanted:
            raise KeyboardInterrupt
        self._wanted = True

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM):
                self._before[number] = signal.signal(number, self._ask)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)
