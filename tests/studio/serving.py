"""A studio as a process of its own, with limits and workers that a test chooses."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx

SCRIPT = """
import functools, json, sys
from preimage.studio import server
from preimage.studio.limits import Limits
limits, command = json.loads(sys.argv[1]), json.loads(sys.argv[2])
if command:
    server.Workers = functools.partial(server.Workers, command=tuple(command))
server.serve(server.listen("127.0.0.1", 0), limits=Limits(**limits),
             ready=lambda address: print(address, flush=True))
"""

ODD_WORKER = str(Path(__file__).parent / "odd_worker.py")


@dataclass(frozen=True)
class Served:
    """Where it is, and its process."""

    address: str
    process: subprocess.Popen[str]

    @property
    def pid(self) -> int:
        return self.process.pid

    @property
    def place(self) -> tuple[str, int]:
        host, _, port = self.address.removeprefix("http://").strip("/").partition(":")
        return host, int(port)

    @property
    def client(self) -> httpx.Client:
        return httpx.Client(base_url=self.address, timeout=60.0, trust_env=False)

    def ask(self, question: str, **body: Any) -> list[dict[str, Any]]:
        """The lines of an answer."""
        with self.client as client:
            content = json.dumps(body)
            headers = {"Content-Type": "application/json"}
            answer = client.post(f"/ask/{question}", content=content, headers=headers)
        assert answer.status_code == 200, answer.text
        return [json.loads(line) for line in answer.text.splitlines()]


@contextmanager
def served(*command: str, **limits: float) -> Iterator[Served]:
    arguments = [sys.executable, "-c", SCRIPT, json.dumps(limits), json.dumps(command)]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield Served(process.stdout.readline().strip(), process)
        finally:
            process.kill()


def odd() -> tuple[str, str]:
    """The command of a worker that does what it is told, see `odd_worker`."""
    return sys.executable, ODD_WORKER


def children(pid: int) -> set[int]:
    """The processes that it has started and that still run."""
    found = set()
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
        except OSError:
            continue
        if int(parent) == pid and state != "Z":
            found.add(int(folder.name))
    return found


def runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def resident(pid: int) -> int:
    """Bytes of memory that a process holds."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def becomes(said: Callable[[], bool], seconds: float = 30.0) -> bool:
    """Whether it comes true before long."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if said():
            return True
        time.sleep(0.02)
    return said()
