"""Clients that mean harm, and workers that go wrong: the rest goes on, within bounds."""

import asyncio
import json
import random
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, aclosing
from typing import Any

import httpx
import pytest

from preimage.studio.limits import MEBIBYTE, Limits
from preimage.studio.questions import QUESTIONS
from preimage.studio.workers import Task, TooBusyError, Workers
from preimage.task.examples import named_task
from preimage.task.files import dump_task
from tests.studio.serving import Served, becomes, children, odd, resident, served


@pytest.fixture
def studio() -> Iterator[Served]:
    """Impatient, with workers that do what they are told."""
    with served(*odd(), patience=1.0, taking=1.0, connections=32, waiting=4) as found:
        yield found


def fresh(studio: Served) -> None:
    """A client that means well is answered, a page and a quick question."""
    with studio.client as client:
        assert client.get("/").status_code == 200
        assert client.post("/ask/examples", json={}).status_code == 200


def talk(studio: Served, text: str = "") -> socket.socket:
    found = socket.create_connection(studio.place, timeout=20)
    found.sendall(text.encode())
    return found


def head(studio: Served, length: int, question: str = "plan") -> str:
    host = f"127.0.0.1:{studio.place[1]}"
    return (
        f"POST /ask/{question} HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n"
        f"Content-Length: {length}\r\n\r\n"
    )


def is_cut(client: socket.socket, drop: str = "") -> bytes:
    """What is said until the server hangs up, while more comes in drops."""
    client.settimeout(0.1)
    said = b""
    for _ in range(200):
        try:
            if drop:
                client.sendall(drop.encode())
            part = client.recv(65536)
        except TimeoutError:
            continue
        except ConnectionError:
            return said
        if not part:
            return said
        said += part
    pytest.fail("the server goes on waiting")


# --- slow clients -------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["", "G", "GET / HTTP/1.1\r\n", "GET / HTTP/1.1\r\nHost: x\r\n"])
def test_a_silent_client_is_cut(text: str, studio: Served) -> None:
    with talk(studio, text) as client:
        assert is_cut(client) == b""


def test_a_head_in_drops_is_cut(studio: Served) -> None:
    with talk(studio, "GET / HTTP/1.1\r\n") as client:
        assert is_cut(client, "a: b\r\n") == b""


def test_a_body_in_drops_is_cut(studio: Served) -> None:
    with talk(studio, head(studio, 100_000)) as client:
        assert is_cut(client, " ").startswith(b"HTTP/1.1 408")


