"""The league's referee box: our teams as its base stations, and our referee in its place. Knows the bus, no physics.

Its protocols are those of reference 9: JSON ended by a zero byte since 2020, single characters before.
"""

DEFAULT_PORT = 28097
"""Where teams' base stations meet the box (reference 9.1)."""
