"""How Gymnasium comes to know the environment."""

from __future__ import annotations

import gymnasium

NAME = "preimage/GuardedMotion-v0"
"""By which `gymnasium.make` knows it."""


def register() -> None:
    """Make the environment known to `gymnasium.make`."""
    if NAME not in gymnasium.registry:
        gymnasium.register(NAME, entry_point="preimage.environment.guarded:GuardedMotion")
