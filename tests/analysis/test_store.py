from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.analysis.store import Store, digest_of
from preimage.errors import InputError
from preimage.task.examples import named_task
from preimage.task.options import Method, PlannerOptions, SearchOrder
from preimage.task.template import Template

BUDGET = [sys.executable, "-m", "preimage.cli.main", "budget", "--example", "peg-in-hole-point"]
QUESTION = [*BUDGET, "--bounds", "control,position,friction", "--workers", "1"]

CELL = Cell.at(Method.KERNEL, friction=20.0, **{"uncertainty.control": 5.0})


def test_what_was_put_is_there_when_it_is_opened_again(tmp_path: Path) -> None:
    path = tmp_path / "cells"
    found = Outcome(Answer.SOLVED, 3, "“words”\n")
    with Store(path, "a task") as store:
        assert store.get(CELL) is None
        store.put(CELL, found)
        # another reader sees it at once: it is not only in this process
        with sqlite3.connect(path) as other:
            assert other.execute("SELECT count(*) FROM cells").fetchone() == (1,)
        other.close()
    with Store(path, "a task") as store:
        assert store.get(CELL) == found
        assert len(store) == 1


@given(value=st.floats(allow_nan=False), method=st.sampled_from(Method))
def test_every_number_is_kept_to_the_last_digit(value: float, method: Method) -> None:
    cell = Cell.at(method, a=value)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "cells")
        with Store(path, "t") as store:
            store.put(cell, Outcome(Answer.REFUSED))
        with Store(path, "t") as store:
            assert store.get(cell) == Outcome(Answer.REFUSED)


def test_another_tasks_store_is_refused(tmp_path: Path) -> None:
    Store(tmp_path / "cells", "one").close()
    with pytest.raises(InputError, match="holds another task"):
        Store(tmp_path / "cells", "other")
    Store(tmp_path / "cells", "one").close()


@pytest.mark.parametrize(
    "content", [b"not a database at all, but long enough to be looked at" * 20]
)
def test_what_is_no_store_is_refused_and_kept(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "cells"
    path.write_bytes(content)
    with pytest.raises(InputError, match="is no store"):
        Store(path, "t")
    assert path.read_bytes() == content


def test_a_database_of_something_else_is_refused_and_kept(tmp_path: Path) -> None:
    path = tmp_path / "cells"
    base = sqlite3.connect(path)
    base.execute("CREATE TABLE addresses (name TEXT)")
    base.close()
    before = path.read_bytes()
    with pytest.raises(InputError, match="something else"):
        Store(path, "t")
    assert path.read_bytes() == before


def test_the_digest_is_that_of_all_that_answers_depend_on() -> None:
    template = Template.of(named_task("peg-in-hole"))
    options = template.task().options
    digests = {
        digest_of(template, options),
        digest_of(Template.of(named_task("cradle")), options),
        *(
            digest_of(template, _with(options, **change))
            for change in ({"max_steps": 3}, {"search": SearchOrder.BEST_FIRST})
        ),
    }
    assert len(digests) == 4
    # each cell names its method, and only guaranteed plans count
    same = _with(options, method=Method.STICKING, or_fail=True)
    assert digest_of(template, same) == digest_of(template, options)


def _with(options: PlannerOptions, **changes: Any) -> PlannerOptions:
    return replace(options, **changes)


@pytest.fixture(scope="module")
def untroubled(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("fresh") / "budget.json"
    subprocess.run([*QUESTION, "-o", str(path)], check=True, capture_output=True, timeout=120)
    assert [entry.name for entry in path.parent.iterdir()] == ["budget.json"]
    return path.read_bytes()


def _cells(path: Path) -> int:
    with sqlite3.connect(path, timeout=10) as base:
        found: int = base.execute("SELECT count(*) FROM cells").fetchone()[0]
    base.close()
    return found


def test_a_run_that_was_killed_goes_on_to_the_same_bytes(tmp_path: Path, untroubled: bytes) -> None:
    path, kept = tmp_path / "budget.json", tmp_path / "budget.json.cells"
    command = [*QUESTION, "-o", str(path)]
    before = 0
    for more in (1, 20):
        run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and run.poll() is None:
            if kept.exists() and kept.stat().st_size and _known(kept) >= before + more:
                break
            time.sleep(0.005)
        run.send_signal(signal.SIGKILL)
        assert run.wait(timeout=30) == -signal.SIGKILL
        assert not path.exists()
        assert _cells(kept) >= before + more
        before = _cells(kept)
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    assert path.read_bytes() == untroubled
    assert not kept.exists()


def _known(path: Path) -> int:
    try:
        return _cells(path)
    except sqlite3.Error:  # not made yet
        return 0


def test_a_full_disk_is_said_in_one_line_and_nothing_is_lost(
    tmp_path: Path, untroubled: bytes
) -> None:
    path, kept = tmp_path / "budget.json", tmp_path / "cells"
    command = [*QUESTION, "-o", str(path), "--store", str(kept)]
    # files may not grow beyond this: for the program that is what a full disk is
    limited = (
        "import resource, signal, sys\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (20480, 20480))\n"
        "from preimage.cli.main import main\n"
        "main(sys.argv[1:])"
    )
    run = subprocess.run(
        [sys.executable, "-c", limited, *command[3:]],
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert run.returncode == 2
    assert run.stderr.count("\n") == 1
    assert str(kept) in run.stderr
    assert not path.exists()
    before = _cells(kept)
    assert before > 0
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    assert path.read_bytes() == untroubled
    assert _cells(kept) > before
