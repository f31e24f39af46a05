"""Carrying plans out: executor, simulator, adversaries (theory 2, 3, 5, 8; paper 3)."""
