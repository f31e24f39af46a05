"""The person as nature: whatever it does within the bounds, a sound plan is not beaten."""

import itertools
import math
import random
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage import Status, Strategy, named_task, named_tasks, plan
from preimage.configuration.start import start_region
from preimage.errors import InputError
from preimage.execution.starts import of_start
from preimage.strategy.plan_file import plan_to_dict
from preimage.studio.playing import MOST_CHEATING, MOST_MOVES, play

Move = list[float]

WON = "the robot is in the goal, and knows it: the plan has won"

KNOWN = "the robot knows that it has failed, as the plan allows"

TASKS = tuple(name for name in named_tasks() if name != "cluttered-hall")

FEW = ("peg-in-hole", "l-room", "connector", "two-bays", "blind-corner", "between-posts")


@cache
def solved(name: str) -> tuple[Strategy, dict[str, Any]]:
    strategy = plan(named_task(name))
    assert strategy.status is Status.SOLVED
    return strategy, plan_to_dict(strategy)


def starts(strategy: Strategy, count: int, seed: int) -> list[list[float]]:
    begin = start_region(strategy.task, strategy.space)
    rng = np.random.default_rng(seed)
    found: list[list[float]] = of_start(strategy.space, begin, count, rng).places.tolist()
    return found


def ask(document: dict[str, Any], start: list[float], moves: list[Move], **more: Any) -> Any:
    return play({"plan": document, "start": start, "moves": moves, **more}, lambda _: None)


def hands(rng: random.Random, style: int) -> Any:
    """What nature does next: noise, one thing for ever, now and then another, extremes only."""
    held = [rng.choice((-1.0, 1.0)) for _ in range(4)]
    while True:
        match style:
            case 0:
                yield [rng.uniform(-1, 1) for _ in range(4)]
            case 1:
                yield held
            case 2:
                if rng.random() < 0.1:
                    held = [float(rng.choice((-1, 0, 1))) for _ in range(4)]
                yield held
            case _:
                yield [rng.choice((-1.0, 1.0)) for _ in range(4)]


def game(name: str, number: int, **more: Any) -> tuple[dict[str, Any], list[Move]]:
    """A game played to its end."""
    strategy, document = solved(name)
    rng = random.Random(number)
    low, _, high, _ = strategy.task.workspace.window.bounds
    size = (high - low) / 20.0
    start = starts(strategy, 1, number)[0]
    moves: list[Move] = []
    for hand in itertools.islice(hands(rng, number % 4), 3_000):
        moves.append([rng.choice((0.05, 0.2, 1.0)) * size, *hand])
        found = ask(document, start, moves, **more)
        if found["over"]:
            return found, moves
    return found, moves


@pytest.mark.parametrize(
    "name", [name if name in FEW else pytest.param(name, marks=pytest.mark.slow) for name in TASKS]
)
def test_a_sound_plan_is_not_beaten(name: str) -> None:
    for number in range(2):
        found, _ = game(name, number)
        assert found["verdict"] == WON or (
            found["verdict"] == KNOWN and solved(name)[0].task.options.or_fail
        ), (number, found["verdict"])
        if found["verdict"] == WON:
            assert found["truly_in_goal"]


@pytest.mark.parametrize("name", ["l-room", "conditional-hall", "blind-corner"])
def test_what_is_read_is_within_the_errors(name: str) -> None:
    strategy, document = solved(name)
    errors = strategy.task.uncertainty
    start = starts(strategy, 1, 3)[0]
    moves: list[Move] = []
    rng = random.Random(1)
    for hand in itertools.islice(hands(rng, 0), 60):
        moves.append([0.5, *(3.0 * part for part in hand)])
        found = ask(document, start, moves)
        if found["over"]:
            break
        if found["measured"] is not None:
            assert math.dist(found["measured"], found["place"]) <= errors.position * (1 + 1e-6)
        if found["actual"] is not None and found["direction"] is not None:
            assert found["actual"] is not None


def test_hands_are_clipped_to_what_nature_may_do() -> None:
    strategy, document = solved("l-room")
    start = starts(strategy, 1, 0)[0]
    within = ask(document, start, [[1.0, 1.0, 1.0, 0.0, -1.0]])
    beyond = ask(document, start, [[1.0, 7.5, 1e300, 0.0, -1e9]])
    assert {**within, "places": 0} == {**beyond, "places": 0}


def test_offsets_stay_in_the_disc() -> None:
    strategy, document = solved("l-room")
    start = starts(strategy, 1, 0)[0]
    found = ask(document, start, [[0.01, 0.0, 1.0, 1.0, 0.0]])
    reach = strategy.task.uncertainty.position
    assert math.dist(found["measured"], found["place"]) <= reach * (1 + 1e-9)


