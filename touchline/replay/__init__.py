"""A recording back on the bus: keys that control it, its progress, and robots played by it (ghosts)."""
