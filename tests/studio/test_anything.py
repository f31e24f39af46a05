"""With anything for a body, a question is answered or refused."""

import copy
import json
import math
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from preimage.errors import InputError, PreimageError
from preimage.studio.questions import QUESTIONS
from tests.studio.test_questions import QUICK, Body, plan_of, start_of, task_of


def deep(levels: int) -> Any:
    found: Any = []
    for _ in range(levels):
        found = [found]
    return found


JUNK: list[Any] = [
    None, True, False, 0, -1, 1, 3.7, 1e-300, 1e300, -1e18, 10**400, math.nan, math.inf, -math.inf,
    "", "x", "\x00", "\ud800", "nan", "x" * 5_000, [], [[]], {}, {"": {}}, {"x": [None]}, [0, 0],
    ["x", 1], [1.0] * 3_000, [[0, 0]] * 300, [[i, i * i] for i in range(50)], deep(25),
    {str(i): i for i in range(200)},
]  # fmt: skip
"""What a value may be instead; the server refuses what is not finite, the questions do too."""


def places_in(value: Any, way: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The way to every node of a document."""
    items: Any = ()
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = enumerate(value)
    for key, below in items:
        yield (*way, key)
        yield from places_in(below, (*way, key))


def changed(document: Any, way: tuple[Any, ...], junk: Any, drop: bool) -> Any:
    found = copy.deepcopy(document)
    node = found
    for key in way[:-1]:
        node = node[key]
    if drop:
        del node[way[-1]]
    else:
        node[way[-1]] = copy.deepcopy(junk)
    return found


def body_of(question: str, name: str) -> Body:
    match question:
        case "space" | "write" | "plan":
            return {"task": task_of(name)}
        case "stage":
            return {"task": task_of(name), "direction": -90, "method": "kernel"}
        case "plan_file":
            return {"plan": plan_of(name)}
        case "run":
            return {"plan": plan_of(name), "control": "left", "sensing": "away", "seed": 1}
        case _:
            moves = [[1.0, 0.5, 0.1, -0.1, 1.0]]
            return {"plan": plan_of(name), "start": start_of(name), "moves": moves, "cheat": {}}


def answered_or_refused(question: str, body: Body) -> None:
    try:
        found = QUESTIONS[question].answer(body, lambda _: None)
    except PreimageError as error:
        words = error.rule if isinstance(error, InputError) else str(error)
        assert words
    else:
        json.dumps(found, allow_nan=False)


def check_changed(question: str, name: str, changes: list[tuple[int, Any, bool]]) -> None:
    body: Any = body_of(question, name)
    for place, junk, drop in changes:
        ways = list(places_in(body))
        if ways:
            body = changed(body, ways[place % len(ways)], junk, drop)
    answered_or_refused(question, body)


CHANGES = st.lists(
    st.tuples(st.integers(0, 10_000), st.sampled_from(JUNK), st.booleans()), min_size=1, max_size=3
)


@settings(max_examples=80, suppress_health_check=[HealthCheck.too_slow])
@given(
    question=st.sampled_from(QUICK),
    name=st.sampled_from(["flat-floor", "l-room", "two-bays", "peg-in-hole"]),
    changes=CHANGES,
)
@example(question="space", name="flat-floor", changes=[(0, 3, False)])
def test_anything_is_answered_or_refused(
    question: str, name: str, changes: list[tuple[int, Any, bool]]
) -> None:
    check_changed(question, name, changes)


@pytest.mark.slow
@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("junk", JUNK, ids=lambda value: repr(value)[:20])
def test_junk_for_everything(question: str, junk: Any) -> None:
    keys = ("task", "plan", "text", "name", "start", "moves", "direction", "bounds", "format")
    for body in ({key: junk} for key in keys):
        answered_or_refused(question, body)
    answered_or_refused(question, dict.fromkeys(keys, junk))


@pytest.mark.slow
@pytest.mark.parametrize("question", QUICK)
@pytest.mark.parametrize("name", ["flat-floor", "two-bays", "peg-in-hole"])
def test_every_node_replaced_by_all_junk(question: str, name: str) -> None:
    body: Any = body_of(question, name)
    for way in list(places_in(body))[:400]:
        for junk in JUNK[:10]:
            answered_or_refused(question, changed(body, way, junk, drop=False))
        answered_or_refused(question, changed(body, way, None, drop=True))
