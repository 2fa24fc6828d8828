"""The game as the referee remembers it: state, restarts, decisions, set pieces, participation, clocks."""
