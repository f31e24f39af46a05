import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from preimage.studio.app import HEADERS
from preimage.studio.questions import QUESTIONS
from preimage.task.examples import named_task
from preimage.task.files import dump_task
from tests.studio.serving import Served, becomes, children, odd, runs, served

PREIMAGE = str(Path(sys.executable).parent / "preimage")

JSON = {"Content-Type": "application/json"}


@pytest.fixture(scope="module")
def studio() -> Iterator[Served]:
    with served(body=100_000, waiting=4) as found:
        yield found


def raw(studio: Served, text: bytes) -> bytes:
    with socket.create_connection(studio.place, timeout=20) as talk:
        talk.sendall(text)
        talk.shutdown(socket.SHUT_WR)
        said = b""
        while part := talk.recv(65536):
            said += part
    return said


def post(studio: Served, question: str, content: bytes, **headers: str) -> httpx.Response:
    with studio.client as client:
        return client.post(f"/ask/{question}", content=content, headers={**JSON, **headers})


ANSWERS = {
    "page": ("GET", "/", {}, b"", 200),
    "head": ("HEAD", "/", {}, b"", 200),
    "given": ("GET", "/given", {}, b"", 200),
    "no page": ("GET", "/nothing", {}, b"", 404),
    "no file": ("GET", "/static/nothing.js", {}, b"", 404),
    "no question": ("POST", "/ask/nothing", JSON, b"{}", 404),
    "wrong method": ("GET", "/ask/space", {}, b"", 405),
    "wrong method of a page": ("POST", "/", {}, b"", 405),
    "other method": ("TRACE", "/", {}, b"", 405),
    "wrong type": ("POST", "/ask/examples", {"Content-Type": "text/plain"}, b"{}", 415),
    "no type": ("POST", "/ask/examples", {}, b"{}", 415),
    "too large": ("POST", "/ask/examples", JSON, b" " * 100_001, 413),
    "malformed": ("POST", "/ask/examples", JSON, b"{", 400),
    "stranger": ("GET", "/", {"Host": "evil.example"}, b"", 403),
    "answered": ("POST", "/ask/examples", JSON, b"{}", 200),
    "refused": ("POST", "/ask/example", JSON, b"{}", 200),
}


@pytest.mark.parametrize("case", ANSWERS)
def test_every_answer_says_all_headers(case: str, studio: Served) -> None:
    method, path, headers, content, status = ANSWERS[case]
    with studio.client as client:
        answer = client.request(method, path, headers=headers, content=content)
    assert answer.status_code == status
    for key, value in HEADERS.items():
        assert answer.headers.get_list(key) == [value]
    assert "server" not in answer.headers


def test_what_is_not_http_gets_all_headers(studio: Served) -> None:
    said = raw(studio, b"rubbish\r\n\r\n")
    assert said.startswith(b"HTTP/1.1 400")
    for key, value in HEADERS.items():
        assert f"{key}: {value}".lower().encode() in said.lower()


