"""Many matches: a plan of matches, executors that play them, and a store of their outcomes."""
