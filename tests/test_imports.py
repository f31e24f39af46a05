"""The floors of the house: who may import whom."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "preimage"


def native_calls(source: Path) -> Iterator[str]:
    """The functions of the compiled module that a module names."""
    for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "preimage._native":
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.Attribute) and ast.unparse(node.value).endswith("_native"):
            yield node.attr


def test_contracts_are_kept() -> None:
    command = "from importlinter.cli import lint_imports_command as lint; lint()"
    done = subprocess.run(
        [sys.executable, "-c", command, "--no-cache", "--no-logo"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_each_native_function_has_one_wrapper() -> None:
    wrappers = defaultdict(set)
    for source in sorted(PACKAGE.rglob("*.py")):
        for name in native_calls(source):
            wrappers[name].add(source.relative_to(PACKAGE).as_posix())
    assert wrappers
    assert {name: rooms for name, rooms in wrappers.items() if len(rooms) > 1} == {}


def test_importing_the_package_loads_no_room() -> None:
    command = "import sys, preimage; print(*(m for m in sys.modules if m.startswith('preimage.')))"
    done = subprocess.run(
        [sys.executable, "-c", command], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["preimage.display"]
