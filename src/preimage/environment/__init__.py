"""Any task as a Gymnasium environment, so that learners and solvers meet the same nature.

An import of this room is all that `gymnasium.make` needs; `preimage.environment:NAME` does it too.
"""

from preimage.environment.registration import NAME, register

__all__ = ["NAME", "register"]

register()
