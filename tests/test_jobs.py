from __future__ import annotations

import logging
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from preimage.errors import InputError, PreimageError
from preimage.jobs import Here, Processes, Workforce, workforce


def squared(pause: float, number: int) -> tuple[int, int]:
    time.sleep(pause)
    return number * number, os.getpid()


def deadly(number: int) -> int:
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def deadly_once(mark: str, number: int) -> int:
    if number == 3 and not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def failing(number: int) -> int:
    raise ValueError("no", number)


def unsendable(_number: int) -> object:
    return lambda: None


@pytest.fixture(params=["here", "processes"])
def crew(request: pytest.FixtureRequest) -> Iterator[Workforce]:
    with Here() if request.param == "here" else Processes(3) as found:
        yield found


def test_each_item_is_done_once_and_comes_with_its_place(crew: Workforce) -> None:
    for items in ([], [5], list(range(40))):
        found = sorted(crew.carry_out(abs, items))
        assert found == list(enumerate(items))


def test_what_work_raises_is_raised_and_the_crew_goes_on(crew: Workforce) -> None:
    with pytest.raises(ValueError, match="no"):
        list(crew.carry_out(failing, range(10)))
    assert sorted(crew.carry_out(abs, [1, 2])) == [(0, 1), (1, 2)]


def test_who_has_enough_may_stop(crew: Workforce) -> None:
    results = crew.carry_out(partial(squared, 0.01), range(1000))
    next(iter(results))
    results.close()
    assert len(list(crew.carry_out(abs, range(5)))) == 5


def test_a_process_that_is_killed_loses_nothing(tmp_path: Path) -> None:
    with Processes(2) as crew:
        work = partial(deadly_once, str(tmp_path / "mark"))
        assert sorted(crew.carry_out(work, range(8))) == list(enumerate(range(8)))
    assert (tmp_path / "mark").exists()


def test_a_process_killed_from_outside_loses_nothing() -> None:
    with Processes(2) as crew:
        found: dict[int, int] = {}
        for place, (square, pid) in crew.carry_out(partial(squared, 0.01), range(30)):
            found[place] = square
            if len(found) in (5, 15):
                os.kill(pid, signal.SIGKILL)
    assert found == {number: number * number for number in range(30)}


def test_an_item_that_ends_its_process_each_time_is_named() -> None:
    with Processes(2) as crew:
        with pytest.raises(PreimageError, match="3 processes were ended while they did this: 3"):
            list(crew.carry_out(deadly, range(8)))
        assert len(list(crew.carry_out(abs, range(4)))) == 4


def test_what_cannot_be_sent_is_refused() -> None:
    with Processes(2) as crew:
        with pytest.raises(PreimageError, match="cannot be sent"):
            list(crew.carry_out(lambda number: number, range(4)))
        with pytest.raises(PreimageError, match="cannot be sent"):
            list(crew.carry_out(unsendable, range(4)))
        assert len(list(crew.carry_out(abs, range(4)))) == 4


def test_processes_end_with_their_parent(tmp_path: Path) -> None:
    script = (
        "import os, signal, sys\n"
        "from functools import partial\n"
        "from tests.test_jobs import squared\n"
        "from preimage.jobs import Processes\n"
        "crew = Processes(2)\n"
        "for place, (_, pid) in crew.carry_out(partial(squared, 0.01), range(4)):\n"
        "    print(pid, flush=True)\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False,
        cwd=Path(__file__).parents[1],
    )  # fmt: skip
    pids = {int(line) for line in done.stdout.split()}
    assert pids
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline and any(_is_alive(pid) for pid in pids):
        time.sleep(0.1)
    assert not any(_is_alive(pid) for pid in pids)


def _is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    stat = Path(f"/proc/{pid}/stat")
    return not stat.exists() or stat.read_text().rpartition(")")[2].split()[0] != "Z"


# --- a cluster ------------------------------------------------------------------------------


@pytest.fixture
def cluster() -> Iterator[Any]:
    distributed = pytest.importorskip("distributed")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, processes=True, dashboard_address=":0",
        scheduler_port=0, silence_logs=logging.CRITICAL,
    ) as found:  # fmt: skip
        yield found


def test_a_cluster_of_which_a_worker_is_killed_loses_nothing(cluster: Any) -> None:
    done: list[int] = []
    with workforce(scheduler=cluster.scheduler_address) as crew:
        assert crew.size == 3
        found: dict[int, int] = {}
        killed = False
        for place, (square, pid) in crew.carry_out(partial(squared, 0.05), range(40)):
            assert place not in found
            found[place] = square
            done.append(len(found))
            if not killed:
                os.kill(pid, signal.SIGKILL)
                killed = True
        assert found == {number: number * number for number in range(40)}
        assert done == list(range(1, 41))
        with pytest.raises(ValueError, match="no"):
            list(crew.carry_out(failing, range(4)))
        assert sorted(crew.carry_out(abs, range(6))) == list(enumerate(range(6)))


def test_a_budget_is_the_same_whoever_makes_it(cluster: Any) -> None:
    from preimage.analysis.budget import budget
    from preimage.analysis.budget_file import format_budget
    from preimage.analysis.survey import Survey
    from preimage.task.examples import named_task

    task = named_task("peg-in-hole-point")
    address = cluster.scheduler_address
    crews: list[Workforce] = [Here(), Processes(2), workforce(scheduler=address)]
    texts = set()
    for crew in crews:
        with crew:
            found = budget(Survey.of(task, workforce=crew), ["control", "position"])
            texts.add(format_budget(found))
    assert len(texts) == 1


def test_a_scheduler_that_is_not_there_is_refused() -> None:
    pytest.importorskip("distributed")
    with (
        pytest.raises(InputError, match="nonsense: no Dask scheduler"),
        workforce(scheduler="nonsense"),
    ):
        pass
