"""Finding a strategy."""
