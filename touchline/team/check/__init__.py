"""Checks whether a brain or a program keeps the contract of a robot: `touchline check`."""
