"""The studio served: sockets, their patience, and a browser that opens."""

from __future__ import annotations

import asyncio
import socket
import webbrowser
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import h11
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from preimage.errors import InputError
from preimage.studio.app import OWN_HEADERS, application
from preimage.studio.limits import Limits
from preimage.studio.workers import Workers

LOOPBACK = ("127.0.0.1", "localhost", "::1")
"""The names of this machine for itself."""


def listen(host: str, port: int) -> socket.socket:
    """A socket that listens; port 0 is one that is free.

    Raises
    ------
    InputError : the host is not known here, the port is taken or not allowed.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    found = socket.socket(family)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((host, port))
        found.listen(128)
    except (OSError, OverflowError) as error:
        found.close()
        words = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"{host}:{port}", f"cannot be served from: {words}") from None
    found.setblocking(False)
    return found


def address_of(listening: socket.socket) -> str:
    """Where a browser finds it."""
    host, port = listening.getsockname()[:2]
    return f"http://{_bracketed(host)}:{port}/"


def _bracketed(host: str) -> str:
    return f"[{host}]" if ":" in host else host


def hosts_of(listening: socket.socket) -> set[str]:
    """By which names a browser may ask for it: this machine's for itself, and the one given."""
    host, port = listening.getsockname()[:2]
    names = {*LOOPBACK, host} if host in LOOPBACK else {host, socket.gethostname().lower()}
    if host in ("0.0.0.0", "::"):
        names |= {*LOOPBACK, *_own_addresses()}
    return {f"{_bracketed(name)}:{port}" for name in names} | (
        {_bracketed(name) for name in names} if port == 80 else set()
    )


def _own_addresses() -> set[str]:
    try:
        return {str(info[4][0]) for info in socket.getaddrinfo(socket.gethostname(), None)}
    except OSError:
        return set()


def serve(
    listening: socket.socket,
    given: Mapping[str, Any] | None = None,
    *,
    browser: bool = False,
    limits: Limits | None = None,
    ready: Callable[[str], None] | None = None,
) -> None:
    """Serve until Ctrl-C.

    Parameters
    ----------
    given : what the page begins with, see `application`.
    ready : told the address once it can be asked for.
    """
    limits = limits or Limits()
    workers = Workers(limits)
    app = application(given, hosts_of(listening), limits, workers)
    address = address_of(listening)
    config = uvicorn.Config(
        app,
        http=patient(limits),
        ws="none",
        lifespan="on",
        log_level="error",
        access_log=False,
        server_header=False,
        timeout_keep_alive=int(limits.patience),
        timeout_graceful_shutdown=1,
        h11_max_incomplete_event_size=16 * 1024,
    )
    server = _Server(config, workers)

    async def serving() -> None:
        task = asyncio.create_task(server.serve(sockets=[listening]))
        while not server.started and not task.done():
            await asyncio.sleep(0.01)
        if ready is not None:
            ready(address)
        if browser:
            await asyncio.to_thread(webbrowser.open, address)
        await task

    asyncio.run(serving())


class _Server(uvicorn.Server):
    """A server that ends its workers first, so that what they answer ends in time."""

    def __init__(self, config: uvicorn.Config, workers: Workers) -> None:
        super().__init__(config)
        self._workers = workers

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """No question keeps it open."""
        await self._workers.close()
        await super().shutdown(sockets)


def patient(limits: Limits) -> type[H11Protocol]:
    """Connections that must say what they want in time, and make room for new ones."""
    return type("Patient", (_Patient,), {"limits": limits, "idle": {}})


class _Patient(H11Protocol):
    """A connection of a server with limits.

    A whole head has to come within the limits' patience, and what is sent has to be taken away
    within theirs; a body's time is the application's to keep. Whoever is waited for, for any of
    the three, goes when there are too many.
    """

    limits: ClassVar[Limits]
    idle: ClassVar[dict[_Patient, None]]
    """Who is waited for, the longest first."""

    _timer: asyncio.TimerHandle | None = None
    _taking: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Make room: who is waited for longest goes."""
        super().connection_made(transport)
        while len(self.connections) > self.limits.connections and self.idle:
            next(iter(self.idle))._abort()
        if len(self.connections) > self.limits.connections:
            self._abort()
        else:
            self._wait()

    def data_received(self, data: bytes) -> None:
        """A whole head ends the patience, a whole body the waiting."""
        super().data_received(data)
        if self._is_asked():
            self._be_patient(False)
            if not self.cycle.more_body and self._taking is None:
                self.idle.pop(self, None)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        if not self.transport.is_closing() and not self._is_asked():
            self._wait()

    def pause_writing(self) -> None:
        """What is sent is not taken away: wait for that."""
        super().pause_writing()
        self.idle[self] = None
        if self._taking is None:
            self._taking = self.loop.call_later(self.limits.taking, self._abort)

    def resume_writing(self) -> None:
        """It was."""
        super().resume_writing()
        self._be_taken()
        if self._is_asked() and not self.cycle.more_body:
            self.idle.pop(self, None)

    def send_400_response(self, msg: str) -> None:
        """What is not HTTP is answered with the same headers as all else."""
        headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"connection", b"close")]
        begin = h11.Response(status_code=400, headers=[*headers, *OWN_HEADERS])
        for event in (begin, h11.Data(data=msg.encode()), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        """Be forgotten."""
        self._stop_waiting()
        super().connection_lost(exc)

    def _is_asked(self) -> bool:
        """Whether a request is being answered."""
        cycle: RequestResponseCycle | None = self.cycle
        return cycle is not None and not cycle.response_complete

    def _wait(self) -> None:
        self.idle.pop(self, None)
        self.idle[self] = None
        self._be_patient(True)

    def _be_patient(self, again: bool) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = self.loop.call_later(self.limits.patience, self._abort) if again else None

    def _be_taken(self) -> None:
        if self._taking is not None:
            self._taking.cancel()
            self._taking = None

    def _stop_waiting(self) -> None:
        self.idle.pop(self, None)
        self._be_patient(False)
        self._be_taken()

    def _abort(self) -> None:
        self._stop_waiting()
        self.connections.discard(self)
        self.transport.abort()