def test_a_connection_that_is_kept_is_cut(studio: Served) -> None:
    with talk(studio, f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{studio.place[1]}\r\n\r\n") as client:
        assert is_cut(client).startswith(b"HTTP/1.1 200")


def test_who_asks_and_never_takes_is_cut(studio: Served) -> None:
    get = f"GET /given HTTP/1.1\r\nHost: 127.0.0.1:{studio.place[1]}\r\n\r\n"
    with socket.socket() as client:
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        client.settimeout(20)
        client.connect(studio.place)
        with pytest.raises(OSError, match=r"reset|Broken pipe|timed out"):
            client.sendall(get.encode() * 200_000)
    fresh(studio)


def test_who_does_not_take_a_long_answer_is_cut(studio: Served) -> None:
    body = json.dumps({"do": "huge", "size": 20_000_000})
    with talk(studio, head(studio, len(body)) + body) as client:
        assert becomes(lambda: len(children(studio.pid)) == 1)
        time.sleep(3.0)
        client.settimeout(20)
        said = 0
        try:
            while part := client.recv(1 << 20):
                said += len(part)
        except ConnectionError:
            pass
        assert said < 20_000_000
    fresh(studio)


# --- many clients -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["silent", "half a head", "half a body", "answered"])
def test_hundreds_of_sockets_leave_room(kind: str, studio: Served) -> None:
    host = f"127.0.0.1:{studio.place[1]}"
    text = {
        "silent": "",
        "half a head": f"GET / HTTP/1.1\r\nHost: {host}\r\n",
        "half a body": head(studio, 1000) + "{",
        "answered": f"GET / HTTP/1.1\r\nHost: {host}\r\n\r\n",
    }[kind]
    with ExitStack() as stack:
        for _ in range(100):
            try:
                stack.enter_context(talk(studio, text))
            except ConnectionError:
                continue
        fresh(studio)
    fresh(studio)


def test_a_thousand_sockets_leave_room_and_little_memory() -> None:
    with served(*odd()) as studio, ExitStack() as stack:
        fresh(studio)
        before = resident(studio.pid)
        for number in range(1000):
            stack.enter_context(talk(studio, "GET / HTTP/1.1\r\nX: " * (number % 2)))
            if number % 250 == 249:
                fresh(studio)
        assert resident(studio.pid) - before < 32 * MEBIBYTE


def test_too_many_questions_are_refused_and_the_quick_ones_go_on(studio: Served) -> None:
    with ExitStack() as stack:
        for _ in range(4):
            client = stack.enter_context(studio.client)
            content = stack.enter_context(
                client.stream("POST", "/ask/plan", json={"do": "sleep", "for": 60})
            )
            assert content.status_code == 200
        with studio.client as client:
            refused = client.post("/ask/plan", json={})
        assert refused.status_code == 503
        assert refused.headers["retry-after"] == "1"
        assert refused.text.count("\n") == 1
        fresh(studio)
    assert becomes(lambda: len(children(studio.pid)) <= 1)
    assert "answer" in studio.ask("plan")[0]


def test_questions_taken_back_leave_nothing(studio: Served) -> None:
    assert studio.ask("plan")
    fresh(studio)
    before, held = len(children(studio.pid)), resident(studio.pid)
    rng = random.Random(5)
    for number in range(150):
        body = json.dumps({"do": "sleep", "for": 60.0, "more": "x" * rng.randrange(100_000)})
        with talk(studio, head(studio, len(body)) + body) as client:
            if number % 3:
                client.settimeout(5)
                client.recv(100)
    assert becomes(lambda: len(children(studio.pid)) <= before)
    fresh(studio)
    assert "answer" in studio.ask("plan")[0]
    assert len(children(studio.pid)) <= before
    assert resident(studio.pid) - held < 32 * MEBIBYTE


def test_quick_questions_taken_back_do_not_jam(studio: Served) -> None:
    for _ in range(100):
        body = json.dumps({"do": "sleep", "for": 0.01})
        with talk(studio, head(studio, len(body), "space") + body):
            pass
    assert becomes(lambda: _is_answered(studio))


def _is_answered(studio: Served) -> bool:
    with studio.client as client:
        return client.post("/ask/space", json={}).status_code == 200


def test_large_questions_leave_little_memory(studio: Served) -> None:
    body = json.dumps({"x": "x" * (MEBIBYTE - 100)})
    fresh(studio)
    before = resident(studio.pid)
    for _ in range(30):
        with talk(studio, head(studio, len(body), "space") + body) as client:
            client.settimeout(20)
            assert client.recv(12).endswith(b"200")
    fresh(studio)
    assert resident(studio.pid) - before < 48 * MEBIBYTE


@pytest.mark.slow
def test_hundreds_of_real_questions_taken_back() -> None:
    task = dump_task(named_task("cluttered-hall"))
    with served() as studio:
        studio.ask("space", task=task)
        studio.ask("plan", task=task)
        before, held = len(children(studio.pid)), resident(studio.pid)
        rng = random.Random(1)
        for _ in range(200):
            question = rng.choice(["budget", "explain", "plan", "space", "runs"])
            body = json.dumps({"task": task})
            with talk(studio, head(studio, len(body), question) + body):
                time.sleep(rng.choice((0.0, 0.05, 0.2)))
        assert becomes(lambda: len(children(studio.pid)) <= before)
        assert studio.ask("plan", task=task)[-1]["answer"]["status"] == "solved"
        assert resident(studio.pid) - held < 64 * MEBIBYTE


# --- workers that go wrong ----------------------------------------------------------------------


def said(workers: Workers, seconds: float = 30.0, quick: bool = False, **body: Any) -> Any:
    """What is answered to one question."""

    async def collect() -> list[dict[str, Any]]:
        task = Task("plan", body, seconds, quick)
        async with aclosing(workers.ask(task)) as lines:
            return [json.loads(line) async for line in lines]

    return collect()


ODDITIES: dict[str, tuple[dict[str, Any], str]] = {
    "crashes": ({"do": "crash"}, "the process that worked on it ended"),
    "ends midway": ({"do": "half"}, "the process that worked on it ended"),
    "never ends": ({"do": "sleep"}, "it took longer than 0.5 s"),
    "talks for ever": ({"do": "talk", "lines": 10**9, "pause": 0.01}, "it took longer than 0.5 s"),
    "says too much": ({"do": "huge", "size": 300_000}, "the answer is too large"),
}


@pytest.mark.parametrize("quick", [True, False])
@pytest.mark.parametrize("case", ODDITIES)
def test_odd_workers_are_replaced(case: str, quick: bool) -> None:
    body, words = ODDITIES[case]

    async def story() -> None:
        workers = Workers(Limits(answer=100_000), odd())
        try:
            for _ in range(3):
                lines = await said(workers, 0.5, quick, **body)
                assert lines[-1] == {"failed": words}
                assert all("progress" in line for line in lines[:-1])
                assert "pid" in (await said(workers, quick=quick))[-1]["answer"]
        finally:
            await workers.close()

    asyncio.run(story())


def test_a_worker_is_kept_while_it_does_well() -> None:
    async def story() -> None:
        workers = Workers(Limits(), odd())
        try:
            found = {(await said(workers, quick=True))[0]["answer"]["pid"] for _ in range(5)}
            assert len(found) == 1
        finally:
            await workers.close()

    asyncio.run(story())


def test_a_command_that_is_none_is_said() -> None:
    async def story() -> None:
        workers = Workers(Limits(), ("/bin/false",))
        for quick in (True, False):
            assert "failed" in (await said(workers, quick=quick))[-1]
        await workers.close()

    asyncio.run(story())


def test_places_are_counted() -> None:
    async def story() -> None:
        workers = Workers(Limits(waiting=2), odd())
        long, quick = Task("plan", {}, 1.0, False), Task("space", {}, 1.0, True)
        for task in (long, quick):
            workers.enter(task)
            workers.enter(task)
            with pytest.raises(TooBusyError):
                workers.enter(task)
            workers.leave(task)
            workers.enter(task)

    asyncio.run(story())


def test_memory_is_limited_in_a_worker() -> None:
    """A real worker, with little more than what its libraries map."""
    task = dump_task(named_task("flat-floor"))
    huge = {**task, "walls": [[[x, 0.0], [x + 0.5, 0.0]] for x in range(20_000)]}
    with served(memory=64 * MEBIBYTE) as studio:
        for _ in range(2):
            [line] = studio.ask("space", task=huge)
            assert set(line) == {"failed"}
        fresh_page = httpx.get(studio.address, trust_env=False)
        assert fresh_page.status_code == 200


def test_every_question_has_a_time() -> None:
    assert all(0.0 < question.seconds <= 1800.0 for question in QUESTIONS.values())
