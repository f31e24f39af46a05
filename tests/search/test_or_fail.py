"""Plans that end in the goal or know that they have failed: runs, proofs, files, words."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import jsonschema
import pytest

from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.errors import PlanFileError
from preimage.execution.describe import describe_report
from preimage.execution.executor import Doing, Executor
from preimage.execution.program import compiled
from preimage.execution.runs import RunOptions, run
from preimage.execution.trace import Outcome
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.search.failure import certain_starts
from preimage.strategy.describe import describe
from preimage.strategy.plan_file import format_plan, plan_to_dict, read_plan
from preimage.strategy.plan_schema import plan_schema
from preimage.task.options import Continuous
from preimage.verification.out_of_reach import out_of_reach
from preimage.verification.verdict import Fault, Verdict
from preimage.verification.verify import verify
from tests.execution.driving import drive
from tests.search.three_notches import or_fail

SENSED = ("true", "towards")


def test_it_ends_in_the_goal_or_knows_that_it_has_failed() -> None:
    strategy = or_fail()
    assert [end.id for end in strategy.failures] == [2]
    report = run(strategy, sensing=SENSED, options=RunOptions(runs=40))
    assert set(report.outcomes) == {Outcome.SUCCESS, Outcome.FAILED}
    assert report.failures == 0
    assert report.failure is None
    assert min(report.outcomes.values()) > 0.2 * report.runs
    words = describe_report(report)
    known = report.outcomes[Outcome.FAILED]
    assert f"out of reach {known:,} (" in words
    assert "failed  " not in words


def test_who_wrongly_says_that_he_has_failed_is_found_out() -> None:
    """A plan that gives up wherever it comes to rest, in the goal too."""
    honest = or_fail()
    motion = honest.region(1).motion
    assert motion is not None
    gives_up = replace(honest.region(1), motion=replace(motion, goals=(2,)))
    report = run(
        replace(honest, regions=(honest.region(0), gives_up, honest.region(2))),
        control="exact", sensing="true", options=RunOptions(runs=40),
    )  # fmt: skip
    assert set(report.outcomes) == {Outcome.FAILED, Outcome.WRONG}
    assert report.failures == report.outcomes[Outcome.WRONG]
    assert report.failure is not None
    assert report.failure.outcome is Outcome.WRONG


def test_the_start_may_be_known_to_be_out_of_reach() -> None:
    strategy = or_fail()
    start = start_region(strategy.task, strategy.space)
    lost = replace(strategy.region(2), region=start.region)
    for begin in ((2,), (0, 2)):
        given_up = replace(strategy, regions=(strategy.region(0), lost), start=begin)
        report = run(given_up, control="exact", sensing=SENSED, options=RunOptions(runs=3))
        assert set(report.outcomes) == {Outcome.FAILED}
        answer = Executor(given_up).start(0.0, 0.0, 3.0)
        assert (answer.doing, answer.command, answer.region) == (Doing.FAILED, None, 2)


def test_the_executor_says_so() -> None:
    strategy = or_fail()
    seen = set()
    for seed in range(4):
        driven = drive(compiled(strategy), seed, 0.02)
        seen.add(driven.answer.doing)
        if driven.answer.doing is Doing.FAILED:
            assert driven.answer.region == 2
            assert driven.answer.command is None
            assert driven.answer.words == "known to have failed"
            assert abs(driven.robots.x[0]) > 3.0
        else:
            assert abs(driven.robots.x[0]) < 1.0
    assert seen == {Doing.DONE, Doing.FAILED}


def test_what_is_certain_falls_into_the_middle() -> None:
    strategy = or_fail()
    found = certain_starts(strategy)
    # two tips four apart, from which the cone widens upwards; the start is from 2 to 4 high
    slope = math.tan(math.radians(5.0))
    assert found.area.measure == pytest.approx(4.0 * 2.0 - 2.0 * slope * 6.0, abs=1e-6)
    assert found.contact.is_empty
    narrow = or_fail(1.0)
    start = start_region(narrow.task, narrow.space).region
    assert regions.is_subset(start, certain_starts(narrow), narrow.space.tolerance)
    motion = strategy.region(1).motion
    assert motion is not None
    alone = replace(strategy.region(1), motion=replace(motion, goals=(0,)))
    sure = replace(strategy, regions=(strategy.region(0), alone))
    assert certain_starts(sure).area.measure == pytest.approx(16.0, abs=1e-6)


def test_from_certain_starts_no_run_fails() -> None:
    strategy = or_fail()
    start = Start.anywhere_in(certain_starts(strategy))
    report = run(strategy, start=start, sensing=SENSED, options=RunOptions(runs=40))
    assert set(report.outcomes) == {Outcome.SUCCESS}


def test_verification_agrees() -> None:
    found = verify(or_fail(), runs=0)
    assert found.verdict is Verdict.PROVEN, found


def test_verification_finds_what_is_given_up_too_early() -> None:
    honest = or_fail()
    lost = honest.region(2)
    above = Region(Area.box(-1.0, 3.0, 1.0, 4.0), lost.region.contact)
    pit = Region(lost.region.area, honest.region(0).region.contact)
    half = Region(areas.within_box(lost.region.area, -6.0, 1.0, 6.0, 6.0), ContactSet.empty())
    for region, verdict, words in (
        (above, Verdict.REFUTED, "may lead to it"),
        (pit, Verdict.REFUTED, "holds a part of the goal"),
        (half, Verdict.UNPROVEN, "may lead elsewhere"),
    ):
        early = replace(honest, regions=(*honest.regions[:2], replace(lost, region=region)))
        (found,) = out_of_reach(early)
        assert (found.fault, found.verdict) == (Fault.REACH, verdict)
        assert found.words.endswith(words)
    task = honest.task
    around = replace(task, options=replace(task.options, directions=Continuous()))
    assert [one.verdict for one in out_of_reach(replace(honest, task=around))]
    assert out_of_reach(replace(honest, regions=honest.regions[:2])) == []


# --- files and words --------------------------------------------------------------------------


def test_the_plan_comes_back_from_its_file() -> None:
    data = plan_to_dict(or_fail())
    assert list(data["regions"][2]) == ["id", "rank", "failure", "geometry"]
    assert "failure" not in data["regions"][0] | data["regions"][1]
    again = read_plan(json.loads(format_plan(or_fail())))
    assert [end.id for end in again.failures] == [2]
    assert format_plan(again) == format_plan(or_fail())
    jsonschema.Draft202012Validator(plan_schema()).validate(data)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"failure": False}, "regions[2].failure: must be true where it is given"),
        ({"failure": 1}, "regions[2].failure: "),
        ({"rank": 1}, "regions[2].rank: must be 0 for a region of failure, not 1"),
        ({"direction": 90}, "regions[2].direction: unknown key"),
        ({"id": 0}, "regions[2].failure: unknown key"),
    ],
)
def test_a_region_of_failure_is_that_alone(change: dict[str, object], words: str) -> None:
    data = plan_to_dict(or_fail())
    data["regions"][2] |= change
    if "id" in change:
        data["regions"][0], data["regions"][1]["goals"] = data["regions"][2], [0]
        words = words.replace("[2]", "[0]")
        del data["regions"][2]
    with pytest.raises(PlanFileError) as caught:
        read_plan(data)
    assert str(caught.value).startswith(words)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(plan_schema()).validate(data)


def test_the_account_says_that_it_may_fail() -> None:
    lines = describe(or_fail()).splitlines()
    assert lines[0] == (
        "three-notches: ends in the goal, or knows that it has failed, in 1 motion at most"
    )
    assert any(line.startswith("  out of reach of it: region 2, ") for line in lines)
