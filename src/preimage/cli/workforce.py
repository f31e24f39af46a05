"""Who does the work: options that commands with many plans to make share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

from preimage.jobs import workforce as workforce

Function = TypeVar("Function", bound=Callable[..., Any])

MOST_WORKERS = 1_024


def workforce_options(function: Function) -> Function:
    """The options `--workers` and `--scheduler`."""
    workers = click.option(
        "--workers",
        type=click.IntRange(1, MOST_WORKERS),
        metavar="N",
        help="Processes that share the work; one on each processor by default.",
    )
    scheduler = click.option(
        "--scheduler",
        metavar="ADDRESS",
        help="Share the work among the workers of a Dask scheduler: tcp://HOST:PORT.",
    )
    return workers(scheduler(function))
