"""Many independent pieces of work, wherever they are done: here, by processes, or by a cluster.

The one seam through which maps, tables and runs go. The results are the same
whoever does the work.
"""

from __future__ import annotations

import os
import pickle
import signal
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Generator, Sequence
from itertools import count
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from types import TracebackType
from typing import Any, Protocol, Self, TypeVar

from preimage.errors import InputError, PreimageError, one_line

Item = TypeVar("Item")
Result = TypeVar("Result")

MOST_DEATHS = 3
"""An item that has ended so many processes is not tried again."""

WATCH = 1.0
"""Seconds between two looks of a process at whether its parent is still there."""

ANSWER = 10.0
"""Seconds in which a scheduler has to answer."""


class Workforce(Protocol):
    """Whoever does the work."""

    @property
    def size(self) -> int:
        """How many pieces of work go on at once."""
        ...

    def carry_out(
        self, work: Callable[[Item], Result], items: Sequence[Item]
    ) -> Generator[tuple[int, Result]]:
        """The results as they are finished, each with the place of its item; each item once.

        Parameters
        ----------
        work : a function of a module, or a `functools.partial` of one. It is sent once to each
            process, however many items there are.

        Raises
        ------
        PreimageError : the work cannot be sent, an item ended several processes, the cluster is
            lost. What `work` raises is raised here; what is queued then is not done.
        """
        ...

    def __enter__(self) -> Self:
        """Begin; processes may be started later."""
        ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Free what was taken; what is still being done is left undone."""
        ...


def workforce(workers: int | None = None, scheduler: str | None = None) -> Workforce:
    """A workforce: a cluster if there is a scheduler, else processes, or this one alone.

    Parameters
    ----------
    workers : how many processes; None for one on each processor.
    scheduler : the address of a Dask scheduler.

    >>> with workforce(1) as crew:
    ...     sorted(crew.carry_out(abs, [-1, -2]))
    [(0, 1), (1, 2)]
    """
    if scheduler is not None:
        return Cluster(scheduler)
    number = processors() if workers is None else workers
    return Processes(number) if number > 1 else Here()


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


# --- here -----------------------------------------------------------------------------------


class Here:
    """The process that asks, one item after the other."""

    size = 1

    def carry_out(
        self, work: Callable[[Item], Result], items: Sequence[Item]
    ) -> Generator[tuple[int, Result]]:
        """The results in order."""
        for place, item in enumerate(items):
            yield place, work(item)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        pass


# --- processes ------------------------------------------------------------------------------


class _Worker:
    """A process, and what it is doing.

    Parameters
    ----------
    inherited : this process' ends of the pipes of others, which a fork has to let go of: who waits
        at the other end would never learn that this process is gone.
    """

    def __init__(self, inherited: Sequence[Connection]) -> None:
        # a fork is quick, and knows the main module whatever it is, but it copies locks that other
        # threads hold
        alone = threading.active_count() == 1 and os.name == "posix"
        context = get_context("fork" if alone else "spawn")
        self.connection, theirs = context.Pipe()
        ends = [*inherited, self.connection] if alone else []
        self.process: BaseProcess = context.Process(  # type: ignore[attr-defined]
            target=_serve, args=(theirs, ends), daemon=True
        )
        self.process.start()
        theirs.close()
        self.knows: int | None = None
        self.place: int | None = None

    def end(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.join()
        self.connection.close()


class Processes:
    """Processes of this machine, which live from one call to the next.

    Parameters
    ----------
    number : how many at most; one on each processor by default.

    A process that is ended from outside loses nothing: another one does its item again.
    """

    def __init__(self, number: int | None = None) -> None:
        self.size = max(1, processors() if number is None else number)
        self._workers: list[_Worker] = []
        self._names = count()

    def carry_out(
        self, work: Callable[[Item], Result], items: Sequence[Item]
    ) -> Generator[tuple[int, Result]]:
        """The results as they are finished."""
        sent = _packed(work)
        name = next(self._names)
        todo = deque(range(len(items)))
        deaths: Counter[int] = Counter()
        try:
            while todo or any(worker.place is not None for worker in self._workers):
                self._hand_out(todo, items, name, sent)
                busy = {one.connection: one for one in self._workers if one.place is not None}
                for connection in wait(list(busy)):
                    assert isinstance(connection, Connection)
                    worker = busy[connection]
                    place = worker.place
                    assert place is not None
                    try:
                        good, value = connection.recv()
                    except (EOFError, OSError):
                        self._buried(worker)
                        deaths[place] += 1
                        if deaths[place] == MOST_DEATHS:
                            raise PreimageError(_deadly(items[place])) from None
                        todo.appendleft(place)
                        continue
                    worker.place = None
                    if not good:
                        raise value
                    yield place, value
        finally:
            for worker in [one for one in self._workers if one.place is not None]:
                self._buried(worker)

    def _hand_out(self, todo: deque[int], items: Sequence[Any], name: int, sent: bytes) -> None:
        """Give every idle process an item; start processes while there are more items than them."""
        while todo:
            idle = next((one for one in self._workers if one.place is None), None)
            if idle is None:
                if len(self._workers) == self.size:
                    return
                idle = _Worker([one.connection for one in self._workers])
                self._workers.append(idle)
            place = todo.popleft()
            message = _packed((None if idle.knows == name else sent, items[place]))
            try:
                idle.connection.send_bytes(message)
            except OSError:  # it was ended while it was idle
                self._buried(idle)
                todo.appendleft(place)
                continue
            idle.knows, idle.place = name, place

    def _buried(self, worker: _Worker) -> None:
        self._workers.remove(worker)
        worker.end()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for worker in list(self._workers):
            self._buried(worker)


def _serve(connection: Connection, inherited: Sequence[Connection]) -> None:
    """What a process does: one item after the other, until nobody is left to ask."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who wants it to stop tells its parent
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    for other in inherited:
        other.close()
    work: Callable[[Any], Any] | None = None
    while True:
        try:
            sent, item = pickle.loads(connection.recv_bytes())
        except (EOFError, OSError):
            return
        try:
            if sent is not None:
                work = pickle.loads(sent)
            assert work is not None
            reply = True, work(item)
        except BaseException as error:
            reply = False, error
        try:
            connection.send(reply)
        except OSError:
            return
        except Exception as error:  # what pickle raises is anybody's guess
            words = f"what came of it cannot be sent: {error}"
            connection.send((False, PreimageError(one_line(words))))