@pytest.mark.parametrize(
    "host",
    ["evil.example", "127.0.0.1", "127.0.0.1:1", "127.0.0.1.evil.example:{port}", "", "[::1]"],
)
def test_other_names_are_refused(host: str, studio: Served) -> None:
    host = host.format(port=studio.place[1])
    said = raw(studio, f"GET / HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
    assert said.startswith(b"HTTP/1.1 403")


def test_no_name_and_two_names_are_refused(studio: Served) -> None:
    host = f"Host: 127.0.0.1:{studio.place[1]}\r\n"
    assert raw(studio, b"GET / HTTP/1.0\r\n\r\n").startswith(b"HTTP/1.1 403")
    twice = f"GET / HTTP/1.1\r\n{host}Host: evil.example\r\n\r\n"
    assert raw(studio, twice.encode()).startswith(b"HTTP/1.1 400")


def test_own_names_are_known(studio: Served) -> None:
    port = studio.place[1]
    for name in ("127.0.0.1", "localhost", "LocalHost", "[::1]"):
        said = raw(studio, f"GET / HTTP/1.1\r\nHost: {name}:{port}\r\n\r\n".encode())
        assert said.startswith(b"HTTP/1.1 200")


def test_pages_of_others_are_refused(studio: Served) -> None:
    own = studio.address.rstrip("/")
    others = [
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": ""},
        {"Origin": own.replace("http", "https")},
        {"Origin": f"{own}.evil.example"},
        {"Origin": own, "Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
        {"Sec-Fetch-Site": "rubbish"},
    ]
    for headers in others:
        assert post(studio, "examples", b"{}", **headers).status_code == 403
    for headers in ({"Origin": own}, {"Origin": own, "Sec-Fetch-Site": "same-origin"}):
        assert post(studio, "examples", b"{}", **headers).status_code == 200


def test_another_origin_beside_our_own_is_refused(studio: Served) -> None:
    own = studio.address.rstrip("/")
    host = f"Host: 127.0.0.1:{studio.place[1]}\r\n"
    for pair in (("http://evil.example", own), (own, "http://evil.example")):
        origins = "".join(f"Origin: {origin}\r\n" for origin in pair)
        assert raw(studio, f"GET / HTTP/1.1\r\n{host}{origins}\r\n".encode())[9:12] == b"403"


@pytest.mark.parametrize(
    "path",
    [
        "/static/../app.py",
        "/static/..%2fapp.py",
        "/static/%2e%2e/app.py",
        "/static/%2e%2e%2fapp.py",
        "/static/..\\app.py",
        "/static//etc/passwd",
        "/static/%2fetc%2fpasswd",
        "/static/",
        "/static/.",
        "/static/app.js%00.html",
        "/static/index.html/",
        "/../../etc/passwd",
        "//etc/passwd",
        "/static/app.py",
        "/ask/../given",
        "/ask/__class__",
        "http://evil.example/",
        "/%ff%fe",
    ],
)
def test_no_path_reaches_the_disk(path: str, studio: Served) -> None:
    host = f"Host: 127.0.0.1:{studio.place[1]}"
    said = raw(studio, f"GET {path} HTTP/1.1\r\n{host}\r\n\r\n".encode())
    assert said[9:12] in (b"400", b"404", b"405", b"307") or b"<!doctype html>" in said.lower()
    assert b"root:" not in said
    assert b"import " not in said.partition(b"\r\n\r\n")[2]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"null",
        b"[]",
        b'"words"',
        b"3",
        b"{",
        b"{}{}",
        b'{"a": NaN}',
        b'{"a": Infinity}',
        b'{"a": -Infinity}',
        b'{"a": 1e999}',
        b'{"a": [-1e999]}',
        b'{"a": ' + b"9" * 5000 + b"}",
        b'{"a": "\xff"}',
        b"\xef\xbb\xbf{}",
        "{}".encode("utf-16"),
        b'{"a": ' + b"[" * 40 + b"]" * 40 + b"}",
        b"[" * 90_000,
        b'{"a":' * 15_000,
        b"]" * 50_000 + b"[" * 49_000,
    ],
)
def test_what_is_not_a_json_object_is_refused(content: bytes, studio: Served) -> None:
    answer = post(studio, "space", content)
    assert answer.status_code == 400
    assert answer.text.count("\n") == 1


def test_a_stream_without_length_is_cut_at_the_limit(studio: Served) -> None:
    def parts() -> Iterator[bytes]:
        for _ in range(1000):
            yield b" " * 10_000

    with studio.client as client:
        try:
            answer = client.post("/ask/space", content=parts(), headers=JSON)
        except httpx.TransportError:
            return  # the server has hung up while we were still talking
        assert answer.status_code == 413


def test_a_long_head_is_refused(studio: Served) -> None:
    said = raw(studio, b"GET / HTTP/1.1\r\nX: " + b"x" * 100_000)
    assert not said or said.startswith(b"HTTP/1.1 4")


def test_a_name_that_is_no_text_is_answered(studio: Served) -> None:
    task = {**dump_task(named_task("flat-floor")), "name": "\ud800/../\x00"}
    for question in ("write", "space", "draw"):
        [line] = studio.ask(question, task=task)
        assert "failed" not in line, line


def test_the_longest_plan_says_how_far_it_is_and_then_the_plan(studio: Served) -> None:
    task = dump_task(named_task("connector"))
    *told, last = studio.ask("plan", task=task)
    assert last["answer"]["status"] == "solved"
    regions = [line["progress"]["regions"] for line in told]
    assert regions == sorted(regions)
    assert regions


