"""The simulation host: server, match, referee, sensing, actuation and physics of one match.

It receives commands and actions, and publishes sights, the true state of the world, and events. It knows neither the
code of the teams nor coaches nor recordings.
"""
