"""How finely sensors read."""

DIGITS = 4
"""Behind the point, of all perceived numbers: 0.1 mm is below any sensor's noise, and half the bytes of a sight."""
