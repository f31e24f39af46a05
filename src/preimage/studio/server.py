"""The studio served: sockets, their patience, and a browser that opens."""

from __future__ import annotations

import asyncio
import socket
import webbrowser
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from preimage.errors import InputError
from preimage.studio.app import application
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
    app = application(given, hosts_of(listening), limits, Workers(limits))
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
    server = uvicorn.Server(config)

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


def patient(limits: Limits) -> type[H11Protocol]:
    """Connections that must say what they want in time, and make room for new ones."""
    return type("Patient", (_Patient,), {"limits": limits, "idle": {}})


class _Patient(H11Protocol):
    """A connection of a server with limits."""

    limits: ClassVar[Limits]
    idle: ClassVar[dict[_Patient, None]]
    """Who is waited for, the longest first."""

    _timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Make room: who has said nothing for longest goes."""
        super().connection_made(transport)
        while len(self.connections) > self.limits.connections and self.idle:
            next(iter(self.idle))._abort()
        if len(self.connections) > self.limits.connections:
            self._abort()
        else:
            self._wait()

    def data_received(self, data: bytes) -> None:
        """A whole head ends the waiting."""
        super().data_received(data)
        if self._is_asked():
            self._stop_waiting()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        if not self.transport.is_closing() and not self._is_asked():
            self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        """Be forgotten."""
        self._stop_waiting()
        super().connection_lost(exc)

    def _is_asked(self) -> bool:
        """Whether a request is being answered."""
        cycle: RequestResponseCycle | None = self.cycle
        return cycle is not None and not cycle.response_complete

    def _wait(self) -> None:
        self._stop_waiting()
        self.idle[self] = None
        self._timer = self.loop.call_later(self.limits.patience, self._abort)

    def _stop_waiting(self) -> None:
        self.idle.pop(self, None)
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _abort(self) -> None:
        self._stop_waiting()
        self.connections.discard(self)
        self.transport.abort()
