"""The command `preimage`."""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
import traceback
from collections.abc import Sequence
from typing import NoReturn

import click

from preimage.cli.command import write_examples
from preimage.cli.output import RefusalError, mute, note

SOLVED, UNSOLVED, REFUSED = 0, 1, 2
"""Exit statuses (files.md)."""

FAILED, INTERRUPTED = 70, 130
"""Exit statuses of a defect of this program, and of one that was told to end at once."""

COMMANDS: dict[str, str] = {
    "plan": "preimage.cli.planning",
    "run": "preimage.cli.execution",
    "export": "preimage.cli.exporting",
    "verify": "preimage.cli.verification",
    "check": "preimage.cli.inspection",
    "draw": "preimage.cli.drawing",
    "backproject": "preimage.cli.stages",
    "kernel": "preimage.cli.stages",
    "preimage": "preimage.cli.stages",
    "directions": "preimage.cli.directions",
    "budget": "preimage.cli.budget",
    "explain": "preimage.cli.explain",
    "studio": "preimage.cli.studio",
    "examples": "preimage.cli.inspection",
    "import": "preimage.cli.importing",
    "schema": "preimage.cli.inspection",
    "completion": "preimage.cli.completion",
}
"""The commands and their modules, which are loaded when they are needed."""


class Commands(click.Group):
    """A group whose commands are loaded when they are asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names, in the order of the table."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """A command by its name."""
        if cmd_name not in COMMANDS:
            return None
        command = getattr(importlib.import_module(COMMANDS[cmd_name]), f"{cmd_name}_command")
        assert isinstance(command, click.Command)
        return command

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Where to begin."""
        write_examples(["preimage plan --example peg-in-hole --figure plan.svg"], formatter)
        super().format_epilog(ctx, formatter)


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(package_name="preimage", prog_name="preimage")
def commands() -> None:
    """Plan robot motions that succeed in spite of errors in control and sensing.

    Exit status: 0 solved, 1 not solved, 2 bad input.
    """


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command and end the process with its exit status."""
    status = run(arguments)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            try:
                stream.flush()
            except OSError:
                mute(stream)
    sys.exit(status)


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; its exit status."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(AttributeError, OSError, ValueError):
            # a stream that is None or no TextIOWrapper lacks it, which is suppressed above
            stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    try:
        status = commands.main(arguments, prog_name="preimage", standalone_mode=False)
    except RefusalError as refusal:
        note(f"preimage: {refusal}")
        return REFUSED
    except click.exceptions.NoArgsIsHelpError as error:
        note(error.format_message())
        return REFUSED
    except click.ClickException as error:
        note(f"preimage: {_usage(error)}")
        return REFUSED
    except (click.Abort, KeyboardInterrupt):
        note("preimage: interrupted")
        return INTERRUPTED
    except MemoryError:
        note("preimage: there is not enough memory")
        return FAILED
    except SystemExit:  # click has printed, and nobody listened
        return SOLVED
    except Exception:
        note(f"{traceback.format_exc()}preimage: this is a defect of the program")
        return FAILED
    return status if isinstance(status, int) else SOLVED


def _usage(error: click.ClickException) -> str:
    """A refusal by click, on one line."""
    from preimage.errors import one_line

    message = error.format_message().replace(os.linesep, " ").rstrip(".")
    context = getattr(error, "ctx", None)
    help_ = f" (see {context.command_path} --help)" if context is not None else ""
    return one_line(message) + help_


if __name__ == "__main__":
    main()
