import copy
import json
import math
import pickle
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.errors import TaskError
from preimage.task import (
    Everywhere,
    Format,
    Template,
    dump_task,
    load_task,
    load_template,
    named_task,
    named_tasks,
    named_template,
    parse_task,
    parse_template,
    save_task,
    task_schema,
)
from preimage.task.documents import parse_document
from preimage.task.examples import named_task_text
from preimage.task.options import Continuous
from tests.task.strategies import mutated, tasks

SCHEMA = jsonschema.Draft202012Validator(task_schema())

OPEN: dict[str, Any] = {
    "version": 1,
    "name": "open",
    "parameters": {"w": 4, "t": 0.5, "n": 2},
    "window": ["-w", "-w", "2 * w", "w + 6"],
    "walls": ["left", "bottom"],
    "robot": {"polygon": [[0, 0], ["t", 0], [0, "t"]], "reference": [0, "t / 2"]},
    "obstacles": [
        {
            "polygon": [[0, 0], ["w", 0], ["w", "w"], [0, "w"]],
            "holes": [[["t", "t"], ["t + 1", "t"], ["t", "t + 1"]]],
        },
        {"chain": [[-3, "-w / 2"], [5, "w * sin(-30)"]], "solid": "right"},
    ],
    "uncertainty": {
        "control": "10 * t",
        "position": "t / 10",
        "force": {"angle": "20 * t", "threshold": ["t / 10", "t / 5"]},
    },
    "friction": {"coefficient": "tan(40 * t)"},
    "sliding": "projection",
    "initial": {"disc": {"center": ["w + 3", 7], "radius": "t"}},
    "goal": {"points": [["w", "w"]]},
    "planner": {"directions": "4 * n", "max_steps": "n + 1", "time_limit": "60 * n"},
}
HOLE: Any = parse_document(named_task_text("tight-hole"), Format.YAML)
WRITTEN: dict[str, Any] = {
    **{word: value for word, value in OPEN.items() if word != "parameters"},
    "window": [-4, -4, 8, 10],
    "robot": {"polygon": [[0, 0], [0.5, 0], [0, 0.5]], "reference": [0, 0.25]},
    "obstacles": [
        {
            "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]],
            "holes": [[[0.5, 0.5], [1.5, 0.5], [0.5, 1.5]]],
        },
        {"chain": [[-3, -2], [5, 4 * math.sin(math.radians(-30))]], "solid": "right"},
    ],
    "uncertainty": {
        "control": 5,
        "position": 0.05,
        "force": {"angle": 10, "threshold": [0.05, 0.1]},
    },
    "friction": {"coefficient": math.tan(math.radians(20))},
    "initial": {"disc": {"center": [7, 7], "radius": 0.5}},
    "goal": {"points": [[4, 4]]},
    "planner": {"directions": 8, "max_steps": 3, "time_limit": 120},
}


def refusal(data: object) -> str:
    with pytest.raises(TaskError) as caught:
        parse_task(data)
    return str(caught.value)


def test_formulas_stand_wherever_a_number_may() -> None:
    assert parse_task(OPEN) == parse_template(OPEN).task()
    friction = parse_task(OPEN).friction
    assert friction == pytest.approx(parse_task(WRITTEN).friction, abs=1e-15)
    exact = {"friction": 20}
    assert parse_task({**OPEN, **exact}) == parse_task({**WRITTEN, **exact})
    SCHEMA.validate(OPEN)


