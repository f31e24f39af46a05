"""Where a motion goes: backprojections and forward projections."""
