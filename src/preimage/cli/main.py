"""The command `preimage`."""

from __future__ import annotations

import click


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="preimage", prog_name="preimage")
def main() -> None:
    """Plan robot motions that succeed in spite of errors in control and sensing."""
