import math
from dataclasses import dataclass
from fractions import Fraction

import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from preimage.errors import TaskError
from preimage.task.formula import FUNCTIONS, MAX_DEPTH, MAX_LENGTH, evaluate, names_of

VALUES = {"a": 2.0, "b": -0.75, "width_2": 12.5, "_": 0.25}


@dataclass(frozen=True)
class Sample:
    """A formula with what it must give: both grow together, no text is read for it."""

    text: str
    value: Fraction
    level: int  # 0: a sum, 1: a product, 2: a factor
    names: frozenset[str] = frozenset()

    def at(self, level: int) -> str:
        return self.text if self.level >= level else f"({self.text})"


def _joined(mark: str, left: Sample, right: Sample, space: str) -> Sample:
    level = 0 if mark in "+-" else 1
    text = f"{left.at(level)}{space}{mark}{space}{right.at(level + 1)}"
    operations = {
        "+": lambda: left.value + right.value,
        "-": lambda: left.value - right.value,
        "*": lambda: left.value * right.value,
        "/": lambda: left.value / right.value,
    }
    if mark == "/" and not right.value:
        return left
    return Sample(text, operations[mark](), level, left.names | right.names)


def _called(name: str, arguments: list[Sample]) -> Sample:
    text = f"{name}({', '.join(one.text for one in arguments)})"
    values = [one.value for one in arguments]
    value = min(values) if name == "min" else max(values)
    return Sample(text, value, 2, frozenset[str]().union(*(one.names for one in arguments)))


LEAVES = st.one_of(
    st.integers(0, 99).map(lambda number: Sample(str(number), Fraction(number), 2)),
    st.sampled_from(["0.5", ".25", "2.", "1e1", "12.5E-1", "4e+0"]).map(
        lambda text: Sample(text, Fraction(float(text)), 2)
    ),
    st.sampled_from(sorted(VALUES)).map(
        lambda name: Sample(name, Fraction(VALUES[name]), 2, frozenset([name]))
    ),
)
SAMPLES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.builds(_joined, st.sampled_from("+-*/"), inner, inner, st.sampled_from(["", " "])),
        inner.map(lambda one: Sample(f"-{one.at(2)}", -one.value, 2, one.names)),
        inner.map(lambda one: Sample(f"( {one.text}\t)", one.value, 2, one.names)),
        st.builds(
            _called, st.sampled_from(["min", "max"]), st.lists(inner, min_size=1, max_size=3)
        ),
    ),
    max_leaves=12,
).filter(lambda one: len(one.text) <= MAX_LENGTH)


@given(SAMPLES)
def test_formulas_are_what_they_say(sample: Sample) -> None:
    # Doubles against rationals: the error is bounded by the size of what is added on the way.
    try:
        found = evaluate(sample.text, VALUES, "key")
    except TaskError:
        # a difference that is zero only in doubles, or parentheses beyond the bound
        reject()
    python = eval(sample.text, {"__builtins__": {}, "min": _least, "max": _most}, VALUES)
    assert found == python
    if abs(sample.value) < 1e6 and "/" not in sample.text:
        assert found == pytest.approx(float(sample.value), rel=1e-9, abs=1e-4)
    assert names_of(sample.text) == sample.names


def _least(*values: float) -> float:
    return min(values)


def _most(*values: float) -> float:
    return max(values)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_themselves(value: float) -> None:
    assert evaluate(repr(value), {}, "key") == value
    assert evaluate("a", {"a": value}, "key") == value


def test_operators_bind_as_in_arithmetic() -> None:
    assert evaluate("10 - 4 - 3", {}, "key") == 3
    assert evaluate("16 / 4 / 2", {}, "key") == 2
    assert evaluate("2 + 3 * 4", {}, "key") == 14
    assert evaluate("-2 * -3 - -1", {}, "key") == 7
    assert evaluate("-(1 + 2) * 3", {}, "key") == -9


@pytest.mark.parametrize("quarter", range(-9, 10))
def test_right_angles_are_exact(quarter: int) -> None:
    angle = {"a": 90.0 * quarter}
    sines = [0.0, 1.0, 0.0, -1.0]
    assert evaluate("sin(a)", angle, "key") == sines[quarter % 4]
    assert evaluate("cos(a)", angle, "key") == sines[(quarter + 1) % 4]
    if quarter % 2:
        with pytest.raises(TaskError, match="has no tan of"):
            evaluate("tan(a)", angle, "key")
    else:
        assert evaluate("tan(a)", angle, "key") == 0.0


