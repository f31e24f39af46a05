"""`preimage studio`."""

from __future__ import annotations

import contextlib
from typing import Any

import click

from preimage.cli.arguments import document, task_argument
from preimage.cli.arguments import load as load_source
from preimage.cli.command import Command
from preimage.cli.output import RefusalError, about, note, say
from preimage.task.files import dump_task

HOST, PORT = "127.0.0.1", 8765


@click.command(
    "studio",
    cls=Command,
    short_help="Draw, plan, run and question in the browser.",
    examples=[
        "preimage studio",
        "preimage studio task.yaml",
        "preimage studio --example peg-in-hole --port 0",
    ],
)
@task_argument
@click.option(
    "--port", default=PORT, show_default=True, metavar="N", help="0 for one that is free.",
    type=click.IntRange(0, 65535),
)  # fmt: skip
@click.option(
    "--host",
    default=HOST,
    show_default=True,
    metavar="ADDRESS",
    help="Whom to listen to; only this machine by default.",
)
@click.option("--browser/--no-browser", default=True, help="Open the page. [default: do]")
def studio_command(
    path: str | None, example: str | None, port: int, host: str, browser: bool
) -> int:
    """Open the studio, a page in the browser that this machine serves, with TASK or a plan file.

    It is served until Ctrl-C. Other machines reach it only if --host says so: there is no
    password.

    Exit status: 0 after Ctrl-C, 2 bad input.
    """
    given = None if path is None and example is None else _given(path, example)
    try:
        from preimage.studio.server import LOOPBACK, listen, serve
    except ImportError as error:
        name = (error.name or "starlette").partition(".")[0]
        raise RefusalError(f"{name} is not installed: pip install 'preimage[studio]'") from None
    with about(f"{host}:{port}"):
        listening = listen(host, port)
    if host not in LOOPBACK:
        note(f"preimage: {host} can be reached by other machines, and there is no password")
    with contextlib.suppress(KeyboardInterrupt):
        serve(
            listening,
            given,
            browser=browser,
            ready=lambda address: say(f"the studio is at {address} until Ctrl-C"),
        )
    return 0


def _given(path: str | None, example: str | None) -> dict[str, Any]:
    """What the page begins with: a task, or a plan with its task."""
    if path is not None and example is None:
        data, _name = document(path)
        if isinstance(data, dict) and "regions" in data and "task" in data:
            from preimage.strategy.plan_file import plan_to_dict, read_plan

            with about(path):
                return {"plan": plan_to_dict(read_plan(data))}
    return {"task": dump_task(load_source(path, example).task)}