@pytest.mark.parametrize("ending", ["yaml", "json", "toml"])
def test_every_format_holds_formulas(ending: str, tmp_path: Path) -> None:
    texts = {
        "yaml": yaml.safe_dump(OPEN, sort_keys=False),
        "json": json.dumps(OPEN),
        "toml": "version = 1\nwindow = ['-w', 0, 'w', 1]\ninitial = 'everywhere'\n"
        "[parameters]\nw = 3.5\n[uncertainty]\ncontrol = 1\nposition = 'w / 7'\n"
        "[goal]\npoints = [[0, 0]]\n",
    }
    path = tmp_path / f"hole.{ending}"
    path.write_text(texts[ending], encoding="utf-8")
    template = load_template(path)
    assert load_task(path) == template.task()
    if ending == "toml":
        assert tomllib.loads(texts[ending])["parameters"] == template.parameters
        assert template.name == "hole"
        assert template.task().uncertainty.position == 0.5
        assert template.task(w=7).workspace.window.bounds == (-7, 0, 7, 1)
    else:
        assert template.task() == parse_task(OPEN)
        assert template.name == "open"
        assert list(template.parameters) == ["w", "t", "n"]


def test_words_are_no_formulas() -> None:
    data = {
        **OPEN,
        "initial": "everywhere",
        "robot": "point",
        "uncertainty": {"control": "t", "position": "inf", "force": "none"},
        "planner": {"directions": "continuous", "time_limit": "none", "max_steps": "n"},
    }
    task = parse_task(data)
    assert isinstance(task.initial, Everywhere)
    assert isinstance(task.options.directions, Continuous)
    assert task.options.time_limit is None
    assert math.isinf(task.uncertainty.position)
    assert not task.uncertainty.has_force_sensor


@given(tasks, st.floats(-100, 100))
def test_a_whole_task_is_a_template(task: Any, value: float) -> None:
    template = Template.of(task)
    assert template.task() == task
    assert template.parameters == {}
    assert template.digest == parse_template(dump_task(task)).digest
    with pytest.raises(TaskError, match=r"^parameters[.]a: the task has no such parameter"):
        template.task(a=value)


@given(st.floats(0.01, 20), st.floats(0.01, 3), st.floats(0.01, 0.4))
def test_values_are_those_that_are_asked_for(width: float, depth: float, play: float) -> None:
    template = named_template("tight-hole")
    asked = {"peg": width, "depth": depth + 0.6, "clearance": play}
    try:
        task = template.task(**asked)
    except TaskError:
        return
    assert parse_task(dump_task(task)) == task
    text = named_task_text("tight-hole")
    given_ = {"peg": "1", "clearance": "0.5", "depth": "2.5"}
    for name, value in asked.items():
        assert f"  {name}: {given_[name]}\n" in text
        text = text.replace(f"  {name}: {given_[name]}\n", f"  {name}: {value!r}\n")
    assert parse_task(parse_document(text, Format.YAML)) == task
    assert template.given(**asked).task() == task
    assert template.task() == named_task("tight-hole")


def test_what_is_saved_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "whole.yaml"
    save_task(parse_task(OPEN), path)
    assert "parameters" not in path.read_text(encoding="utf-8")
    assert load_task(path) == parse_task(OPEN)
    assert load_template(path).parameters == {}


@pytest.mark.parametrize("name", [*named_tasks(), "comb-3"])
def test_named_templates_give_the_named_tasks(name: str) -> None:
    assert named_template(name).task() == named_task(name)
    assert named_template(name).name == name


def test_the_digest_says_which_task() -> None:
    template = parse_template(OPEN)
    backwards = parse_template(dict(reversed(list(OPEN.items()))))
    floats = parse_template(json.loads(json.dumps(OPEN), parse_int=float))
    assert template.digest == backwards.digest == floats.digest
    assert len(template.digest) == 64
    assert template.digest == pickle.loads(pickle.dumps(template)).digest
    changes: list[dict[str, Any]] = [
        {"parameters": {"w": 4, "t": 0.5, "n": 4}},
        {"name": "other"},
        {"friction": 1},
        {"walls": ["bottom", "left"]},
    ]
    digests = {parse_template({**OPEN, **change}).digest for change in changes}
    assert len(digests | {template.digest}) == 5
    assert template.given(w=5).digest != template.digest == template.given(w=4).digest
    # 1 and true are two things, and arrays are lists
    arrays = {**OPEN, "window": np.array([1.0, 2.0]), "walls": ("left", "bottom")}
    lists = {**OPEN, "window": [1, 2], "friction": 2}
    assert parse_template({**arrays, "friction": np.float64(2)}).digest == (
        parse_template(lists).digest
    )
    truths = parse_template({**lists, "planner": {"max_steps": "n", "or_fail": True}})
    assert (
        truths.digest
        != parse_template({**lists, "planner": {"max_steps": "n", "or_fail": 1}}).digest
    )
    with pytest.raises(TaskError, match="must be mappings, lists, numbers and words"):
        Template({"a": object()}, "a", {}).digest  # noqa: B018


