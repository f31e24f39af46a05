"""Doors in and out: drawings and maps to tasks, plans to other programs' files."""
