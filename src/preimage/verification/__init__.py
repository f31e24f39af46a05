"""Whether a strategy is true, by code of its own."""
