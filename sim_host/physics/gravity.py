"""The one number that the engine, the kicks and the wheels share."""

GRAVITY = 9.81
"""m/s², simatch world file."""