def test_templates_can_be_sent() -> None:
    template = parse_template(OPEN)
    assert pickle.loads(pickle.dumps(template)).task(w=5) == template.task(w=5)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"parameters": 3}, "parameters: must be a mapping, not 3"),
        ({"parameters": ["w"]}, "parameters: must be a mapping, not a list of 1"),
        ({"parameters": {"w": "4"}}, "parameters.w: must be a number, not '4'"),
        ({"parameters": {"w": True}}, "parameters.w: must be a number, not true"),
        ({"parameters": {"w": None}}, "parameters.w: must be a number, not nothing"),
        ({"parameters": {"w": [1]}}, "parameters.w: must be a number, not a list of 1"),
        ({"parameters": {"w": math.nan}}, "parameters.w: must be a finite number, not nan"),
        ({"parameters": {"w": math.inf}}, "parameters.w: must be a finite number, not inf"),
        (
            {"parameters": {"w": 10**400}},
            "parameters.w: must be a finite number, not a number of too many digits",
        ),
        (
            {"parameters": {"a-b": 1}},
            "parameters: names must be 1 to 40 letters, digits and _, a letter first, not 'a-b'",
        ),
        (
            {"parameters": {1: 1}},
            "parameters: names must be 1 to 40 letters, digits and _, a letter first, not 1",
        ),
        (
            {"parameters": {"a\n": 1}},
            r"parameters: names must be 1 to 40 letters, digits and _, a letter first, not 'a\n'",
        ),
        (
            {"parameters": {"inf": 1}},
            "parameters: names must not be words that mean something, as inf does",
        ),
        (
            {"parameters": {"sqrt": 1}},
            "parameters: names must not be words that mean something, as sqrt does",
        ),
        (
            {"parameters": {f"a{number}": 1 for number in range(65)}},
            "parameters: must be 64 or fewer, not 65",
        ),
        (
            {"parameters": {"w": 4, "t": 0.5, "n": 2, "wide": 4}},
            "parameters.wide: is used by no formula",
        ),
        (
            {"parameters": {"w": 4, "t": 0.5, "num": 2}},
            "parameters.num: is used by no formula",
        ),
        ({"parameters": {}}, "version: must be a number, not '1'"),
        ({"friction": "w +"}, "friction: the formula 'w +' must have a number or a name at 4"),
        ({"friction": "v"}, "friction: the formula 'v' has the unknown name 'v'"),
        ({"friction": "w / 0"}, "friction: the formula 'w / 0' divides by zero"),
        ({"friction": "inf"}, "friction: the formula 'inf' has the unknown name 'inf'"),
        (
            {"friction": "30 * w"},
            "friction: must be at least 0 and at most 90 degrees, not 120.0"
            " (by the formula '30 * w')",
        ),
        ({"goal": "w"}, "goal: must be a mapping, not 4.0 (by the formula 'w')"),
        ({"walls": ["w"]}, "walls[0]: must be left, right, bottom or top, not 'w'"),
        ({"sliding": "w"}, "sliding: must be projection or "),
        ({"initial": "w"}, "initial: must be everywhere or a mapping, not 'w'"),
        ({"robot": "w"}, "robot: must be point or a mapping, not 'w'"),
        ({"version": "w / w"}, "version: must be a number, not 'w / w'"),
        ({"name": "w\n"}, r"name: must be 1 to 100 printable characters, not 'w\n'"),
        (
            {"window": ["w", 0, "-w", 1]},
            "window: xmin must be below xmax, but 4 is not below -4 (with w = 4, t = 0.5, n = 2)",
        ),
        (
            {"planner": {"max_steps": "n / 4"}},
            "planner.max_steps: must be a whole number, not 0.5 (by the formula 'n / 4')",
        ),
        (
            {"planner": {"directions": ["n", "n / 0"]}},
            "planner.directions[1]: the formula 'n / 0' divides by zero",
        ),
        ({"planner": {"or_fail": "n"}}, "planner.or_fail: must be true or false, not 'n'"),
    ],
)
def test_refuses(change: dict[str, Any], line: str) -> None:
    data = copy.deepcopy(OPEN) | change
    if "parameters" in change and not change["parameters"]:
        data["version"] = "1"
    elif "parameters" not in change:
        # whatever the change drops is still used
        data["obstacles"] = [
            *data["obstacles"],
            {"polygon": [[9, 9], ["9 + t / n", 9], [9, "9 + w / 4"]]},
        ]
    assert refusal(data).startswith(line)


