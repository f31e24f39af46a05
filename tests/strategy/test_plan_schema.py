import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.plan_schema import plan_schema
from tests.strategy.plans import plan_data, planned

PUBLISHED = Path(__file__).parents[2] / "docs" / "plan.schema.json"
VALIDATOR = jsonschema.Draft202012Validator(plan_schema())


def test_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(plan_schema())


def test_is_published() -> None:
    text = json.dumps(plan_schema(), indent=2, ensure_ascii=False) + "\n"
    command = f"preimage schema plan -o {PUBLISHED}"
    assert PUBLISHED.read_text(encoding="utf-8") == text, command


@pytest.mark.parametrize("name", ["flat-floor", "l-room", "peg-in-hole", "example-4", "hall-6"])
def test_accepts_plans(name: str) -> None:
    VALIDATOR.validate(plan_to_dict(planned(name)))


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("version",), 2),
        (("status",), "fine"),
        (("extra",), 1),
        (("task", "goal"), {}),
        (("regions",), []),
        (("regions", 0, "rank"), 1),
        (("regions", 0, "direction"), 90),
        (("regions", 1, "goals"), []),
        (("regions", 1, "goals"), [0, 0]),
        (("regions", 1, "geometry"), {"type": "Point", "coordinates": [1]}),
        (("regions", 1, "geometry"), {"type": "Feature"}),
        (("regions", 1, "margin"), -1),
        (("regions", 1, "margin"), 181),
        (("regions", 0, "margin"), 1),
        (("margins",), 3),
        (("margins",), {"slack": 1}),
        (("margins",), {"start": -1}),
        (("margins",), {"reading": "wide"}),
        (("margins",), {"direction": 181}),
        (("regions", 1, "termination"), []),
        (("regions", 1, "termination", 0), {"kind": "sticking", "period": 1}),
        (("regions", 1, "termination", 0), {"kind": "elapsed", "period": 0}),
        (("regions", 1, "termination", 0), {"kind": "reading", "domain": "all"}),
        (("start",), [1.5]),
        (("statistics", "seconds"), -1),
    ],
)
def test_refuses_what_the_reader_refuses(place: tuple[str | int, ...], value: object) -> None:
    data: Any = plan_data()
    there = data
    for step in place[:-1]:
        there = there[step]
    there[place[-1]] = value
    assert not VALIDATOR.is_valid(data)
