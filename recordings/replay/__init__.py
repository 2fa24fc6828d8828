"""Replays recordings on the bus: a player with its controls, and a host that publishes its messages."""
