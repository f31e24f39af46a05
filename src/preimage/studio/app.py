"""The studio's pages and questions, as an ASGI application."""

from __future__ import annotations

import asyncio
import json
import math
from collections.abc import AsyncGenerator, Collection, Mapping
from contextlib import aclosing, asynccontextmanager
from importlib import resources
from typing import Any

from starlette.applications import Starlette
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from preimage.studio.limits import Limits
from preimage.studio.questions import QUESTIONS, Question
from preimage.studio.workers import Task, TooBusyError, Workers

MEDIA = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
}
"""What the page is made of."""

POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)

HEADERS = {
    "Content-Security-Policy": POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}
"""Said with everything that is answered."""

OWN_HEADERS = tuple((key.lower().encode(), value.encode()) for key, value in HEADERS.items())
"""The same, as they are sent."""


def application(
    given: Mapping[str, Any] | None,
    hosts: Collection[str],
    limits: Limits,
    workers: Workers,
    questions: Mapping[str, Question] = QUESTIONS,
) -> ASGIApp:
    """The studio.

    Parameters
    ----------
    given : what the page begins with: `{"task": document}`, `{"plan": document}`, or None.
    hosts : the names and ports by which it may be asked for, as browsers say them: a page of
        somebody else's, under a name that leads here, is refused.
    workers : who answers; ended with the application.
    """
    pages = _pages()

    @asynccontextmanager
    async def lifespan(_app: Starlette) -> AsyncGenerator[None]:
        yield
        await workers.close()

    async def page(request: Request) -> Response:
        name = request.path_params.get("name", "index.html")
        if name not in pages:
            raise HTTPException(404, "there is no such page")
        body, media = pages[name]
        return Response(body, media_type=media)

    async def begin(_request: Request) -> Response:
        return JSONResponse(given)

    async def ask(request: Request) -> Response:
        question = questions.get(request.path_params["question"])
        if question is None:
            raise HTTPException(404, "there is no such question")
        body = await _body(request, limits)
        task = Task(request.path_params["question"], body, question.seconds, question.quick)
        try:
            workers.enter(task)
        except TooBusyError as error:
            raise HTTPException(503, str(error), {"Retry-After": "1"}) from None
        return _Answer(workers, task, limits)

    routes = [
        Route("/", page),
        Route("/static/{name}", page),
        Route("/given", begin),
        Route("/ask/{question}", ask, methods=["POST"]),
    ]
    app = Starlette(routes=routes, lifespan=lifespan, exception_handlers={HTTPException: _refused})
    return _Guarded(app, frozenset(hosts))


def _pages() -> dict[str, tuple[bytes, str]]:
    """The files of the page, read once: no path that a client sends reaches the disk."""
    folder = resources.files("preimage.studio") / "static"
    found = {}
    for entry in folder.iterdir():
        ending = "." + entry.name.rpartition(".")[2]
        if entry.is_file() and ending in MEDIA:
            found[entry.name] = entry.read_bytes(), MEDIA[ending]
    return found


async def _refused(_request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return PlainTextResponse(f"{error.detail}\n", error.status_code, error.headers)


async def _body(request: Request, limits: Limits) -> Any:
    """The JSON that a request brings.

    Raises
    ------
    HTTPException : it is of another type, too large, too slow, too deep, or not JSON.
    """
    if request.headers.get("content-type", "").partition(";")[0].strip() != "application/json":
        raise HTTPException(415, "a question is asked in JSON")
    whole = bytearray()
    try:
        async with asyncio.timeout(limits.patience):
            async for part in request.stream():
                whole += part
                if len(whole) > limits.body:
                    raise HTTPException(413, f"a question is at most {limits.body} bytes long")
    except TimeoutError:
        raise HTTPException(408, "the question took too long to arrive") from None
    except ClientDisconnect:
        raise HTTPException(400, "the question did not arrive") from None
    if _depth(whole) > limits.depth:
        raise HTTPException(400, f"the question is nested deeper than {limits.depth} levels")
    try:
        text = bytes(whole).decode("utf-8")
        body = json.loads(text, parse_constant=_no_number, parse_float=_finite)
    except (ValueError, RecursionError):
        raise HTTPException(400, "the question is not JSON") from None
    if not isinstance(body, dict):
        raise HTTPException(400, "the question is not a JSON object")
    return body


def _no_number(word: str) -> float:
    raise ValueError(word)


def _finite(word: str) -> float:
    found = float(word)
    return found if math.isfinite(found) else _no_number(word)


def _depth(text: bytearray) -> int:
    """How deeply lists and objects are nested, at most; brackets in strings count too."""
    deepest = level = 0
    for byte in text.translate(None, delete=_OTHERS):
        level += 1 if byte in b"[{" else -1
        deepest = max(deepest, level)
    return deepest


_OTHERS = bytes(set(range(256)) - set(b"[]{}"))


class _Answer(Response):
    """An answer as it comes, line by line; who hangs up takes the question back."""

    def __init__(self, workers: Workers, task: Task, limits: Limits) -> None:
        super().__init__(media_type="application/x-ndjson")
        self._workers, self._task, self._limits = workers, task, limits

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Say what the worker says, until it is done or nobody listens."""
        saying = asyncio.create_task(self._say(send))
        listening = asyncio.create_task(_hung_up(receive))
        try:
            await asyncio.wait({saying, listening}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._workers.leave(self._task)
            for task in (saying, listening):
                task.cancel()
            ended = await asyncio.gather(saying, listening, return_exceptions=True)
        if isinstance(ended[0], Exception) and not isinstance(ended[0], OSError | TimeoutError):
            raise ended[0]

    async def _say(self, send: Send) -> None:
        start: Message = {
            "type": "http.response.start", "status": 200, "headers": self.raw_headers,
        }  # fmt: skip
        # there is no content-length: the headers of an empty response have one
        start["headers"] = [pair for pair in start["headers"] if pair[0] != b"content-length"]
        await send(start)
        async with aclosing(self._workers.ask(self._task)) as lines:
            async for line in lines:
                async with asyncio.timeout(self._limits.taking):
                    await send({"type": "http.response.body", "body": line, "more_body": True})
        async with asyncio.timeout(self._limits.taking):
            await send({"type": "http.response.body", "body": b""})


async def _hung_up(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


class _Guarded:
    """Refuses who was sent by somebody else's page, and says the headers with everything."""

    def __init__(self, app: ASGIApp, hosts: frozenset[str]) -> None:
        self._app = app
        self._hosts = hosts
        self._origins = frozenset(f"http://{host}" for host in hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            return

        async def said(message: Message) -> None:
            if message["type"] == "http.response.start":
                kept = [pair for pair in message["headers"] if pair[0] != b"server"]
                message = {**message, "headers": [*kept, *OWN_HEADERS]}
            await send(message)

        refusal = self._refusal(scope)
        if refusal is not None:
            await PlainTextResponse(f"{refusal}\n", 403)(scope, receive, said)
        else:
            await self._app(scope, receive, said)

    def _refusal(self, scope: Scope) -> str | None:
        # a header may come twice: each value has to be right
        headers = Headers(scope=scope)
        hosts = {host.lower() for host in headers.getlist("host")}
        if not hosts or not hosts <= self._hosts:
            return "the studio is not asked for by this name"
        origins = {origin.lower() for origin in headers.getlist("origin")}
        sites = set(headers.getlist("sec-fetch-site"))
        if not origins <= self._origins or not sites <= {"same-origin", "none"}:
            return "a page of somebody else's asks"
        return None
