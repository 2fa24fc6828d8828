"""Gravity, as the engine, the kicks and the wheels use it."""

GRAVITY = 9.81
"""m/s², as in the world file of nubot-nu's simatch."""
