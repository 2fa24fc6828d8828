"""A tournament: teams, a format and a table; the matches of its plan are played by `touchline.matches.engine`."""
