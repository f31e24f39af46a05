"""Files that are no task files, some of them hostile."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.errors import TaskError
from preimage.task import Format, dump_task, format_task, load_task, named_task
from preimage.task.documents import MAX_BYTES, MAX_DEPTH, parse_document

Y, J, T = Format.YAML, Format.JSON, Format.TOML


def refusal(text: str, kind: Format) -> str:
    with pytest.raises(TaskError) as caught:
        parse_document(text, kind)
    line = str(caught.value)
    assert line.isprintable()
    assert len(line) <= 400
    return line


@pytest.mark.parametrize(
    ("kind", "text", "line"),
    [
        (Y, "", "task: is empty"),
        (J, " \n", "task: is empty"),
        (Y, "a: &x 1\nb: 2", "task: has an anchor at line 1: write the value out"),
        (Y, "a: 1\nb: &x [1]", "task: has an anchor at line 2: write the value out"),
        (Y, "a: *x", "task: has an alias at line 1: write the value out"),
        (Y, "a:\n  <<: {b: 1}", "task: has a merge key at line 2: write the keys out"),
        (Y, "a: !!float 1", "task: has a tag at line 1: values are plain"),
        (Y, "a: ! 1", "task: has a tag at line 1: values are plain"),
        (Y, "!!python/object:os.system a", "task: has a tag at line 1: values are plain"),
        (Y, "a: 1\n'a': 2", "task: key 'a' is repeated at line 2"),
        (Y, "? [1, 2]\n: 3", "task: has a key that is no word at line 1"),
        (Y, "a: 1\n---\nb: 2", "task: has a second document at line 2"),
        (Y, "a: [1", "task: is not YAML at line 2, column 1: "),
        (Y, "a: \x00", "task: is not YAML: "),
        (Y, "\t- a", "task: is not YAML at line 1, column 1: "),
        (Y, "[" * 21, "task: must be nested 20 deep or less"),
        (Y, "a: " + "1" * 500, "task: has too many digits at line 1"),
        (J, '{"a": 1, "a": 2}', "task: key 'a' is repeated"),
        (J, '[{"b": {"a": 1, "c": 0, "a": 1}}]', "task: key 'a' is repeated"),
        (J, '{"a": NaN}', 'task: NaN is not JSON; "inf" is infinity'),
        (J, '{"a": -Infinity}', 'task: -Infinity is not JSON; "inf" is infinity'),
        (J, '{"a": 1,\n }', "task: is not JSON at line 2, column 2: "),
        (J, "{} {}", "task: is not JSON at line 1, column 4: Extra data"),
        (J, "1" * 5000, "task: has a number of too many digits"),
        (J, "[" * 21 + "]" * 21, "task: must be nested 20 deep or less"),
        (T, "a = 1\na = 2", "task: is not TOML: "),
        (T, "a", "task: is not TOML: "),
        (T, "a = " + "1" * 5000, "task: has a number of too many digits"),
        (T, "a = " + "[" * 21 + "]" * 21, "task: must be nested 20 deep or less"),
        (T, ".".join("a" * 21) + " = 1", "task: must be nested 20 deep or less"),
        (T, "a" + ' . "b"' * 21 + " = 1", "task: must be nested 20 deep or less"),
    ],
)
def test_refuses_text(kind: Format, text: str, line: str) -> None:
    assert refusal(text, kind).startswith(line)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 0.001),
        ("1E5", 1e5),
        ("-.5", -0.5),
        ("+1.", 1.0),
        ("010", 10),
        ("1_000", "1_000"),
        ("0x10", "0x10"),
        ("1:30", "1:30"),
        ("2001-01-01", "2001-01-01"),
        (".inf", float("inf")),
        ("-.inf", float("-inf")),
        ("true", True),
        ("yes", "yes"),
        ("~", None),
        ("", None),
        ("'1'", "1"),
        ('"true"', "true"),
        ("|\n  1", "1\n"),
    ],
)
def test_yaml_values(text: str, value: object) -> None:
    result = parse_document(f"a: {text}\n", Y)
    assert result == {"a": value}
    assert isinstance(result, dict)
    assert type(result["a"]) is type(value)


@pytest.mark.parametrize("kind", Format)
def test_twenty_levels_are_legal(kind: Format) -> None:
    inner = MAX_DEPTH - 1
    brackets = "[" * inner + "]" * inner
    text = f"a = {brackets}" if kind is T else f'{{"a": {brackets}}}'
    assert isinstance(parse_document(text, kind), dict)


@given(st.text(alphabet=st.characters(), max_size=200), st.sampled_from(Format))
def test_random_text_is_data_or_refused(text: str, kind: Format) -> None:
    line = ""
    try:
        parse_document(text, kind)
    except TaskError as error:
        line = str(error)
    assert line.isprintable()


@given(st.text(alphabet="[]{}:,-?&*!|>'\"%#@ \n\tab1.e=<", max_size=60), st.sampled_from(Format))
def test_random_punctuation_is_data_or_refused(text: str, kind: Format) -> None:
    line = ""
    try:
        parse_document(text, kind)
    except TaskError as error:
        line = str(error)
    assert line.isprintable()


@given(content=st.binary(max_size=100), ending=st.sampled_from((".yaml", ".json", ".toml")))
def test_random_bytes_are_refused(
    content: bytes, ending: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / f"random{ending}"
    path.write_bytes(content)
    with pytest.raises(TaskError):
        load_task(path)


def test_refuses_what_is_no_file(tmp_path: Path) -> None:
    def line(path: str | Path) -> str:
        with pytest.raises(TaskError) as caught:
            load_task(path)
        return str(caught.value).replace(f"{tmp_path}/", "")

    assert line(tmp_path / "a.yaml") == "a.yaml: cannot be read: No such file or directory"
    (tmp_path / "b.yaml").mkdir()
    assert line(tmp_path / "b.yaml") == "b.yaml: cannot be read: Is a directory"
    os.mkfifo(tmp_path / "c.yaml")
    assert line(tmp_path / "c.yaml") == "c.yaml: cannot be read: Is no regular file"
    (tmp_path / "d.yaml").symlink_to("/dev/zero")
    assert line(tmp_path / "d.yaml") == "d.yaml: cannot be read: Is no regular file"
    (tmp_path / "e.yaml").write_bytes(b"a: \xff")
    assert line(tmp_path / "e.yaml") == "e.yaml: is not UTF-8 at byte 3"
    (tmp_path / "f.yaml").write_bytes("a: 1".encode("utf-16"))
    assert line(tmp_path / "f.yaml") == "f.yaml: is not UTF-8 at byte 0"
    (tmp_path / "g.yaml").write_bytes(b"")
    assert line(tmp_path / "g.yaml") == "g.yaml: is empty"
    (tmp_path / "h.yaml").write_text("- 1")
    assert line(tmp_path / "h.yaml") == "task: must be a mapping, not a list of 1"
    assert line(tmp_path / "i") == "i: must end in .yaml, .json or .toml, not ''"
    assert line("a\0.yaml").endswith("cannot be read: embedded null byte")
    with (tmp_path / "j.json").open("wb") as file:
        file.truncate(MAX_BYTES + 1)
    assert line(tmp_path / "j.json") == "j.json: must be 64 MiB or less"


def test_a_byte_order_mark_is_legal(tmp_path: Path) -> None:
    task = named_task("flat-floor")
    for kind in Format:
        path = tmp_path / f"a{kind.value[0]}"
        path.write_text(format_task(task, kind), encoding="utf-8-sig")
        assert load_task(path) == task


HOSTILE = {
    "deep-list.json": "'[' * 10**6",
    "deep-mapping.json": "'{\"a\":' * 10**5",
    "deep-list.yaml": "'[' * 10**6",
    "deep-mapping.yaml": "'{a: ' * 10**6",
    "deep-block.yaml": "'\\n'.join(' ' * i + '-' for i in range(5000))",
    "deep-dashes.yaml": "'- ' * 10**6",
    "deep-list.toml": "'a = ' + '[' * 10**6",
    "deep-inline.toml": "'a = ' + '{a = ' * 10**5",
    "dotted.toml": "'.'.join(['a'] * 10**6) + ' = 1'",
    "quoted.toml": "'.'.join(['\"a\"'] * 10**6) + ' = 1'",
    "header.toml": "'[' + '.'.join(['a'] * 10**6) + ']'",
    "many-lists.json": "'[' + '[],' * 10**7 + '[]]'",
    "many-lists.yaml": "'[' + '[],' * 10**7 + '[]]'",
    "aliases.yaml": "'a: &a [x, x]\\n' + ''.join(f'{i}: &{i} [*a, *a]\\n' for i in range(99))",
    "long-key.yaml": "'a' * 10**7 + ': 1'",
    "long-key.json": "'{\"' + 'a' * 10**7 + '\": 1}'",
    "long-word.json": "'{\"version\": \"' + 'a' * 10**7 + '\"}'",
    "long-number.yaml": "'version: ' + '1' * 10**7",
    "long-number.json": "'{\"version\": ' + '1' * 10**7 + '}'",
    "questions.yaml": "'? ' * 10**6",
    "spaces.yaml": "' ' * 10**7 + '['",
    "words.toml": "'a ' * 10**6",
    "word.toml": "'a' * 10**7",
    "quotes.toml": "'\"a\" ' * 10**6",
}


bounds_memory = pytest.mark.skipif(
    "libasan" in os.environ.get("LD_PRELOAD", ""),
    reason="the address sanitizer reserves more addresses than the bound",
)


@bounds_memory
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused_soon(name: str, tmp_path: Path) -> None:
    """With a bound on memory, in a process of its own."""
    path = tmp_path / name
    script = f"""
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (3 * 2**30, 3 * 2**30))
        from preimage.errors import TaskError
        from preimage.task import load_task
        open({str(path)!r}, "w").write({HOSTILE[name]})
        try:
            load_task({str(path)!r})
        except TaskError as error:
            print(error)
    """
    began = time.monotonic()
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1
    assert time.monotonic() - began < 60


@bounds_memory
@pytest.mark.parametrize("kind", Format)
def test_a_hall_of_a_hundred_thousand_vertices_is_read(kind: Format, tmp_path: Path) -> None:
    path = tmp_path / f"hall{kind.value[0]}"
    path.write_text(format_task(named_task("hall-20000"), kind))
    script = f"""
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (3 * 2**30, 3 * 2**30))
        from preimage.task import load_task
        print(len(load_task({str(path)!r}).workspace.obstacles))
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert done.stdout == "20000\n"


def test_dumped_data_is_json() -> None:
    for name in ("peg-in-hole", "l-room"):
        data = dump_task(named_task(name))
        assert json.loads(json.dumps(data, allow_nan=False)) == data
