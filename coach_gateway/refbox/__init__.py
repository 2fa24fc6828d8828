"""The league's referee box: our teams as its base stations, and our referee in its place. Knows the bus, no physics.

Its protocols are those of the league's program RefBox: JSON ended by a zero byte since 2020, single characters before.
"""

DEFAULT_PORT = 28097
"""The port on which RefBox listens for base stations."""
