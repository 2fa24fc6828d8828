"""Skills, one a file: pure functions from a robot's state and a setpoint to a drive; all in the team frame."""
