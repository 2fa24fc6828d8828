"""The resolution of the sensors."""

DIGITS = 4
"""Decimal places of all perceived numbers: 0.1 mm is below any sensor's noise, and halves the bytes of a sight."""
