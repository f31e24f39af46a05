"""Robot motion planning with uncertainty in control and sensing, by preimage backchaining."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    __version__: str

# The public names and the module that each lives in: loaded when first asked for, so that
# `import preimage` costs nothing. Whoever reads types sees them above.
_HOMES: dict[str, str] = {}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> object:
    """Load a public name from its room."""
    value: object
    if name == "__version__":
        value = import_module("importlib.metadata").version("preimage")
    elif name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
    else:
        raise AttributeError(f"module 'preimage' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names."""
    return sorted({*globals(), *__all__})
