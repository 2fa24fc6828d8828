"""The simulation host: server, match, referee, sensing, actuation and physics of one match.

Knows nothing of teams' code, of coaches or of files: it receives commands and actions, and
publishes sights, truth and events.
"""
