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
from preimage.task.schema import whole_schema

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
    schema = whole_schema()["properties"]
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
        "prefer",
    }  # not in the contract
    for word, option in schema["planner"]["properties"].items():
        if word in ours:
            assert word not in task["planner"]
            document = dump_task(named_task("flat-floor"))
            document["planner"][word] = option["default"]
            assert parse_task(document) == named_task("flat-floor")
        else:
            assert task["planner"][word] == given.get(word, option["default"])


# --- formulas ---------------------------------------------------------------------------------

PLAIN = jsonschema.Draft202012Validator(whole_schema())


@pytest.mark.parametrize("name", named_tasks())
def test_plain_files_may_hold_no_formula(name: str) -> None:
    data = dump_task(named_task(name))
    assert VALIDATOR.is_valid(data)
    assert PLAIN.is_valid(data)
    data["friction"] = "2 * width"
    assert not VALIDATOR.is_valid(data)
    assert not PLAIN.is_valid(data)
    data["parameters"] = {"width": 3}
    assert VALIDATOR.is_valid(data)
    assert not PLAIN.is_valid(data)


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("friction", "a; b"),
        ("friction", "__import__('os')"),
        ("friction", ""),
        ("friction", "a" * 201),
        ("friction", True),
        ("friction", 91),
        ("window", [0, 0, "a"]),
        ("window", "a"),
        ("walls", ["a"]),
        ("sliding", "a"),
        ("initial", "a"),
        ("robot", "a"),
        ("version", "a"),
        ("parameters", {"a": "1"}),
        ("parameters", {"a b": 1}),
        ("parameters", {"min": 1}),
        ("parameters", {"a": True}),
        ("parameters", {f"a{number}": 1 for number in range(65)}),
        ("parameters", [1]),
    ],
)
def test_formulas_stand_for_numbers_only(word: str, value: object) -> None:
    data = {**dump_task(named_task("flat-floor")), "friction": "a", "parameters": {"a": 1}}
    assert VALIDATOR.is_valid(data)
    assert not VALIDATOR.is_valid({**data, word: value})


@pytest.mark.parametrize("position", ["inf", ".inf", "2 * a", 0.5])
def test_words_are_no_formulas(position: object) -> None:
    data = dump_task(named_task("flat-floor"))
    data["uncertainty"]["position"] = position
    data["planner"] |= {"directions": "continuous", "time_limit": "none", "max_steps": "a"}
    VALIDATOR.validate({**data, "parameters": {"a": 3}})