def test_refusals_name_the_place(studio: Served) -> None:
    assert studio.ask("space") == [{"refused": {"where": "task", "words": "is missing"}}]


def test_who_hangs_up_ends_the_worker() -> None:
    with served(*odd()) as studio, studio.client as client:
        assert studio.ask("plan", do="repeat")
        before = children(studio.pid)
        with client.stream("POST", "/ask/plan", json={"do": "talk", "lines": 5, "pause": 1e3}) as s:
            lines = s.iter_lines()
            assert json.loads(next(lines)) == {"progress": {"number": 0}}
            during = children(studio.pid)
        assert becomes(lambda: not during & children(studio.pid))
        assert studio.ask("plan", do="repeat")
        assert len(children(studio.pid)) <= len(before)


def test_real_questions_end_when_nobody_listens(studio: Served) -> None:
    task = dump_task(named_task("cluttered-hall"))
    with studio.client as client:
        with client.stream("POST", "/ask/budget", json={"task": task}) as answer:
            lines = answer.iter_lines()  # hangs up when it is forgotten
            next(lines)
            during = children(studio.pid)
        assert during
        assert becomes(lambda: len(children(studio.pid)) < len(during))


def test_every_question_is_on_a_known_list(studio: Served) -> None:
    for name in QUESTIONS:
        [line] = studio.ask(name, task=0, plan=0)
        assert set(line) & {"answer", "refused"}, (name, line)


# --- the command --------------------------------------------------------------------------------


def command(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [PREIMAGE, "studio", "--no-browser", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_command_says_where_it_is_and_ends(number: signal.Signals) -> None:
    with command("--port", "0", "--example", "flat-floor") as process:
        assert process.stdout is not None
        address = process.stdout.readline().split()[4]
        given = httpx.get(f"{address}given", trust_env=False).json()
        assert given == {"task": dump_task(named_task("flat-floor"))}
        httpx.post(f"{address}ask/examples", json={}, timeout=60, trust_env=False)
        workers = children(process.pid)
        assert workers
        process.send_signal(number)
        out, err = process.communicate(timeout=30)
        assert (out, err) == ("", "")
        if number == signal.SIGINT:
            assert process.returncode == 0
        assert becomes(lambda: not any(map(runs, workers)))


def test_ctrl_c_does_not_wait_for_a_long_question() -> None:
    with command("--port", "0") as process:
        assert process.stdout is not None
        address = process.stdout.readline().split()[4]
        task = dump_task(named_task("cluttered-hall"))
        with (
            httpx.Client(timeout=60, trust_env=False) as client,
            client.stream("POST", f"{address}ask/budget", json={"task": task}) as answer,
        ):
            lines = answer.iter_lines()  # hangs up when it is forgotten
            next(lines)
            workers = children(process.pid)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=30)
        assert process.returncode == 0
        assert err == ""
        assert becomes(lambda: not any(map(runs, workers)))


def test_a_port_that_is_taken_is_one_line_and_status_2() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with command("--port", str(port)) as process:
            out, err = process.communicate(timeout=30)
    assert process.returncode == 2
    assert out == ""
    assert err.count("\n") == 1
    assert f"127.0.0.1:{port}" in err


@pytest.mark.parametrize("host", ["nowhere.invalid", "256.0.0.1", "192.0.2.1", "\x7f", "a" * 300])
def test_hosts_that_are_not_here_are_one_line_and_status_2(host: str) -> None:
    with command("--port", "0", "--host", host) as process:
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (2, "")
    assert "Traceback" not in err
    assert err.count("\n") <= 2


def test_workers_end_with_a_server_that_is_killed() -> None:
    with served() as studio:
        task = dump_task(named_task("cluttered-hall"))
        with studio.client as client:
            client.post("/ask/examples", json={})
            with client.stream("POST", "/ask/budget", json={"task": task}) as answer:
                lines = answer.iter_lines()  # hangs up when it is forgotten
                next(lines)
                workers = children(studio.pid)
                assert len(workers) == 2
                os.kill(studio.pid, signal.SIGKILL)
                assert becomes(lambda: not any(map(runs, workers)), 60.0)
