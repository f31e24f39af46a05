"""`preimage completion`."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from preimage.cli.command import Command
from preimage.cli.output import say

VARIABLE = "_PREIMAGE_COMPLETE"
"""The environment variable by which a shell asks."""

SHELLS = ("bash", "zsh", "fish")


@click.command(
    "completion",
    cls=Command,
    short_help="Print the script for completion in a shell.",
    examples=[
        'eval "$(preimage completion bash)"       # in ~/.bashrc',
        'eval "$(preimage completion zsh)"        # in ~/.zshrc, after compinit',
        "preimage completion fish | source        # in ~/.config/fish/config.fish",
    ],
)
@click.argument("shell", type=click.Choice(SHELLS))
def completion_command(shell: str) -> int:
    """Print the script that completes commands, options and named tasks in SHELL."""
    kind = get_completion_class(shell)
    assert kind is not None
    script = kind(click.get_current_context().find_root().command, {}, "preimage", VARIABLE)
    say(script.source())
    return 0