def test_without_parameters_a_word_is_no_number() -> None:
    data = {**WRITTEN, "friction": "20"}
    assert refusal(data) == "friction: must be a number, not '20'"
    assert refusal({**data, "parameters": {}}) == "friction: must be a number, not '20'"


def test_a_misspelt_key_of_parameters_is_known() -> None:
    data = {word: value for word, value in OPEN.items() if word != "parameters"}
    line = "parameter: unknown key, did you mean parameters?"
    assert refusal({**data, "parameter": OPEN["parameters"]}) == line
    with pytest.raises(TaskError, match="must be split from the document"):
        Template(OPEN, "open", {}).task()


def test_other_values_are_refused_by_name() -> None:
    template = parse_template(OPEN)
    table: list[tuple[dict[str, float], str]] = [
        ({"weight": 1.0}, "parameters.weight: the task has no such parameter"),
        ({"tt": 1.0}, "parameters.tt: the task has no such parameter, did you mean t?"),
        ({"t": math.nan}, "parameters.t: must be a finite number, not nan"),
        ({"t": True}, "parameters.t: must be a number, not true"),
        ({"t": 100.0}, "obstacles[0].holes[0]: is not inside the polygon (with w = 4, t = 100, "),
        ({"n": 1e6}, "planner.directions: must be "),
    ]
    for values, line in table:
        with pytest.raises(TaskError) as caught:
            template.task(**values)
        assert str(caught.value).startswith(line)
    assert "(by the formula '4 * n')" in str(caught.value)


def test_hostile_data_is_refused() -> None:
    nested: list[Any] = []
    for _ in range(100_000):
        nested = [nested]
    assert refusal({**OPEN, "window": nested}) == "task: must be nested 20 deep or less"
    circle: list[Any] = []
    circle.append(circle)
    assert refusal({**OPEN, "window": circle}) == "task: must be nested 20 deep or less"
    long = "(" * 1_000_000
    line = "window[0]: formulas must have 200 characters or fewer"
    assert refusal({**OPEN, "window": [long, 0, 1, 1]}) == line
    for garbage in (None, 3, "w", [OPEN]):
        with pytest.raises(TaskError, match="task: must be a mapping"):
            parse_template(garbage)
    while nested:  # taken apart from outside: the interpreter would do it by recursion
        nested = nested.pop()


@settings(max_examples=300)
@given(mutated((OPEN, dict(HOLE))))
def test_changed_templates_are_refused_or_good(data: Any) -> None:
    try:
        task = parse_task(data)
    except TaskError as error:
        line = str(error)
    else:
        line = ""
        assert parse_task(dump_task(task)) == task
        SCHEMA.validate(data)
    assert line.isprintable()
