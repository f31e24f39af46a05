"""Every benchmark, by name."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import partial

from benchmarks.timing import table


def python(*arguments: str) -> Callable[[], object]:
    """A run of the interpreter, from its start to its end."""
    return partial(subprocess.run, [sys.executable, *arguments], check=True, capture_output=True)


BENCHMARKS = {
    "start python": python("-c", "pass"),
    "import preimage": python("-c", "import preimage"),
    "preimage --help": python("-c", "from preimage.cli.main import main; main(['--help'])"),
}

if __name__ == "__main__":
    table(BENCHMARKS)
