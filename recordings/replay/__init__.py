"""Recordings back onto the bus: a tape that is wound, a player with its controls, and a host that speaks for it."""
