"""Formats of tournaments: pure functions from the teams and the results so far to the fixtures that are known."""
