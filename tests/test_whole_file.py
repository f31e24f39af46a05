import os
import threading
from pathlib import Path

import pytest

from preimage.whole_file import write_whole, written_whole


def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    path.write_text("old")

    def fail() -> None:
        with written_whole(path) as target:
            target.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fail()
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["plan.json"]


def test_new_files_get_the_usual_permissions(tmp_path: Path) -> None:
    plain, whole = tmp_path / "plain", tmp_path / "whole"
    plain.write_text("")
    write_whole(whole, "ü\n")
    assert whole.stat().st_mode == plain.stat().st_mode
    assert whole.read_bytes() == b"\xc3\xbc\n"


def test_a_pipe_is_written_to_and_stays_one(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(path.read_text()))
    reader.start()
    write_whole(path, "text")
    reader.join(10)
    assert read == ["text"]
    assert path.is_fifo()


def test_directories_are_no_files(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="Is a directory"):
        write_whole(tmp_path, "text")
    assert os.listdir(tmp_path) == []
