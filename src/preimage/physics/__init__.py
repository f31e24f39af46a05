"""Plans carried out in an engine that nobody here wrote: MuJoCo (theory 2, 3)."""