def _end_with(parent: int) -> None:
    """End this process soon after its parent, whatever ended that."""
    while os.getppid() == parent:
        time.sleep(WATCH)
    os._exit(1)


def _packed(value: object) -> bytes:
    try:
        return pickle.dumps(value)
    except Exception as error:  # what pickle raises is anybody's guess
        raise PreimageError(one_line(f"cannot be sent to another process: {error}")) from None


def _deadly(item: object) -> str:
    return one_line(f"{MOST_DEATHS} processes were ended while they did this: {item!r}")


# --- a cluster ------------------------------------------------------------------------------


class Cluster:
    """The workers of a Dask scheduler; the package must be installed where they run.

    Parameters
    ----------
    address : of the scheduler, such as `tcp://10.0.0.1:8786`.

    Raises
    ------
    InputError : on entering: nobody answers there, or `distributed` is not installed.

    A worker that is lost loses nothing: the scheduler gives its items to others.
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._client: Any = None
        self._names = count()

    @property
    def size(self) -> int:
        """How many threads the workers have now."""
        return max(1, sum(self._client.nthreads().values())) if self._client is not None else 1

    def carry_out(
        self, work: Callable[[Item], Result], items: Sequence[Item]
    ) -> Generator[tuple[int, Result]]:
        """The results as they are finished."""
        from distributed import as_completed
        from distributed.client import FutureCancelledError
        from distributed.scheduler import KilledWorker

        assert self._client is not None, "a cluster is entered first"
        # as a task of its own it is made again where it is lost with its worker
        name = f"preimage-{os.getpid()}-{id(self)}-{next(self._names)}"
        known = self._client.submit(pickle.loads, _packed(work), key=f"{name}-work")
        futures = {
            self._client.submit(_applied, known, _packed(item), key=f"{name}-{place}"): place
            for place, item in enumerate(items)
        }
        try:
            for future in as_completed(list(futures), loop=self._client.loop):
                place = futures[future]
                error = future.exception()
                if isinstance(error, KilledWorker):
                    raise PreimageError(_deadly(items[place])) from None
                if isinstance(error, FutureCancelledError) or future.cancelled():
                    raise PreimageError(f"{self._address}: the cluster was lost") from None
                if error is not None:
                    raise error
                yield place, future.result()
                future.release()
        finally:
            if any(not future.done() for future in futures):
                self._client.cancel([*futures, known])

    def __enter__(self) -> Self:
        try:
            from distributed import Client
        except ImportError:
            rule = "needs distributed, which is not installed: pip install 'preimage[cluster]'"
            raise InputError("--scheduler", rule) from None
        try:
            self._client = Client(self._address, timeout=ANSWER, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            rule = f"no Dask scheduler answers there: {error}"
            raise InputError(self._address, rule) from None
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._client is not None:
            self._client.close(timeout=ANSWER)


def _applied(work: Callable[[Any], Any], packed: bytes) -> Any:
    return work(pickle.loads(packed))
