"""The state of the game: restarts, decisions, set pieces, participation, clocks."""
