"""The simulation host: the loop, the world, bodies, actuation, sensing, radio, referee.

Knows nothing of teams' code, of coaches or of files: it takes commands and actions, and gives sights, truth and events.
"""
