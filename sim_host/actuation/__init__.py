"""The actuators of the robots: drive, dribbler and kicker."""
