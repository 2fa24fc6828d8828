"""Recordings back onto the bus: a cursor that seeks, a player with its controls, and a host that speaks for it."""
