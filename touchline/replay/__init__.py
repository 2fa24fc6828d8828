"""Replays a recording on the bus: control keys, progress display, and robots that repeat it (ghosts)."""
