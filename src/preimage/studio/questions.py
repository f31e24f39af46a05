"""What a page may ask, and in which time it is answered."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

Body = dict[str, Any]

Tell = Callable[[Body], None]
"""Told how far an answer has come."""


@dataclass(frozen=True, slots=True)
class Question:
    """One thing that may be asked.

    Parameters
    ----------
    home : the function that answers, as `module:name`; it is loaded by who answers, not by the
        process that serves the page.
    seconds : the answer may take.
    quick : it is answered by the process that is kept warm for what a page asks all the time.
    """

    home: str
    seconds: float
    quick: bool = False

    def answer(self, body: Body, tell: Tell) -> Body:
        """The answer.

        Raises
        ------
        PreimageError : the question is refused.
        """
        module, _, name = self.home.partition(":")
        function: Callable[[Body, Tell], Body] = getattr(
            import_module(f"preimage.studio.{module}"), name
        )
        return function(body, tell)


QUESTIONS: dict[str, Question] = {
    "examples": Question("documents:examples", 10.0, quick=True),
    "example": Question("documents:example", 10.0, quick=True),
    "read": Question("documents:read", 10.0, quick=True),
    "write": Question("documents:write", 10.0, quick=True),
    "adversaries": Question("running:adversaries", 10.0, quick=True),
    "space": Question("scenes:space", 20.0, quick=True),
    "stage": Question("scenes:stage", 20.0, quick=True),
    "run": Question("running:one_run", 20.0, quick=True),
    "play": Question("playing:play", 20.0, quick=True),
    "plan": Question("planned:new_plan", 300.0),
    "plan_file": Question("planned:plan_file", 60.0),
    "margins": Question("planned:slack", 120.0),
    "verify": Question("planned:verified", 300.0),
    "runs": Question("running:many_runs", 300.0),
    "explain": Question("asked:explained", 900.0),
    "budget": Question("asked:budgeted", 1800.0),
    "draw": Question("documents:drawn", 60.0),
    "film": Question("documents:filmed", 120.0),
}
"""All of them; the page loops over nothing else."""
