"""The workers of a studio: which are free, which are over their time, which are given up."""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import AsyncGenerator
from contextlib import aclosing
from dataclasses import dataclass
from typing import Any

from preimage.errors import PreimageError
from preimage.studio.limits import Limits

COMMAND = (sys.executable, "-m", "preimage.studio.worker")


class TooBusyError(PreimageError):
    """So many questions wait that one more is refused."""


@dataclass(frozen=True, slots=True)
class Task:
    """A question on its way to a worker.

    Parameters
    ----------
    seconds : it may take.
    quick : it is answered by the warm worker, one after another; else by one of its own.
    """

    question: str
    body: Any
    seconds: float
    quick: bool

    @property
    def line(self) -> bytes:
        """As a worker reads it."""
        asked = {"question": self.question, "body": self.body}
        return json.dumps(asked, allow_nan=False).encode() + b"\n"


def failed(words: str) -> bytes:
    """The line that says so."""
    return json.dumps({"failed": words}).encode() + b"\n"


class Worker:
    """One process, started when it is first asked and again after it has ended."""

    def __init__(self, limits: Limits, command: tuple[str, ...] = COMMAND) -> None:
        self._limits = limits
        self._command = command
        self._process: asyncio.subprocess.Process | None = None
        self._dying: list[asyncio.subprocess.Process] = []
        self._over = False

    async def ask(self, task: Task) -> AsyncGenerator[bytes]:
        """What it says, line by line; the last line is an answer, a refusal, or what failed."""
        try:
            async with asyncio.timeout(task.seconds):
                async for line in self._said(task):
                    yield line
        except TimeoutError:
            self.end()
            yield failed(f"it took longer than {task.seconds:g} s")
        except ValueError:  # of the reader: a line is over its limit
            self.end()
            yield failed("the answer is too large")

    async def _said(self, task: Task) -> AsyncGenerator[bytes]:
        if self._over:
            yield failed("the studio has ended")
            return
        process = await self._running()
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(task.line)
            await process.stdin.drain()
        except ConnectionError:
            pass  # it has ended: the next line says so
        while True:
            line = await process.stdout.readline()
            if not line.endswith(b"\n"):
                self.end()
                yield failed("the process that worked on it ended")
                return
            yield line
            if not line.startswith(b'{"progress"'):
                return

    async def _running(self) -> asyncio.subprocess.Process:
        if self._process is None or self._process.returncode is not None:
            self._process = await asyncio.create_subprocess_exec(
                *self._command,
                str(self._limits.memory),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                limit=self._limits.answer,
            )
        return self._process

    def end(self) -> None:
        """Kill it; the next question starts another."""
        process, self._process = self._process, None
        if process is not None:
            # kills it, and lets go of its pipes and what is in them, which kill alone does not
            process._transport.close()  # type: ignore[attr-defined]
            self._dying = [one for one in self._dying if one.returncode is None] + [process]

    async def close(self) -> None:
        """Kill it, and see it gone; nothing is answered from then on."""
        self._over = True
        self.end()
        for process in self._dying:
            await process.wait()


class Workers:
    """One warm worker for quick questions, and a few for long ones."""

    def __init__(self, limits: Limits, command: tuple[str, ...] = COMMAND) -> None:
        self._limits = limits
        self._quick = Worker(limits, command)
        self._turn = asyncio.Lock()
        self._free = [Worker(limits, command) for _ in range(limits.at_once)]
        self._places = asyncio.Semaphore(limits.at_once)
        self._all = [self._quick, *self._free]
        self._waiting = {True: 0, False: 0}
        self._finishing: set[asyncio.Task[None]] = set()

    def enter(self, task: Task) -> None:
        """Take a place in the queue: quick questions have one of their own.

        Raises
        ------
        TooBusyError : there is none.
        """
        if self._waiting[task.quick] >= self._limits.waiting:
            raise TooBusyError("too many questions at once: try again")
        self._waiting[task.quick] += 1

    def leave(self, task: Task) -> None:
        """Give the place back."""
        self._waiting[task.quick] -= 1

    async def ask(self, task: Task) -> AsyncGenerator[bytes]:
        """What is said to a question; who stops listening takes it back."""
        answers = self._asked_quickly(task) if task.quick else self._asked_at_length(task)
        async with aclosing(answers):
            async for line in answers:
                yield line

    async def _asked_quickly(self, task: Task) -> AsyncGenerator[bytes]:
        """A quick question that is taken back is still answered, to nobody: that takes less."""
        await self._turn.acquire()
        lines: asyncio.Queue[bytes | None] = asyncio.Queue()
        finishing = asyncio.create_task(self._finish(task, lines))
        self._finishing.add(finishing)
        finishing.add_done_callback(self._finishing.discard)
        while (line := await lines.get()) is not None:
            yield line

    async def _finish(self, task: Task, lines: asyncio.Queue[bytes | None]) -> None:
        try:
            async for line in self._quick.ask(task):
                lines.put_nowait(line)
        finally:
            lines.put_nowait(None)
            self._turn.release()

    async def _asked_at_length(self, task: Task) -> AsyncGenerator[bytes]:
        async with self._places:
            worker = self._free.pop()
            answered = False
            try:
                async with aclosing(worker.ask(task)) as said:
                    async for line in said:
                        answered = not line.startswith(b'{"progress"')
                        yield line
            finally:
                if not answered:
                    worker.end()
                self._free.append(worker)

    async def close(self) -> None:
        """Kill them all, and see them gone."""
        for finishing in self._finishing:
            finishing.cancel()
        await asyncio.gather(*self._finishing, return_exceptions=True)
        for worker in self._all:
            await worker.close()
