"""A task: a score of a match, whatever its game is, by a function of the user that can end the match."""
