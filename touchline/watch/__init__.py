"""The match drawn in a terminal: pure functions from match state and size to lines."""
