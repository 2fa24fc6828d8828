"""A match in one process, without a network."""
