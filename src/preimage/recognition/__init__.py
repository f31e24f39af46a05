"""What a motion can tell: readings, kernels, termination conditions."""
