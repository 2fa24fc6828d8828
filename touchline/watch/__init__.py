"""The match drawn in a terminal: pure functions from what is known and a size to lines."""
