"""The command as a process of its own: how it starts, is interrupted, and loses its readers."""

import contextlib
import json
import os
import pty
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from preimage.task.examples import named_task
from preimage.task.files import dump_task

PREIMAGE = [sys.executable, "-m", "preimage.cli.main"]
FLOOR = [*PREIMAGE, "plan", "--example", "flat-floor"]


def process(*arguments: str, **options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*PREIMAGE, *arguments],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **options},
        timeout=120,
    )


@pytest.fixture
def long_task(tmp_path: Path) -> Path:
    """A task that is planned for minutes: a wide hall, much uncertainty, a start anywhere."""
    data = dump_task(named_task("hall-300"))
    data["uncertainty"]["control"] = 25
    data["initial"] = "everywhere"
    data["planner"]["directions"] = 64
    path = tmp_path / "task.json"
    path.write_text(json.dumps(data))
    return path


def test_version() -> None:
    done = process("--version")
    assert done.stdout.startswith("preimage, version ")
    assert done.returncode == 0


def test_the_version_is_said_without_loading_numpy() -> None:
    code = (
        "import sys; sys.argv = ['preimage', '--version']\n"
        "from preimage.cli.main import run; run()\n"
        "heavy = {'numpy', 'shapely', 'matplotlib', 'yaml'} & set(sys.modules)\n"
        "sys.exit(f'loaded: {heavy}' if heavy else 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_planning_loads_no_matplotlib() -> None:
    code = (
        "import sys\nfrom preimage.cli.main import run\n"
        "assert run(['plan', '--example', 'flat-floor']) == 0\n"
        "sys.exit('matplotlib' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, check=False, timeout=60
    )
    assert done.returncode == 0


class Terminal:
    """A process whose standard error is a terminal."""

    def __init__(self, *arguments: str) -> None:
        self._leader, follower = pty.openpty()
        self.process = subprocess.Popen(
            [*PREIMAGE, *arguments], stdout=subprocess.PIPE, stderr=follower, text=True
        )
        os.close(follower)
        self.told = b""

    def read(self, until: bytes | None = None) -> None:
        """Read what it says there, up to a word or to the end."""
        with contextlib.suppress(OSError):  # the other side is closed
            while until is None or until not in self.told:
                self.told += os.read(self._leader, 4096)

    def end(self) -> str:
        """Wait for the end; what it said on standard output."""
        said, _ = self.process.communicate(timeout=120)
        self.read()
        os.close(self._leader)
        return str(said)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_it_writes_what_it_has(
    number: signal.Signals, long_task: Path, tmp_path: Path
) -> None:
    plan = tmp_path / "plan.json"
    running = Terminal("plan", str(long_task), "-o", str(plan))
    running.read(until=b"regions")
    running.process.send_signal(number)
    assert running.end().startswith("hall-300: stopped: interrupted\n")
    assert running.process.returncode == 1
    assert json.loads(plan.read_text())["status"] == "stopped"


def test_out_of_time_it_writes_what_it_has(long_task: Path, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    done = process("plan", str(long_task), "--time-limit", "0.5", "-o", str(plan))
    assert done.returncode == 1
    assert done.stdout.startswith("hall-300: stopped: the time limit of 0.5 s came first\n")
    assert json.loads(plan.read_text())["status"] == "stopped"


def test_progress_on_a_terminal(long_task: Path) -> None:
    running = Terminal("plan", str(long_task), "--time-limit", "2")
    assert running.end().startswith("hall-300: stopped: the time limit of 2 s came first\n")
    assert running.process.returncode == 1
    assert b" regions, layer " in running.told
    assert b" from the start, " in running.told
    assert running.told.endswith(b"\r\x1b[K")


def test_a_reader_that_leaves_does_not_change_the_status() -> None:
    for arguments in (FLOOR, [*PREIMAGE, "plan", "--help"], [*PREIMAGE, "examples"]):
        running = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        assert running.stdout is not None
        assert running.stderr is not None
        running.stdout.close()
        told = running.stderr.read()
        running.stderr.close()
        assert running.wait(60) == 0
        assert told == b""


def test_closed_streams() -> None:
    command = " ".join(FLOOR)
    for redirection in (">&-", "2>&-", ">&- 2>&-", "<&-"):
        done = subprocess.run(
            f"{command} {redirection}", shell=True, capture_output=True, check=False, timeout=60
        )
        assert done.returncode == 0
        assert done.stderr == b""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a full device")
def test_a_full_device_is_no_success() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            FLOOR, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=60
        )
    assert done.returncode == 2
    assert done.stderr == "preimage: standard output: cannot be written: " + (
        "No space left on device\n"
    )


def test_terminals_without_arrows() -> None:
    done = process("plan", "--example", "flat-floor", PYTHONIOENCODING="ascii", PYTHONUTF8="0")
    assert done.returncode == 0
    assert "motion 1 of 1: ? down (270?)" in done.stdout


def test_shells_are_answered() -> None:
    answer = process(
        _PREIMAGE_COMPLETE="bash_complete",
        COMP_WORDS="preimage plan --example flat",
        COMP_CWORD="3",
    )
    assert answer.stdout == "plain,flat-floor\n"
    assert answer.returncode == 0
