"""The league's referee box: our teams as its base stations, and our referee in its place. Knows the bus, not physics.

The box's protocols are JSON ended by a zero byte since 2020, and single characters before.
"""

DEFAULT_PORT = 28097
"""The port of the league's box that base stations connect to."""
