"""What stands in the way, in pictures of planning runs that found no strategy."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from preimage.rendering.picture import draw
from preimage.rendering.reasons import reason_words
from preimage.search.planner import plan
from preimage.strategy.reason import Reason, ReasonKind, shown_reasons, told
from preimage.strategy.strategy import Strategy
from preimage.task.examples import named_task
from preimage.task.options import Method


def trap(direction: float, x: float) -> Reason:
    words = f"along {direction}: stops at {x}"
    return Reason(ReasonKind.TRAP, direction, (-4.0, 2.5), words, feature=0, place=(x, 0.0))


def aimless(direction: float) -> Reason:
    return Reason(ReasonKind.NOTHING_RECOGNISED, direction, (-4.0, 2.5), f"nothing {direction}")


WHY = (trap(1.0, -4.0), trap(1.0, -8.0), trap(2.0, -4.0), aimless(3.0), aimless(4.0), aimless(5.0))


@pytest.fixture(scope="module")
def found() -> Strategy:
    task = named_task("peg-in-hole")
    directions = tuple(math.radians(angle) for angle in (0, 90, 180, 270))
    options = replace(task.options, method=Method.STICKING, directions=directions)
    return replace(plan(replace(task, options=options)), why=WHY)


def test_few_are_told() -> None:
    assert told(WHY) == [*WHY[:3], WHY[3]]
    assert shown_reasons(WHY)[-1] == "2 other directions: nothing to aim at"
    assert shown_reasons((*WHY[:2], aimless(3.0)))[-1] == "nothing 3.0"
    assert shown_reasons(()) == []


def test_what_is_about_another_place_says_so() -> None:
    other = replace(trap(2.0, 3.0), origin=(1.0, 1.0))
    assert shown_reasons((WHY[0], other))[1] == "from (1, 1) along 2.0: stops at 3.0"


def test_places_are_marked_with_the_numbers_of_their_words(found: Strategy, tmp_path: Path) -> None:
    path = tmp_path / "found.svg"
    draw(found, path)
    text = path.read_text()
    assert 'id="found-reason-1-3"' in text  # two reasons about one place
    assert 'id="found-reason-2"' in text
    words = reason_words(found)
    assert words.startswith("(1) along 1.0: stops at -4.0; (2) ")
    assert words.endswith("; 2 other directions: nothing to aim at")


def test_without_reasons_nothing_is_marked(found: Strategy, tmp_path: Path) -> None:
    path = tmp_path / "found.svg"
    draw(replace(found, why=()), path)
    assert "reason" not in path.read_text()
