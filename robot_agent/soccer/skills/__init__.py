"""Skills with the ball, one a file: pure functions from a robot's state to a drive or command, in the team frame."""
