"""Words of soccer: the states of its game."""
