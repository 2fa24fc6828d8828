"""Skills of motion, one a file: pure functions from a robot's state and a setpoint to a drive, in the team frame."""