@settings(max_examples=15)
@given(
    name=st.sampled_from(["l-room", "conditional-hall", "blind-corner", "rails"]),
    number=st.integers(0, 10),
    moves=st.lists(
        st.tuples(st.floats(0.0, 3.0), *[st.floats(-1.0, 1.0)] * 4).map(list),
        min_size=1,
        max_size=12,
    ),
    cut=st.integers(0, 12),
)
def test_a_game_replayed_is_the_game_played_on(
    name: str, number: int, moves: list[Move], cut: int
) -> None:
    strategy, document = solved(name)
    start = starts(strategy, 1, number)[0]

    def whole() -> Any:
        ask(document, start, [])
        return ask(document, start, moves)

    once = whole()
    ask(solved("flat-floor")[1], starts(solved("flat-floor")[0], 1, 0)[0], [])
    ask(document, start, moves[:cut])
    on = ask(document, start, moves)
    ask(solved("flat-floor")[1], starts(solved("flat-floor")[0], 1, 0)[0], [])
    again = ask(document, start, moves)
    places, replayed = on.pop("places"), again.pop("places")
    once.pop("places")
    assert once == on == again
    assert replayed[len(replayed) - len(places) :] == places


def test_moves_taken_back_are_another_game() -> None:
    strategy, document = solved("l-room")
    start = starts(strategy, 1, 0)[0]
    moves = [[0.5, 1.0, 0.0, 0.0, 0.0], [0.5, -1.0, 0.0, 0.0, 0.0]]
    first = ask(document, start, moves[:1])
    ask(document, start, moves)
    back = ask(document, start, moves[:1])
    assert back == first


@pytest.mark.parametrize("name", ["flat-floor", "connector", "rails", "cradle", "two-bays"])
@pytest.mark.parametrize("bound", ["control", "force"])
def test_a_plan_that_was_told_too_little_can_be_beaten(name: str, bound: str) -> None:
    verdicts = [game(name, number, cheat={bound: 8.0})[0]["verdict"] for number in range(6)]
    assert any(verdict != WON for verdict in verdicts)


def test_a_plan_that_was_told_too_little_can_be_deceived() -> None:
    found = [game("landmark-edge", number, cheat={"force": 8.0})[0] for number in range(8)]
    deceived = [one for one in found if "nature has won" in one["verdict"]]
    assert deceived
    assert not any(one["truly_in_goal"] for one in deceived)


def test_no_cheating_is_cheating_by_one() -> None:
    strategy, document = solved("l-room")
    start = starts(strategy, 1, 0)[0]
    moves = [[1.0, 0.5, 0.5, 0.5, 0.5]]
    ones = dict.fromkeys(("control", "position", "force"), 1.0)
    told = ask(document, start, moves)
    assert {**ask(document, start, moves, cheat=ones), "places": 0} == {**told, "places": 0}


def test_a_game_that_is_over_stays_over() -> None:
    found, moves = game("l-room", 0)
    start = starts(solved("l-room")[0], 1, 0)[0]
    more = ask(solved("l-room")[1], start, [*moves, [5.0, 1.0, 1.0, 0.0, 1.0]])
    for key in ("place", "verdict", "time", "over"):
        assert more[key] == found[key]


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"start": None}, "start"),
        ({"start": [1]}, "start"),
        ({"start": [math.inf, 0]}, "start[0]"),
        ({"start": [1e9, 0.0]}, "start"),
        ({"start": ["a", 0.0]}, "start[0]"),
        ({"moves": {}}, "moves"),
        ({"moves": [[1, 2, 3]]}, "moves[0]"),
        ({"moves": [[1, 0, 0, 0, "x"]]}, "moves[0][4]"),
        ({"moves": [[1, 0, 0, 0, True]]}, "moves[0][4]"),
        ({"moves": [[math.nan, 0, 0, 0, 0]]}, "moves[0][0]"),
        ({"moves": [[10**400, 0, 0, 0, 0]]}, "moves[0][0]"),
        ({"moves": [[0, 0, 0, 0, 0]] * (MOST_MOVES + 1)}, "moves"),
        ({"cheat": []}, None),
        ({"cheat": [1]}, "cheat"),
        ({"cheat": {"control": -1}}, "cheat.control"),
        ({"cheat": {"force": MOST_CHEATING + 1}}, "cheat.force"),
        ({"cheat": {"position": "x"}}, "cheat.position"),
        ({"plan": None}, "plan"),
        ({"plan": []}, "plan"),
    ],
)
def test_refusals_name_the_key(change: dict[str, Any], where: str | None) -> None:
    strategy, document = solved("flat-floor")
    body = {"plan": document, "start": starts(strategy, 1, 0)[0], **change}
    if where is None:
        play(body, lambda _: None)
        return
    with pytest.raises(InputError) as refused:
        play(body, lambda _: None)
    assert refused.value.key == where


def test_a_game_begins_only_where_the_plan_does() -> None:
    strategy, document = solved("l-room")
    x0, y0, x1, y1 = strategy.task.workspace.window.bounds
    rng = random.Random(2)
    first = strategy.region(strategy.start[0]).region.area
    for _ in range(40):
        place = [rng.uniform(x0, x1), rng.uniform(y0, y1)]
        try:
            ask(document, place, [])
        except InputError:
            continue
        assert first.distance(*place) <= 1e-6 or place in starts(strategy, 1, 0)


def test_errors_of_zero_and_of_nothing_are_played() -> None:
    strategy, document = solved("l-room")
    start = starts(strategy, 1, 0)[0]
    for cheat in (
        {"control": 0.0, "position": 0.0, "force": 0.0},
        dict.fromkeys(("control",), 100.0),
    ):
        found = ask(document, start, [[1.0, 1.0, 1.0, 1.0, 1.0]], cheat=cheat)
        assert all(map(math.isfinite, found["place"]))
