from pathlib import Path

import pytest
from hypothesis import given, settings

from preimage.task import (
    Format,
    Task,
    dump_task,
    format_task,
    load_task,
    named_task,
    named_tasks,
    parse_task,
    save_task,
)
from preimage.task.documents import parse_document
from tests.task.strategies import tasks

NAMES = [*named_tasks(), "comb-3", "saw-tooth-5", "hall-7"]


@settings(max_examples=150)
@given(tasks)
def test_dumped_data_is_the_task(task: Task) -> None:
    data = dump_task(task)
    again = parse_task(data)
    assert again == task
    assert dump_task(again) == data


@pytest.mark.parametrize("kind", Format)
@settings(max_examples=60)
@given(task=tasks)
def test_text_is_the_task(kind: Format, task: Task) -> None:
    text = format_task(task, kind)
    again = parse_task(parse_document(text, kind))
    assert again == task
    assert format_task(again, kind) == text


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("ending", [ending for kind in Format for ending in kind.value])
def test_files_keep_named_tasks(name: str, ending: str, tmp_path: Path) -> None:
    task = named_task(name)
    path = tmp_path / f"file{ending}"
    save_task(task, path)
    assert load_task(path) == task
    first = path.read_bytes()
    save_task(load_task(path), path)
    assert path.read_bytes() == first


def test_files_are_for_people() -> None:
    text = format_task(named_task("peg-in-hole"), Format.YAML)
    assert text.startswith(
        "version: 1\n"
        "name: peg-in-hole\n"
        "window: [-10, -6, 10, 10]\n"
        "walls: []\n"
        "robot: {polygon: [[-0.5, 0], [0.5, 0], [0.5, 2], [-0.5, 2]], reference: [0, 0]}\n"
    )
    assert "uncertainty: {control: 5, position: 0.3, force: {angle: 10," in text


def test_a_file_names_its_task(tmp_path: Path) -> None:
    path = tmp_path / "my task.yaml"
    path.write_text(
        "version: 1\nwindow: [0, 0, 9, 9]\nuncertainty: {control: 0, position: 0}\n"
        "initial: everywhere\ngoal: {points: [[0, 0]]}\n"
    )
    assert load_task(path).name == "my task"


def test_refuses_to_write_where_it_cannot(tmp_path: Path) -> None:
    task = named_task("flat-floor")
    with pytest.raises(Exception, match="cannot be written: No such file or directory"):
        save_task(task, tmp_path / "missing" / "file.yaml")
    with pytest.raises(Exception, match=r"must end in \.yaml, \.json or \.toml"):
        save_task(task, tmp_path / "file.txt")
    assert not list(tmp_path.iterdir())
