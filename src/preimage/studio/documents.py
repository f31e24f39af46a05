"""Files that come and go: named tasks, task files, pictures and films."""

from __future__ import annotations

import base64
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from preimage.errors import InputError
from preimage.execution.control import CONTROLS
from preimage.execution.runs import RunOptions, trace_of
from preimage.execution.sensing import SENSINGS
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import drawable, needed, strategy_of, task_of, whole, word
from preimage.task.documents import Format, parse_document
from preimage.task.examples import named_data, named_tasks
from preimage.task.files import dump_task, format_task
from preimage.task.template import parse_template

FORMATS = {kind.name.lower(): kind for kind in Format}

PICTURES = {"svg": "image/svg+xml", "png": "image/png", "pdf": "application/pdf"}

FILMS = {"gif": "image/gif", "html": "text/html"}

MOST_TEXT = 2**20
"""Characters of a file that is read."""


def examples(body: Body, tell: Tell) -> Body:
    """The named tasks."""
    return {"examples": [{"name": name, "words": words} for name, words in named_tasks().items()]}


def example(body: Body, tell: Tell) -> Body:
    """One of them."""
    name = word(body, "name", list(named_tasks()))
    return {"task": dump_task(parse_template(named_data(name), name=name).task())}


def read(body: Body, tell: Tell) -> Body:
    """The task of a file's text, its named numbers filled in."""
    text = needed(body, "text")
    if not isinstance(text, str) or len(text) > MOST_TEXT:
        raise InputError("text", f"must be a text of at most {MOST_TEXT} characters")
    data = parse_document(text, FORMATS[word(body, "format", FORMATS)])
    return {"task": dump_task(parse_template(data, name="task").task())}


def write(body: Body, tell: Tell) -> Body:
    """The text of a task's file."""
    kind = word(body, "format", FORMATS, "yaml")
    task = task_of(body)
    return {"name": f"{_stem(task.name)}.{kind}", "text": format_task(task, FORMATS[kind])}


def drawn(body: Body, tell: Tell) -> Body:
    """A picture of a task or of a plan."""
    from preimage.rendering import draw

    kind = word(body, "format", PICTURES, "svg")
    planned = body.get("plan") is not None
    subject = strategy_of(body) if planned else task_of(body)
    name = subject.task.name if planned else subject.name  # type: ignore[union-attr]
    return _file(name, kind, PICTURES[kind], lambda path: draw(subject, path))


def filmed(body: Body, tell: Tell) -> Body:
    """A film of one run."""
    from preimage.rendering import animate

    kind = word(body, "format", FILMS, "gif")
    strategy = strategy_of(body, solved=True)
    drawable(strategy.space)
    pair = (
        word(body, "control", list(CONTROLS), "hunting"),
        word(body, "sensing", list(SENSINGS), "towards"),
    )
    options = RunOptions(seed=whole(body, "seed", 0, 0, 2**31))
    made = trace_of(strategy, pair, whole(body, "number", 0, 0, 2_000), options=options)
    return _file(strategy.task.name, kind, FILMS[kind], lambda path: animate(made, path))


def _file(name: str, kind: str, media: str, make: Callable[[Path], None]) -> Body:
    """What is made, in base64; nothing of it stays on the disk."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"made.{kind}"
        make(path)
        content = base64.b64encode(path.read_bytes()).decode("ascii")
    return {"name": f"{_stem(name)}.{kind}", "media": media, "base64": content}


def _stem(name: str) -> str:
    """A name for a file: letters, digits and dashes of a task's name."""
    kept = "".join(letter if letter.isalnum() or letter in "-_" else "-" for letter in name)
    return kept.strip("-")[:60] or "task"
