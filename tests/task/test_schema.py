import json
from pathlib import Path

import jsonschema
import pytest

from preimage.task import (
    Format,
    dump_task,
    named_task,
    named_tasks,
    parse_task,
    task_families,
    task_schema,
)
from preimage.task.documents import parse_document
from preimage.task.examples import named_task_text

PUBLISHED = Path(__file__).parents[2] / "docs" / "task.schema.json"
VALIDATOR = jsonschema.Draft202012Validator(task_schema())


def test_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(task_schema())


def test_is_published() -> None:
    text = json.dumps(task_schema(), indent=2, ensure_ascii=False) + "\n"
    assert PUBLISHED.read_text(encoding="utf-8") == text, f"write task_schema() to {PUBLISHED}"


@pytest.mark.parametrize("name", named_tasks())
def test_accepts_named_tasks(name: str) -> None:
    VALIDATOR.validate(parse_document(named_task_text(name), Format.YAML))
    VALIDATOR.validate(dump_task(named_task(name)))


@pytest.mark.parametrize("family", task_families())
def test_accepts_families(family: str) -> None:
    VALIDATOR.validate(dump_task(named_task(f"{family}-3")))


def test_defaults_are_the_parsers() -> None:
    schema = task_schema()["properties"]
    task = dump_task(named_task("flat-floor"))
    for word in ("walls", "robot", "sliding"):
        assert schema[word]["default"] == task[word]
    given = {"directions": 4}
    ours = {
        "search",
        "time_limit",
        "max_regions",
        "arc_tolerance",
        "resolution",
        "or_fail",
    }  # not in the contract
    for word, option in schema["planner"]["properties"].items():
        if word in ours:
            assert word not in task["planner"]
            document = dump_task(named_task("flat-floor"))
            document["planner"][word] = option["default"]
            assert parse_task(document) == named_task("flat-floor")
        else:
            assert task["planner"][word] == given.get(word, option["default"])
