"""Tasks: match files with a score, played from many seeds; those that ship are in `touchline/tasks`."""
