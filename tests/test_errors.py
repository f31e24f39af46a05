import pickle

import numpy as np
import pytest

from preimage.errors import InputError, PlanFileError, PreimageError, TaskError, one_line, shown


@pytest.mark.parametrize("kind", [TaskError, PlanFileError])
def test_renders_key_and_rule_on_one_line(kind: type[InputError]) -> None:
    error = kind("name", "must be\nshort")
    assert str(error) == "name: must be short"
    assert isinstance(error, PreimageError)
    assert (error.key, error.rule) == ("name", "must be\nshort")


@pytest.mark.parametrize(
    ("prefix", "key", "place"),
    [
        ("obstacles[2]", "polygon[1]", "obstacles[2].polygon[1]"),
        ("task", "[0]", "task[0]"),
        ("task", "", "task"),
    ],
)
def test_goes_under_a_prefix(prefix: str, key: str, place: str) -> None:
    error = TaskError(key, "is wrong").under(prefix)
    assert type(error) is TaskError
    assert error.key == place


def test_can_be_pickled() -> None:
    error = pickle.loads(pickle.dumps(TaskError("a", "b")))
    assert (error.key, error.rule) == ("a", "b")


def test_long_lines_are_cut() -> None:
    assert len(one_line("x" * 10_000)) == 400


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "nothing"),
        (True, "true"),
        (np.False_, "false"),
        (10**500, "a number of too many digits"),
        (np.float64(0.5), "0.5"),
        ("a\nb", r"'a\nb'"),
        ("x" * 99, f"'{'x' * 39}…'"),
        ({}, "a mapping"),
        ([0] * 7, "a list of 7"),
        (object(), "a value of type object"),
    ],
)
def test_shows_values_shortly(value: object, text: str) -> None:
    assert shown(value) == text