@given(st.floats(-1e4, 1e4))
def test_angles_are_degrees(angle: float) -> None:
    sine, cosine = (evaluate(f"{word}(a)", {"a": angle}, "key") for word in ("sin", "cos"))
    assert sine == pytest.approx(math.sin(math.radians(angle)), abs=1e-10)
    assert cosine == pytest.approx(math.cos(math.radians(angle)), abs=1e-10)
    if abs(cosine) > 1e-3:
        assert evaluate("tan(a)", {"a": angle}, "key") == pytest.approx(sine / cosine)
    assert evaluate("sqrt(a * a)", {"a": angle}, "key") == pytest.approx(abs(angle))


@pytest.mark.parametrize(
    ("formula", "rule"),
    [
        ("", "must have a number or a name at 1, not nothing"),
        ("  ", "must have a number or a name at 1, not nothing"),
        ("1 +", "must have a number or a name at 4, not nothing"),
        ("+1", "must have a number or a name at 1, not '+'"),
        ("1 2", "must have an operator at 3, not '2'"),
        ("2a", "must have an operator at 2, not 'a'"),
        ("a(1)", "must have an operator at 2, not '('"),
        ("(1", "must have a closing parenthesis at 3, not nothing"),
        ("1)", "must have an operator at 2, not ')'"),
        ("()", "must have a number or a name at 2, not ')'"),
        ("1, 2", "must have an operator at 2, not ','"),
        ("a ** 2", "must have a number or a name at 4, not '*'"),
        ("a // 2", "must have a number or a name at 4, not '/'"),
        ("a % 2", "has no place for '%' at 3"),
        ("a.b", "has no place for '.' at 2"),
        ("a\n", r"has no place for '\n' at 2"),
        ("١", "has no place for '١' at 1"),
        ("ä", "has no place for 'ä' at 1"),
        ("a\x00", r"has no place for '\x00' at 2"),
        ("__import__('os')", """has no place for "'" at 12"""),
        ("widht", "has the unknown name 'widht', did you mean width?"),
        ("sqr(2)", "has the unknown name 'sqr', did you mean sqrt?"),
        ("eval", "has the unknown name 'eval'"),
        ("sin", "must have ( after sin at 4, not nothing"),
        ("min()", "must have a number or a name at 5, not ')'"),
        ("sin(1, 2)", "gives sin 2 numbers, not one"),
        ("sqrt(-1)", "has no sqrt of -1.0"),
        ("1 / (a - a)", "divides by zero"),
        ("1 / -0", "divides by zero"),
        ("1e999", "has a step that is not finite"),
        ("1e200 * 1e200 * 0", "has a step that is not finite"),
        ("-1e308 - 1e308", "has a step that is not finite"),
        ("1 / 1e-320", "has a step that is not finite"),
    ],
)
def test_refuses(formula: str, rule: str) -> None:
    with pytest.raises(TaskError) as caught:
        evaluate(formula, {"a": 1.0, "width": 2.0}, "window[0]")
    assert str(caught.value) == f"window[0]: the formula {formula!r} {rule}"


def test_depth_is_bounded() -> None:
    for opening, closing in (("(", ")"), ("-", ""), ("min(", ")")):
        deepest = opening * (MAX_DEPTH - 1) + "1" + closing * (MAX_DEPTH - 1)
        assert abs(evaluate(deepest, {}, "key")) == 1.0
        with pytest.raises(TaskError, match="must be nested 20 deep or less"):
            evaluate(f"{opening}{deepest}{closing}", {}, "key")


@pytest.mark.parametrize("unit", ["(", "-", "1+", "a", " ", "sin(", "9", "((1)"])
def test_the_length_is_bounded(unit: str) -> None:
    with pytest.raises(TaskError, match="must have 200 characters or fewer"):
        evaluate(unit * 1_000_000, {"a": 1.0}, "key")
    assert names_of(unit * 1_000_000) <= {"a" * MAX_LENGTH}


@given(st.text(max_size=40) | st.text("0123456789.eE+-*/(), ab", max_size=40))
def test_any_text_has_a_finite_value_or_a_line(text: str) -> None:
    try:
        value = evaluate(text, VALUES, "key")
    except TaskError as error:
        line = str(error)
    else:
        line = ""
        assert math.isfinite(value)
        assert names_of(text) <= VALUES.keys()
    assert line.isprintable()


def test_functions_are_few() -> None:
    assert sorted(FUNCTIONS) == ["cos", "max", "min", "sin", "sqrt", "tan"]
