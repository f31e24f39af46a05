"""Reachability and recognition together."""
